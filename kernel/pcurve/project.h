#pragma once
// The image of a curve in space in a surface's parameter plane, with a proven distance.

#include "kernel/pcurve/deviation.h"

namespace trimloop {

struct ProjectOptions {
  double tolerance_mm = 1e-6;  // how well the pcurve follows the feet of the curve's points
  std::optional<Uv> start;     // near the image of the range's start: which sheet, which turn
};

struct ProjectedCurve {
  Curve2 pcurve;
  Interval range;       // its parameters at the ends of the curve's range; affine between
  Deviation deviation;  // of the curve from the surface at the pcurve
};

// Follows the nearest point along the curve and runs on over periods and seams (unwrapped): a thread of ten turns has
// an image ten periods long. Exact on planes; else a cubic spline, refined until it follows the feet within the
// tolerance. A curve off the surface is projected; its distance is then part of the deviation. Of a NURBS surface that
// merely closes the image runs on beyond the knot domain by whole ranges (DeviationOptions::period_u).
Result<ProjectedCurve> project(const Curve&, Interval range, const Surface&, const ProjectOptions& = {});

}  // namespace trimloop
