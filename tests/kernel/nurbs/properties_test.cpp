// The properties that the seeds promise (000 section 1.2, 002 sections 3 and 8), on random splines.
#include <boost/test/unit_test.hpp>

#include "kernel/math/transform.h"
#include "kernel/nurbs/basis_functions.h"
#include "kernel/nurbs/blossom.h"
#include "kernel/nurbs/surface.h"
#include "tests/kernel/nurbs/random_nurbs.h"

using namespace trimloop;
using testing::Random;

namespace {

Vector any_vector(Random& random) { return {random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)}; }

Transform any_affine(Random& random) {
  Transform m;
  for (auto& row : m.r)
    for (double& r : row) r = random.real(-2, 2);
  m.t = 5 * any_vector(random);
  return m;
}

template <class F>
void for_random_curves(unsigned seed, F check) {
  Random random(seed);
  for (int degree = 1; degree <= 8; ++degree)
    for (int kind = 0; kind < 4; ++kind)
      for (int repeat = 0; repeat < 3; ++repeat) check(random.curve(degree, kind & 1, kind & 2), random);
}

// How often a signed distance changes its sign, zeros left out.
template <class F>
int sign_changes(int count, F value) {
  int changes = 0;
  double last = 0;
  for (int i = 0; i < count; ++i) {
    const double v = value(i);
    if (v == 0) continue;
    if (last != 0 && (v > 0) != (last > 0)) ++changes;
    last = v;
  }
  return changes;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(properties)

BOOST_AUTO_TEST_CASE(affine_maps_of_poles_are_those_of_points) {
  for_random_curves(201, [](const NurbsCurve& c, Random& random) {
    const Transform m = any_affine(random);
    const NurbsCurve moved = transformed(c, m);
    for (int i = 0; i < 10; ++i) {
      const double t = random.in(c.domain());
      BOOST_TEST(distance(evaluate(moved, t), apply(m, evaluate(c, t))) < 1e-12 * 60);
    }
  });
  Random random(202);
  for (int i = 0; i < 20; ++i) {
    const NurbsSurface s = random.surface(random.integer(1, 5), random.integer(1, 5), i % 2);
    const Transform m = any_affine(random);
    const Uv at{random.in(s.domain_u()), random.in(s.domain_v())};
    BOOST_TEST(distance(evaluate(transformed(s, m), at), apply(m, evaluate(s, at))) < 1e-12 * 60);
  }
}

// Every half space that holds the poles of a span holds its points: no direction tells them apart.
BOOST_AUTO_TEST_CASE(points_lie_in_the_hull_of_the_poles_of_their_span) {
  for_random_curves(203, [](const NurbsCurve& c, Random& random) {
    const std::size_t p = static_cast<std::size_t>(c.degree());
    for (int i = 0; i < 10; ++i) {
      const double t = random.in(c.domain());
      const std::size_t k = static_cast<std::size_t>(find_span(c.degree(), c.knots(), c.poles().size(), t));
      const Point q = evaluate(c, t);
      for (int d = 0; d < 10; ++d) {
        const Vector n = any_vector(random);
        double highest = -infinity;
        for (std::size_t j = k - p; j <= k; ++j) highest = std::max(highest, dot(n, to_vector(project(c.poles()[j]))));
        BOOST_TEST(dot(n, to_vector(q)) <= highest + 1e-13);
      }
    }
  });
}

// A plane meets the curve no oftener than it meets the control polygon (positive weights).
BOOST_AUTO_TEST_CASE(curves_vary_no_more_than_their_polygons) {
  for_random_curves(204, [](const NurbsCurve& c, Random& random) {
    const NurbsCurve b = trimmed(c, c.domain());
    for (int d = 0; d < 10; ++d) {
      const Vector n = any_vector(random);
      const double level = dot(n, to_vector(evaluate(b, random.in(b.domain()))));
      const int of_polygon = sign_changes(static_cast<int>(b.poles().size()), [&](int i) {
        return dot(n, to_vector(project(b.poles()[static_cast<std::size_t>(i)]))) - level;
      });
      const int of_curve = sign_changes(400, [&](int i) {
        const double v = dot(n, to_vector(evaluate(b, b.domain().at(i / 399.0)))) - level;
        return std::abs(v) < 1e-12 ? 0 : v;
      });
      BOOST_TEST(of_curve <= of_polygon);
    }
  });
}

BOOST_AUTO_TEST_CASE(a_pole_changes_the_curve_over_its_own_knots_only) {
  for_random_curves(205, [](const NurbsCurve& c, Random& random) {
    const std::size_t i = static_cast<std::size_t>(random.integer(0, static_cast<int>(c.poles().size()) - 1));
    std::vector<Hpoint> poles = c.poles();
    poles[i].x += 3;
    const NurbsCurve moved = NurbsCurve::from_homogeneous(c.degree(), c.knots(), poles).value();
    const double lo = c.knots()[i], hi = c.knots()[i + static_cast<std::size_t>(c.degree()) + 1];
    int inside = 0;
    for (int k = 0; k <= 60; ++k) {
      const double t = c.domain().at(k / 60.0);
      const Point a = evaluate(c, t), b = evaluate(moved, t);
      if (t < lo || t > hi) BOOST_TEST((a.x == b.x && a.y == b.y && a.z == b.z));
      inside += a.x != b.x;
    }
    const bool seen = lo < c.domain().hi && hi > c.domain().lo &&
                      std::min(hi, c.domain().hi) - std::max(lo, c.domain().lo) > c.domain().length() / 20;
    if (seen) BOOST_TEST(inside > 0);
  });
}

BOOST_AUTO_TEST_CASE(basis_functions_are_positive_and_sum_to_one) {
  Random random(206);
  for (int degree = 1; degree <= 25; ++degree) {
    const std::vector<double> knots = random.knots(degree, degree % 2);
    const std::size_t p = static_cast<std::size_t>(degree), n = knots.size() - p - 1;
    for (int i = 0; i < 10; ++i) {
      const double t = random.in({knots[p], knots[n]});
      double sum = 0, slopes = 0, largest = 0;
      for (std::size_t k = 0; k < n; ++k) {
        const auto d = basis_function_derivatives(degree, knots, k, t, 1);
        BOOST_TEST(d[0] >= 0);
        sum += d[0], slopes += d[1];
        largest = std::max(largest, std::abs(d[1]));
      }
      BOOST_TEST(std::abs(sum - 1) < 1e-14);
      BOOST_TEST(std::abs(slopes) <= 1e-13 * largest);
    }
  }
}

BOOST_AUTO_TEST_CASE(reversal_is_a_symmetry) {
  for_random_curves(207, [](const NurbsCurve& c, Random& random) {
    const NurbsCurve back = reversed(c);
    const Interval d = c.domain();
    for (int i = 0; i < 10; ++i) {
      const double t = random.in(d);
      BOOST_TEST(distance(evaluate(back, d.lo + (d.hi - t)), evaluate(c, t)) < 1e-11);
    }
    BOOST_TEST(reversed(back).poles().size() == c.poles().size());
  });
}

BOOST_AUTO_TEST_CASE(the_polar_form_is_symmetric_and_multi_affine) {
  for_random_curves(208, [](const NurbsCurve& c, Random& random) {
    const double t = random.in(c.domain());
    const std::size_t k = static_cast<std::size_t>(find_span(c.degree(), c.knots(), c.poles().size(), t));
    const Interval inside{c.knots()[k], c.knots()[k + 1]};
    std::vector<double> a;
    for (int i = 0; i < c.degree(); ++i) a.push_back(random.in(inside));
    const auto near = [](const Hpoint& x, const Hpoint& y) {
      const Hpoint d = x - y;
      return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z), std::abs(d.w)}) < 1e-12 * 40;
    };
    const Hpoint f = blossom(c, t, a);
    std::vector<double> turned(a.rbegin(), a.rend());
    BOOST_TEST(near(f, blossom(c, t, turned)));
    std::vector<double> b = a, mixed = a;
    b[0] = random.in(inside);
    mixed[0] = 0.25 * a[0] + 0.75 * b[0];
    BOOST_TEST(near(blossom(c, t, mixed), 0.25 * f + 0.75 * blossom(c, t, b)));
    const std::vector<double> diagonal(a.size(), t);
    BOOST_TEST(distance(project(blossom(c, t, diagonal)), evaluate(c, t)) < 1e-12);
    // The poles of a sub-interval.
    const std::vector<Hpoint> poles = segment_poles(c, t, inside);
    BOOST_TEST(distance(project(poles.front()), evaluate(c, inside.lo)) < 1e-12);
  });
  Random random(209);
  const NurbsSurface s = random.surface(3, 2, true);
  const Uv at{random.in(s.domain_u()), random.in(s.domain_v())};
  BOOST_TEST(distance(project(blossom(s, at, std::vector<double>(3, at.u), std::vector<double>(2, at.v))),
                      evaluate(s, at)) < 1e-13);
}

BOOST_AUTO_TEST_SUITE_END()
