#pragma once
// Surface: a closed set of value types with the parametrizations of ISO 10303-42 (angles in radians).

#include <optional>

#include "kernel/geometry/curve.h"
#include "kernel/nurbs/surface.h"

namespace trimloop {

struct Surface;
using SurfacePtr = std::shared_ptr<const Surface>;

struct Plane {  // origin + u x + v y; unbounded
  Frame frame;
};
struct Cylinder {  // origin + radius (cos u x + sin u y) + v z
  Frame frame;
  double radius = 1;
};
struct Cone {  // origin + (radius + v tan a)(cos u x + sin u y) + v z, a = half angle
  Frame frame;
  double radius = 0;
  double half_angle_rad = pi / 4;
};
struct Sphere {  // origin + radius cos v (cos u x + sin u y) + radius sin v z, v in [-pi/2, pi/2]
  Frame frame;
  double radius = 1;
};
struct Torus {  // origin + (R + r cos v)(cos u x + sin u y) + r sin v z
  Frame frame;
  double major_radius = 2, minor_radius = 1;
};
struct Revolution {  // u: angle about (axis_origin, axis), right-handed, from range_u.lo; v: parameter of the
                     // generatrix
  Point axis_origin;
  Vector axis{0, 0, 1};  // unit
  CurvePtr generatrix;   // position at u = 0
  Interval range_u{0, two_pi};
};
struct Extrusion {  // C(u) + v direction
  CurvePtr directrix;
  Vector direction{0, 0, 1};
  Interval range_v{0, 1};
};
class ArcLength;
struct Ruled {  // (1 - v) A(a(u)) + v B(b(u)), u and v in [0,1]; a, b affine onto the curves' ranges (b backwards if
                // reversed)
  CurvePtr first, second;
  bool second_reversed = false;
  bool equal_arc_length = false;  // a, b by arc length instead of parameter
  // Tables for that, built by make_ruled. Without them each evaluation measures the curves again.
  std::shared_ptr<const ArcLength> first_length = nullptr, second_length = nullptr;
};
struct OffsetSurface {  // S + distance * unit normal of S (Su x Sv)
  SurfacePtr basis;
  double distance = 0;
};

struct Surface {
  std::variant<Plane, Cylinder, Cone, Sphere, Torus, Revolution, Extrusion, Ruled, OffsetSurface, NurbsSurface> shape;
};

Ruled make_ruled(CurvePtr first, CurvePtr second, bool second_reversed = false, bool equal_arc_length = false);

// The rectangle of parameters the surface is defined over. Periodic directions have period_u/v > 0 (angles, 2 pi);
// a NURBS that merely closes has closed_u/v set and no period. Sides that collapse to a point are poles.
struct SurfaceDomain {
  Interval u, v;  // infinite ends for unbounded directions
  double period_u = 0, period_v = 0;
  bool closed_u = false, closed_v = false;  // S(u.lo, v) == S(u.hi, v) within the tolerance; true for periodic ones
  bool pole_u_lo = false, pole_u_hi = false, pole_v_lo = false, pole_v_hi = false;  // that side is one point
  bool is_bounded() const { return u.is_bounded() && v.is_bounded(); }
};
// Closedness and poles are measured with `tolerance_mm` on sampled sides (exact for analytic types).
SurfaceDomain domain(const Surface&, double tolerance_mm = 1e-6);

Point evaluate(const Surface&, Uv);  // NURBS: clamped to the knot domain; analytic: everywhere
void jet1(const Surface&, Uv, Point& point, Vector& du, Vector& dv);
SurfaceJet jet(const Surface&, Uv);
// Unit normal Su x Sv; at a pole the limit along the inward direction; zero vector only when none exists.
Vector normal(const Surface&, Uv);
std::vector<double> breaks_u(const Surface&);  // domain ends (where finite) and lines of reduced smoothness inside
std::vector<double> breaks_v(const Surface&);
Box bounding_box(const Surface&, Interval u, Interval v);  // encloses the patch over a bounded rectangle
Result<Surface> transformed(const Surface&, const Transform&);
// How parameters change under `transformed`: analytic surfaces under scale/mirror. Maps old (u,v) to new.
struct UvMap {
  double uu = 1, uv = 0, vu = 0, vv = 1, u0 = 0, v0 = 0;  // u' = uu u + uv v + u0 ; v' = vu u + vv v + v0
};
Uv apply(const UvMap&, Uv);
UvMap parameter_map(const Surface&, const Transform&);

// Exact NURBS over a bounded rectangle (cut to the domain where the type cannot be extended) and the parameter map per
// direction. Unsupported: offsets, and ruled surfaces whose curves are not matched by rational functions (an arc
// against a line, arcs of different span, equal arc length of anything but lines and circles).
struct ToNurbsSurface {
  NurbsSurface surface;
  ParameterMap map_u, map_v;
  double deviation = 0;  // as in ToNurbsCurve
};
Result<ToNurbsSurface> to_nurbs(const Surface&, Interval u, Interval v);
inline Uv map_to_nurbs(const ToNurbsSurface& n, Uv p) {
  return {map_to_nurbs(n.map_u, p.u), map_to_nurbs(n.map_v, p.v)};
}
inline Uv map_from_nurbs(const ToNurbsSurface& n, Uv p) {
  return {map_from_nurbs(n.map_u, p.u), map_from_nurbs(n.map_v, p.v)};
}

struct SurfaceFoot {
  Uv uv;
  Point point;
  double distance = infinity;
};
// Nearest point over the rectangle `u` x `v` (bounded; defaults to the domain). Closed forms for elementary surfaces;
// otherwise a seed grid per patch and Newton, sides and corners are candidates.
SurfaceFoot closest_point(const Surface&, Point, std::optional<Interval> u = {}, std::optional<Interval> v = {});
// From a start only; may run outside the domain along periodic directions (unwrapped), clamped otherwise.
SurfaceFoot closest_point_near(const Surface&, Point, Uv start);

}  // namespace trimloop
