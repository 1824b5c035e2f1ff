#pragma once
// A first set of interior points from curvature alone: staggered rows whose distances follow the admissible steps, so
// that refinement only has to repair what the estimate missed. For even curvature the triangles are near optimal
// (area 2.6 eps / sqrt K on elliptic places, 4.5 eps / sqrt -K on hyperbolic ones).

#include <span>

#include "kernel/mesh/chart.h"
#include "kernel/mesh/triangulation.h"

namespace trimloop::mesh {

// Points inside the closed polygons (odd parity), in chart coordinates, at a distance from every segment.
// Nothing when the estimate exceeds `max_points`.
std::vector<Uv> seed_points(const Chart&, std::span<const Uv> polygon, std::span<const Segment>, std::size_t max_points);

}  // namespace trimloop::mesh
