#pragma once
// Bodies made by hand for tests: exact surfaces, exact pcurves, edges shared between faces, closed shells.
// Nothing of kernel/heal is used, so that they can serve as its reference.

#include "kernel/topology/body.h"

namespace trimloop::test {

Body box(Point lo, Point hi);                                          // 6 faces, 12 edges, 8 vertices
Body cylinder(Point base, double radius, double height);               // axis +z; lateral face with seam, two caps
Body cone(Point base, double radius, double height);                   // axis +z; lateral face with seam and apex, base
Body sphere(Point centre, double radius);                              // one face, one seam, two poles
Body torus(Point centre, double major_radius, double minor_radius);    // one face, two seams
struct RoundHole {
  double x = 0, y = 0, radius = 1;
};
// Plane sheet [0, width] x [0, depth] at z = 0 with round holes.
Body plate(double width, double depth, const std::vector<RoundHole>& holes);

}  // namespace trimloop::test
