#pragma once
// Surfaces from curves by closed forms, exact. The NURBS Book, 2nd ed., chapter 8 and section 10.2. Curves may be
// rational, of any degree; their active ranges count.

#include <span>

#include "kernel/nurbs/surface.h"

namespace trimloop {

// Corners at (u, v) = (0, 0), (1, 0), (0, 1), (1, 1).
Result<NurbsSurface> bilinear(Point p00, Point p10, Point p01, Point p11);
// S(u, v) = C(u) + v direction, v in [0, 1]. The general cylinder.
Result<NurbsSurface> extruded(const NurbsCurve&, Vector direction);
// S(u, v) = (1 - v) A(u) + v B(u) of homogeneous points, over A's parameters: straight lines v -> S. Degrees, knots and
// range of B are brought to those of A; equal weights give equal ratios on the lines.
Result<NurbsSurface> ruled(const NurbsCurve& a, const NurbsCurve& b);
// The cone over a curve: v = 0 is the curve, v = 1 the apex on a degenerate side. An ideal apex (w = 0) is a direction:
// the cylinder, which at v = 1 has run to infinity.
Result<NurbsSurface> cone(const NurbsCurve&, Hpoint apex);
// S(u, v) = A(u) + B(v) - B(start): A moved along B.
Result<NurbsSurface> translational(const NurbsCurve& a, const NurbsCurve& b);
// The generatrix (along v) turned about the axis through `angle` (along u, knots 0, 1, ..). A8.1. Degenerate without an
// axis. Poles on the axis give degenerate sides.
Result<NurbsSurface> revolved(const NurbsCurve& generatrix, Point on_axis, Vector axis, Interval angle_rad);
// Profile P(u) in the xz plane swung about z along the trajectory T(v) in the xy plane, eq. 10.1:
// S = (factor Px Tx, factor Px Ty, Pz).
Result<NurbsSurface> swung(const NurbsCurve& profile, const NurbsCurve& trajectory, double factor = 1);

// Curves over one degree, one set of knots and the range of the first, clamped; exact. Knots that differ by less than
// `same_knot` of the range are taken as one (the shape of the later curve then moves by as much).
std::vector<NurbsCurve> made_compatible(std::span<const NurbsCurve>, double same_knot = 1e-13);

}  // namespace trimloop
