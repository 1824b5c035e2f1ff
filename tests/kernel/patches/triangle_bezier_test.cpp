#include <boost/test/unit_test.hpp>
#include <random>

#include "kernel/patches/triangle_bezier.h"

using namespace trimloop;

namespace {

TriangleBezier random_patch(int degree, unsigned seed, bool rational) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> coordinate(-10, 10), weight(0.3, 3);
  std::vector<Point> points;
  std::vector<double> weights;
  for (std::size_t i = 0; i < TriangleBezier::count(degree); ++i) {
    points.push_back({coordinate(engine), coordinate(engine), coordinate(engine)});
    weights.push_back(rational ? weight(engine) : 1);
  }
  return *TriangleBezier::from_cartesian(degree, points, weights);
}

// k-variate Bernstein sum (seed 001 §8.3.2).
Point by_bernstein(const TriangleBezier& patch, Barycentric p) {
  const int n = patch.degree();
  Hpoint sum{0, 0, 0, 0};
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j) {
      const int k = n - i - j;
      const double count = std::tgamma(n + 1) / (std::tgamma(i + 1) * std::tgamma(j + 1) * std::tgamma(k + 1));
      sum = sum + (count * std::pow(p.a, i) * std::pow(p.b, j) * std::pow(p.c, k)) * patch.pole(i, j, k);
    }
  return project(sum);
}

const Barycentric places[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.2, 0.3, 0.5}, {0.6, 0.1, 0.3}, {0, 0.4, 0.6}, {1.0 / 3, 1.0 / 3, 1.0 / 3}};

}  // namespace

BOOST_AUTO_TEST_SUITE(triangle_patches)

BOOST_AUTO_TEST_CASE(de_casteljau_and_bernstein_agree) {
  for (int n = 1; n <= 9; ++n)
    for (const bool rational : {false, true}) {
      const auto patch = random_patch(n, static_cast<unsigned>(n), rational);
      for (const Barycentric& p : places) BOOST_TEST(distance(evaluate(patch, p), by_bernstein(patch, p)) <= 1e-11);
    }
}

BOOST_AUTO_TEST_CASE(polar_form_is_symmetric_affine_and_the_patch_on_its_diagonal) {
  const auto patch = random_patch(3, 5, true);
  const Barycentric a{0.2, 0.3, 0.5}, b{-0.4, 1, 0.4}, c{0.7, 0.7, -0.4};
  const auto value = [&](Barycentric x, Barycentric y, Barycentric z) { return blossom(patch, std::array{x, y, z}); };
  const Hpoint abc = value(a, b, c), cab = value(c, a, b);
  BOOST_TEST(norm(Vector{abc.x - cab.x, abc.y - cab.y, abc.z - cab.z}) <= 1e-12);
  const Barycentric mid{(a.a + b.a) / 2, (a.b + b.b) / 2, (a.c + b.c) / 2};
  const Hpoint whole = value(mid, b, c), halves = 0.5 * (value(a, b, c) + value(b, b, c));
  BOOST_TEST(norm(Vector{whole.x - halves.x, whole.y - halves.y, whole.z - halves.z}) <= 1e-12);
  BOOST_TEST(distance(project(value(a, a, a)), evaluate(patch, a)) == 0);
}

BOOST_AUTO_TEST_CASE(derivatives_follow_the_last_triangle) {
  for (const bool rational : {false, true}) {
    const auto patch = random_patch(4, 11, rational);
    const Barycentric p{0.3, 0.45, 0.25};
    const auto j = jet(patch, p);
    const double h = 1e-6;
    const Vector db = (evaluate(patch, {p.a - h, p.b + h, p.c}) - evaluate(patch, {p.a + h, p.b - h, p.c})) / (2 * h);
    const Vector dc = (evaluate(patch, {p.a - h, p.b, p.c + h}) - evaluate(patch, {p.a + h, p.b, p.c - h})) / (2 * h);
    BOOST_TEST(norm(j.db - db) <= 1e-6 * norm(db));
    BOOST_TEST(norm(j.dc - dc) <= 1e-6 * norm(dc));
    BOOST_TEST(norm(j.normal - normalized(cross(db, dc))) <= 1e-6);
  }
}

BOOST_AUTO_TEST_CASE(elevation_and_splitting_keep_the_patch) {
  for (const bool rational : {false, true}) {
    const auto patch = random_patch(5, 3, rational);
    const auto raised = elevated(patch);
    BOOST_TEST(raised.degree() == 6);
    BOOST_TEST(raised.is_rational() == rational);
    const Barycentric at{0.5, 0.2, 0.3};
    const auto parts = split(patch, at);
    for (const Barycentric& p : places) {
      BOOST_TEST(distance(evaluate(raised, p), evaluate(patch, p)) <= 1e-12);
      // A place of part 1, (A, at, C), in the patch's own coordinates.
      const Barycentric own{p.a + p.b * at.a, p.b * at.b, p.c + p.b * at.c};
      BOOST_TEST(distance(evaluate(parts[1], p), evaluate(patch, own)) <= 1e-12);
    }
  }
}

BOOST_AUTO_TEST_CASE(both_quadrilateral_forms_are_the_patch) {
  for (int n = 1; n <= 8; ++n) {
    for (const bool rational : {false, true}) {
      const auto patch = random_patch(n, 40u + static_cast<unsigned>(n), rational);
      const NurbsSurface collapsed = to_collapsed_quad(patch);
      const auto thirds = to_three_quads(patch);
      BOOST_TEST(collapsed.degree_u() == n);
      BOOST_TEST(collapsed.is_rational() == rational);
      for (const double u : {0.0, 0.3, 0.8, 1.0}) {
        for (const double v : {0.0, 0.6, 1.0}) {
          BOOST_TEST(distance(evaluate(collapsed, {u, v}), evaluate(patch, {1 - u, u * (1 - v), u * v})) <= 1e-11);
          // Third 0: a, middle of a c, middle of a b, centroid at (0,0), (0,1), (1,0), (1,1).
          const double f00 = (1 - u) * (1 - v), f01 = (1 - u) * v, f10 = u * (1 - v), f11 = u * v;
          const Barycentric p{f00 + f01 / 2 + f10 / 2 + f11 / 3, f10 / 2 + f11 / 3, f01 / 2 + f11 / 3};
          BOOST_TEST(distance(evaluate(thirds[0], {u, v}), evaluate(patch, p)) <= 1e-11);
        }
      }
      // All look the same way as the patch:
      const Barycentric middle{1.0 / 4 + 1.0 / 4 + 1.0 / 12, 1.0 / 8 + 1.0 / 12, 1.0 / 8 + 1.0 / 12};
      Point point;
      Vector su, sv;
      jet1(thirds[0], {0.5, 0.5}, point, su, sv);
      BOOST_TEST(norm(normalized(cross(su, sv)) - jet(patch, middle).normal) <= 1e-8);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_flat_rational_patch_stays_in_its_plane) {
  std::vector<Point> flat;
  std::vector<double> weights;
  for (int m = 0; m <= 2; ++m)
    for (int k = 0; k <= m; ++k) flat.push_back({static_cast<double>(m), static_cast<double>(k), 7}), weights.push_back(1 + m + 2 * k);
  const auto patch = TriangleBezier::from_cartesian(2, flat, weights);
  BOOST_REQUIRE(patch.has_value());
  for (const Barycentric& p : places) BOOST_TEST(std::abs(evaluate(*patch, p).z - 7) <= 1e-14);
}

BOOST_AUTO_TEST_CASE(joints_are_measured) {
  const auto one = random_patch(3, 1, false);
  // The mirror image across the plane of a flat patch's side joins with no gap and a known angle.
  const auto flat = TriangleBezier::from_cartesian(1, std::vector<Point>{{1, 0, 0}, {0, 0, 0}, {0, 1, 0}});
  const auto up = TriangleBezier::from_cartesian(1, std::vector<Point>{{-1, 0, 1}, {0, 1, 0}, {0, 0, 0}});
  const TriangleJoint joint = joint_along_bc(*flat, *up);
  BOOST_TEST(joint.gap_mm <= 1e-15);
  BOOST_TEST(std::abs(joint.angle_rad - pi / 4) <= 1e-12);
  BOOST_TEST(joint_along_bc(one, one).gap_mm > 0.1);
}

BOOST_AUTO_TEST_CASE(wrong_counts_and_values_are_refused) {
  BOOST_TEST(!TriangleBezier::from_cartesian(2, std::vector<Point>(5)));
  BOOST_TEST(!TriangleBezier::from_cartesian(0, std::vector<Point>(1)));
  BOOST_TEST(!TriangleBezier::from_cartesian(33, std::vector<Point>(TriangleBezier::count(33))));
  BOOST_TEST(!TriangleBezier::from_cartesian(1, std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, infinity, 0}}));
  BOOST_TEST(!TriangleBezier::from_cartesian(1, std::vector<Point>(3), std::vector<double>(2, 1.0)));
}

BOOST_AUTO_TEST_SUITE_END()
