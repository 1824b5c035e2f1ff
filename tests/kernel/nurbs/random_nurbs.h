#pragma once
// Random splines of every kind, and a plain evaluator to compare with: de Boor's recursion in long double, written
// from the definition and sharing nothing with the kernel.

#include <algorithm>
#include <random>

#include "kernel/nurbs/surface.h"

namespace trimloop::testing {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double real(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(engine_); }
  int integer(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(engine_); }
  double in(Interval i) { return i.clamp(real(i.lo, i.hi)); }

  // Uneven knots with inner multiplicities 1 .. degree; clamped, or with loose ends of any multiplicity.
  std::vector<double> knots(int degree, bool clamped) {
    const double scale = std::pow(10.0, integer(-3, 3));
    double t = scale * real(-5, 5);
    std::vector<double> k;
    const auto step = [&] { t += scale * (integer(0, 3) == 0 ? real(0.001, 0.01) : real(0.2, 2)); };
    const auto run = [&](int count) { k.insert(k.end(), static_cast<std::size_t>(count), t); };
    const auto end = [&] {
      if (clamped) return run(degree + 1), step();
      for (int left = degree + 1; left > 0; step()) {
        const int m = integer(1, left);
        run(m);
        left -= m;
      }
    };
    end();
    for (int i = integer(0, 5); i > 0; --i) run(integer(1, degree)), step();
    end();
    return k;
  }

  std::vector<Hpoint> poles(std::size_t count, bool rational) {
    std::vector<Hpoint> result(count);
    for (Hpoint& h : result) {
      const double w = rational ? real(0.3, 3) : 1;
      h = {w * real(-10, 10), w * real(-10, 10), w * real(-10, 10), w};
    }
    return result;
  }

  NurbsCurve curve(int degree, bool rational, bool clamped = true) {
    std::vector<double> k = knots(degree, clamped);
    const std::size_t count = k.size() - static_cast<std::size_t>(degree) - 1;
    return NurbsCurve::from_homogeneous(degree, std::move(k), poles(count, rational)).value();
  }

  NurbsSurface surface(int degree_u, int degree_v, bool rational, bool clamped = true) {
    std::vector<double> ku = knots(degree_u, clamped), kv = knots(degree_v, clamped);
    const std::size_t rows = ku.size() - static_cast<std::size_t>(degree_u) - 1;
    const std::size_t columns = kv.size() - static_cast<std::size_t>(degree_v) - 1;
    return NurbsSurface::from_homogeneous(degree_u, degree_v, std::move(ku), std::move(kv),
                                          poles(rows * columns, rational))
        .value();
  }

 private:
  std::mt19937 engine_;
};

// Basis function i of degree p by its definition, eq. 2.5 of the NURBS Book; `span` says which piece t is taken in.
inline long double basis_function(const std::vector<double>& k, std::size_t i, int p, std::size_t span, long double t) {
  if (p == 0) return i == span ? 1 : 0;
  const std::size_t e = i + static_cast<std::size_t>(p);
  const long double left = static_cast<long double>(k[e]) - k[i], right = static_cast<long double>(k[e + 1]) - k[i + 1];
  long double n = 0;
  if (left > 0) n += (t - k[i]) / left * basis_function(k, i, p - 1, span, t);
  if (right > 0) n += (k[e + 1] - t) / right * basis_function(k, i + 1, p - 1, span, t);
  return n;
}

inline std::vector<long double> all_basis_functions(const std::vector<double>& k, int p, double t) {
  const std::size_t count = k.size() - static_cast<std::size_t>(p) - 1;
  std::size_t span = static_cast<std::size_t>(p);
  for (std::size_t i = span; i < count; ++i)
    if (k[i] < k[i + 1] && k[i] <= t) span = i;
  std::vector<long double> n(count);
  for (std::size_t i = 0; i < count; ++i)
    if (i <= span && span <= i + static_cast<std::size_t>(p)) n[i] = basis_function(k, i, p, span, t);
  return n;
}

struct LongPoint {
  long double x = 0, y = 0, z = 0, w = 0;
  void add(long double s, const Hpoint& h) { x += s * h.x, y += s * h.y, z += s * h.z, w += s * h.w; }
  Point point() const { return {static_cast<double>(x / w), static_cast<double>(y / w), static_cast<double>(z / w)}; }
};

inline Point plain_evaluate(const NurbsCurve& c, double t) {
  const auto n = all_basis_functions(c.knots(), c.degree(), t);
  LongPoint sum;
  for (std::size_t i = 0; i < n.size(); ++i) sum.add(n[i], c.poles()[i]);
  return sum.point();
}

inline Point plain_evaluate(const NurbsSurface& s, Uv at) {
  const auto nu = all_basis_functions(s.knots_u(), s.degree_u(), at.u);
  const auto nv = all_basis_functions(s.knots_v(), s.degree_v(), at.v);
  LongPoint sum;
  for (std::size_t i = 0; i < nu.size(); ++i)
    for (std::size_t j = 0; j < nv.size(); ++j)
      if (nu[i] != 0 && nv[j] != 0) sum.add(nu[i] * nv[j], s.pole(i, j));
  return sum.point();
}

// Largest coordinate of the poles: what rounding errors are relative to.
inline double size(const std::vector<Hpoint>& poles) {
  double s = 0;
  for (const Hpoint& h : poles) {
    const Point p = project(h);
    s = std::max({s, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  return s;
}

}  // namespace trimloop::testing
