// Nearest points of plane, cylinder, cone, sphere and torus in closed form; in a part of one the sides, which are lines
// and circles, come into question too.

#include <array>

#include "kernel/geometry/surface_descent.h"

namespace trimloop {
namespace {

// Feet of the point on the whole surface; where an angle is not defined (on the axis, in the centre) it is that of
// `hint`. `v` is an angle on sphere and torus.
struct Elementary {
  std::array<Uv, 2> feet;
  int count = 0;
  bool u_is_angle = false, v_is_angle = false;
};

struct Meridian {  // the point in cylinder coordinates
  double angle, rho, h;
};
Meridian meridian(const Frame& f, Point p, double hint) {
  const Vector r = p - f.origin;
  const double x = dot(r, f.x), y = dot(r, f.y), rho = std::hypot(x, y);
  return {rho > 1e-14 * norm(r) ? std::atan2(y, x) : hint, rho, dot(r, f.z)};
}
double angle_or(double y, double x, double hint) { return x == 0 && y == 0 ? hint : std::atan2(y, x); }

Elementary feet_of(const Plane& s, Point p, Uv) {
  const Vector r = p - s.frame.origin;
  return {{Uv{dot(r, s.frame.x), dot(r, s.frame.y)}}, 1};
}
Elementary feet_of(const Cylinder& s, Point p, Uv hint) {
  const Meridian m = meridian(s.frame, p, hint.u);
  return {{Uv{s.radius < 0 ? m.angle + pi : m.angle, m.h}}, 1, true};
}
Elementary feet_of(const Cone& s, Point p, Uv hint) {  // on the near line through the apex, and on the opposite one
  const Meridian m = meridian(s.frame, p, hint.u);
  const double slope = std::tan(s.half_angle_rad), scale = 1 / (1 + slope * slope);
  return {{Uv{m.angle, ((m.rho - s.radius) * slope + m.h) * scale},
           Uv{m.angle + pi, ((-m.rho - s.radius) * slope + m.h) * scale}},
          2,
          true};
}
Elementary feet_of(const Sphere& s, Point p, Uv hint) {
  const Meridian m = meridian(s.frame, p, hint.u);
  if (s.radius < 0) return {{Uv{m.angle + pi, angle_or(-m.h, m.rho, hint.v)}}, 1, true, false};
  return {{Uv{m.angle, angle_or(m.h, m.rho, hint.v)}}, 1, true, false};
}
Elementary feet_of(const Torus& s, Point p, Uv hint) {
  const Meridian m = meridian(s.frame, p, hint.u);
  const double sign = s.minor_radius < 0 ? -1 : 1;
  return {{Uv{m.angle, angle_or(sign * m.h, sign * (m.rho - s.major_radius), hint.v)},
           Uv{m.angle + pi, angle_or(sign * m.h, sign * (-m.rho - s.major_radius), hint.v)}},
          2,
          true,
          true};
}

std::optional<Elementary> elementary_feet(const Surface& s, Point p, Uv hint) {
  if (const auto* plane = std::get_if<Plane>(&s.shape)) return feet_of(*plane, p, hint);
  if (const auto* cylinder = std::get_if<Cylinder>(&s.shape)) return feet_of(*cylinder, p, hint);
  if (const auto* cone = std::get_if<Cone>(&s.shape)) return feet_of(*cone, p, hint);
  if (const auto* sphere = std::get_if<Sphere>(&s.shape)) return feet_of(*sphere, p, hint);
  if (const auto* torus = std::get_if<Torus>(&s.shape)) return feet_of(*torus, p, hint);
  return {};
}

double nearest_turn(double angle, double hint) { return angle + two_pi * std::round((hint - angle) / two_pi); }

}  // namespace

namespace detail {

std::optional<SurfaceFoot> closest_elementary(const Surface& s, Point p, Interval u, Interval v) {
  const auto feet = elementary_feet(s, p, {u.is_bounded() ? u.lo : 0, v.is_bounded() ? v.lo : 0});
  if (!feet) return {};
  const Elementary& e = *feet;
  SurfaceFoot best;
  bool inside = false;
  for (int i = 0; i < e.count; ++i) {
    Uv uv = e.feet[static_cast<std::size_t>(i)];
    if (e.u_is_angle) uv.u = first_at_or_after(u.lo, uv.u);
    if (e.v_is_angle) uv.v = first_at_or_after(v.lo, uv.v);
    if (!u.contains(uv.u) || !v.contains(uv.v)) continue;
    keep_nearer(best, foot_at(s, p, uv));
    inside = inside || i == 0;  // the first foot is the nearest point of the whole surface (of a cone: of its nappe)
  }
  if (inside && !std::holds_alternative<Cone>(s.shape)) return best;
  const auto along_side = [&](bool at_u, double fixed) {
    if (!std::isfinite(fixed)) return;
    const double t = closest_point(elementary_isocurve(s, at_u, fixed, at_u ? v : u), p).t;
    keep_nearer(best, foot_at(s, p, at_u ? Uv{fixed, t} : Uv{t, fixed}));
  };
  for (const double fixed : {u.lo, u.hi}) along_side(true, fixed);
  for (const double fixed : {v.lo, v.hi}) along_side(false, fixed);
  return best;
}

std::optional<SurfaceFoot> closest_elementary_near(const Surface& s, Point p, Uv start) {
  const auto feet = elementary_feet(s, p, start);
  if (!feet) return {};
  const Elementary& e = *feet;
  const Rectangle r = rectangle(s);
  Interval v = r.v;
  if (const auto* cone = std::get_if<Cone>(&s.shape)) {  // stays on the nappe of the start
    const double apex = -cone->radius / std::tan(cone->half_angle_rad);
    if (std::isfinite(apex)) v = start.v < apex ? Interval{-infinity, apex} : Interval{apex, infinity};
  }
  SurfaceFoot best;
  for (int i = 0; i < e.count; ++i) {
    Uv uv = e.feet[static_cast<std::size_t>(i)];
    if (e.u_is_angle) uv.u = nearest_turn(uv.u, start.u);
    uv.v = e.v_is_angle ? nearest_turn(uv.v, start.v) : v.clamp(uv.v);
    keep_nearer(best, foot_at(s, p, uv));
  }
  return best;
}

}  // namespace detail

}  // namespace trimloop
