#pragma once

#include "kernel/geometry/surface.h"

namespace trimloop::pcurve {

struct Lifted {
  CurvePtr curve;            // over the pcurve's parameter
  double deviation_mm = 0;   // 0: exact; else measured at four points a piece
};
// The model curve of an edge that is known only through its curve in parameter space, t -> S(P(t)) over `range`. Exact
// on planes and along lines of constant u or v (offset surfaces apart, isocurve.h); else a cubic spline.
Result<Lifted> lift(const Surface&, const Curve2& pcurve, Interval range, double tolerance_mm);

}  // namespace trimloop::pcurve
