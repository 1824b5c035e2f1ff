#include <boost/test/unit_test.hpp>

#include "kernel/nurbs/construct_conic.h"
#include "kernel/nurbs/construct_surface.h"
#include "kernel/nurbs/fit.h"
#include "kernel/patches/developable.h"

using namespace trimloop;

namespace {

// Half of a circle of radius r at height z, run through at a speed that depends on `slant`.
NurbsCurve half_circle(double r, double z, double slant) {
  std::vector<Point> points;
  for (int i = 0; i <= 200; ++i) {
    const double x = i / 200.0, angle = pi * (x + slant * x * (1 - x));
    points.push_back({r * std::cos(angle), r * std::sin(angle), z});
  }
  return interpolate(points, 3, Spacing::Uniform)->curve;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(developable_strips)

BOOST_AUTO_TEST_CASE(a_cone_is_found_however_its_sides_are_run_through) {
  const NurbsCurve a = half_circle(4, 0, 0), b = half_circle(1, 3, 0.6);
  const auto plain = ruled(a, b);
  BOOST_TEST(ruling_twist(*plain) > 0.05);  // equal parameters make no cone
  const auto strip = developable_strip(a, b);
  BOOST_REQUIRE(strip.has_value());
  BOOST_TEST(strip->unmatched == 0u);
  BOOST_TEST(strip->twist_rad <= 2e-3);
  BOOST_TEST(strip->curve_miss <= 1e-3);
  // Points lie on the cone through both circles: the radius falls from 4 to 1 over the height of 3.
  for (const double u : {0.1, 0.35, 0.8})
    for (const double v : {0.0, 0.5, 1.0}) {
      const Point p = evaluate(strip->surface, {u, v});
      BOOST_TEST(std::abs(std::hypot(p.x, p.y) - (4 - p.z)) <= 2e-3);
    }
}

BOOST_AUTO_TEST_CASE(any_number_of_rulings_gives_the_cone) {
  const NurbsCurve a = half_circle(4, 0, 0.3), b = half_circle(2, 3, -0.5);
  for (const int rulings : {9, 17, 33, 65}) {
    const auto strip = developable_strip(a, b, rulings);
    BOOST_REQUIRE(strip.has_value());
    BOOST_TEST(strip->unmatched == 0u);
    BOOST_TEST(strip->twist_rad <= 1e-5);
  }
}

BOOST_AUTO_TEST_CASE(curves_without_a_common_plane_are_told) {
  const auto line = [](Point p, Point q) { return *NurbsCurve::from_cartesian(1, {0, 0, 1, 1}, std::vector{p, q}, {}); };
  const auto strip = developable_strip(line({0, 0, 0}, {1, 0, 0}), line({0, 1, 0}, {1, 1, 1}), 5);  // skew lines
  BOOST_REQUIRE(strip.has_value());
  BOOST_TEST(strip->unmatched == 3u);
  BOOST_TEST(strip->twist_rad > 0.1);
  BOOST_TEST(!developable_strip(line({0, 0, 0}, {1, 0, 0}), line({0, 1, 0}, {1, 1, 1}), 1));
}

BOOST_AUTO_TEST_SUITE_END()
