#pragma once
// Clamped, unclamped and periodic forms of one shape. The NURBS Book, 2nd ed., section 12.2 (A12.1).

#include "kernel/nurbs/surface.h"

namespace trimloop {

NurbsCurve clamped(const NurbsCurve&);  // over the knot domain; the range stays
NurbsSurface clamped(const NurbsSurface&);
// The same curve over other outer knots: `before` ascends to the first knot of the domain and replaces the degree knots
// left of it, `after` those right of its last. Poles by the polar form of the outermost spans. InvalidArgument when the
// counts or the order are wrong, or a knot is repeated so often that the end would come loose.
Result<NurbsCurve> unclamped(const NurbsCurve&, std::span<const double> before, std::span<const double> after);
// A12.1: the outer knots repeat the spacing of the other end, as if the domain were a period.
NurbsCurve unclamped(const NurbsCurve&);

// Whether the knots repeat with the domain as period and the last degree poles repeat the first, to the bit or within
// `tolerance` in each homogeneous coordinate.
bool is_periodic_form(const NurbsCurve&, double tolerance = 0);

struct PeriodicForm {
  NurbsCurve curve;      // unclamped, the seam a knot of multiplicity degree - continuity
  int continuity = 0;    // of the homogeneous curve across the seam
  double deviation = 0;  // bound on what making the repeated poles equal moved
};
// A closed curve as a periodic spline with the highest continuity across the seam that costs at most `tolerance`.
// Degenerate when the ends do not meet within it.
Result<PeriodicForm> periodic(const NurbsCurve&, double tolerance);

struct PeriodicSurface {
  NurbsSurface surface;
  int continuity = 0;
  double deviation = 0;
};
Result<PeriodicSurface> periodic_u(const NurbsSurface&, double tolerance);
Result<PeriodicSurface> periodic_v(const NurbsSurface&, double tolerance);
// From the poles of one period: pole i + n is pole i, knot i + n is knot i + period. Cylinder and torus nets (S7).
Result<NurbsCurve> from_periodic(int degree, std::span<const double> knots_of_period, std::span<const Hpoint> poles);
Result<NurbsSurface> from_periodic(int degree_u, int degree_v, std::span<const double> knots_u,
                                   std::span<const double> knots_v, std::span<const Hpoint> poles, bool periodic_u,
                                   bool periodic_v);

}  // namespace trimloop
