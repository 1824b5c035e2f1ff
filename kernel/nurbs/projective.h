#pragma once
// Projective maps as first-class operations: x' = M x on homogeneous points, exact on curves and surfaces (The NURBS
// Book, 2nd ed., section 6.3; perspective included). Points that go to infinity become ideal poles or zero weights.

#include <array>

#include "kernel/nurbs/surface.h"

namespace trimloop {

struct Projective {  // rows; acts on (x, y, z, 1)
  std::array<std::array<double, 4>, 4> m{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
};
Hpoint apply(const Projective&, const Hpoint&);
Point apply(const Projective&, Point);  // not finite where the point goes to infinity
Projective operator*(const Projective& after, const Projective& before);
// Central perspective from `eye` onto the plane through `on_plane` with that normal. Degenerate: the eye in the plane.
Result<Projective> perspective(Point eye, Point on_plane, Vector normal);
// InvalidArgument when an entry is not finite, Degenerate when all of the shape goes to infinity.
Result<NurbsCurve> transformed(const NurbsCurve&, const Projective&);
Result<NurbsSurface> transformed(const NurbsSurface&, const Projective&);

}  // namespace trimloop
