#pragma once
// Inversion of points and tangents. The NURBS Book, 2nd ed., chapter 6.

#include "kernel/geometry/surface.h"

namespace trimloop {

// The parameter of a point that lies on the shape within the tolerance; NotFound with the distance when it does not. Of
// several the one of the nearest point (kernel/geometry/curve.h, surface.h).
Result<double> invert_point(const Curve&, Point, double tolerance);
Result<Uv> invert_point(const Surface&, Point, double tolerance);

// Direction (du, dv) whose image du Su + dv Sv is the tangent part of a vector; `off_plane` is what is left of it.
// Degenerate where Su and Sv span no plane.
struct TangentInversion {
  Uv direction;
  double off_plane = 0;
};
Result<TangentInversion> invert_tangent(const Surface&, Uv, Vector);

}  // namespace trimloop
