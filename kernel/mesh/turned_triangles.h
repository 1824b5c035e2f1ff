#pragma once
// A few triangles may be sound in the chart and still look away from their surface in space, or have no area there:
// where a boundary chord bows as much as the triangle beside it is high, or points of a straight edge line up.
// They are removed by flipping one of their sides.

#include <span>

#include "kernel/mesh/stop_check.h"
#include "kernel/mesh/tessellate.h"

namespace trimloop::mesh {

// Flips sides inside the face until no flip makes the worse one of two triangles look better along the surface's
// normals. A flip keeps both triangles positive in the parameter plane (negative for a `reversed` face), and its new
// side within the deflection and the angle. `points`: by face vertex. Returns the triangles that changed, ascending.
// May end early when stopped.
std::vector<std::uint32_t> turn_back(FaceMesh&, std::span<const Point> points, const Surface&, bool reversed,
                                     const TessellationOptions& bounds, StopCheck&);

}  // namespace trimloop::mesh
