#pragma once
// Solids swept from closed planar profiles, as exact boundary representations: planes, cylinders, cones, spheres and tori
// where the profile's lines and circles give them, else surfaces of extrusion and revolution. Nothing is approximated.

#include "kernel/topology/body.h"

namespace trimloop {

// A planar profile: curves end to end (gaps up to the tolerance are closed by the vertices), either the whole of one
// closed curve or several.
using Profile = std::vector<Curve>;

// The profile's smooth pieces (the children of composites, the sides of polylines).
Profile pieces_of(const Curve& curve);

// How far the profile is from closing and from being of one piece: the largest distance from an end to the next start.
// `open`: without that from the last end to the first start.
double largest_gap(const Profile& profile, bool open = false);
Box bounding_box(const Profile& profile);

// The closed profile moved along `direction` (any but its plane). Degenerate when the profile is not closed or not
// planar within `tolerance_mm`, or when the direction lies in its plane.
Result<Body> extrude(const Profile& profile, Vector direction, double tolerance_mm);

// The profile turned by `angle_rad` (0 .. 2 pi] about an axis in its plane, right-handed. An open profile is closed by
// its ends' perpendiculars to the axis and the axis (`close_on_axis`) or by a straight line between its ends. Degenerate
// when the profile crosses the axis or does not lie in a plane with it.
struct Axis {
  Point origin;
  Vector direction{0, 0, 1};
};
Result<Body> revolve(Profile profile, const Axis& axis, double angle_rad, bool close_on_axis, double tolerance_mm);

// Whole closed surface as a solid: sphere, torus or a NURBS that closes on itself. Degenerate when it does not.
Result<Body> solid_of(SurfacePtr surface, double tolerance_mm);

}  // namespace trimloop
