#pragma once
// What is right: splines over exact rational numbers, written from the definitions (L. Ramshaw, "Blossoms are polar
// forms", CAGD 6, 1989) and sharing no code with the kernel. Every double is a rational, so evaluation, derivatives and
// every change of representation have one exact answer. A pole of any refined, elevated, split or reparametrized spline
// is a value of the polar form at its knots, so one function here is the measure of many there.

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <vector>

namespace trimloop::exact {

using Rational = boost::multiprecision::cpp_rational;
using Row = std::vector<Rational>;  // the components of one pole; of a surface: of one row of poles

struct Spline {
  std::size_t degree = 1;
  std::vector<Rational> knots;
  std::vector<Row> poles;

  const Rational& lo() const { return knots[degree]; }
  const Rational& hi() const { return knots[poles.size()]; }
};

// Span k with knots[k] <= t < knots[k + 1]; at the end of the domain the last that has a length. From the left:
// knots[k] < t <= knots[k + 1].
inline std::size_t span(const Spline& s, const Rational& t, bool from_left = false) {
  std::size_t found = s.degree;
  bool any = false;
  for (std::size_t k = s.degree; k < s.poles.size(); ++k) {
    if (!(s.knots[k] < s.knots[k + 1])) continue;
    if (!any || (from_left ? s.knots[k] < t : s.knots[k] <= t)) found = k;
    any = true;
  }
  return found;
}

// The polar form of the polynomial over span k, at `degree` arguments. Level j replaces the j-th of them.
inline Row blossom(const Spline& s, std::size_t k, const std::vector<Rational>& arguments) {
  const std::size_t p = s.degree;
  std::vector<Row> d(s.poles.begin() + static_cast<std::ptrdiff_t>(k - p),
                     s.poles.begin() + static_cast<std::ptrdiff_t>(k + 1));
  for (std::size_t j = 1; j <= p; ++j)
    for (std::size_t i = p; i >= j; --i) {
      const Rational &a = s.knots[k - p + i], &b = s.knots[k + i + 1 - j];
      const Rational share = (arguments[j - 1] - a) / (b - a), rest = 1 - share;
      for (std::size_t c = 0; c < d[i].size(); ++c) d[i][c] = rest * d[i - 1][c] + share * d[i][c];
    }
  return d[p];
}

inline Row value(const Spline& s, const Rational& t, bool from_left = false) {
  return blossom(s, span(s, t, from_left), std::vector<Rational>(s.degree, t));
}

// The derivative as a spline over the same knots without the outermost two. A knot of full multiplicity inside makes it
// jump; its pole there is never used, and is set to zero.
inline Spline hodograph(const Spline& s) {
  Spline d{s.degree - 1, {s.knots.begin() + 1, s.knots.end() - 1}, {}};
  for (std::size_t i = 0; i + 1 < s.poles.size(); ++i) {
    const Rational width = s.knots[i + s.degree + 1] - s.knots[i + 1];
    Row row(s.poles[i].size());
    if (width != 0)
      for (std::size_t c = 0; c < row.size(); ++c)
        row[c] = Rational(static_cast<long>(s.degree)) * (s.poles[i + 1][c] - s.poles[i][c]) / width;
    d.poles.push_back(std::move(row));
  }
  return d;
}

// Derivatives 0 .. order of the homogeneous curve at t.
inline std::vector<Row> homogeneous_derivatives(Spline s, const Rational& t, std::size_t order,
                                                bool from_left = false) {
  std::vector<Row> out;
  const std::size_t width = s.poles.front().size();
  for (std::size_t m = 0; m <= order; ++m) {
    if (m > 0 && s.degree > 0) s = hodograph(s);
    out.push_back(m > 0 && out.size() > s.degree + m ? Row(width) : value(s, t, from_left));
    if (s.degree == 0 && m < order) {
      out.resize(order + 1, Row(width));
      break;
    }
  }
  return out;
}

// Of Cartesian values, by Leibniz's rule on A = w C. The last component is the weight.
inline std::vector<Row> quotient_derivatives(const std::vector<Row>& a) {
  const std::size_t n = a.size(), dimension = a[0].size() - 1;
  std::vector<Row> out(n, Row(dimension));
  for (std::size_t m = 0; m < n; ++m)
    for (std::size_t c = 0; c < dimension; ++c) {
      Rational v = a[m][c], binomial = 1;
      for (std::size_t i = 1; i <= m; ++i) {
        binomial = binomial * static_cast<long>(m - i + 1) / static_cast<long>(i);
        v -= binomial * a[i][dimension] * out[m - i][c];
      }
      out[m][c] = v / a[0][dimension];
    }
  return out;
}

// Pole i of the spline of degree q over `knots` that equals s: the polar form, raised to degree q (the mean over all
// ways to leave out q - p arguments), at knots[i + 1] .. knots[i + q].
inline Row raised_blossom(const Spline& s, std::size_t k, const std::vector<Rational>& arguments) {
  if (arguments.size() == s.degree) return blossom(s, k, arguments);
  Row sum;
  for (std::size_t left_out = 0; left_out < arguments.size(); ++left_out) {
    std::vector<Rational> rest = arguments;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(left_out));
    const Row r = raised_blossom(s, k, rest);
    if (sum.empty()) sum.resize(r.size());
    for (std::size_t c = 0; c < r.size(); ++c) sum[c] += r[c];
  }
  for (Rational& c : sum) c /= static_cast<long>(arguments.size());
  return sum;
}

inline Row pole_over(const Spline& s, const std::vector<Rational>& knots, std::size_t i, std::size_t q) {
  for (std::size_t k = i; k <= i + q; ++k) {
    if (!(knots[k] < knots[k + 1]) || knots[k] < s.lo() || knots[k + 1] > s.hi()) continue;
    const std::vector<Rational> arguments(knots.begin() + static_cast<std::ptrdiff_t>(i + 1),
                                          knots.begin() + static_cast<std::ptrdiff_t>(i + q + 1));
    return raised_blossom(s, span(s, knots[k]), arguments);
  }
  return {};  // the pole belongs to no span of the domain
}

// Coefficients of powers of (t - origin) of the polynomial over the span of t, ascending.
inline std::vector<Row> power_coefficients(const Spline& s, const Rational& t, const Rational& origin) {
  const std::size_t k = span(s, t);
  Spline piece = s;  // derivatives at the origin, of the polynomial that is extended from span k
  std::vector<Row> out;
  Rational factorial = 1;
  for (std::size_t m = 0; m <= s.degree; ++m) {
    if (m > 0) piece = hodograph(piece), factorial *= static_cast<long>(m);
    Row row = blossom(piece, k - m, std::vector<Rational>(piece.degree, origin));
    for (Rational& c : row) c /= factorial;
    out.push_back(std::move(row));
  }
  return out;
}

}  // namespace trimloop::exact
