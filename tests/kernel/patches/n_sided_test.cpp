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

// Along each spoke the cross derivatives A and B of the two patches and the spoke's own derivative lie in one plane: all
// Bernstein coefficients of A + B - 2 (1 - t) cos(2 pi / n) S' are of rounding size, and so is the angle of the normals.
BOOST_AUTO_TEST_CASE(tangent_planes_agree_along_every_spoke) {
  for (const std::size_t n : {3u, 4u, 5u, 6u, 7u, 8u}) {
    const auto sides = ring(n, 0.3);
    const auto fill = n_sided_fill(sides, 1e-9, FillContinuity::Tangent);
    BOOST_REQUIRE(fill.has_value());
    BOOST_TEST(fill->patches.size() == n);
    BOOST_TEST(fill->boundary_miss <= 1e-15);
    BOOST_TEST(fill->spoke_angle_rad <= 1e-12);
    for (std::size_t i = 0; i < n; ++i) {
      const NurbsSurface &patch = fill->patches[i], &next = fill->patches[(i + 1) % n];
      BOOST_TEST(patch.degree_u() == 4);
      for (int k = 0; k <= 20; ++k) {
        const double t = k / 20.0;
        BOOST_TEST(distance(evaluate(patch, {t, 0}), evaluate(sides[(i + 1) % n], t)) <= 1e-14);
        BOOST_TEST(distance(evaluate(patch, {0, t}), evaluate(sides[i], 2 - t)) <= 1e-14);
        BOOST_TEST(distance(evaluate(patch, {1, t}), evaluate(next, {t, 1})) <= 1e-14);
      }
      // Out of the centre: A of `next`, whose spoke runs along u at v = 1, and B of `patch`, whose spoke runs along v at u = 1.
      const auto pole = [](const NurbsSurface& s, std::size_t u, std::size_t v) { return project(s.poles()[(4 - u) * 5 + 4 - v]); };
      double residual = 0, size = 0;
      for (std::size_t k = 0; k <= 4; ++k) {
        const Vector a = 4 * (pole(next, k, 1) - pole(next, k, 0)), b = 4 * (pole(patch, 1, k) - pole(patch, 0, k));
        const Vector d = k < 4 ? 4 * (pole(next, k + 1, 0) - pole(next, k, 0)) : Vector{};
        const double share = (1 - static_cast<double>(k) / 4) * 2 * std::cos(two_pi / static_cast<double>(n));
        residual = std::max(residual, norm(a + b - share * d));
        size = std::max({size, norm(a), norm(d)});
      }
      BOOST_TEST(residual <= 1e-12 * size);
    }
    // What the positional fill of the same ring leaves open.
    BOOST_TEST(n_sided_fill(sides, 1e-9)->spoke_angle_rad > 1e-3);
  }
}

BOOST_AUTO_TEST_CASE(sides_with_inner_knots_are_met_with_tangent_planes_too) {
  auto sides = ring(5, 0.2);
  for (NurbsCurve& s : sides) s = elevate(insert_knot(s, 0.5, 1), 2);  // quintic splines of three pieces
  const auto fill = n_sided_fill(sides, 1e-9, FillContinuity::Tangent);
  BOOST_REQUIRE(fill.has_value());
  BOOST_TEST(fill->spoke_angle_rad <= 1e-12);
  for (double t = 0; t <= 1; t += 0.05) BOOST_TEST(distance(evaluate(fill->patches[0], {t, 0}), evaluate(sides[1], t)) <= 1e-13);
}

BOOST_AUTO_TEST_CASE(a_flat_ring_stays_flat_with_tangent_planes) {
  const auto fill = n_sided_fill(ring(6, 0), 1e-9, FillContinuity::Tangent);
  BOOST_REQUIRE(fill.has_value());
  for (const NurbsSurface& p : fill->patches)
    for (const Hpoint& h : p.poles()) BOOST_TEST(std::abs(h.z) <= 1e-15);
}

BOOST_AUTO_TEST_CASE(sides_that_cannot_be_smooth_are_refused_with_tangent_planes) {
  auto sides = ring(5, 0.2);
  const Point a = evaluate(sides[2], 0), b = evaluate(sides[2], 2);
  sides[2] = *NurbsCurve::from_cartesian(1, {0, 0, 1, 2, 2}, std::vector{a, Point{0, 0, 1}, b}, {});  // a corner in its middle
  const auto fill = n_sided_fill(sides, 1e-9, FillContinuity::Tangent);
  BOOST_REQUIRE(!fill.has_value());
  BOOST_TEST(fill.error().text.find("side 2 has a corner") != std::string::npos);
  const auto line = [](Point p, Point q) { return *NurbsCurve::from_cartesian(1, {0, 0, 1, 1}, std::vector{p, q}, {}); };
  const std::vector<NurbsCurve> flat{line({0, 0, 0}, {1, 0, 0}), line({1, 0, 0}, {2, 0, 0}), line({2, 0, 0}, {0, 0, 0})};
  BOOST_TEST(!n_sided_fill(flat, 1e-9, FillContinuity::Tangent));
}

BOOST_AUTO_TEST_CASE(open_rings_and_rational_sides_are_refused) {
  auto sides = ring(4, 0.1);
  BOOST_TEST(!n_sided_fill(std::span(sides).first(2), 1e-9));
  BOOST_TEST(!n_sided_fill(std::span(sides).first(3), 1e-9));
  sides[1] = *NurbsCurve::from_homogeneous(1, {0, 0, 1, 1}, {{0, 1, 0, 1}, {-2, 0, 0, 2}});
  BOOST_TEST(!n_sided_fill(sides, 1e-9));
}

BOOST_AUTO_TEST_SUITE_END()
