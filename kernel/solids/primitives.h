#pragma once
// The primitives of constructive solid geometry as exact boundary representations. Every one stands in a frame of its
// own; sizes are positive (Degenerate otherwise).

#include "kernel/topology/body.h"

namespace trimloop {

Result<Body> make_block(const Frame& corner, double x, double y, double z);
// A block whose side at y = `y` is only `top_x` wide (0: an edge). 0 <= top_x < x.
Result<Body> make_wedge(const Frame& corner, double x, double y, double z, double top_x);
// From the frame's origin along its axis. `top_radius` 0 is an apex.
Result<Body> make_cylinder(const Frame& base, double radius, double height);
Result<Body> make_cone(const Frame& base, double radius, double top_radius, double height);
Result<Body> make_sphere(const Frame& centre, double radius);
Result<Body> make_torus(const Frame& centre, double major_radius, double minor_radius);  // minor < major
Result<Body> make_ellipsoid(const Frame& centre, double a, double b, double c);          // semi-axes along x, y, z

}  // namespace trimloop
