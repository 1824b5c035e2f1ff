#include "kernel/nurbs/basis_functions.h"

#include <algorithm>

#include "base/assert.h"
#include "kernel/nurbs/basis.h"
#include "kernel/nurbs/curve.h"

namespace trimloop {
namespace {

struct Place {
  const double* at;
  double t;
};
Place place(int degree, std::span<const double> knots, double t) {
  const std::size_t p = static_cast<std::size_t>(degree), poles = knots.size() - p - 1;
  TRIMLOOP_ASSERT(degree >= 1 && degree <= detail::max_degree && poles > p, "the knots make a spline");
  t = Interval{knots[p], knots[poles]}.clamp(t);
  return {knots.data() + detail::span_of(knots.data(), p, poles, t), t};
}

// Functions i .. i + p - d of degree d at t, for d = 0 .. p, from the knots of function i only; `level` receives those
// of degree `stop`.
std::vector<double> triangle(const double* k, std::size_t p, std::size_t stop, bool last, double t) {
  std::vector<double> n(p + 1, 0.0);
  for (std::size_t r = 0; r <= p; ++r)
    n[r] = k[r] < k[r + 1] && (last ? k[r] < t && t <= k[r + 1] : k[r] <= t && t < k[r + 1]);
  for (std::size_t d = 1; d <= stop; ++d)
    for (std::size_t r = 0; r + d <= p; ++r) {
      const double left = n[r] == 0 ? 0 : n[r] * ((t - k[r]) / (k[r + d] - k[r]));
      const double right = n[r + 1] == 0 ? 0 : n[r + 1] * (1 - (t - k[r + 1]) / (k[r + d + 1] - k[r + 1]));
      n[r] = left + right;
    }
  return n;
}

}  // namespace

std::vector<double> basis_functions(int degree, std::span<const double> knots, double t) {
  const Place here = place(degree, knots, t);
  detail::Basis<0> basis;
  detail::fill(basis, degree, here.at, here.t);
  return {basis.n[0], basis.n[0] + degree + 1};
}

std::vector<std::vector<double>> basis_derivatives(int degree, std::span<const double> knots, double t, int order) {
  TRIMLOOP_ASSERT(order >= 0, "the order of a derivative is not negative");
  const Place here = place(degree, knots, t);
  const std::size_t count = static_cast<std::size_t>(degree) + 1;
  std::vector<std::vector<double>> rows(static_cast<std::size_t>(order) + 1, std::vector<double>(count, 0.0));
  for (int m = 0; m <= std::min(order, degree); ++m)
    detail::fill_derivative(degree, m, here.at, here.t, rows[static_cast<std::size_t>(m)].data());
  return rows;
}

double basis_function(int degree, std::span<const double> knots, std::size_t i, double t) {
  return basis_function_derivatives(degree, knots, i, t, 0).front();
}

std::vector<double> basis_function_derivatives(int degree, std::span<const double> knots, std::size_t i, double t,
                                               int order) {
  const std::size_t p = static_cast<std::size_t>(degree), count = static_cast<std::size_t>(std::max(order, 0)) + 1;
  TRIMLOOP_ASSERT(degree >= 1 && i + p + 1 < knots.size(), "the function has degree + 2 knots");
  const double* k = knots.data() + i;
  std::vector<double> out(count, 0.0);
  const bool last = t == knots.back();
  if (!(k[0] <= t && t <= k[p + 1])) return out;
  for (std::size_t m = 0; m < count && m <= p; ++m) {
    std::vector<double> n = triangle(k, p, p - m, last, t);
    for (std::size_t d = p - m + 1; d <= p; ++d)  // eq. 2.7
      for (std::size_t r = 0; r + d <= p; ++r) {
        const double left = n[r] == 0 ? 0 : n[r] / (k[r + d] - k[r]);
        const double right = n[r + 1] == 0 ? 0 : n[r + 1] / (k[r + d + 1] - k[r + 1]);
        n[r] = static_cast<double>(d) * (left - right);
      }
    out[m] = n[0];
  }
  return out;
}

}  // namespace trimloop
