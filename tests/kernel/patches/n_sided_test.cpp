#include <boost/test/unit_test.hpp>

#include "kernel/patches/n_sided.h"

using namespace trimloop;

namespace {

// A closed ring of n cubics over the unit circle's corners, raised by `height` in the middle of each side.
std::vector<NurbsCurve> ring(std::size_t n, double height) {
  std::vector<NurbsCurve> sides;
  const auto corner = [n](std::size_t i) {
    const double a = two_pi * static_cast<double>(i % n) / static_cast<double>(n);
    return Point{std::cos(a), std::sin(a), 0};
  };
  for (std::size_t i = 0; i < n; ++i) {
    const Point a = corner(i), b = corner(i + 1);
    sides.push_back(*NurbsCurve::from_cartesian(3, {0, 0, 0, 0, 2, 2, 2, 2},
                                                std::vector{a, a + (b - a) / 3 + Vector{0, 0, height}, b - (b - a) / 3 + Vector{0, 0, height}, b}, {}));
  }
  return sides;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(n_sided_fills)

BOOST_AUTO_TEST_CASE(patches_reproduce_the_sides_and_meet_at_the_centre) {
  for (const std::size_t n : {3u, 5u, 6u, 9u}) {
    const auto sides = ring(n, 0.3);
    const auto fill = n_sided_fill(sides, 1e-9);
    BOOST_REQUIRE(fill.has_value());
    BOOST_TEST(fill->patches.size() == n);
    for (std::size_t i = 0; i < n; ++i) {
      const NurbsSurface &patch = fill->patches[i], &next = fill->patches[(i + 1) % n];
      BOOST_TEST(distance(evaluate(patch, {1, 1}), fill->centre) <= 1e-14);
      for (int k = 0; k <= 20; ++k) {
        const double t = k / 20.0;
        BOOST_TEST(distance(evaluate(patch, {t, 0}), evaluate(sides[(i + 1) % n], t)) <= 1e-12);       // first half of side i + 1
        BOOST_TEST(distance(evaluate(patch, {0, t}), evaluate(sides[i], 2 - t)) <= 1e-12);             // second half of side i
        BOOST_TEST(distance(evaluate(patch, {1, t}), evaluate(next, {t, 1})) <= 1e-12);                // the spoke between them
      }
    }
    BOOST_TEST(fill->spoke_angle_rad > 0);
    BOOST_TEST(fill->spoke_angle_rad < 1);
  }
}

BOOST_AUTO_TEST_CASE(a_flat_ring_is_filled_flat_and_smooth) {
  const auto fill = n_sided_fill(ring(5, 0), 1e-9);
  BOOST_REQUIRE(fill.has_value());
  BOOST_TEST(fill->spoke_angle_rad <= 1e-12);
  for (const NurbsSurface& p : fill->patches)
    for (const double u : {0.1, 0.6}) BOOST_TEST(std::abs(evaluate(p, {u, 0.7}).z) <= 1e-15);
}

BOOST_AUTO_TEST_CASE(open_rings_and_rational_sides_are_refused) {
  auto sides = ring(4, 0.1);
  BOOST_TEST(!n_sided_fill(std::span(sides).first(2), 1e-9));
  BOOST_TEST(!n_sided_fill(std::span(sides).first(3), 1e-9));
  sides[1] = *NurbsCurve::from_homogeneous(1, {0, 0, 1, 1}, {{0, 1, 0, 1}, {-2, 0, 0, 2}});
  BOOST_TEST(!n_sided_fill(sides, 1e-9));
}

BOOST_AUTO_TEST_SUITE_END()
