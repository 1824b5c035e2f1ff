#pragma once
// Banded linear systems with rows of points on the right (not part of the public face).

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "kernel/nurbs/curve.h"

namespace trimloop::detail {

class Banded {
 public:
  Banded(std::size_t size, std::size_t lower, std::size_t upper)
      : n_(size), lower_(lower), upper_(lower + upper), a_(size * (lower_ + upper_ + 1), 0.0) {}
  std::size_t size() const { return n_; }
  // |i - j| within the band; interchanges of rows need `lower` more above the diagonal.
  double& at(std::size_t i, std::size_t j) { return a_[i * (lower_ + upper_ + 1) + j + lower_ - i]; }

  // Gaussian elimination with partial pivoting; row i of b is b[i * width] .. and becomes that of the solution. The
  // matrix is used up. False when a pivot vanishes against the largest entry.
  bool solve(std::vector<Hpoint>& b, std::size_t width) {
    double largest = 0;
    for (const double v : a_) largest = std::max(largest, std::abs(v));
    for (std::size_t k = 0; k < n_; ++k) {
      const std::size_t below = std::min(n_, k + lower_ + 1), right = std::min(n_, k + upper_ + 1);
      std::size_t pivot = k;
      for (std::size_t i = k + 1; i < below; ++i)
        if (std::abs(at(i, k)) > std::abs(at(pivot, k))) pivot = i;
      if (!(std::abs(at(pivot, k)) > 1e-15 * largest)) return false;
      if (pivot != k) {
        for (std::size_t j = k; j < right; ++j) std::swap(at(k, j), at(pivot, j));
        for (std::size_t c = 0; c < width; ++c) std::swap(b[k * width + c], b[pivot * width + c]);
      }
      for (std::size_t i = k + 1; i < below; ++i) {
        const double f = at(i, k) / at(k, k);
        if (f == 0) continue;
        for (std::size_t j = k + 1; j < right; ++j) at(i, j) -= f * at(k, j);
        for (std::size_t c = 0; c < width; ++c) b[i * width + c] = b[i * width + c] - f * b[k * width + c];
      }
    }
    for (std::size_t i = n_; i-- > 0;) {
      for (std::size_t j = i + 1; j < std::min(n_, i + upper_ + 1); ++j)
        for (std::size_t c = 0; c < width; ++c) b[i * width + c] = b[i * width + c] - at(i, j) * b[j * width + c];
      for (std::size_t c = 0; c < width; ++c) b[i * width + c] = 1 / at(i, i) * b[i * width + c];
    }
    return true;
  }

 private:
  std::size_t n_, lower_, upper_;
  std::vector<double> a_;
};

}  // namespace trimloop::detail
