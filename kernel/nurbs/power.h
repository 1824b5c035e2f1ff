#pragma once
// Piecewise cubic power polynomials (the spline form of IGES 112 and 114) as B-splines, exactly.

#include <array>
#include <span>

#include "kernel/nurbs/curve.h"
#include "kernel/nurbs/surface.h"

namespace trimloop {

struct PowerCurve {
  NurbsCurve curve;        // cubic, knots are the breaks (three-fold inside), same parameter
  double largest_gap = 0;  // between the end of a segment and the start of the next, in the coefficients' unit
};
// Segment i: sum over k of c[k] (t - breaks[i])^k for x, then y, then z. Breaks ascending, one more than segments.
Result<PowerCurve> from_power(std::span<const double> breaks, std::span<const std::array<double, 12>> segments);

struct PowerSurface {
  NurbsSurface surface;
  double largest_gap = 0;
};
// Patch (i, j) at patches[i * stride + j]: sum over k, l of c[4 l + k] (u - breaks_u[i])^k (v - breaks_v[j])^l for x
// (16 coefficients), then y, then z.
Result<PowerSurface> from_power(std::span<const double> breaks_u, std::span<const double> breaks_v,
                                std::span<const std::array<double, 48>> patches, std::size_t stride);

}  // namespace trimloop
