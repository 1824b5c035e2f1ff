#pragma once

#include <optional>

#include "kernel/pcurve/fit_pcurve.h"

namespace trimloop::pcurve {

// The exact pcurve on a surface whose parameters are affine coordinates of a plane (a plane, a bilinear patch over a
// parallelogram): the curve itself in those coordinates, without its height. Nothing when surface or curve do not
// allow that.
std::optional<FittedPcurve> flattened(const Sheet&, const Curve& curve, Interval range);

}  // namespace trimloop::pcurve
