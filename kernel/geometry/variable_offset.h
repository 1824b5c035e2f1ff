#pragma once
// The curve beside a curve at a distance that changes along it.

#include <functional>

#include "kernel/geometry/approximate.h"

namespace trimloop {

// C(t) + distance(t) * normalized(side x C'(t)) over the range of the bounded `basis`. A segment when the basis is one and
// the distance is affine in t (deviation 0); else cubic pieces within `tolerance_mm`. `law_breaks` are parameters where
// the distance has corners.
Result<SpaceApproximation> variable_offset(const Curve& basis, const std::function<double(double)>& distance, Vector side,
                                           const std::vector<double>& law_breaks, double tolerance_mm);

}  // namespace trimloop
