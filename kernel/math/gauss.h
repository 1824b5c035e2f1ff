#pragma once
// Gauss-Legendre rules on [-1, 1] and the Gauss-Kronrod pairs (3, 7) and (7, 15).

#include <array>
#include <span>

namespace trimloop {

struct GaussNode {
  double x = 0, w = 0;
};
constexpr int largest_gauss_rule = 32;
// n from 1 to largest_gauss_rule; exact for polynomials of degree 2 n - 1. Nodes ascend.
std::span<const GaussNode> gauss_rule(int n);

struct KronrodNode {
  double x = 0, kronrod = 0, gauss = 0;  // gauss: 0 at the nodes that only the larger rule has
};
std::span<const KronrodNode> kronrod_7();
std::span<const KronrodNode> kronrod_15();

}  // namespace trimloop
