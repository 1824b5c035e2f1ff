#pragma once
// Ruled strips that can be bent from a flat sheet, as ships' hulls are plated (seed 002 §1): rulings whose two end
// tangents lie in one plane, so that the normal does not turn along a ruling (do Carmo, section 3.5).

#include "kernel/nurbs/surface.h"

namespace trimloop {

struct DevelopableStrip {
  NurbsSurface surface;        // ruled: u along both curves, v from the first (0) to the second (1)
  double curve_miss = 0;       // largest distance, at the middles between rulings, of the sides from the curves
  double twist_rad = 0;        // largest turn of the normal along a ruling (sampled); 0: developable
  std::size_t unmatched = 0;   // rulings for which no plane was found: there the strip is ruled only
};
// `rulings` (2 or more) are spread over the first curve's parameter; each finds its partner on the second by
// det(A', B', B - A) = 0, never running backwards. Sides are cubics through the rulings' ends.
Result<DevelopableStrip> developable_strip(const NurbsCurve& first, const NurbsCurve& second, int rulings = 65);

// Largest turn of the normal between the ends of a ruling v = 0 .. 1 of any ruled surface, at `samples` rulings.
double ruling_twist(const NurbsSurface&, int samples = 129);

}  // namespace trimloop
