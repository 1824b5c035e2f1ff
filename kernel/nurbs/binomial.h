#pragma once
// Binomial coefficients and products of Bezier polynomials (not part of the public face).

#include <algorithm>
#include <vector>

namespace trimloop::detail {

// n over k as a double: exact while it is below 2^53 (n up to 56), else within a few units in the last place.
inline double binomial(std::size_t n, std::size_t k) {
  if (k > n) return 0;
  k = std::min(k, n - k);
  double out = 1;
  for (std::size_t i = 1; i <= k; ++i) out = out * static_cast<double>(n - k + i) / static_cast<double>(i);
  return out;
}

// Bezier coefficients of f g, from those of f (degree m) and g (degree n), with `times(f_i, g_j)`:
// (f g)_k = sum over i + j = k of C(m,i) C(n,j) / C(m+n,k) f_i g_j. G. Farin, Curves and Surfaces for CAGD.
template <class F, class G, class Times>
auto bezier_product(const std::vector<F>& f, const std::vector<G>& g, Times times) {
  using Value = decltype(times(f[0], g[0]));
  const std::size_t m = f.size() - 1, n = g.size() - 1;
  std::vector<Value> out;
  out.reserve(m + n + 1);
  for (std::size_t k = 0; k <= m + n; ++k) {
    const double whole = binomial(m + n, k);
    const std::size_t first = k > n ? k - n : 0, last = std::min(m, k);
    Value sum = binomial(m, first) * binomial(n, k - first) / whole * times(f[first], g[k - first]);
    for (std::size_t i = first + 1; i <= last; ++i)
      sum = sum + binomial(m, i) * binomial(n, k - i) / whole * times(f[i], g[k - i]);
    out.push_back(sum);
  }
  return out;
}

}  // namespace trimloop::detail
