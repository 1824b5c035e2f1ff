#pragma once
// An n-sided hole filled with n four-sided patches around a centre (seed 001 §8.3.3).

#include <span>

#include "kernel/nurbs/surface.h"

namespace trimloop {

struct NSidedFill {
  std::vector<NurbsSurface> patches;  // patch i between the middles of sides i and i + 1, (1,1) at the centre
  Point centre;
  double boundary_miss = 0;           // bound on the distance of the patches' outer sides from the given curves
  double spoke_angle_rad = 0;         // largest angle of normals across the spokes between patches (sampled): the G1 defect
};
// Sides follow one another around the hole, end to start within `tolerance` (their ends are then taken as one point),
// three or more. Each patch is the Coons patch of two half sides and two spokes; spokes are cubics that leave the sides
// towards the centre and reach it in one plane. Position is continuous everywhere; tangent planes are at the centre
// only, elsewhere the defect is stated. Unsupported for rational sides.
Result<NSidedFill> n_sided_fill(std::span<const NurbsCurve> sides, double tolerance);

}  // namespace trimloop
