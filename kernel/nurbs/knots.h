#pragma once
// Checks and questions on one knot vector, shared by curves and surfaces (not part of the public face).

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "kernel/math/vec.h"
#include "kernel/nurbs/curve.h"

namespace trimloop::detail {

// Whether `degree`, `knots` and the number of poles along them make a spline: 1 <= degree <= 64, at least degree + 1
// poles, poles + degree + 1 finite ascending knots, a domain with length, multiplicities up to degree inside the domain
// and degree + 1 at its ends. Knots are equal when their bits are: nothing is snapped. `where` starts the message ("u
// ").
Result<void> check_knots(std::string_view where, int degree, std::span<const double> knots, std::size_t poles);

// The active range: the domain when none is wanted; what sticks out of it by up to 1e-9 of its length is cut off.
Result<Interval> check_range(std::string_view where, Interval domain, std::optional<Interval> wanted);

// Refuses poles that are not finite and weights that are all zero.
Result<void> check_poles(std::span<const Hpoint> poles);

// Divides equal weights out of the poles, to exactly one, and returns whether the poles are rational: weights differ
// (or are all zero, or too small to divide by).
bool divide_out_equal_weights(std::span<Hpoint> poles);

// Premultiplied poles of Cartesian points with weights (none: all one).
Result<std::vector<Hpoint>> premultiply(std::span<const Point> points, std::span<const double> weights);

std::size_t multiplicity(std::span<const double> knots, double t);

// Both ends of `range` and the distinct knots strictly inside it.
std::vector<double> breaks(std::span<const double> knots, Interval range);

}  // namespace trimloop::detail
