#pragma once
// How far two splines over the same parameters are apart, as a bound: what every approximation here returns.

#include "kernel/nurbs/surface.h"

namespace trimloop {

// At least the largest distance |a(t) - b(t)| over the common range, rounding included. Both are brought to one degree
// and one set of knots; there the difference times the weight of a is
//   w_a (C_a - C_b) = (A_a - A_b) - C_b (w_a - w_b),
// whose poles bound it. The knots are then refined `refinements` times by halving, which brings the bound towards the
// truth at the rate of 1/4 each. Infinite where weights are not positive or the domains have no part in common.
double deviation_bound(const NurbsCurve& a, const NurbsCurve& b, int refinements = 2);
double deviation_bound(const NurbsSurface& a, const NurbsSurface& b, int refinements = 2);

}  // namespace trimloop
