// Points and derivatives of surfaces. Each type has its own functions; the public ones at the end pick the set.

#include "kernel/geometry/surface.h"

#include "kernel/geometry/arc_length.h"
#include "kernel/geometry/detail.h"

namespace trimloop {
namespace {

// ---- Plane

Point point_of(const Plane& s, Uv p) { return s.frame.origin + (p.u * s.frame.x + p.v * s.frame.y); }
SurfaceJet jet_of(const Plane& s, Uv p) { return {point_of(s, p), s.frame.x, s.frame.y, {}, {}, {}}; }

// ---- Cylinder, cone, sphere, torus: origin + rho(v) e(u) + h(v) z, where e is the radial direction at angle u.

struct Profile {  // rho and h with their derivatives
  double rho, h, rho1, h1, rho2, h2;
};
Profile profile(const Cylinder& s, double v) { return {s.radius, v, 0, 1, 0, 0}; }
Profile profile(const Cone& s, double v) {
  const double slope = std::tan(s.half_angle_rad);
  return {s.radius + v * slope, v, slope, 1, 0, 0};
}
Profile circular_profile(double centre, double radius, double v) {
  const double c = radius * std::cos(v), s = radius * std::sin(v);
  return {centre + c, s, -s, c, -c, -s};
}
Profile profile(const Sphere& s, double v) { return circular_profile(0, s.radius, v); }
Profile profile(const Torus& s, double v) { return circular_profile(s.major_radius, s.minor_radius, v); }

template <class Turned>
SurfaceJet jet_of(const Turned& s, Uv p) {
  const Profile k = profile(s, p.v);
  const double c = std::cos(p.u), sn = std::sin(p.u);
  const Frame& f = s.frame;
  const Vector e = c * f.x + sn * f.y, e1 = c * f.y - sn * f.x;
  return {f.origin + (k.rho * e + k.h * f.z),
          k.rho * e1,
          k.rho1 * e + k.h1 * f.z,
          -k.rho * e,
          k.rho1 * e1,
          k.rho2 * e + k.h2 * f.z};
}
template <class Turned>
Point point_of(const Turned& s, Uv p) {
  const Profile k = profile(s, p.v);
  return s.frame.origin + (k.rho * (std::cos(p.u) * s.frame.x + std::sin(p.u) * s.frame.y) + k.h * s.frame.z);
}

// ---- Revolution

struct Turn {  // rotation about the axis by u, and its first and second derivatives with respect to u
  Vector axis;
  double c, s;
  Turn(const Revolution& r, double u) : axis(r.axis), c(std::cos(u)), s(std::sin(u)) {}
  Vector value(Vector a) const {
    const Vector along = dot(a, axis) * axis;
    return along + c * (a - along) + s * cross(axis, a);
  }
  Vector first(Vector a) const { return c * cross(axis, a) - s * (a - dot(a, axis) * axis); }
  Vector second(Vector a) const { return -c * (a - dot(a, axis) * axis) - s * cross(axis, a); }
};
Point point_of(const Revolution& r, Uv p) {
  if (!r.generatrix) return {};
  return r.axis_origin + Turn(r, p.u).value(evaluate(*r.generatrix, p.v) - r.axis_origin);
}
SurfaceJet jet_of(const Revolution& r, Uv p) {
  if (!r.generatrix) return {};
  const Turn turn(r, p.u);
  const CurveJet c = jet(*r.generatrix, p.v);
  const Vector arm = c.point - r.axis_origin;
  return {r.axis_origin + turn.value(arm),
          turn.first(arm),
          turn.value(c.d1),
          turn.second(arm),
          turn.first(c.d1),
          turn.value(c.d2)};
}

// ---- Extrusion

Point point_of(const Extrusion& e, Uv p) {
  return e.directrix ? evaluate(*e.directrix, p.u) + p.v * e.direction : Point{};
}
SurfaceJet jet_of(const Extrusion& e, Uv p) {
  if (!e.directrix) return {};
  const CurveJet c = jet(*e.directrix, p.u);
  return {c.point + p.v * e.direction, c.d1, e.direction, c.d2, {}, {}};
}

// ---- Ruled

// One of the two curves over [0, 1].
struct Side {
  const CurvePtr& curve;
  bool reversed;
  bool by_length;
  const ArcLength* table;
};
Side first_side(const Ruled& r) { return {r.first, false, r.equal_arc_length, r.first_length.get()}; }
Side second_side(const Ruled& r) { return {r.second, r.second_reversed, r.equal_arc_length, r.second_length.get()}; }

double parameter_at(const Side& side, const ArcLength* table, double u) {
  const double fraction = side.reversed ? 1 - u : u;
  return table ? table->parameter(fraction) : range(*side.curve).at(fraction);
}
CurveJet side_jet(const Side& side, const ArcLength* table, double u) {
  const double sign = side.reversed ? -1 : 1;
  const CurveJet j = jet(*side.curve, parameter_at(side, table, u));
  double t1 = sign * range(*side.curve).length(), t2 = 0;  // dt/du and its derivative
  if (table) {
    const double speed = norm(j.d1);
    if (!(speed > 0)) return {j.point, {}, {}};
    t1 = sign * table->total() / speed;
    t2 = -t1 * t1 * dot(j.d1, j.d2) / (speed * speed);
  }
  return {j.point, t1 * j.d1, t1 * t1 * j.d2 + t2 * j.d1};
}
CurveJet side_jet(const Side& side, double u) {
  if (!side.curve) return {};
  if (side.by_length && !side.table) {
    const ArcLength measured(side.curve);
    return side_jet(side, &measured, u);
  }
  return side_jet(side, side.by_length ? side.table : nullptr, u);
}
SurfaceJet jet_of(const Ruled& r, Uv p) {
  const CurveJet a = side_jet(first_side(r), p.u), b = side_jet(second_side(r), p.u);
  const Vector across = b.point - a.point;
  return {p.v == 1 ? b.point : a.point + p.v * across,
          a.d1 + p.v * (b.d1 - a.d1),
          across,
          a.d2 + p.v * (b.d2 - a.d2),
          b.d1 - a.d1,
          {}};
}
Point point_of(const Ruled& r, Uv p) { return jet_of(r, p).point; }

// ---- Offset

// n = N / |N| with N = Su x Sv;  n_u = (N_u - (n . N_u) n) / |N|.
void jet1_of(const OffsetSurface& s, Uv p, Point& point, Vector& du, Vector& dv) {
  if (!s.basis) return void(point = {}), void(du = dv = {});
  const SurfaceJet j = jet(*s.basis, p);
  const Vector across = cross(j.du, j.dv);
  const double size = norm(across);
  du = j.du;
  dv = j.dv;
  if (!(size > 1e-12 * norm(j.du) * norm(j.dv))) {  // a pole of the basis: the derivatives are one-sided limits at best
    point = j.point + s.distance * normal(*s.basis, p);
    return;
  }
  const Vector n = across / size;
  const Vector n_u = cross(j.duu, j.dv) + cross(j.du, j.duv), n_v = cross(j.duv, j.dv) + cross(j.du, j.dvv);
  point = j.point + s.distance * n;
  du += s.distance / size * (n_u - dot(n, n_u) * n);
  dv += s.distance / size * (n_v - dot(n, n_v) * n);
}
// Second derivatives need third ones of the basis; a central difference (relative error about 1e-8) has to do.
SurfaceJet jet_of(const OffsetSurface& s, Uv p) {
  SurfaceJet out;
  jet1_of(s, p, out.point, out.du, out.dv);
  if (!s.basis) return out;
  const detail::Rectangle r = detail::rectangle(*s.basis);
  const auto inside = [](const Interval& i, bool free, double t) { return free ? t : i.clamp(t); };
  const double hu = 1e-5 * (r.u.is_bounded() ? r.u.length() : 1), hv = 1e-5 * (r.v.is_bounded() ? r.v.length() : 1);
  const double u0 = inside(r.u, r.free_u, p.u - hu), u1 = inside(r.u, r.free_u, p.u + hu);
  const double v0 = inside(r.v, r.free_v, p.v - hv), v1 = inside(r.v, r.free_v, p.v + hv);
  if (!(u1 > u0) || !(v1 > v0)) return out;
  Point ignored;
  Vector du0, dv0, du1, dv1;
  jet1_of(s, {u0, p.v}, ignored, du0, dv0);
  jet1_of(s, {u1, p.v}, ignored, du1, dv1);
  out.duu = (du1 - du0) / (u1 - u0);
  out.duv = (dv1 - dv0) / (u1 - u0);
  jet1_of(s, {p.u, v0}, ignored, du0, dv0);
  jet1_of(s, {p.u, v1}, ignored, du1, dv1);
  out.dvv = (dv1 - dv0) / (v1 - v0);
  return out;
}
Point point_of(const OffsetSurface& s, Uv p) {
  return s.basis ? evaluate(*s.basis, p) + s.distance * normal(*s.basis, p) : Point{};
}

// ---- NURBS

Point point_of(const NurbsSurface& s, Uv p) { return evaluate(s, p); }
SurfaceJet jet_of(const NurbsSurface& s, Uv p) { return jet(s, p); }
void jet1_of(const NurbsSurface& s, Uv p, Point& point, Vector& du, Vector& dv) { jet1(s, p, point, du, dv); }

template <class S>
void jet1_of(const S& s, Uv p, Point& point, Vector& du, Vector& dv) {
  const SurfaceJet j = jet_of(s, p);
  point = j.point;
  du = j.du;
  dv = j.dv;
}

}  // namespace

Point evaluate(const Surface& s, Uv p) {
  return std::visit([p](const auto& shape) { return point_of(shape, p); }, s.shape);
}
void jet1(const Surface& s, Uv p, Point& point, Vector& du, Vector& dv) {
  std::visit([&](const auto& shape) { jet1_of(shape, p, point, du, dv); }, s.shape);
}
SurfaceJet jet(const Surface& s, Uv p) {
  return std::visit([p](const auto& shape) { return jet_of(shape, p); }, s.shape);
}

Ruled make_ruled(CurvePtr first, CurvePtr second, bool second_reversed, bool equal_arc_length) {
  Ruled out{std::move(first), std::move(second), second_reversed, equal_arc_length};
  if (equal_arc_length && out.first) out.first_length = std::make_shared<const ArcLength>(out.first);
  if (equal_arc_length && out.second) out.second_length = std::make_shared<const ArcLength>(out.second);
  return out;
}

}  // namespace trimloop
