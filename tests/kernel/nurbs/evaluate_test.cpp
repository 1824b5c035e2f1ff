// Values and derivatives against closed forms, against the definition and against each other.
#include <boost/test/unit_test.hpp>

#include "kernel/nurbs/basis.h"
#include "kernel/nurbs/surface.h"
#include "tests/kernel/nurbs/random_nurbs.h"

using namespace trimloop;
using testing::Random;

namespace {

const double root_half = std::sqrt(0.5);

// Full circle of radius 2 about the origin: nine rational quadratic poles (NURBS Book, fig. 7.16a).
NurbsCurve circle() {
  const double h = root_half;
  const std::vector<Point> points{{2, 0}, {2, 2}, {0, 2}, {-2, 2}, {-2, 0}, {-2, -2}, {0, -2}, {2, -2}, {2, 0}};
  const std::vector<double> weights{1, h, 1, h, 1, h, 1, h, 1};
  return NurbsCurve::from_cartesian(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}, points, weights).value();
}

// One eighth of the unit sphere; the row at v = 1 is collapsed to the pole (0, 0, 1).
NurbsSurface sphere_octant() {
  const double h = root_half;
  const std::vector<Point> points{{1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {1, 1, 0}, {1, 1, 1},
                                  {0, 0, 1}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
  const std::vector<double> weights{1, h, 1, h, 0.5, h, 1, h, 1}, knots{0, 0, 0, 1, 1, 1};
  return NurbsSurface::from_cartesian(2, 2, knots, knots, points, weights).value();
}

double relative(Vector a, Vector b, double scale) { return norm(a - b) / scale; }

bool same_bits(Vector a, Vector b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
bool same_bits(Point a, Point b) { return same_bits(to_vector(a), to_vector(b)); }

}  // namespace

BOOST_AUTO_TEST_CASE(rational_quadratics_make_a_circle) {
  const NurbsCurve c = circle();
  for (int i = 0; i <= 400; ++i) {
    const CurveJet j = jet(c, 0.01 * i);
    const Vector r = to_vector(j.point);
    BOOST_TEST(std::abs(norm(r) - 2) < 4e-15);
    BOOST_TEST(std::abs(dot(r, j.d1)) < 1e-14);                    // the tangent is perpendicular
    BOOST_TEST(std::abs(dot(j.d1, j.d1) + dot(r, j.d2)) < 1e-13);  // derivative of the line above
  }
  // Half-angle parameter: at t the quarter has turned by 2 atan(...); its middle is at 45 degrees.
  BOOST_TEST(distance(evaluate(c, 0.5), {2 * root_half, 2 * root_half}) < 1e-15);
  BOOST_TEST(distance(evaluate(c, 3.5), {2 * root_half, -2 * root_half}) < 1e-15);
}

BOOST_AUTO_TEST_CASE(a_rational_biquadratic_makes_a_sphere_octant) {
  const NurbsSurface s = sphere_octant();
  for (int i = 0; i <= 20; ++i)
    for (int k = 0; k <= 20; ++k) {
      const SurfaceJet j = jet(s, {i / 20.0, k / 20.0});
      const Vector n = to_vector(j.point);
      BOOST_TEST(std::abs(norm(n) - 1) < 1e-15);
      BOOST_TEST(std::abs(dot(n, j.du)) < 2e-15);
      BOOST_TEST(std::abs(dot(n, j.dv)) < 2e-15);
      BOOST_TEST(std::abs(dot(n, j.duu) + dot(j.du, j.du)) < 2e-14);  // second derivatives of |S|^2 = 1
      BOOST_TEST(std::abs(dot(n, j.duv) + dot(j.du, j.dv)) < 2e-14);
      BOOST_TEST(std::abs(dot(n, j.dvv) + dot(j.dv, j.dv)) < 2e-14);
    }
  BOOST_TEST(norm(jet(s, {0.3, 1}).du) < 1e-15);  // the collapsed row
}

BOOST_AUTO_TEST_CASE(basis_functions_are_a_partition_of_unity) {
  Random random(1);
  for (int degree = 1; degree <= detail::max_degree; ++degree) {
    const std::vector<double> k = random.knots(degree, degree % 2 == 0);
    const std::size_t p = static_cast<std::size_t>(degree), poles = k.size() - p - 1;
    for (int i = 0; i < 20; ++i) {
      const double t = random.in({k[p], k[poles]});
      const std::size_t span = detail::span_of(k.data(), p, poles, t);
      detail::Basis<2> b;
      detail::fill(b, degree, k.data() + span, t);
      double sum = 0, slopes = 0, largest = 0;
      for (std::size_t r = 0; r <= p; ++r) {
        BOOST_TEST(b.n[0][r] >= 0);
        sum += b.n[0][r];
        slopes += b.n[1][r];
        largest = std::max(largest, std::abs(b.n[1][r]));
      }
      BOOST_TEST(std::abs(sum - 1) < 1e-14);
      BOOST_TEST(std::abs(slopes) <= 1e-14 * largest);
    }
  }
}

BOOST_AUTO_TEST_CASE(curve_points_agree_with_the_definition) {
  Random random(2);
  for (int degree = 1; degree <= 9; ++degree)
    for (int kind = 0; kind < 4; ++kind) {
      const NurbsCurve c = random.curve(degree, kind & 1, kind & 2);
      std::vector<double> at = c.knots();
      for (int i = 0; i < 20; ++i) at.push_back(random.in(c.domain()));
      for (double t : at)
        if (c.domain().contains(t))
          BOOST_TEST(distance(evaluate(c, t), testing::plain_evaluate(c, t)) < 1e-14 * testing::size(c.poles()));
    }
}

BOOST_AUTO_TEST_CASE(surface_points_agree_with_the_definition) {
  Random random(3);
  for (int p = 1; p <= 5; ++p)
    for (int q = 1; q <= 5; ++q)
      for (int kind = 0; kind < 4; ++kind) {
        const NurbsSurface s = random.surface(p, q, kind & 1, kind & 2);
        for (int i = 0; i < 4; ++i) {
          const Uv uv{random.in(s.domain_u()), random.in(s.domain_v())};
          BOOST_TEST(distance(evaluate(s, uv), testing::plain_evaluate(s, uv)) < 1e-14 * testing::size(s.poles()));
        }
      }
}

BOOST_AUTO_TEST_CASE(all_evaluators_give_the_same_bits) {
  Random random(4);
  for (int degree = 1; degree <= 9; ++degree)
    for (bool rational : {false, true}) {
      const NurbsCurve c = random.curve(degree, rational);
      const NurbsSurface s = random.surface(degree, 10 - degree, rational);
      for (int i = 0; i < 10; ++i) {
        const double t = random.in(c.domain());
        BOOST_TEST(same_bits(evaluate(c, t), jet(c, t).point));
        const Uv uv{random.in(s.domain_u()), random.in(s.domain_v())};
        const SurfaceJet j = jet(s, uv);
        Point point;
        Vector du, dv;
        jet1(s, uv, point, du, dv);
        BOOST_TEST((same_bits(point, j.point) && same_bits(point, evaluate(s, uv))));
        BOOST_TEST((same_bits(du, j.du) && same_bits(dv, j.dv)));
      }
    }
}

BOOST_AUTO_TEST_CASE(clamped_ends_are_the_end_poles_bit_for_bit) {
  Random random(5);
  for (int degree = 1; degree <= 20; ++degree)
    for (bool rational : {false, true}) {
      const NurbsCurve c = random.curve(degree, rational);
      for (double t : {c.domain().lo, -infinity}) BOOST_TEST(same_bits(evaluate(c, t), project(c.poles().front())));
      for (double t : {c.domain().hi, infinity}) BOOST_TEST(same_bits(evaluate(c, t), project(c.poles().back())));
      const NurbsSurface s = random.surface(degree, 3, rational);
      const Uv far{s.domain_u().hi, s.domain_v().hi};
      BOOST_TEST(same_bits(evaluate(s, far), project(s.poles().back())));
      BOOST_TEST(same_bits(evaluate(s, {-infinity, infinity}), project(s.pole(0, s.poles_v() - 1))));
    }
}

BOOST_AUTO_TEST_CASE(a_parameter_that_is_no_number_gives_no_number) {
  Random random(6);
  const NurbsCurve c = random.curve(3, true, false);
  BOOST_TEST(!is_finite(evaluate(c, std::nan(""))));
  BOOST_TEST(!is_finite(jet(c, std::nan("")).d1));
  const NurbsSurface s = random.surface(3, 7, false, false);
  BOOST_TEST(!is_finite(evaluate(s, {s.domain_u().lo, std::nan("")})));
  BOOST_TEST(find_span(3, c.knots(), c.poles().size(), std::nan("")) >= 3);
}

BOOST_AUTO_TEST_CASE(spans_hold_their_parameter) {
  // Knots -2 -1 0 0 1 1 1 4 5 6: degree 3, six poles, domain [0, 1]; the only span with length is [0, 1].
  const std::vector<double> k{-2, -1, 0, 0, 1, 1, 1, 4, 5, 6};
  for (double t : {-7.0, 0.0, 0.5, 1.0, 9.0}) BOOST_TEST(find_span(3, k, 6, t) == 3);
  Random random(7);
  for (int degree = 1; degree <= 9; ++degree) {
    const NurbsCurve c = random.curve(degree, degree % 2 == 0);
    for (int i = 0; i < 50; ++i) {
      const double t = i < 2 ? c.domain().at(i) : random.in(c.domain());
      const std::size_t span = static_cast<std::size_t>(find_span(degree, c.knots(), c.poles().size(), t));
      BOOST_TEST((span >= static_cast<std::size_t>(degree) && span < c.poles().size()));
      BOOST_TEST(c.knots()[span] < c.knots()[span + 1]);
      BOOST_TEST(c.knots()[span] <= t);
      BOOST_TEST((t < c.knots()[span + 1] || t == c.domain().hi));
    }
  }
}

BOOST_AUTO_TEST_CASE(curve_derivatives_agree_with_central_differences) {
  Random random(8);
  for (int degree = 2; degree <= 9; ++degree)
    for (bool rational : {false, true}) {
      const NurbsCurve c = random.curve(degree, rational);
      const auto b = breaks(c);
      for (std::size_t i = 0; i + 1 < b.size(); ++i) {
        const Interval piece{b[i], b[i + 1]};
        const double t = piece.at(0.4), h = 1e-5 * piece.length();
        const CurveJet before = jet(c, t - h), here = jet(c, t), after = jet(c, t + h);
        const double scale1 = norm(here.d1) + testing::size(c.poles()) / piece.length();
        const double scale2 = norm(here.d2) + scale1 / piece.length();
        BOOST_TEST(relative(here.d1, (after.point - before.point) / (2 * h), scale1) < 1e-6);
        BOOST_TEST(relative(here.d2, (after.d1 - before.d1) / (2 * h), scale2) < 1e-6);
      }
    }
}

BOOST_AUTO_TEST_CASE(surface_derivatives_agree_with_central_differences) {
  Random random(9);
  for (int degree = 1; degree <= 9; ++degree)
    for (bool rational : {false, true}) {
      const NurbsSurface s = random.surface(degree, 10 - degree, rational);
      const auto bu = breaks_u(s), bv = breaks_v(s);
      const Interval u{bu[0], bu[1]}, v{bv[0], bv[1]};
      const Uv at{u.at(0.4), v.at(0.6)};
      const double hu = 1e-5 * u.length(), hv = 1e-5 * v.length(), size = testing::size(s.poles());
      const SurfaceJet j = jet(s, at);
      const SurfaceJet west = jet(s, at - Uv{hu, 0}), east = jet(s, at + Uv{hu, 0});
      const SurfaceJet south = jet(s, at - Uv{0, hv}), north = jet(s, at + Uv{0, hv});
      const double du = norm(j.du) + size / u.length(), dv = norm(j.dv) + size / v.length();
      BOOST_TEST(relative(j.du, (east.point - west.point) / (2 * hu), du) < 1e-6);
      BOOST_TEST(relative(j.dv, (north.point - south.point) / (2 * hv), dv) < 1e-6);
      BOOST_TEST(relative(j.duu, (east.du - west.du) / (2 * hu), norm(j.duu) + du / u.length()) < 1e-6);
      BOOST_TEST(relative(j.duv, (north.du - south.du) / (2 * hv), norm(j.duv) + du / v.length()) < 1e-6);
      BOOST_TEST(relative(j.dvv, (north.dv - south.dv) / (2 * hv), norm(j.dvv) + dv / v.length()) < 1e-6);
    }
}

BOOST_AUTO_TEST_CASE(derivatives_agree_with_the_hodograph) {
  Random random(10);
  for (int degree = 2; degree <= 9; ++degree) {
    const NurbsCurve c = random.curve(degree, false, degree % 2 == 0);
    // Eq. 3.4: poles p (P_i+1 - P_i) / (u_i+p+1 - u_i+1) over the same knots without the outermost two. A knot of full
    // multiplicity inside would make the hodograph jump, so such curves are left out.
    const std::size_t p = static_cast<std::size_t>(degree);
    std::vector<Hpoint> poles;
    for (std::size_t i = 0; i + 1 < c.poles().size(); ++i) {
      const double width = c.knots()[i + p + 1] - c.knots()[i + 1];
      poles.push_back(degree / width * (c.poles()[i + 1] - c.poles()[i]));
      poles.back().w = 1;
    }
    const auto hodograph =
        NurbsCurve::from_homogeneous(degree - 1, {c.knots().begin() + 1, c.knots().end() - 1}, poles);
    if (!hodograph) continue;
    // Each derivative may be 2 p / h times the one before, h the shortest span; rounding errors grow with that.
    double h = infinity;
    const auto b = breaks(c);
    for (std::size_t i = 0; i + 1 < b.size(); ++i) h = std::min(h, b[i + 1] - b[i]);
    for (int i = 0; i < 20; ++i) {
      const double t = random.in(c.domain());
      double scale = testing::size(poles);
      BOOST_TEST(norm(jet(c, t).d1 - to_vector(evaluate(*hodograph, t))) < 1e-14 * scale);
      const auto all = derivatives(c, t, degree + 2), lower = derivatives(*hodograph, t, degree + 1);
      for (std::size_t m = 0; m < lower.size(); ++m, scale *= 2 * degree / h)
        BOOST_TEST(norm(all[m + 1] - lower[m]) <= 1e-14 * scale);
      BOOST_TEST(norm(all[p]) > 0);
      BOOST_TEST(norm(all[p + 1]) == 0);
    }
  }
}

BOOST_AUTO_TEST_CASE(derivatives_of_every_order_begin_with_the_jet) {
  Random random(11);
  for (int degree = 1; degree <= 9; ++degree)
    for (bool rational : {false, true}) {
      const NurbsCurve c = random.curve(degree, rational);
      const double t = random.in(c.domain());
      const CurveJet j = jet(c, t);
      const auto d = derivatives(c, t, 2);
      BOOST_TEST_REQUIRE(d.size() == 3u);
      BOOST_TEST(same_bits(to_point(d[0]), j.point));
      BOOST_TEST(relative(d[1], j.d1, norm(j.d1)) < 1e-12);
      BOOST_TEST(norm(d[2] - j.d2) <= 1e-11 * norm(j.d2));
      BOOST_TEST(derivatives(c, t, 0).size() == 1u);
    }
}

BOOST_AUTO_TEST_CASE(high_derivatives_of_a_rational_curve_follow_the_closed_form) {
  // x = 1 / (1 + t) on [0, 1]: w = 1 + t, wx = 1. The m-th derivative is (-1)^m m! / (1 + t)^(m + 1).
  const NurbsCurve c = NurbsCurve::from_homogeneous(1, {0, 0, 1, 1}, {{1, 0, 0, 1}, {1, 0, 0, 2}}).value();
  for (double t : {0.0, 0.3, 1.0}) {
    const auto d = derivatives(c, t, 8);
    double expected = 1 / (1 + t);
    for (int m = 0; m <= 8; ++m) {
      BOOST_TEST(std::abs(d[static_cast<std::size_t>(m)].x - expected) < 1e-13 * std::abs(expected));
      expected *= -(m + 1) / (1 + t);
    }
  }
}

BOOST_AUTO_TEST_CASE(ideal_and_negative_weights_are_data) {
  // The half circle with an ideal middle pole: (1, 0), direction (0, 1), (-1, 0).
  const std::vector<Point> points{{1, 0}, {0, 1}, {-1, 0}};
  const std::vector<double> ideal{1, 0, 1}, negative{1, -root_half, 1}, knots{0, 0, 0, 1, 1, 1};
  const NurbsCurve half = NurbsCurve::from_cartesian(2, knots, points, ideal).value();
  BOOST_TEST(half.poles()[1].y == 1);
  BOOST_TEST(half.poles()[1].w == 0);
  for (int i = 0; i <= 50; ++i) {
    const CurveJet j = jet(half, i / 50.0);
    BOOST_TEST(std::abs(norm(to_vector(j.point)) - 1) < 1e-15);
    BOOST_TEST(std::abs(dot(to_vector(j.point), j.d1)) < 1e-14);
    BOOST_TEST(j.point.y >= 0);
  }
  // A quarter with the middle weight negated is the other three quarters of the same circle.
  const std::vector<Point> corner{{1, 0}, {1, 1}, {0, 1}};
  const NurbsCurve rest = NurbsCurve::from_cartesian(2, knots, corner, negative).value();
  for (int i = 0; i <= 50; ++i) BOOST_TEST(std::abs(norm(to_vector(evaluate(rest, i / 50.0))) - 1) < 2e-15);
  BOOST_TEST(evaluate(rest, 0.5).x < 0);
}

BOOST_AUTO_TEST_CASE(a_periodic_cubic_closes_smoothly) {
  // Unclamped uniform knots, the first three poles repeated: C(0) = C(4) with two derivatives.
  const std::vector<Point> square{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
  const NurbsCurve c = NurbsCurve::from_cartesian(3, {-3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7}, square, {}).value();
  BOOST_TEST(c.domain().lo == 0);
  BOOST_TEST(c.domain().hi == 4);
  const CurveJet a = jet(c, 0), b = jet(c, 4);
  BOOST_TEST(distance(a.point, b.point) < 1e-15);
  BOOST_TEST(norm(a.d1 - b.d1) < 1e-15);
  BOOST_TEST(norm(a.d2 - b.d2) < 1e-15);
  BOOST_TEST(distance(a.point, {-2.0 / 3, 2.0 / 3}) < 1e-15);  // (P0 + 4 P1 + P2) / 6
}
