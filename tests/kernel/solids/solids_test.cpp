// Primitives and sweeps against the formulas of their volumes and areas; every structural promise holds.
#include <boost/test/unit_test.hpp>

#include "kernel/check/measure.h"
#include "kernel/solids/primitives.h"
#include "kernel/solids/sweep.h"

using namespace trimloop;

namespace {

const Frame tilted = make_frame({3, -2, 5}, {1, 2, 3}, {1, 0, 0});

void check_solid(const Result<Body>& body, double volume_mm3, double area_mm2, std::size_t faces) {
  BOOST_REQUIRE_MESSAGE(body, body.error().text);
  BOOST_TEST((body->kind == BodyKind::Solid));
  BOOST_TEST(body->faces.size() == faces);
  for (const Face& f : body->faces) BOOST_TEST((f.status == FaceStatus::Ok), f.reason);
  for (const std::string& broken : broken_promises(*body, 1e-6)) BOOST_ERROR(broken);
  const auto v = volume(*body, ShellId{0}, 1e-11);
  BOOST_REQUIRE(v);
  BOOST_TEST(std::abs(v->value - volume_mm3) <= 1e-9 * volume_mm3, "volume " << v->value << " is not " << volume_mm3);
  double sum = 0;
  for (std::uint32_t f = 0; f < body->faces.size(); ++f) sum += area(*body, FaceId{f}, 1e-11).value;
  if (area_mm2 > 0) BOOST_TEST(std::abs(sum - area_mm2) <= 1e-9 * area_mm2, "area " << sum << " is not " << area_mm2);
}

Curve line(Point a, Point b) { return {Line{a, b, {0, 1}}}; }

}  // namespace

BOOST_AUTO_TEST_CASE(primitives_have_their_volumes) {
  for (const Frame& f : {Frame{}, tilted}) {
    check_solid(make_block(f, 2, 3, 4), 24, 52, 6);
    check_solid(make_wedge(f, 4, 3, 2, 1), 15, 2 * 7.5 + 2 * (4 + 3 + 1 + std::sqrt(18.0)), 6);
    check_solid(make_wedge(f, 4, 3, 2, 0), 12, 2 * 6 + 2 * 12, 5);
    check_solid(make_cylinder(f, 2, 5), 20 * pi, 28 * pi, 3);
    check_solid(make_cone(f, 3, 1, 4), pi * 4 / 3 * 13, pi * (10 + 4 * std::sqrt(20.0)), 3);
    check_solid(make_cone(f, 3, 0, 4), 12 * pi, 24 * pi, 2);
    check_solid(make_cone(f, 2, 2, 5), 20 * pi, 28 * pi, 3);
    check_solid(make_sphere(f, 3), 36 * pi, 36 * pi, 1);
    check_solid(make_torus(f, 5, 2), 40 * pi * pi, 40 * pi * pi, 1);
    check_solid(make_ellipsoid(f, 4, 3, 2), 32 * pi, 0, 1);
  }
}

BOOST_AUTO_TEST_CASE(primitives_without_size_are_refused) {
  BOOST_TEST(!make_block({}, 1, 0, 1));
  BOOST_TEST(!make_sphere({}, -1));
  BOOST_TEST(!make_torus({}, 1, 1));
  BOOST_TEST(!make_cone({}, 1, -1, 1));
}

BOOST_AUTO_TEST_CASE(sweeps_follow_their_profiles) {
  // A half disc with a straight side, pushed at an angle: its base times its height.
  const Profile half{Curve{Circle{Frame{}, 2, {0, pi}}}, line({-2, 0, 0}, {2, 0, 0})};
  check_solid(extrude(half, {1, 1, 3}, 1e-6), 2 * pi * 3, 0, 4);
  check_solid(extrude(half, {0, 0, -3}, 1e-6), 2 * pi * 3, 4 * pi + 6 * pi + 12, 4);
  // The same about its straight side: a ball; in parts, a slice of it.
  const Frame upright = make_frame({}, {0, -1, 0}, {0, 0, 1});
  const Profile arc{Curve{Circle{upright, 2, {-pi, 0}}}};  // from -z over +-x to +z
  const Point middle = evaluate(arc[0], -pi / 2);
  BOOST_TEST(std::abs(std::abs(middle.x) - 2) < 1e-12);
  check_solid(revolve(arc, {{}, {0, 0, 1}}, two_pi, true, 1e-6), 32.0 / 3 * pi, 16 * pi, 1);
  check_solid(revolve(arc, {{}, {0, 0, 1}}, pi / 2, true, 1e-6), 8.0 / 3 * pi, 4 * pi + 4 * pi, 3);
  // A square beside the axis.
  const Profile square{line({2, 0, 0}, {3, 0, 0}), line({3, 0, 0}, {3, 0, 1}), line({3, 0, 1}, {2, 0, 1}),
                       line({2, 0, 1}, {2, 0, 0})};
  check_solid(revolve(square, {{}, {0, 0, 1}}, two_pi, false, 1e-6), 5 * pi, 20 * pi, 4);
  check_solid(revolve(square, {{}, {0, 0, 1}}, pi, false, 1e-6), 2.5 * pi, 10 * pi + 2, 6);
  // With a hollow corner: a quarter of a tube's section is missing.
  const Profile hollow{line({2, 0, 0}, {3, 0, 0}), line({3, 0, 0}, {3, 0, 1}),
                       Curve{Circle{Frame{{3, 0, 1.5}, {0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}, 0.5, {0, pi / 2}}},
                       line({2.5, 0, 1.5}, {2, 0, 1.5}), line({2, 0, 1.5}, {2, 0, 0})};
  const double missing = pi / 16, centroid = 3 - 4 * 0.5 / (3 * pi);  // Pappus
  check_solid(revolve(hollow, {{}, {0, 0, 1}}, two_pi, false, 1e-6), 7.5 * pi - two_pi * centroid * missing, 0, 5);
  // A circle beside it: a torus.
  const Profile ring{Curve{Circle{make_frame({5, 0, 0}, {0, 1, 0}, {1, 0, 0}), 2, {0, two_pi}}}};
  check_solid(revolve(ring, {{}, {0, 0, 1}}, two_pi, false, 1e-6), 40 * pi * pi, 40 * pi * pi, 1);
  check_solid(revolve(ring, {{}, {0, 0, 1}}, 1, false, 1e-6), 20 * pi, 20 * pi + 8 * pi, 3);
}

BOOST_AUTO_TEST_CASE(profiles_that_enclose_nothing_are_refused) {
  const Profile open{line({0, 0, 0}, {1, 0, 0}), line({1, 0, 0}, {1, 1, 0})};
  BOOST_TEST(!extrude(open, {0, 0, 1}, 1e-6));
  const Profile triangle{line({0, 0, 0}, {1, 0, 0}), line({1, 0, 0}, {1, 1, 0}), line({1, 1, 0}, {0, 0, 0})};
  BOOST_TEST(!extrude(triangle, {1, 1, 0}, 1e-6));
  BOOST_TEST(!revolve(triangle, {{0.5, -1, 0}, {0, 1, 0}}, two_pi, false, 1e-6));  // crosses the axis
  BOOST_TEST(!revolve(triangle, {{-1, 0, 0}, {0, 0, 1}}, two_pi, false, 1e-6));    // not in a plane with it
  BOOST_TEST(!revolve(triangle, {{-1, 0, 0}, {0, 1, 0}}, 0, false, 1e-6));
}
