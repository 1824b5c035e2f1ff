#pragma once
// Where a quadrature over a rational surface must look closely (not part of the public face).

#include <vector>

#include "kernel/geometry/surface.h"

namespace trimloop::detail {

// `breaks` (ends of spans, ascending) and, in spans over which the weights differ by a factor R above 16, places at a distance
// of 1/8, 1/64, ... to about 1/R of the span from either end: with a small weight at a corner nearly all of the shape lies within
// 1/R of the corner, where no rule of moderate order over the whole span looks. Weights must be positive there.
std::vector<double> graded_breaks_u(const Surface&, std::vector<double> breaks);
std::vector<double> graded_breaks_v(const Surface&, std::vector<double> breaks);

}  // namespace trimloop::detail
