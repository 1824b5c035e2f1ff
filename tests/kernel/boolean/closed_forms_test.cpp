// Booleans of primitives against the formulas of their volumes and areas; every structural promise holds.
#include <boost/test/unit_test.hpp>

#include "kernel/boolean/boolean.h"
#include "kernel/check/measure.h"
#include "kernel/solids/primitives.h"

using namespace trimloop;

namespace {

constexpr auto unite = BooleanOperation::Union, intersect_ = BooleanOperation::Intersection, subtract = BooleanOperation::Difference;

Frame at(double x, double y, double z) { return make_frame({x, y, z}, {0, 0, 1}, {1, 0, 0}); }
Frame along(Point p, Vector axis, Vector x = {}) { return make_frame(p, axis, x); }

double volume_of(const std::vector<Body>& bodies) {
  double sum = 0;
  for (const Body& b : bodies)
    for (std::uint32_t s = 0; s < b.shells.size(); ++s) {
      const auto v = volume(b, ShellId{s}, 1e-11);
      BOOST_REQUIRE(v);
      sum += v->value;
    }
  return sum;
}
double area_of(const std::vector<Body>& bodies) {
  double sum = 0;
  for (const Body& b : bodies)
    for (std::uint32_t f = 0; f < b.faces.size(); ++f) sum += area(b, FaceId{f}, 1e-11).value;
  return sum;
}
std::size_t faces_of(const std::vector<Body>& bodies) {
  std::size_t n = 0;
  for (const Body& b : bodies) n += b.faces.size();
  return n;
}

struct Expected {
  double volume = 0;
  double area = -1;
  int faces = -1;
  int bodies = 1;
};

std::vector<Body> check(const Result<Body>& a, const Result<Body>& b, BooleanOperation op, Expected e) {
  BOOST_REQUIRE(a && b);
  const auto r = combine(*a, *b, op);
  BOOST_REQUIRE_MESSAGE(r, r.error().text);
  for (const Body& body : r->bodies)
    for (const std::string& broken : broken_promises(body, 1e-6)) BOOST_ERROR(broken);
  BOOST_TEST(r->bodies.size() == std::size_t(e.bodies));
  const double v = volume_of(r->bodies), a2 = area_of(r->bodies);
  BOOST_TEST(std::abs(v - e.volume) <= 1e-9 * std::max(e.volume, 1e-300), "volume " << v << " is not " << e.volume);
  if (e.area >= 0) BOOST_TEST(std::abs(a2 - e.area) <= 1e-8 * e.area, "area " << a2 << " is not " << e.area);
  if (e.faces >= 0) BOOST_TEST(faces_of(r->bodies) == std::size_t(e.faces));
  return r->bodies;
}

}  // namespace

BOOST_AUTO_TEST_CASE(boxes) {
  const auto a = make_block(at(0, 0, 0), 2, 2, 2), b = make_block(at(1, 1, 1), 2, 2, 2);
  check(a, b, unite, {15, 42, 12});
  check(a, b, intersect_, {1, 6, 6});
  check(a, b, subtract, {7, 24, 9});
}

BOOST_AUTO_TEST_CASE(boxes_that_share_planes) {
  const auto a = make_block(at(0, 0, 0), 2, 2, 2);
  const auto b = make_block(at(1, 0, 0), 2, 2, 2);  // four planes in common
  check(a, b, unite, {12, 32, -1});
  check(a, b, intersect_, {4, 16, 6});
  check(a, b, subtract, {4, 16, 6});
  const auto touching = make_block(at(2, 0, 0), 2, 2, 2);
  check(a, touching, unite, {16, 40, -1});
  check(a, touching, intersect_, {0, 0, 0, 0});
  check(a, touching, subtract, {8, 24, 6});
  const auto part = make_block(at(2, 0.5, 0.5), 1, 1, 1);  // on a part of a face
  check(a, part, unite, {9, 24 + 4, 11});
  check(a, part, subtract, {8, 24, 6});
  const auto pocket = make_block(at(0.5, 0.5, 1), 1, 1, 1);  // shares the top plane
  check(a, pocket, subtract, {7, 24 + 4, 11});
  check(a, pocket, unite, {8, 24, 6});
  check(a, a, unite, {8, 24, 6});
  check(a, a, intersect_, {8, 24, 6});
  check(a, a, subtract, {0, 0, 0, 0});
}

BOOST_AUTO_TEST_CASE(contained_and_disjoint) {
  const auto a = make_block(at(0, 0, 0), 4, 4, 4), b = make_sphere(at(2, 2, 2), 1);
  check(a, b, unite, {64, 96, 6});
  check(a, b, intersect_, {4 * pi / 3, 4 * pi, 1});
  const auto hollow = check(a, b, subtract, {64 - 4 * pi / 3, 96 + 4 * pi, 7});
  BOOST_TEST(hollow.front().shells.size() == 2u);
  check(b, a, subtract, {0, 0, 0, 0});
  const auto far = make_sphere(at(20, 0, 0), 1);
  check(a, far, unite, {64 + 4 * pi / 3, 96 + 4 * pi, 7, 2});
  check(a, far, intersect_, {0, 0, 0, 0});
  check(a, far, subtract, {64, 96, 6});
}

BOOST_AUTO_TEST_CASE(block_and_cylinder) {
  const auto a = make_block(at(-2, -2, 0), 4, 4, 2), through = make_cylinder(at(0, 0, -1), 1, 4);
  check(a, through, subtract, {32 - 2 * pi, 64 - 2 * pi + 4 * pi, 7});
  check(a, through, intersect_, {2 * pi, 6 * pi, 3});
  check(a, through, unite, {32 + 2 * pi, -1, 10});
  const auto flush = make_cylinder(at(0, 0, 0), 1, 2);  // ends in both planes
  check(a, flush, subtract, {32 - 2 * pi, 64 - 2 * pi + 4 * pi, 7});
  check(a, flush, unite, {32, 64, 6});
  const auto blind = make_cylinder(at(0, 0, 1), 1, 4);
  check(a, blind, subtract, {32 - pi, 64 + 2 * pi, 8});
  check(a, blind, unite, {32 + 3 * pi, -1, 8});
  const auto edge = make_cylinder(at(2, 0, -1), 1, 4);  // half in the block
  check(a, edge, subtract, {32 - pi, -1, 8});  // one side falls in two
  check(a, edge, unite, {32 + 4 * pi - pi, -1, -1});
  const auto on_corner = make_cylinder(at(2, 2, 0), 1, 2);
  check(a, on_corner, intersect_, {pi / 2, -1, 5});
  check(a, on_corner, unite, {32 + 2 * pi - pi / 2, -1, -1});
}

BOOST_AUTO_TEST_CASE(tilted_cylinder_through_a_block) {
  // Through both faces at 45 degrees: the length in the block is that of the axis.
  const auto a = make_block(at(-5, -5, 0), 10, 10, 2);
  const auto c = make_cylinder(along({-3, 0, -2}, {1, 0, 1}), 0.5, 6 * std::sqrt(2.0));
  check(a, c, subtract, {200 - pi * 0.25 * 2 * std::sqrt(2.0), -1, 7});
}

BOOST_AUTO_TEST_CASE(crossing_cylinders) {
  const auto a = make_cylinder(along({0, 0, -3}, {0, 0, 1}), 1, 6), b = make_cylinder(along({-3, 0, 0}, {1, 0, 0}), 1, 6);
  check(a, b, intersect_, {16.0 / 3, 16, -1});
  check(a, b, unite, {12 * pi - 16.0 / 3, -1, -1});
  check(a, b, subtract, {6 * pi - 16.0 / 3, -1, -1, 2});
  // Steinmetz with unequal radii has no closed form: the identities of the long run check it.
}

BOOST_AUTO_TEST_CASE(spheres) {
  const auto a = make_sphere(at(0, 0, 0), 1), b = make_sphere(at(1, 0, 0), 1);
  const double lens = pi * 5 / 12;
  check(a, b, intersect_, {lens, 2 * pi, 2});
  check(a, b, unite, {8 * pi / 3 - lens, 6 * pi, 2});
  check(a, b, subtract, {4 * pi / 3 - lens, 4 * pi, 2});
  const auto block = make_block(at(0, 0, 0), 2, 2, 2);
  check(a, block, intersect_, {pi / 6, pi / 2 + 3 * pi / 4, 4});
  check(block, a, subtract, {8 - pi / 6, 24 - 3 * pi / 4 + pi / 2, 7});
  check(a, block, subtract, {7 * pi / 6, -1, 4});
  const auto pierced = make_cylinder(at(0, 0, -2), 0.6, 4);  // a napkin ring: pi h^3 / 6, h = 1.6
  check(a, pierced, subtract, {pi * 1.6 * 1.6 * 1.6 / 6, 4 * pi * 0.8 + 2 * pi * 0.6 * 1.6, 2});
}

BOOST_AUTO_TEST_CASE(cones_and_tori) {
  const auto cone = make_cone(at(0, 0, 0), 2, 0, 4);
  const auto top = make_block(at(-3, -3, 2), 6, 6, 3);
  check(cone, top, subtract, {pi * 16 / 3 * 7 / 8, -1, 3});
  check(cone, top, intersect_, {pi * 16 / 3 / 8, -1, 2});
  const auto half = make_block(at(-3, 0, -1), 6, 6, 6);  // through the axis
  check(cone, half, intersect_, {pi * 8 / 3, -1, 3});
  const auto torus = make_torus(at(0, 0, 0), 3, 1);
  const double whole = 2 * pi * pi * 3;
  check(torus, make_block(at(-5, -5, 0), 10, 10, 2), intersect_, {whole / 2, -1, 2});
  check(torus, make_block(at(-5, 0, -2), 10, 10, 4), subtract, {whole / 2, -1, 3});
  check(torus, make_block(at(0, 0, -2), 10, 10, 4), intersect_, {whole / 4, -1, 3});
}

BOOST_AUTO_TEST_CASE(tangent_surfaces) {
  // A bar with a round end: the cylinder touches the sides of the block along its edges.
  const auto bar = make_block(at(0, -1, 0), 5, 2, 1), end = make_cylinder(at(0, 0, 0), 1, 1), boss = make_cylinder(at(0, 0, -1), 1, 3);
  check(bar, end, unite, {10 + pi / 2, -1, -1});
  check(bar, end, intersect_, {pi / 2, -1, 4});
  check(bar, end, subtract, {10 - pi / 2, -1, 6});
  check(bar, boss, unite, {10 + 3 * pi - pi / 2, -1, -1});
  // Inside the block's length it touches them in lines that part nothing.
  const auto within = make_cylinder(at(2, 0, 0), 1, 1);
  check(bar, within, intersect_, {pi, -1, -1});
  check(bar, within, unite, {10, 24 + 10 + 0, 6});
  // A ball on a plate, a ball in a tube.
  const auto plate = make_block(at(-3, -3, -1), 6, 6, 1), ball = make_sphere(at(0, 0, 1), 1), tube = make_cylinder(at(0, 0, -3), 1, 6);
  check(plate, ball, unite, {36 + 4 * pi / 3, -1, 7, 2});
  check(plate, ball, intersect_, {0, 0, 0, 0});
  check(tube, make_sphere(at(0, 0, 0), 1), intersect_, {4 * pi / 3, 4 * pi, 1});
}

BOOST_AUTO_TEST_CASE(bodies_that_touch_along_an_edge_are_two) {
  const auto a = make_block(at(0, 0, 0), 1, 1, 1), b = make_block(at(1, 1, 0), 1, 1, 1), c = make_block(at(1, 1, 1), 1, 1, 1);
  check(a, b, unite, {2, 12, 12, 2});
  check(a, c, unite, {2, 12, 12, 2});  // in a corner
}

BOOST_AUTO_TEST_CASE(ten_operations_one_after_another) {
  std::vector<Body> plate{*make_block(at(0, 0, 0), 22, 4, 2)};
  for (int i = 0; i < 10; ++i) {
    const Body drill = *make_cylinder(at(2 * i + 2, 2, -1), 0.75, 4);
    const auto r = combine(plate, {drill}, subtract);
    BOOST_REQUIRE_MESSAGE(r, r.error().text);
    plate = r->bodies;
  }
  BOOST_REQUIRE(plate.size() == 1u);
  BOOST_TEST(plate.front().faces.size() == 16u);
  for (const std::string& broken : broken_promises(plate.front(), 1e-6)) BOOST_ERROR(broken);
  const double wanted = 22 * 4 * 2 - 10 * 2 * pi * 0.75 * 0.75;
  BOOST_TEST(std::abs(volume_of(plate) - wanted) <= 1e-9 * wanted);
  // Cut in two, and drilled once more from the side.
  const auto halves = combine(plate, {*make_block(at(10.9, -1, -1), 0.2, 6, 4)}, subtract);
  BOOST_REQUIRE(halves);
  BOOST_TEST(halves->bodies.size() == 2u);
  const auto drilled = combine(halves->bodies, {*make_cylinder(along({-1, 2, 1}, {1, 0, 0}), 0.25, 30)}, subtract);
  BOOST_REQUIRE_MESSAGE(drilled, drilled.error().text);
  for (const Body& body : drilled->bodies)
    for (const std::string& broken : broken_promises(body, 1e-6)) BOOST_ERROR(broken);
}

BOOST_AUTO_TEST_CASE(what_is_no_closed_solid_is_refused) {
  Body open = *make_block(at(0, 0, 0), 1, 1, 1);
  open.shells.front().closed = false;
  const Body box = *make_block(at(0, 0, 0), 1, 1, 1);
  BOOST_TEST(!combine(open, box, unite));
  BOOST_TEST(!combine(box, open, subtract));
}
