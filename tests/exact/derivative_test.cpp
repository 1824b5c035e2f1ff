// Derivatives to order three against exact arithmetic, by basis functions, by derivative poles, by the hodograph as a
// spline, and from both sides of knots.
#include <boost/test/unit_test.hpp>

#include "kernel/nurbs/basis_functions.h"
#include "kernel/nurbs/hodograph.h"
#include "tests/exact/cases.h"

using namespace trimloop;
using namespace trimloop::exact;

namespace {

constexpr std::size_t orders = 3;

// What rounding may cost the m-th derivative: the derivative operator of eq. 2.7 at the span multiplies errors of
// coordinates by at most 2 j / (least width of the functions of degree j), j = p, p - 1, ..
std::vector<double> scales(const std::vector<double>& knots, std::size_t k, std::size_t p) {
  std::vector<double> out{1};
  for (std::size_t m = 1; m <= orders; ++m) {
    const std::size_t j = p + 1 > m ? p + 1 - m : 0;
    double width = infinity;
    for (std::size_t i = k + 1 - j; i <= k && j > 0; ++i) width = std::min(width, knots[i + j] - knots[i]);
    out.push_back(j == 0 ? out.back() : out.back() * 2 * static_cast<double>(j) / width);
  }
  return out;
}

// Error units of the Cartesian derivatives: those of the homogeneous ones through Leibniz's rule.
std::vector<double> allowed(const std::vector<Row>& a, const std::vector<Row>& c, const Size& size,
                            const std::vector<double>& scale, double factor) {
  const double w = std::abs(as_double(a[0][3]));
  const auto magnitude = [](const Row& v, std::size_t n) {
    double out = 0;
    for (std::size_t i = 0; i < n; ++i) out = std::max(out, std::abs(as_double(v[i])));
    return out;
  };
  std::vector<double> out;
  for (std::size_t m = 0; m < c.size(); ++m) {
    double error = size.point * scale[m] * epsilon, binomial = 1;
    for (std::size_t i = 0; i <= m; ++i) {
      error += binomial * size.weight * scale[i] * epsilon * magnitude(c[m - i], 3);
      if (i > 0) error += binomial * std::abs(as_double(a[i][3])) * out[m - i] / factor;
      binomial = binomial * static_cast<double>(m - i) / static_cast<double>(i + 1);
    }
    out.push_back(factor * error / w);
  }
  return out;
}

double shortest(const std::vector<double>& at) {
  double least = infinity;
  for (std::size_t i = 0; i + 1 < at.size(); ++i) least = std::min(least, at[i + 1] - at[i]);
  return least;
}
double shortest_span_factor(const NurbsCurve& c) { return c.range().length() / shortest(breaks(c)); }
double shortest(const NurbsSurface& s) { return std::min(shortest(breaks_u(s)), shortest(breaks_v(s))); }

}  // namespace

BOOST_AUTO_TEST_CASE(curve_derivatives_are_exact_to_their_condition) {
  Cases cases(31);
  double worst = 0;
  int count = 0;
  for (int i = 0; i < 1500; ++i) {
    const int p = cases.degree();
    const NurbsCurve c = cases.curve(p, cases.weights(), 3);
    const double t = cases.parameter(c.knots(), c.domain());
    const bool left = cases.chance(0.3);
    const Spline s = exact::exact(c);
    const std::size_t k = span(s, t, left);
    const std::vector<Row> a = homogeneous_derivatives(s, t, orders, left);
    if (!(std::abs(as_double(a[0][3])) > 1e-6 * size_of(c.poles()).weight)) continue;
    const std::vector<Row> right = quotient_derivatives(a);
    const Size size = size_of(std::span<const Hpoint>(c.poles().data() + k - s.degree, s.degree + 1));
    const std::vector<double> limit = allowed(a, right, size, scales(c.knots(), k, s.degree), 2 * (p + 1));
    const auto compare = [&](const std::vector<Vector>& got) {
      for (std::size_t m = 0; m <= orders; ++m) {
        const double error = difference(right[m], to_point(got[m]));
        BOOST_TEST(error <= limit[m]);
        if (limit[m] > 0) worst = std::max(worst, error / limit[m]);
      }
    };
    compare(derivatives(c, t, static_cast<int>(orders), left ? Side::Left : Side::Right));
    if (left) continue;
    compare(derivatives(c, t, static_cast<int>(orders)));
    compare(derivatives_by_poles(c, t, static_cast<int>(orders)));
    const CurveJet j = jet(c, t);
    compare({to_vector(j.point), j.d1, j.d2, derivatives(c, t, 3)[3]});
    ++count;
  }
  BOOST_TEST(count > 500);
  BOOST_TEST_MESSAGE("curve derivatives: largest error " << worst << " of what the condition allows");
}

BOOST_AUTO_TEST_CASE(surface_derivatives_are_exact_to_their_condition) {
  Cases cases(32);
  double worst = 0;
  for (int i = 0; i < 250; ++i) {
    const NurbsSurface s = cases.surface(cases.integer(1, 4), cases.integer(1, 4), Weights::Positive, 1);
    const Uv at{cases.in(s.domain_u()), cases.in(s.domain_v())};
    const Spline rows = exact::exact(s);
    const std::size_t n = 3, ku = span(rows, at.u);
    // Homogeneous partial derivatives, exactly.
    std::vector<Row> h(n * n);
    const std::vector<Row> along_u = homogeneous_derivatives(rows, at.u, n - 1);
    std::size_t kv = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const Spline column = along_v(s, along_u[k]);
      kv = span(column, at.v);
      const std::vector<Row> d = homogeneous_derivatives(column, at.v, n - 1);
      for (std::size_t l = 0; l < n; ++l) h[k * n + l] = d[l];
    }
    const std::vector<double> su = scales(s.knots_u(), ku, rows.degree),
                              sv = scales(s.knots_v(), kv, static_cast<std::size_t>(s.degree_v()));
    const Size size = size_of(s.poles());
    const double w = as_double(h[0][3]), ratio = size.weight / w;
    const std::vector<Vector> by_basis = derivatives(s, at, 2), by_poles = derivatives_by_poles(s, at, 2);
    std::vector<Row> right(n * n, Row(3));
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t l = 0; k + l < n; ++l) {
        Row v(h[k * n + l].begin(), h[k * n + l].begin() + 3);
        const auto binomial = [](std::size_t m, std::size_t j) { return m == 2 && j == 1 ? 2 : 1; };
        for (std::size_t a = 0; a <= k; ++a)
          for (std::size_t b = a == 0 ? 1 : 0; b <= l; ++b)
            for (std::size_t c = 0; c < 3; ++c)
              v[c] -= binomial(k, a) * binomial(l, b) * h[a * n + b][3] * right[(k - a) * n + (l - b)][c];
        for (Rational& c : v) c /= h[0][3];
        right[k * n + l] = v;
        // Each order of the quotient may bring the ratio of weights, and the first derivative's scale, once more.
        const double scale = std::max(su[k], std::pow(su[1], k)) * std::max(sv[l], std::pow(sv[1], l));
        const double limit = 8 * (s.degree_u() + s.degree_v() + 2) * epsilon * size.point / w * scale *
                             std::pow(4 * ratio, static_cast<double>(k + l) + 1);
        for (const auto& got : {by_basis, by_poles}) {
          const double error = difference(v, to_point(got[k * n + l]));
          BOOST_TEST(error <= limit);
          worst = std::max(worst, error / limit);
        }
      }
  }
  BOOST_TEST_MESSAGE("surface derivatives: largest error " << worst << " of the bound");
}

BOOST_AUTO_TEST_CASE(the_hodograph_is_the_derivative_as_a_spline) {
  Cases cases(33);
  double worst = 0;
  for (int i = 0; i < 300; ++i) {
    const int p = cases.integer(1, 6);
    const bool rational = i % 2;
    const NurbsCurve c = cases.curve(p, rational ? Weights::Positive : Weights::None, 2);
    const auto pieces = hodograph(c);
    BOOST_TEST_REQUIRE(pieces.has_value());
    const Spline s = exact::exact(c);
    for (const NurbsCurve& d : *pieces) {
      BOOST_TEST(d.degree() == (rational && c.is_rational() ? 2 * p : std::max(1, p - 1)));
      const double t = cases.in(d.range());
      if (t == d.range().hi) continue;
      const std::vector<Row> right = quotient_derivatives(homogeneous_derivatives(s, t, 1));
      const Row got = value(exact::exact(d), t);
      const Row v = projected(got);
      double error = 0;
      for (std::size_t k = 0; k < 3; ++k) error = std::max(error, std::abs(as_double(v[k] - right[1][k])));
      // The numerator is a difference of products A' w - A w', each as large as this.
      const Size own = size_of(d.poles());
      Size size = size_of(c.poles());
      const double products = c.is_rational() ? 2 * p / d.range().length() * size.point * size.weight : 0;
      size = {std::max(own.point, shortest_span_factor(c) * products), own.weight};
      const double units = error / unit(got, size);
      BOOST_TEST(units <= 8 * (p + 1));
      worst = std::max(worst, units / (8 * (p + 1)));
    }
  }
  BOOST_TEST_MESSAGE("hodographs: largest error " << worst << " of 8(p+1) units of the hodograph's own poles");
}

BOOST_AUTO_TEST_CASE(surface_hodographs_are_the_partial_derivatives) {
  Cases cases(34);
  for (int i = 0; i < 60; ++i) {
    const NurbsSurface s =
        cases.surface(cases.integer(1, 3), cases.integer(1, 3), i % 2 ? Weights::Positive : Weights::None, 1);
    const Uv at{cases.in(s.domain_u()), cases.in(s.domain_v())};
    const std::vector<Vector> right = derivatives(s, at, 1);
    const auto holds = [](const NurbsSurface& d, Uv p) {
      return d.range_u().contains(p.u) && d.range_v().contains(p.v);
    };
    for (const auto& [parts, expected] : {std::pair{hodograph_u(s), right[2]}, std::pair{hodograph_v(s), right[1]}}) {
      BOOST_TEST_REQUIRE(parts.has_value());
      for (const NurbsSurface& d : *parts)
        if (holds(d, at)) {
          Size size = size_of(d.poles());
          const Size own = size_of(s.poles());
          if (s.is_rational())
            size.point =
                std::max(size.point, own.point * own.weight * 2 * std::max(s.degree_u(), s.degree_v()) / shortest(s));
          const auto [point, error] = std::pair{evaluate(d, at), norm(to_vector(evaluate(d, at)) - expected)};
          const Row h = value(along_v(d, value(exact::exact(d), at.u)), at.v);
          BOOST_TEST(error <= 64 * unit(h, size));
          BOOST_TEST(is_finite(point));
        }
    }
  }
}

BOOST_AUTO_TEST_CASE(single_basis_functions_are_exact) {
  Cases cases(35);
  for (int i = 0; i < 600; ++i) {
    const int p = cases.degree(12);
    const std::vector<double> knots = cases.knots(p, 3);
    const std::size_t n = knots.size() - static_cast<std::size_t>(p) - 1;
    const std::size_t which = static_cast<std::size_t>(cases.integer(0, int(n) - 1));
    // Function `which` is the spline with that pole one and the others zero.
    Spline s{static_cast<std::size_t>(p), exact::exact(knots), std::vector<Row>(n, Row(1))};
    s.poles[which][0] = 1;
    if (!(s.lo() < s.hi())) continue;
    const Interval domain{knots[static_cast<std::size_t>(p)], knots[n]};
    const double t = cases.parameter(knots, domain);
    const std::size_t k = span(s, t);
    if (t == domain.hi && t < knots.back()) continue;  // beyond the domain the function goes on to the right
    const std::vector<double> got = basis_function_derivatives(p, knots, which, t, 2);
    const std::vector<Row> right = homogeneous_derivatives(s, t, 2, t == domain.hi);
    const std::vector<double> scale = scales(knots, t == domain.hi ? span(s, t, true) : k, s.degree);
    for (std::size_t m = 0; m <= 2; ++m)
      BOOST_TEST(difference(right[m][0], got[m]) <= 4 * (p + 1) * epsilon * scale[m]);
    if (k - s.degree <= which && which <= k) {
      const std::vector<double> all = basis_functions(p, knots, t);
      BOOST_TEST(std::abs(all[which - (k - s.degree)] - got[0]) <= 4 * (p + 1) * epsilon);
      BOOST_TEST(std::abs(basis_derivatives(p, knots, t, 1)[1][which - (k - s.degree)] -
                          as_double(homogeneous_derivatives(s, t, 1)[1][0])) <=
                 4 * (p + 1) * epsilon * scales(knots, k, s.degree)[1]);
    }
  }
}
