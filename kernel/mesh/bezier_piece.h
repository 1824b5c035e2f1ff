#pragma once
// Bézier poles of a part of one knot span, and enclosures of the derivatives of what they stand for.

#include <array>
#include <span>
#include <vector>

#include "kernel/mesh/derivative_bounds.h"

namespace trimloop::mesh::detail {

// Row j gives Bézier pole j over [a, b], inside the knot span that starts at span[0] of the flat knots, as a sum of the span's degree + 1
// poles: the polar form (Ramshaw) at a (degree - j times) and b (j times). (degree + 1)^2 numbers.
void bezier_weights(int degree, const double* span, Interval ab, std::vector<double>& out);
// Those sums; pole i of the span is poles[i * stride].
void bezier_poles(int degree, const std::vector<double>& weights, const Hpoint* poles, std::size_t stride, Hpoint* out,
                  std::size_t out_stride);

// Partial derivatives S_ij, i + j <= 3, of a Bézier patch (poles[i * (q + 1) + j]) over a rectangle of the given size;
// S_00 relative to `origin`. False when a weight is not positive.
using Partials = std::array<std::array<Ball, 4>, 4>;
bool enclose_partials(int p, int q, std::vector<Hpoint>& poles, double width_u, double width_v, bool rational,
                      Point origin, Partials& out);

}  // namespace trimloop::mesh::detail
