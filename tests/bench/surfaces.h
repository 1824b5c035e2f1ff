#pragma once
// Surfaces that the evaluation and closest-point programs share.

#include <random>

#include "kernel/nurbs/surface.h"

namespace trimloop::bench {

// Rational bicubic, clamped, `poles` x `poles`, knots slightly uneven: a wavy sheet of size 100 x 100, waves of
// `height`.
inline NurbsSurface wavy(std::size_t poles, double height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto knots = [&] {
    std::vector<double> k(4, 0.0);
    for (std::size_t i = 1; i + 3 < poles; ++i) k.push_back(static_cast<double>(i) + 0.3 * (unit(random) - 0.5));
    k.insert(k.end(), 4, static_cast<double>(poles - 3));
    return k;
  };
  std::vector<double> u = knots(), v = knots();
  std::vector<Hpoint> net;
  const double cell = 100.0 / static_cast<double>(poles - 1);
  for (std::size_t i = 0; i < poles; ++i)
    for (std::size_t j = 0; j < poles; ++j) {
      const double w = 0.5 + 1.5 * unit(random), x = cell * static_cast<double>(i), y = cell * static_cast<double>(j);
      const double z = height * (std::sin(0.11 * x) * std::cos(0.09 * y) + 0.4 * (unit(random) - 0.5));
      net.push_back({w * x, w * y, w * z, w});
    }
  return *NurbsSurface::from_homogeneous(3, 3, std::move(u), std::move(v), std::move(net));
}

}  // namespace trimloop::bench
