#pragma once
// B-spline basis functions at one parameter, for the evaluators of this folder (not part of the public face).
// No allocation; the degree may be a compile-time constant, and the pragmas have the triangles of degrees 1 to 3
// unrolled then (-O2 would not).
//
// Notation: `at` points at knot t_k of the span [t_k, t_k+1), so that at[0] <= t <= at[1], at[0] < at[1], and
// at[1 - p] .. at[p] are the knots that matter. Function r of degree j, r = 0..j, belongs to pole k - j + r; it rests
// on the knots at[r - j] .. at[r + 1].

#include <cstddef>

namespace trimloop::detail {

constexpr int max_degree = 64;  // the size of the buffers below; Limits::degree is not larger

// The span of t, which must lie in the domain; at its upper end the last span that has length. A2.1 without branches.
// Any index inside is returned for NaN.
inline std::size_t span_of(const double* knots, std::size_t degree, std::size_t poles, double t) {
  const double* first = knots + degree;
  for (std::size_t count = poles - degree; count > 1;) {
    const std::size_t half = count / 2;
    first += first[half] <= t ? half : 0;
    count -= half;
  }
  std::size_t k = static_cast<std::size_t>(first - knots);
  while (k > degree && !(knots[k] < knots[k + 1])) --k;
  return k;
}

// From the j functions of degree j - 1 to the j + 1 functions of degree j, in place. A2.2, one column.
// The share (t - a) / (b - a) is exactly 0 or 1 at the ends, so that a clamped curve starts on its first pole's bits.
inline void raise_degree(int j, const double* at, double t, double* n) {
  double carried = 0;
#pragma GCC unroll 4
  for (int r = 0; r < j; ++r) {
    const double a = at[r + 1 - j], share = (t - a) / (at[r + 1] - a), old = n[r];
    n[r] = carried + old * (1 - share);
    carried = old * share;
  }
  n[j] = carried;
}

// From functions of degree j - 1 (or m-th derivatives of them) to the first derivatives (m + 1-th) of those of degree
// j: N' = j (N_left / width_left - N_right / width_right), eq. 2.7.
inline void raise_derivative(int j, const double* at, const double* n, double* d) {
  double left = 0;
#pragma GCC unroll 4
  for (int r = 0; r < j; ++r) {
    const double right = n[r] / (at[r + 1] - at[r + 1 - j]);
    d[r] = j * (left - right);
    left = right;
  }
  d[j] = j * left;
}

template <int Order>
struct Basis {
  double n[Order + 1][max_degree + 1];  // n[m][r]: m-th derivative of function r; what is not used is not initialised
};

// Values and derivatives up to Order (0, 1 or 2) of the functions of one degree. Degree 0 stands for "at run time".
template <int Degree, int Order>
inline void fill_of_degree(Basis<Order>& b, int run_time_degree, const double* at, double t) {
  const int p = Degree > 0 ? Degree : run_time_degree;
  double slopes[max_degree + 1];  // first derivatives at degree p - 1
  slopes[0] = 0;
  b.n[0][0] = 1;
#pragma GCC unroll 4
  for (int j = 1; j <= p; ++j) {
    if constexpr (Order >= 2) {
      if (j == p - 1) raise_derivative(j, at, b.n[0], slopes);
      if (j == p) raise_derivative(j, at, slopes, b.n[2]);
    }
    if constexpr (Order >= 1) {
      if (j == p) raise_derivative(j, at, b.n[0], b.n[1]);
    }
    raise_degree(j, at, t, b.n[0]);
  }
}

template <int Order>
inline void fill(Basis<Order>& b, int degree, const double* at, double t) {
  switch (degree) {
    case 1:
      return fill_of_degree<1>(b, degree, at, t);
    case 2:
      return fill_of_degree<2>(b, degree, at, t);
    case 3:
      return fill_of_degree<3>(b, degree, at, t);
    default:
      return fill_of_degree<0>(b, degree, at, t);
  }
}

// The m-th derivatives of all functions of degree p, for any m <= p; n has room for p + 1. Same rules, O(p^2).
inline void fill_derivative(int p, int m, const double* at, double t, double* n) {
  n[0] = 1;
  for (int j = 1; j <= p - m; ++j) raise_degree(j, at, t, n);
  double raised[max_degree + 1];
  for (int j = p - m + 1; j <= p; ++j) {
    raise_derivative(j, at, n, raised);
    for (int r = 0; r <= j; ++r) n[r] = raised[r];
  }
}

}  // namespace trimloop::detail
