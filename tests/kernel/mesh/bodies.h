#pragma once
// Bodies made by hand for the mesher's tests: natural patches with seams and poles, boxes, capped cylinders, plates.

#include "kernel/topology/body.h"

namespace trimloop::test {

// The curve of `surface` at u = at (along_u false) or v = at (along_u true) over `range`, in the surface's own parameter;
// Line uses 0..1. For cylinder, cone, sphere, torus and NURBS.
struct IsoCurve {
  CurvePtr curve;
  Interval range;
};
IsoCurve iso_curve(const Surface& surface, bool along_u, double at, Interval range);

// One face over a rectangle of parameters. Sides that meet are one seam edge, sides that are a point are poles.
Body patch(Surface surface, Interval u, Interval v, bool reversed = false);

Body box(double x, double y, double z);                    // closed, outward
Body capped_cylinder(double radius, double height);        // closed: side with a seam, two discs
Body plate(double width, double height, int holes_per_side, double hole_radius);  // plane with round holes
// Plane disc about the origin; its hole has its centre at (offset, 0) and begins at the angle `start`.
Body disc(double radius, double hole_radius, double offset, double start);
// Adds a loop with edges of its own: lines between these corners of the face's plane z = 0.
void add_polygon_loop(Body&, FaceId, const std::vector<Uv>& corners);
// The same for the arc of a circle about the origin, from angle.lo to angle.hi, and its chord.
void add_segment_loop(Body&, FaceId, double radius, Interval angle);

// Torus about z as biquadratic rational patches; major radius 0 and half a turn of the minor circle make a sphere.
NurbsSurface nurbs_torus(double major_radius, double minor_radius, bool half_turn = false);
NurbsSurface wavy_patch(int poles_per_side, double size, double amplitude);  // bicubic height field

}  // namespace trimloop::test
