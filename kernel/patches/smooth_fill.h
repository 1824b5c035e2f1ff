#pragma once
// The patches of an n-sided fill with continuous tangent planes (not part of the public face).

#include <span>
#include <utility>

#include "kernel/nurbs/surface.h"

namespace trimloop::detail {

// `halves`: of each side, split at its middle. Patch i has the centre at (0,0), spoke i along u and spoke i + 1 along v.
// Bidegree 4, or that of the sides.
Result<std::vector<NurbsSurface>> smooth_patches(std::span<const std::pair<NurbsCurve, NurbsCurve>> halves, Point centre);

}  // namespace trimloop::detail
