#pragma once
// Knot vectors by rule, and the two conventions of counting them.
//
// Here and in IGES, STEP and The NURBS Book a spline of n poles and degree p has n + p + 1 knots; the first and the
// last of them carry no shape. The seeds and others leave them out and count n + p - 1.

#include <span>
#include <vector>

#include "kernel/nurbs/curve.h"

namespace trimloop {

// Domain [0, poles - degree], spans of one. At least degree + 1 poles.
std::vector<double> uniform_knots(int degree, std::size_t poles);  // 0 at the domain's start, loose ends
std::vector<double> clamped_knots(int degree, std::size_t poles);  // Bezier end conditions: end knots degree + 1 times

// The full vector with its outermost knots repeated, and without them.
std::vector<double> from_short_knots(std::span<const double> knots);
std::vector<double> to_short_knots(std::span<const double> knots);

// Seed 001's other end condition: each end point repeated until it counts `degree` times over uniform knots. The curve
// reaches the end points with all derivatives zero there; it is not a clamped knot vector.
Result<NurbsCurve> with_repeated_ends(int degree, std::span<const Point> points);

// A spline of any number of components at t in its domain (colours, temperatures, ...): pole i is
// values[i * components] .. . Same basis, same clamping as NurbsCurve. A3.1.
std::vector<double> spline_value(int degree, std::span<const double> knots, std::span<const double> values,
                                 std::size_t components, double t);

}  // namespace trimloop
