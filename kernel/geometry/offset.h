#pragma once
// Offsets of curves and surfaces as shapes of the closed set: exact where an offset is one, else cubic splines with a
// bound that is proven.
//
// Proof, per piece: with the approximation B, D = B - C, unit tangent T and the offset d along N,
//   |B - (C + d N)|^2 = (D.N - d)^2 + (D.T)^2 (+ the part off the plane),
// and |D|^2 - d^2 and D.T are ratios of polynomials whose Bernstein coefficients bound them (R. Farouki and C. Neff,
// "Analytic properties of plane offset curves", CAGD 7, 1990, for what offsets do).

#include "kernel/geometry/surface.h"

namespace trimloop {

struct CurveOffset {
  // Pieces end to end, in the direction of the curve; several chains where trimming took something out between.
  std::vector<std::vector<Curve>> chains;
  double bound = 0;  // no point of the pieces is farther from the true offset of its parameter; 0: exact
  int trimmed = 0;   // stretches that lay nearer to the curve than the offset and were cut off
};
struct OffsetOptions {
  double tolerance = 1e-6;  // mm
  bool trim = true;  // plane curves: cut off loops, swallowtails and what is nearer to the curve than the distance
  int most_pieces = 4096;
};
// C + distance * normalized(C' x normal), as OffsetCurve. The curve lies in a plane across `normal`, to the tolerance.
// Corners on the outer side are filled by arcs. InvalidArgument: unbounded curves, no normal, not in a plane.
// NoConvergence with the bound reached: a cusp of the curve itself, or too many pieces. An offset that is trimmed away
// entirely has no chains.
Result<CurveOffset> offset(const Curve&, double distance, Vector normal, const OffsetOptions& = {});

struct SurfaceOffset {
  Surface surface;   // elementary, or a NURBS over the parameters of to_nurbs()
  double bound = 0;  // 0: exact
};
// S + distance * normal. Plane, cylinder, cone, sphere and torus exactly, over their own parameters; a NURBS that is
// one comes back as that surface (kernel/geometry/recognize.h has the maps). Others by bicubic patches over the
// rectangle. Unsupported: creases inside. Degenerate: no radius left, or poles inside a freeform surface.
Result<SurfaceOffset> offset(const Surface&, Interval u, Interval v, double distance, double tolerance = 1e-6,
                             int most_patches = 4096);

}  // namespace trimloop
