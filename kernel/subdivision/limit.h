#pragma once
// Points and normals of the limit surface at the control points, in closed form (eigenvectors of the schemes' matrices:
// Halstead, Kass and DeRose 1993 for Catmull-Clark; Loop 1987; Doo and Sabin 1978).

#include "kernel/subdivision/schemes.h"

namespace trimloop::subdivision {

struct LimitPoint {
  Point point;
  Vector normal;  // unit, outward; zero on borders and creases, where it is not computed, and where there is none
};

// One per control point (Catmull-Clark, Loop, Butterfly: no normals) or per face (Doo-Sabin: its centre). Unsupported
// for the other schemes. A point that no face uses is its own limit. Semi-sharp creases count as if they were smooth
// once their rounds have passed.
Result<std::vector<LimitPoint>> limit_points(const ControlMesh&, Scheme);

// The share of a neighbour in Loop's new vertex of a valence; 1/16 at valence 6.
double loop_beta(std::size_t valence);

}  // namespace trimloop::subdivision
