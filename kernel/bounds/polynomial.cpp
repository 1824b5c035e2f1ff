#include "kernel/bounds/polynomial.h"

#include <algorithm>

#include "base/assert.h"
#include "kernel/nurbs/binomial.h"

namespace trimloop::bounds {

double Polynomial::lowest() const { return *std::min_element(c.begin(), c.end()) - error; }
double Polynomial::highest() const { return *std::max_element(c.begin(), c.end()) + error; }
double Polynomial::magnitude() const { return std::max(std::abs(lowest()), std::abs(highest())); }

namespace {

// C(p, i) C(q, k) / C(p + q, i + k) at [i * (q + 1) + k]
std::vector<double> shares(int p, int q) {
  const std::size_t a = static_cast<std::size_t>(p), b = static_cast<std::size_t>(q);
  std::vector<double> out;
  for (std::size_t i = 0; i <= a; ++i)
    for (std::size_t k = 0; k <= b; ++k)
      out.push_back(detail::binomial(a, i) * detail::binomial(b, k) / detail::binomial(a + b, i + k));
  return out;
}
std::size_t size(int degree) { return static_cast<std::size_t>(degree) + 1; }

}  // namespace

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  Polynomial out{a.m + b.m, a.n + b.n, std::vector<double>(size(a.m + b.m) * size(a.n + b.n)), 0};
  const std::vector<double> in_u = shares(a.m, b.m), in_v = shares(a.n, b.n);
  const std::size_t columns = size(out.n);
  for (std::size_t i = 0; i < size(a.m); ++i)
    for (std::size_t k = 0; k < size(b.m); ++k)
      for (std::size_t j = 0; j < size(a.n); ++j) {
        const double x = in_u[i * size(b.m) + k] * a.c[i * size(a.n) + j];
        const double* y = b.c.data() + k * size(b.n);
        double* to = out.c.data() + (i + k) * columns + j;
        for (std::size_t l = 0; l < size(b.n); ++l) to[l] += x * (in_v[j * size(b.n) + l] * y[l]);
      }
  // Each coefficient is a sum of at most (m + 1) (n + 1) products with shares that add up to one.
  const double ma = a.magnitude(), mb = b.magnitude();
  const double terms = static_cast<double>(std::min(size(a.m), size(b.m)) * std::min(size(a.n), size(b.n)));
  const double roundings = terms + 8 + 2 * (a.m + b.m + a.n + b.n);  // those of the binomials included
  out.error = ma * b.error + mb * a.error + roundings * eps * ma * mb;
  return out;
}
Polynomial operator*(double s, const Polynomial& a) {
  Polynomial out = a;
  for (double& x : out.c) x *= s;
  out.error = std::abs(s) * (a.error + eps * a.magnitude());
  return out;
}

namespace {

Polynomial combined(const Polynomial& a, const Polynomial& b, double sign) {
  TRIMLOOP_ASSERT(a.m == b.m && a.n == b.n, "polynomials of like degree are added");
  Polynomial out = a;
  for (std::size_t k = 0; k < out.c.size(); ++k) out.c[k] += sign * b.c[k];
  out.error = (a.error + b.error) * (1 + eps) + eps * (a.magnitude() + b.magnitude());
  return out;
}

}  // namespace

Polynomial operator+(const Polynomial& a, const Polynomial& b) { return combined(a, b, 1); }
Polynomial operator-(const Polynomial& a, const Polynomial& b) { return combined(a, b, -1); }

Polynomial along_u(const Polynomial& a) {
  Polynomial out{std::max(a.m - 1, 0), a.n, {}, 2 * a.m * (a.error + eps * a.magnitude())};
  for (std::size_t k = 0; k < size(out.m) * size(a.n); ++k)
    out.c.push_back(a.m == 0 ? 0 : a.m * (a.c[k + size(a.n)] - a.c[k]));
  return out;
}
Polynomial along_v(const Polynomial& a) {
  Polynomial out{a.m, std::max(a.n - 1, 0), {}, 2 * a.n * (a.error + eps * a.magnitude())};
  for (std::size_t i = 0; i < size(a.m); ++i)
    for (std::size_t j = 0; j < size(out.n); ++j)
      out.c.push_back(a.n == 0 ? 0 : a.n * (a.c[i * size(a.n) + j + 1] - a.c[i * size(a.n) + j]));
  return out;
}

Vector3 operator*(const Polynomial& w, const Vector3& a) { return {w * a[0], w * a[1], w * a[2]}; }
Vector3 operator*(double s, const Vector3& a) { return {s * a[0], s * a[1], s * a[2]}; }
Vector3 operator-(const Vector3& a, const Vector3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector3 along_u(const Vector3& a) { return {along_u(a[0]), along_u(a[1]), along_u(a[2])}; }
Vector3 along_v(const Vector3& a) { return {along_v(a[0]), along_v(a[1]), along_v(a[2])}; }

double largest_length(const Vector3& a) {
  double out = 0;
  for (std::size_t k = 0; k < a[0].c.size(); ++k) out = std::max(out, norm(Vector{a[0].c[k], a[1].c[k], a[2].c[k]}));
  return (out + a[0].error + a[1].error + a[2].error) * (1 + 8 * eps);
}

Homogeneous homogeneous(std::span<const Hpoint> poles, int p, int q) {
  Homogeneous out;
  const auto empty = [&] { return Polynomial{p, q, std::vector<double>(size(p) * size(q)), 0}; };
  out.a = {empty(), empty(), empty()};
  out.w = empty();
  bool positive = true;
  Box box;
  for (const Hpoint& h : poles) {
    positive = positive && h.w > 0;
    if (positive) box.add(project(h));
  }
  if (positive) out.origin = midpoint(box.lo, box.hi);
  double largest = 0, weight = 0;
  for (std::size_t j = 0; j < size(q); ++j)
    for (std::size_t i = 0; i < size(p); ++i) {
      const Hpoint& h = poles[j * size(p) + i];
      const std::size_t at = i * size(q) + j;
      out.a[0].c[at] = h.x - h.w * out.origin.x;
      out.a[1].c[at] = h.y - h.w * out.origin.y;
      out.a[2].c[at] = h.z - h.w * out.origin.z;
      out.w.c[at] = h.w;
      largest = std::max({largest, std::abs(h.x), std::abs(h.y), std::abs(h.z)});
      weight = std::max(weight, std::abs(h.w));
    }
  // Insertion of up to p - 1 knots on either side along u and q - 1 along v: three roundings each.
  const double roundings = 6 * (p + q) + 4;
  out.w.error = roundings * eps * weight;
  const double off = weight * std::max({std::abs(out.origin.x), std::abs(out.origin.y), std::abs(out.origin.z)});
  for (Polynomial& x : out.a) x.error = roundings * eps * (largest + off);
  return out;
}

}  // namespace trimloop::bounds
