#pragma once

#include "kernel/geometry/surface.h"

namespace trimloop::pcurve {

// The curve of constant u (or v) over a bounded range of the other parameter, with that parameter as its own. Exact
// wherever the type allows; of an offset surface a cubic spline through points (a few micrometres per metre off).
// Null for degenerate input.
CurvePtr isocurve(const Surface&, bool constant_u, double value, Interval range);

}  // namespace trimloop::pcurve
