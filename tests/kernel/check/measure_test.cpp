#include <boost/test/unit_test.hpp>

#include "base/limits.h"
#include "kernel/check/measure.h"
#include "kernel/heal/make_face.h"
#include "tests/support/builders.h"

using namespace trimloop;

namespace {

double whole_area(const Body& body) {
  double sum = 0;
  for (std::uint32_t i = 0; i < body.faces.size(); ++i) {
    const Measured m = area(body, FaceId{i});
    BOOST_TEST(m.error <= 1e-6 * m.value);
    sum += m.value;
  }
  return sum;
}

double whole_volume(const Body& body) {
  BOOST_REQUIRE_EQUAL(body.shells.size(), 1u);
  BOOST_TEST(body.shells[0].closed);
  const auto v = volume(body, ShellId{0});
  BOOST_REQUIRE(v.has_value());
  return v->value;
}

void check_sound(const Body& body) {
  const auto broken = broken_promises(body, 1e-9);
  BOOST_TEST(broken.empty(), (broken.empty() ? std::string{} : broken.front()));
}

bool close_to(double value, double expected, double relative = 1e-9) {
  return std::abs(value - expected) <= relative * std::abs(expected);
}

void check_box(Box b, Point lo, Point hi, double tolerance) {
  BOOST_TEST(distance(b.lo, lo) < tolerance);
  BOOST_TEST(distance(b.hi, hi) < tolerance);
}

Box box_of(const Body& body) {
  Box b;
  for (std::uint32_t i = 0; i < body.faces.size(); ++i) b.add(bounding_box(body, FaceId{i}));
  return b;
}

}  // namespace

BOOST_AUTO_TEST_CASE(box_has_its_area_and_volume) {
  const Body body = test::box({1, 2, 3}, {3, 5, 7});
  check_sound(body);
  BOOST_TEST(close_to(whole_area(body), 2 * (2 * 3 + 3 * 4 + 2 * 4)));
  BOOST_TEST(close_to(whole_volume(body), 24));
  check_box(box_of(body), {1, 2, 3}, {3, 5, 7}, 1e-12);
}

BOOST_AUTO_TEST_CASE(cylinder_has_its_area_and_volume) {
  const Body body = test::cylinder({1, 1, 1}, 2, 5);
  check_sound(body);
  BOOST_TEST(close_to(whole_area(body), 2 * pi * 2 * 5 + 2 * pi * 4));
  BOOST_TEST(close_to(whole_volume(body), pi * 4 * 5));
  check_box(box_of(body), {-1, -1, 1}, {3, 3, 6}, 1e-9);
}

BOOST_AUTO_TEST_CASE(cone_has_its_area_and_volume) {
  const Body body = test::cone({0, 0, 0}, 3, 4);
  check_sound(body);
  BOOST_TEST(close_to(whole_area(body), pi * 3 * 5 + pi * 9));
  BOOST_TEST(close_to(whole_volume(body), pi * 9 * 4 / 3));
}

BOOST_AUTO_TEST_CASE(sphere_has_its_area_volume_and_box) {
  const Body body = test::sphere({10, 0, -3}, 7);
  check_sound(body);
  BOOST_TEST(close_to(whole_area(body), 4 * pi * 49));
  BOOST_TEST(close_to(whole_volume(body), 4 * pi * 343 / 3));
  check_box(box_of(body), {3, -7, -10}, {17, 7, 4}, 1e-6);
}

BOOST_AUTO_TEST_CASE(torus_has_its_area_volume_and_box) {
  const Body body = test::torus({0, 0, 0}, 5, 2);
  check_sound(body);
  BOOST_TEST(close_to(whole_area(body), 4 * pi * pi * 5 * 2));
  BOOST_TEST(close_to(whole_volume(body), 2 * pi * pi * 5 * 4));
  check_box(box_of(body), {-7, -7, -2}, {7, 7, 2}, 1e-6);
}

// A bilinear patch covers its rectangle whatever the weights are; with a small one at a corner nearly all of the rectangle
// belongs to parameters next to that corner. Near 1 there are few doubles, which the stated error knows.
BOOST_AUTO_TEST_CASE(a_small_weight_at_a_corner_does_not_hide_the_area) {
  for (const double weight : {1e-2, 1e-5, 1e-10})
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const Point points[] = {{0, 0, 0}, {0, 4, 0}, {8, 0, 0}, {8, 4, 0}};
      double weights[] = {1, 1, 1, 1};
      weights[corner] = weight;
      auto patch = NurbsSurface::from_cartesian(1, 1, {0, 0, 1, 1}, {0, 0, 1, 1}, points, weights);
      BOOST_REQUIRE(patch.has_value());
      heal::FaceInput input;
      input.surface = std::make_shared<const Surface>(Surface{std::move(*patch)});
      Body body;
      const heal::FaceOutcome made = heal::make_face(body, input);
      const Measured m = area(body, made.face);
      BOOST_TEST_CONTEXT("weight " << weight << " at corner " << corner << ": " << m.value << ", error " << m.error) {
        BOOST_TEST(std::abs(m.value - 32) <= std::max(m.error, 1e-12));
        BOOST_TEST(m.error <= 32 * std::max(2e-7, 1e-14 / weight));  // 1e-7 for each of the two integrals
      }
    }
}

BOOST_AUTO_TEST_CASE(holes_are_taken_out_of_a_plate) {
  const Body body = test::plate(10, 6, {{2, 2, 1}, {7, 3, 2}});
  check_sound(body);
  BOOST_TEST(close_to(whole_area(body), 60 - pi - 4 * pi));
}

BOOST_AUTO_TEST_CASE(an_open_shell_has_no_volume) {
  Body body = test::box({0, 0, 0}, {1, 1, 1});
  body.shells[0].faces.pop_back();
  body.shells[0].closed = false;
  BOOST_TEST(!volume(body, ShellId{0}).has_value());
}
BOOST_AUTO_TEST_CASE(centres_of_volume) {
  const auto centre = [](const Body& body) {
    const auto c = centroid(body, ShellId{0});
    BOOST_REQUIRE(c);
    return *c;
  };
  BOOST_TEST(distance(centre(test::box({1, 2, 3}, {5, 8, 13})), {3, 5, 8}) < 1e-9);
  BOOST_TEST(distance(centre(test::cylinder({1, -2, 3}, 2, 10)), {1, -2, 8}) < 1e-7);
  BOOST_TEST(distance(centre(test::cone({1, 2, 3}, 2, 8)), {1, 2, 5}) < 1e-7);  // a quarter of the height
  BOOST_TEST(distance(centre(test::sphere({-7, 2, 3}, 4)), {-7, 2, 3}) < 1e-7);
  BOOST_TEST(distance(centre(test::torus({4, 5, -6}, 5, 2)), {4, 5, -6}) < 1e-7);
}

