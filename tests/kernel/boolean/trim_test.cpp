// Sheets trimmed by bodies, open and closed, against closed forms of their areas.
#include <boost/test/unit_test.hpp>

#include "kernel/boolean/boolean.h"
#include "kernel/check/measure.h"
#include "kernel/heal/make_face.h"
#include "kernel/solids/primitives.h"

using namespace trimloop;

namespace {

Body sheet(Surface s, Interval u, Interval v) {
  Body body;
  heal::FaceInput input;
  input.surface = std::make_shared<const Surface>(std::move(s));
  input.range_u = u, input.range_v = v;
  heal::add_face(body, input);
  return body;
}
Body spline_sheet(const Surface& s, Interval u, Interval v) {
  auto n = to_nurbs(s, u, v);
  const Interval a = n->surface.range_u(), b = n->surface.range_v();
  return sheet(Surface{std::move(n->surface)}, a, b);
}

double area_of(const Body& sheet, const Body& tool, TrimSide side, std::size_t faces) {
  const auto r = trim(sheet, tool, side);
  BOOST_REQUIRE_MESSAGE(r, r.error().text);
  double sum = 0;
  std::size_t n = 0;
  for (const Body& b : r->bodies) {
    for (const std::string& broken : broken_promises(b, 1e-6)) BOOST_ERROR(broken);
    n += b.faces.size();
    for (std::uint32_t f = 0; f < b.faces.size(); ++f) sum += area(b, FaceId{f}, 1e-10).value;
  }
  BOOST_TEST(n == faces);
  return sum;
}
void check(double value, double wanted) { BOOST_TEST(std::abs(value - wanted) <= 1e-8 * wanted, value << " is not " << wanted); }

}  // namespace

BOOST_AUTO_TEST_CASE(a_plate_is_trimmed_by_solids) {
  const Body plate = sheet(Surface{Plane{Frame{}}}, {-2, 2}, {-2, 2});
  const Body ball = *make_sphere(Frame{}, 1), box = *make_block(Frame{{0, 0, -1}}, 1, 1, 2);
  check(area_of(plate, ball, TrimSide::Inside, 1), pi);
  check(area_of(plate, ball, TrimSide::Outside, 1), 16 - pi);
  check(area_of(plate, ball, TrimSide::Both, 2), 16);
  check(area_of(plate, box, TrimSide::Inside, 1), 1);
  check(area_of(plate, box, TrimSide::Outside, 1), 15);
}

BOOST_AUTO_TEST_CASE(a_tube_ends_at_a_wall) {
  // An open tube through an open curved wall, both splines. The wall's normals point away from its axis: outside is there.
  const double r = 0.5;
  const Body wall = spline_sheet(Surface{Cylinder{Frame{}, 2}}, {-pi / 2, pi / 2}, {-3, 3});
  const Body tube = spline_sheet(Surface{Cylinder{make_frame({}, {1, 0, 0}, {0, 0, 1}), r}}, {0, two_pi}, {1, 4});
  const double whole = two_pi * r * 3;
  const double outside = area_of(tube, wall, TrimSide::Outside, 1), inside = area_of(tube, wall, TrimSide::Inside, 1);
  check(outside + inside, whole);
  // The height of the wall above the tube's circle, sqrt(4 - r^2 sin^2 t), summed over the circle.
  double rim = 0;
  constexpr int steps = 2000;
  for (int i = 0; i < steps; ++i) rim += r * two_pi / steps * std::sqrt(4 - std::pow(r * std::sin(two_pi * i / steps), 2));
  check(inside, rim - two_pi * r);
  // The hole in the wall.
  const double hole = area_of(wall, tube, TrimSide::Inside, 1), rest = area_of(wall, tube, TrimSide::Outside, 1);
  check(hole + rest, 2 * pi * 6);
  check(area_of(wall, tube, TrimSide::Both, 2), 2 * pi * 6);
}

BOOST_AUTO_TEST_CASE(a_sheet_that_is_not_met_stays_or_goes) {
  const Body plate = sheet(Surface{Plane{Frame{}}}, {-1, 1}, {-1, 1});
  const Body around = *make_sphere(Frame{}, 5), away = *make_sphere(Frame{{20, 0, 0}}, 1);
  check(area_of(plate, around, TrimSide::Inside, 1), 4);
  BOOST_TEST(trim(plate, around, TrimSide::Outside)->bodies.empty());
  check(area_of(plate, away, TrimSide::Outside, 1), 4);
}
