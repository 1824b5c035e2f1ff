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
enum class FillContinuity : std::uint8_t {
  Position,  // Coons patches: tangent planes agree at the centre only
  Tangent    // G1 along every spoke, identically: the patches' cross derivatives A and B meet A + B = 2 a(u) S'(u)
};
// Sides follow one another around the hole, end to start within `tolerance` (their ends are then taken as one point),
// three or more. Unsupported for rational sides.
// Position: each patch is the Coons patch of two half sides and two spokes; spokes are cubics that leave the sides
// towards the centre and reach it in one plane. Tangent: spokes are quartics, patches biquartic (or of the sides'
// degree); a side with a corner in its middle is Unsupported, sides that do not go around their centre are Degenerate.
Result<NSidedFill> n_sided_fill(std::span<const NurbsCurve> sides, double tolerance,
                                FillContinuity = FillContinuity::Position);

}  // namespace trimloop
