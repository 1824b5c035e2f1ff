#pragma once
// Scalar polynomials on the unit square by their Bernstein coefficients, whose range encloses that of the polynomial
// (not part of the public face). A polynomial of one variable has q = 0.

#include <algorithm>
#include <vector>

#include "kernel/nurbs/binomial.h"

namespace trimloop::detail {

struct Bernstein2 {
  std::size_t p = 0, q = 0;
  std::vector<double> c{0.0};  // (p + 1) x (q + 1), row-major

  double& at(std::size_t i, std::size_t j) { return c[i * (q + 1) + j]; }
  double at(std::size_t i, std::size_t j) const { return c[i * (q + 1) + j]; }
  double lowest() const { return *std::min_element(c.begin(), c.end()); }
  double highest() const { return *std::max_element(c.begin(), c.end()); }
  double largest() const { return std::max(highest(), -lowest()); }
};

inline Bernstein2 constant(double value, std::size_t p = 0, std::size_t q = 0) {
  return {p, q, std::vector<double>((p + 1) * (q + 1), value)};
}

inline Bernstein2 operator*(const Bernstein2& f, const Bernstein2& g) {
  Bernstein2 out = constant(0, f.p + g.p, f.q + g.q);
  for (std::size_t i = 0; i <= f.p; ++i)
    for (std::size_t k = 0; k <= g.p; ++k) {
      const double u = binomial(f.p, i) * binomial(g.p, k) / binomial(out.p, i + k);
      for (std::size_t j = 0; j <= f.q; ++j)
        for (std::size_t l = 0; l <= g.q; ++l)
          out.at(i + k, j + l) +=
              u * binomial(f.q, j) * binomial(g.q, l) / binomial(out.q, j + l) * f.at(i, j) * g.at(k, l);
    }
  return out;
}
inline Bernstein2 operator*(double s, Bernstein2 f) {
  for (double& v : f.c) v *= s;
  return f;
}

// To degrees that are not lower.
inline Bernstein2 raised(const Bernstein2& f, std::size_t p, std::size_t q) {
  return f.p == p && f.q == q ? f : f * constant(1, p - f.p, q - f.q);
}
inline Bernstein2 operator+(const Bernstein2& f, const Bernstein2& g) {
  Bernstein2 out = raised(f, std::max(f.p, g.p), std::max(f.q, g.q));
  const Bernstein2 other = raised(g, out.p, out.q);
  for (std::size_t i = 0; i < out.c.size(); ++i) out.c[i] += other.c[i];
  return out;
}
inline Bernstein2 operator-(const Bernstein2& f, const Bernstein2& g) { return f + -1.0 * g; }

inline Bernstein2 derivative_u(const Bernstein2& f) {
  if (f.p == 0) return constant(0, 0, f.q);
  Bernstein2 out = constant(0, f.p - 1, f.q);
  for (std::size_t i = 0; i < f.p; ++i)
    for (std::size_t j = 0; j <= f.q; ++j) out.at(i, j) = static_cast<double>(f.p) * (f.at(i + 1, j) - f.at(i, j));
  return out;
}
inline Bernstein2 derivative_v(const Bernstein2& f) {
  if (f.q == 0) return constant(0, f.p, 0);
  Bernstein2 out = constant(0, f.p, f.q - 1);
  for (std::size_t i = 0; i <= f.p; ++i)
    for (std::size_t j = 0; j < f.q; ++j) out.at(i, j) = static_cast<double>(f.q) * (f.at(i, j + 1) - f.at(i, j));
  return out;
}

struct BernsteinVector {
  Bernstein2 x, y, z;
};
inline Bernstein2 dot(const BernsteinVector& a, const BernsteinVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline BernsteinVector cross(const BernsteinVector& a, const BernsteinVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline BernsteinVector operator*(const Bernstein2& s, const BernsteinVector& a) { return {s * a.x, s * a.y, s * a.z}; }
inline BernsteinVector operator-(const BernsteinVector& a, const BernsteinVector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

}  // namespace trimloop::detail
