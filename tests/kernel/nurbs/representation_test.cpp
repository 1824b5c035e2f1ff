// Knot conventions, end conditions, components, projective maps, one-sided derivatives.
#include <boost/test/unit_test.hpp>

#include "kernel/nurbs/bezier.h"
#include "kernel/nurbs/hodograph.h"
#include "kernel/nurbs/knot_vectors.h"
#include "kernel/nurbs/projective.h"
#include "tests/kernel/nurbs/random_nurbs.h"

using namespace trimloop;
using testing::Random;

BOOST_AUTO_TEST_SUITE(representation)

BOOST_AUTO_TEST_CASE(both_knot_conventions_mean_the_same_curve) {
  Random random(401);
  for (int p = 1; p <= 5; ++p) {
    const std::size_t n = static_cast<std::size_t>(p) + 4;
    const std::vector<Hpoint> poles = random.poles(n, false);
    const NurbsCurve loose = NurbsCurve::from_homogeneous(p, uniform_knots(p, n), poles).value();
    const NurbsCurve tight = NurbsCurve::from_homogeneous(p, clamped_knots(p, n), poles).value();
    BOOST_TEST((loose.domain().lo == 0 && loose.domain().hi == static_cast<double>(n) - p));
    BOOST_TEST((tight.domain().lo == 0 && tight.domain().hi == static_cast<double>(n) - p));
    BOOST_TEST(distance(evaluate(tight, 0), project(poles[0])) == 0);
    for (const NurbsCurve* c : {&loose, &tight}) {
      const std::vector<double> brief = to_short_knots(c->knots());
      BOOST_TEST(brief.size() == n + static_cast<std::size_t>(p) - 1);
      const NurbsCurve again = NurbsCurve::from_homogeneous(p, from_short_knots(brief), poles).value();
      for (int i = 0; i <= 20; ++i)
        BOOST_TEST(distance(evaluate(again, c->domain().at(i / 20.0)), evaluate(*c, c->domain().at(i / 20.0))) < 1e-13);
    }
  }
}

BOOST_AUTO_TEST_CASE(repeated_end_points_reach_the_ends_without_clamped_knots) {
  const std::vector<Point> points{{0, 0}, {1, 2}, {3, 2}, {4, 0}};
  for (int p = 2; p <= 5; ++p) {
    const NurbsCurve c = with_repeated_ends(p, points).value();
    BOOST_TEST(c.knots()[0] < c.knots()[1]);
    // At the domain's start only the first `degree` poles count, and all of them are the end point.
    BOOST_TEST(distance(evaluate(c, c.domain().lo), points.front()) < 1e-14);
    BOOST_TEST(norm(jet(c, c.domain().lo).d1) <= 1e-13);
    BOOST_TEST(distance(evaluate(c, c.domain().hi), points.back()) < 1e-14);
  }
  BOOST_TEST(!with_repeated_ends(3, std::vector<Point>{{0, 0}}).has_value());
}

BOOST_AUTO_TEST_CASE(any_number_of_components_is_one_spline) {
  Random random(402);
  const std::vector<double> knots = random.knots(3, true);
  const std::size_t n = knots.size() - 4;
  std::vector<double> values;
  for (std::size_t i = 0; i < 7 * n; ++i) values.push_back(random.real(-5, 5));
  for (int i = 0; i < 20; ++i) {
    const double t = random.in({knots[3], knots[n]});
    const std::vector<double> got = spline_value(3, knots, values, 7, t);
    const auto basis = testing::all_basis_functions(knots, 3, t);
    for (std::size_t c = 0; c < 7; ++c) {
      long double sum = 0;
      for (std::size_t k = 0; k < n; ++k) sum += basis[k] * values[7 * k + c];
      BOOST_TEST(std::abs(got[c] - static_cast<double>(sum)) < 1e-13);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_last_de_casteljau_segment_is_the_tangent) {
  Random random(403);
  for (int n = 1; n <= 8; ++n)
    for (int repeat = 0; repeat < 10; ++repeat) {
      std::vector<Hpoint> poles = random.poles(static_cast<std::size_t>(n) + 1, true);
      if (repeat % 3 == 1 && n > 1) poles[1].w = 0;  // an ideal pole
      std::vector<double> knots(poles.size(), 0.0);
      knots.insert(knots.end(), poles.size(), 1.0);
      const NurbsCurve c = NurbsCurve::from_homogeneous(n, knots, poles).value();
      for (const double t : {0.0, 0.3, 0.8, 1.0}) {
        const BezierTangent b = bezier_tangent(poles, t);
        const CurveJet j = jet(c, t);
        BOOST_TEST(distance(b.point, j.point) < 1e-12 * (1 + norm(to_vector(j.point))));
        BOOST_TEST(norm(b.derivative - j.d1) < 1e-11 * (1 + norm(j.d1)));
      }
    }
}

BOOST_AUTO_TEST_CASE(projecting_poles_is_projecting_points) {
  Random random(404);
  const Projective view = perspective({0, 0, 40}, {0, 0, -15}, {0.1, 0.2, 1}).value();
  for (int i = 0; i < 40; ++i) {
    const NurbsCurve c = random.curve(random.integer(1, 5), i % 2);
    const NurbsCurve seen = transformed(c, view).value();
    const NurbsSurface s = random.surface(2, 3, i % 2), seen_s = transformed(s, view).value();
    for (int k = 0; k < 10; ++k) {
      const double t = random.in(c.domain());
      const Point p = apply(view, evaluate(c, t));
      BOOST_TEST(distance(evaluate(seen, t), p) < 1e-12 * 60);
      BOOST_TEST(std::abs(dot(p - Point{0, 0, -15}, normalized({0.1, 0.2, 1}))) < 1e-12 * 60);      // in the plane
      BOOST_TEST(norm(cross(p - Point{0, 0, 40}, evaluate(c, t) - Point{0, 0, 40})) < 1e-10 * 60);  // on the ray
      const Uv at{random.in(s.domain_u()), random.in(s.domain_v())};
      BOOST_TEST(distance(evaluate(seen_s, at), apply(view, evaluate(s, at))) < 1e-12 * 60);
    }
  }
  // Two maps after one another are their product.
  const NurbsCurve c = random.curve(3, true);
  const Projective both = view * view;
  BOOST_TEST(distance(evaluate(transformed(c, both).value(), c.range().mid()),
                      evaluate(transformed(transformed(c, view).value(), view).value(), c.range().mid())) < 1e-11);
  BOOST_TEST(!perspective({0, 0, 0}, {1, 0, 0}, {0, 0, 1}).has_value());
  Projective broken;
  broken.m[1][2] = std::nan("");
  BOOST_TEST(!transformed(c, broken).has_value());
}

BOOST_AUTO_TEST_CASE(both_sides_of_a_knot_have_their_own_derivatives) {
  // Degree 3 with knots of multiplicity 1, 2, 3 inside: orders 3, 2, 1 and above jump, those below do not.
  Random random(405);
  const NurbsCurve c =
      NurbsCurve::from_homogeneous(3, {0, 0, 0, 0, 1, 2, 2, 3, 3, 3, 4, 4, 4, 4}, random.poles(10, false)).value();
  for (int m = 1; m <= 3; ++m) {
    const auto l = derivatives(c, m, 3, Side::Left), r = derivatives(c, m, 3, Side::Right);
    for (int k = 0; k <= 3; ++k) {
      const double jump = norm(l[static_cast<std::size_t>(k)] - r[static_cast<std::size_t>(k)]);
      if (k <= 3 - m) BOOST_TEST(jump < 1e-11);
      if (k > 3 - m) BOOST_TEST(jump > 1e-3);
    }
    // Each is the limit from its side.
    BOOST_TEST(norm(l[1] - derivatives(c, m - 1e-9, 1)[1]) < 1e-5);
    BOOST_TEST(norm(r[1] - derivatives(c, m + 1e-9, 1)[1]) < 1e-5);
  }
  const auto a = derivatives(c, 0, 2, Side::Left), b = derivatives(c, 0, 2, Side::Right);
  BOOST_TEST(norm(a[1] - b[1]) == 0);  // at the start there is one side
}

BOOST_AUTO_TEST_SUITE_END()
