#pragma once
// The polar form (blossom): the one symmetric, multi-affine map whose diagonal is the polynomial of a span. Poles of
// every refinement, sub-interval or continuation are its values. L. Ramshaw, CAGD 6 (1989); C. de Boor's algorithm with
// a different parameter at each level.

#include "kernel/nurbs/surface.h"

namespace trimloop {

// Homogeneous, of the polynomial over the span of `span_at`; `arguments` holds degree numbers, anywhere on the line.
// Poles of knots that are no span apart may not be combined: with arguments inside the span only convex combinations
// are formed.
Hpoint blossom(const NurbsCurve&, double span_at, std::span<const double> arguments);
// Tensor product: degree_u and degree_v arguments.
Hpoint blossom(const NurbsSurface&, Uv span_at, std::span<const double> arguments_u,
               std::span<const double> arguments_v);
// Bezier poles over any interval of the polynomial of the span of `span_at`: b_i = f(lo .., hi ..), hi taken i times.
std::vector<Hpoint> segment_poles(const NurbsCurve&, double span_at, Interval);

}  // namespace trimloop
