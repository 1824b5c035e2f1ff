// Centroid and inertia against closed forms.
#include "kernel/check/mass.h"

#include <boost/test/unit_test.hpp>

#include "tests/support/builders.h"

using namespace trimloop;

namespace {

void close(double got, double wanted, double scale) { BOOST_TEST(std::abs(got - wanted) <= 1e-10 * scale); }

}  // namespace

BOOST_AUTO_TEST_CASE(solids_have_their_closed_moments) {
  const MassProperties b = mass_properties(test::box({1, 2, 3}, {3, 5, 7}), ShellId{0}).value();  // 2 x 3 x 4
  close(b.measure, 24, 24);
  BOOST_TEST(distance(b.centroid, {2, 3.5, 5}) < 1e-12);
  close(b.moments.xx, 24 * 4 / 12.0, 100);
  close(b.moments.yy, 24 * 9 / 12.0, 100);
  close(b.moments.zz, 24 * 16 / 12.0, 100);
  close(b.moments.xy, 0, 100);
  close(b.principal[0], 24 * 13 / 12.0, 100);  // about z: x^2 + y^2
  close(b.principal[2], 24 * 25 / 12.0, 100);
  BOOST_TEST(std::abs(std::abs(b.axes[0].z) - 1) < 1e-12);

  const MassProperties c = mass_properties(test::cylinder({1, 1, 1}, 2, 5), ShellId{0}).value();
  const double m = pi * 4 * 5;
  close(c.measure, m, m);
  BOOST_TEST(distance(c.centroid, {1, 1, 3.5}) < 1e-10);
  close(c.inertia[2][2], m * 4 / 2, m * 25);
  close(c.inertia[0][0], m * (3 * 4 + 25) / 12, m * 25);

  const MassProperties k = mass_properties(test::cone({0, 0, 0}, 2, 6), ShellId{0}).value();
  const double mk = pi * 4 * 6 / 3;
  close(k.measure, mk, mk);
  BOOST_TEST(distance(k.centroid, {0, 0, 1.5}) < 1e-10);
  close(k.inertia[2][2], 0.3 * mk * 4, mk * 36);
  close(k.inertia[0][0], mk * (3.0 / 20 * 4 + 3.0 / 80 * 36), mk * 36);

  const MassProperties s = mass_properties(test::sphere({1, 2, 3}, 2), ShellId{0}).value();
  const double ms = 4 * pi * 8 / 3;
  close(s.measure, ms, ms);
  BOOST_TEST(distance(s.centroid, {1, 2, 3}) < 1e-10);
  for (std::size_t i = 0; i < 3; ++i) close(s.principal[i], 0.4 * ms * 4, ms * 16);

  const MassProperties t = mass_properties(test::torus({0, 0, 1}, 5, 2), ShellId{0}).value();
  const double mt = 2 * pi * pi * 5 * 4;
  close(t.measure, mt, mt);
  close(t.inertia[2][2], mt * (25 + 0.75 * 4), mt * 49);
  close(t.inertia[0][0], mt * (0.5 * 25 + 0.625 * 4), mt * 49);
  BOOST_TEST(t.error <= 1e-9 * mt);
}

BOOST_AUTO_TEST_CASE(sheets_and_curves_have_theirs) {
  const Body plate = test::plate(4, 2, {{1, 1, 0.5}});
  const MassProperties p = mass_properties(plate, FaceId{0}).value();
  const double hole = pi * 0.25, m = 8 - hole;
  close(p.measure, m, m);
  BOOST_TEST(distance(p.centroid, {(8 * 2 - hole) / m, 1, 0}) < 1e-11);
  const double about_hole = hole * (0.0625 + 1);  // of x^2 about the origin
  close(p.moments.xx, 8 * 16 / 3.0 - about_hole - m * p.centroid.x * p.centroid.x, 50);
  const MassProperties dome = mass_properties(test::sphere({0, 0, 0}, 3), FaceId{0}).value();
  close(dome.measure, 36 * pi, 36 * pi);
  close(dome.principal[0], 2.0 / 3 * 36 * pi * 9, 36 * pi * 9);

  const MassProperties l = mass_properties(Curve{Line{{0, 0, 0}, {4, 0, 0}}}).value();
  close(l.measure, 4, 4);
  close(l.moments.xx, 16.0 / 3, 16);
  const MassProperties arc = mass_properties(Curve{Circle{{}, 2, {0, pi}}}).value();
  close(arc.measure, 2 * pi, 2 * pi);
  BOOST_TEST(distance(arc.centroid, {0, 4 / pi, 0}) < 1e-11);
  const MassProperties ring = mass_properties(Curve{Circle{{}, 2}}).value();
  close(ring.inertia[2][2], 4 * pi * 4, 50);
  BOOST_TEST(!mass_properties(Curve{Line{{0, 0, 0}, {1, 0, 0}, {0, infinity}}}).has_value());
}
