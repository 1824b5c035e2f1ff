#pragma once
// The curve in parameter space that belongs to a curve in space.

#include "kernel/pcurve/sheet.h"

namespace trimloop::pcurve {

struct FittedPcurve {
  Curve2 pcurve;
  Interval range;       // its parameters at the curve's range.lo and range.hi; affine between
  double gap_mm = 0;    // largest distance between the curve and the surface at the pcurve
  bool proven = false;  // gap_mm is a bound that holds (kernel/pcurve/deviation.h), else the largest distance seen
};

struct ParameterHint {
  double t = 0;  // of the curve: one of its ends
  Uv uv;         // about where it should be, in the cover
};

// Projects `curve` over `range` onto the surface. Exact where the surface is flat and its parameters are affine;
// elsewhere a cubic spline through projected points, halved until it follows the projection within `fit_mm`. Runs on
// in the cover (unwrapped) and ends at poles where the curve arrives. Fails when the points cannot be projected.
Result<FittedPcurve> fit_pcurve(const Sheet&, const Curve& curve, Interval range, std::optional<ParameterHint> hint,
                                double fit_mm, double tolerance_mm);

}  // namespace trimloop::pcurve
