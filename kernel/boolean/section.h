#pragma once
// Where two elementary surfaces meet, as lines and conics in closed form (not part of the public face).
//
// J. Levin, "A parametric algorithm for drawing pictures of solid objects composed of quadric surfaces", CACM 19 (1976);
// C. M. Hoffmann, "Geometric and Solid Modeling" (1989), ch. 5; J. R. Miller, R. N. Goldman, "Geometric algorithms for
// detecting and calculating all conic sections in the intersection of any two natural quadric surfaces" (1995).

#include "kernel/geometry/surface.h"

namespace trimloop::boolean {

// The same set of points, to `tolerance_mm` within `reach` (where both are looked at). `opposed`: their normals differ.
struct Coincidence {
  bool same = false, opposed = false;
};
Coincidence coincidence(const Surface&, const Surface&, const Box& reach, double tolerance_mm);

// All curves along which the surfaces cross; unbounded ones cut to a range that covers `reach`. Where they only touch
// (closer than `tolerance_mm`) there is no curve. Nothing when the pair has no closed form here.
std::optional<std::vector<Curve>> section(const Surface&, const Surface&, const Box& reach, double tolerance_mm);

}  // namespace trimloop::boolean
