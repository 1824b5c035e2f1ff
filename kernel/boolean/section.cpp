#include "kernel/boolean/section.h"

#include <array>

namespace trimloop::boolean {
namespace {

using Curves = std::vector<Curve>;
using MaybeCurves = std::optional<Curves>;

constexpr double parallel = 1e-12;  // sine of an angle that rounding makes

bool are_parallel(Vector a, Vector b) { return norm(cross(a, b)) <= parallel; }

struct Reach {
  Point centre;
  double radius;
  double tolerance;
};

Curve line(Point at, Vector unit, const Reach& r) {
  const Point start = at + dot(r.centre - at, unit) * unit;
  return {Line{start, start + unit, {-1.01 * r.radius, 1.01 * r.radius}}};
}
Curve circle(Point centre, Vector axis, Vector x, double radius) {
  return {Circle{make_frame(centre, axis, x), radius, {0, two_pi}}};
}
Frame frame_of(Point origin, Vector x, Vector y) { return {origin, x, y, cross(x, y)}; }

// ---- Plane with plane, sphere, cylinder, cone, torus

Curves with_plane(const Plane& a, const Plane& b, const Reach& r) {
  const Vector along = cross(a.frame.z, b.frame.z);
  const double sine = norm(along);
  if (sine <= parallel) return {};
  const Vector d = along / sine;
  const Vector across = cross(d, a.frame.z);  // in a, away from the line
  const double offset = dot(b.frame.origin - r.centre, b.frame.z);
  const Point in_a = r.centre - dot(r.centre - a.frame.origin, a.frame.z) * a.frame.z;
  const double left = offset + dot(r.centre - in_a, b.frame.z);
  return {line(in_a + left / dot(across, b.frame.z) * across, d, r)};
}

Curves with_plane(const Plane& p, const Sphere& s, const Reach& r) {
  const double d = dot(s.frame.origin - p.frame.origin, p.frame.z);
  if (std::abs(d) >= s.radius - r.tolerance) return {};
  return {circle(s.frame.origin - d * p.frame.z, p.frame.z, p.frame.x, std::sqrt((s.radius - d) * (s.radius + d)))};
}

Curves with_plane(const Plane& p, const Cylinder& c, const Reach& r) {
  const Vector n = p.frame.z, axis = c.frame.z;
  const double d = dot(c.frame.origin - p.frame.origin, n), cosine = dot(n, axis);
  if (std::abs(cosine) <= parallel) {
    if (std::abs(d) >= c.radius - r.tolerance) return {};
    const double half = std::sqrt((c.radius - d) * (c.radius + d));
    const Vector across = normalized(cross(axis, n));
    const Point foot = c.frame.origin - d * n;
    return {line(foot + half * across, axis, r), line(foot - half * across, axis, r)};
  }
  const Point centre = c.frame.origin - d / cosine * axis;
  if (are_parallel(n, axis)) return {circle(centre, axis, c.frame.x, c.radius)};
  const Vector minor = normalized(cross(n, axis)), major = cross(minor, n);
  return {Curve{Ellipse{frame_of(centre, major, minor), c.radius / std::abs(cosine), c.radius, {0, two_pi}}}};
}

// Derivation: with the apex at the origin, p = d n + s e1 + t e2 in the plane and k = axis . e1, the cone (p . axis)^2 =
// C p^2 (C = cos^2 of its half angle) is A s^2 - 2 c d k s + C t^2 = (c^2 - C) d^2 with A = C - k^2, c = axis . n.
Curves with_plane(const Plane& p, const Cone& cone, const Reach& r) {
  const Vector n = p.frame.z, axis = cone.frame.z;
  const double slope = std::tan(cone.half_angle_rad), sa = std::abs(std::sin(cone.half_angle_rad)), ca = std::cos(cone.half_angle_rad);
  const Point apex = cone.frame.origin - cone.radius / slope * axis;
  const double d = dot(p.frame.origin - apex, n), c = dot(axis, n);  // of the plane from the apex
  if (are_parallel(n, axis)) {
    const double height = d / c, radius = std::abs(height * slope);
    if (radius <= r.tolerance) return {};
    return {circle(apex + height * axis, axis, cone.frame.x, radius)};
  }
  const Vector e1 = normalized(axis - c * n), e2 = cross(n, e1);
  const double k = dot(axis, e1), A = ca * ca - k * k;
  if (std::abs(d) <= r.tolerance) {  // through the apex
    if (A >= -parallel) return {};
    const double cosine = ca / k, sine = std::sqrt(1 - cosine * cosine);
    return {line(apex, cosine * e1 + sine * e2, r), line(apex, cosine * e1 - sine * e2, r)};
  }
  const Point foot = apex + d * n;
  if (std::abs(A) <= 1e-11) {
    const double C = ca * ca, divisor = 2 * c * d * k;
    const double vertex = -(1 - 2 * C) * d * d / divisor, focal = std::abs(divisor) / (4 * C);
    const Vector x = divisor > 0 ? e1 : -e1;
    const double span = std::sqrt((2 * r.radius + distance(foot, r.centre) + std::abs(vertex)) / focal) + 1;
    return {Curve{Parabola{frame_of(foot + vertex * e1, x, divisor > 0 ? e2 : -e2), focal, {-span, span}}}};
  }
  const Point centre = foot + c * d * k / A * e1;
  const double a = std::abs(d) * sa * ca / std::abs(A), b = std::abs(d) * sa / std::sqrt(std::abs(A));
  if (A > 0) return {Curve{Ellipse{frame_of(centre, e1, e2), a, b, {0, two_pi}}}};
  const double span = std::asinh((2 * r.radius + distance(centre, r.centre)) / b) + 1;
  return {Curve{Hyperbola{frame_of(centre, e1, e2), a, b, {-span, span}}},
          Curve{Hyperbola{frame_of(centre, -e1, -e2), a, b, {-span, span}}}};
}

// ---- Surfaces of revolution about one axis: their profiles in the half plane (distance from the axis, height)

struct Profile {
  bool is_line = true;
  Uv at, direction;  // line: unit direction
  double radius = 0;  // circle about `at`
};

struct RoundAxis {
  Point origin;
  Vector axis, x;
};

bool on_axis(const RoundAxis& a, Point p, double tolerance) { return norm(cross(p - a.origin, a.axis)) <= tolerance; }
double height(const RoundAxis& a, Point p) { return dot(p - a.origin, a.axis); }

// The profile about the axis; nothing where the surface does not turn about it.
std::optional<std::vector<Profile>> profiles(const Surface& s, const RoundAxis& a, double tolerance) {
  const auto coaxial = [&](const Frame& f) { return are_parallel(f.z, a.axis) && on_axis(a, f.origin, tolerance); };
  if (const auto* p = std::get_if<Plane>(&s.shape)) {
    if (!are_parallel(p->frame.z, a.axis)) return std::nullopt;
    return std::vector<Profile>{{true, {0, height(a, p->frame.origin)}, {1, 0}}};
  }
  if (const auto* c = std::get_if<Cylinder>(&s.shape)) {
    if (!coaxial(c->frame)) return std::nullopt;
    return std::vector<Profile>{{true, {c->radius, 0}, {0, 1}}};
  }
  if (const auto* c = std::get_if<Cone>(&s.shape)) {
    if (!coaxial(c->frame)) return std::nullopt;
    const double turn = dot(c->frame.z, a.axis) > 0 ? 1 : -1, sa = std::sin(c->half_angle_rad), ca = std::cos(c->half_angle_rad);
    const Uv at{c->radius, height(a, c->frame.origin)};
    return std::vector<Profile>{{true, at, {sa, turn * ca}}, {true, {-at.u, at.v}, {-sa, turn * ca}}};
  }
  if (const auto* b = std::get_if<Sphere>(&s.shape)) {
    if (!on_axis(a, b->frame.origin, tolerance)) return std::nullopt;
    return std::vector<Profile>{{false, {0, height(a, b->frame.origin)}, {}, b->radius}};
  }
  if (const auto* t = std::get_if<Torus>(&s.shape)) {
    if (!coaxial(t->frame)) return std::nullopt;
    return std::vector<Profile>{{false, {t->major_radius, height(a, t->frame.origin)}, {}, t->minor_radius}};
  }
  return std::nullopt;
}

std::vector<Uv> meet(const Profile& p, const Profile& q, double tolerance) {
  if (p.is_line && q.is_line) {
    const double sine = cross(p.direction, q.direction);
    if (std::abs(sine) <= parallel) return {};
    return {p.at + cross(q.at - p.at, q.direction) / sine * p.direction};
  }
  if (!p.is_line && q.is_line) return meet(q, p, tolerance);
  const Uv to = q.at - p.at;
  if (p.is_line) {
    const double off = cross(p.direction, to);
    if (std::abs(off) >= q.radius - tolerance) return {};
    const double along = dot(to, p.direction), half = std::sqrt((q.radius - off) * (q.radius + off));
    return {p.at + (along + half) * p.direction, p.at + (along - half) * p.direction};
  }
  const double d = norm(to);
  if (d >= p.radius + q.radius - tolerance || d <= std::abs(p.radius - q.radius) + tolerance) return {};
  const Uv unit = (1 / d) * to, across{-unit.v, unit.u};
  const double along = 0.5 * (d + (p.radius - q.radius) * (p.radius + q.radius) / d);
  const double half = std::sqrt((p.radius - along) * (p.radius + along));
  return {p.at + along * unit + half * across, p.at + along * unit + -half * across};
}

MaybeCurves coaxial(const Surface& s, const Surface& t, const RoundAxis& a, const Reach& r) {
  const auto ps = profiles(s, a, r.tolerance), qs = profiles(t, a, r.tolerance);
  if (!ps || !qs) return std::nullopt;
  Curves out;
  std::vector<Uv> seen;
  for (const Profile& p : *ps)
    for (const Profile& q : *qs)
      for (const Uv m : meet(p, q, r.tolerance)) {
        if (m.u <= r.tolerance) continue;
        bool known = false;
        for (const Uv o : seen) known = known || norm(o - m) <= r.tolerance;
        if (known) continue;
        seen.push_back(m);
        out.push_back(circle(a.origin + m.v * a.axis, a.axis, a.x, m.u));
      }
  return out;
}

std::optional<RoundAxis> axis_of(const Surface& s) {
  const auto of = [](const Frame& f) { return RoundAxis{f.origin, f.z, f.x}; };
  if (const auto* c = std::get_if<Cylinder>(&s.shape)) return of(c->frame);
  if (const auto* c = std::get_if<Cone>(&s.shape)) return of(c->frame);
  if (const auto* t = std::get_if<Torus>(&s.shape)) return of(t->frame);
  return std::nullopt;
}

// ---- The rest

MaybeCurves cylinders(const Cylinder& a, const Cylinder& b, const Reach& r) {
  const Vector z = a.frame.z;
  const Vector between = b.frame.origin - a.frame.origin;
  if (are_parallel(z, b.frame.z)) {
    const Vector across = between - dot(between, z) * z;
    const double d = norm(across);
    if (d >= a.radius + b.radius - r.tolerance || d <= std::abs(a.radius - b.radius) + r.tolerance) return Curves{};
    const double along = 0.5 * (d + (a.radius - b.radius) * (a.radius + b.radius) / d);
    const double half = std::sqrt((a.radius - along) * (a.radius + along));
    const Vector x = across / d, y = cross(z, x);
    return Curves{line(a.frame.origin + along * x + half * y, z, r), line(a.frame.origin + along * x - half * y, z, r)};
  }
  const Vector w = b.frame.z, n = normalized(cross(z, w));
  if (std::abs(a.radius - b.radius) > r.tolerance || std::abs(dot(between, n)) > r.tolerance) return std::nullopt;
  // Equal radii and axes that meet: two ellipses in the planes between the axes.
  const Vector side = between - dot(between, z) * z, lean = w - dot(w, z) * z;
  const Point meet = b.frame.origin - dot(side, lean) / dot(lean, lean) * w;
  Curves out;
  for (const Vector m : {normalized(z + w), normalized(z - w)}) {
    const double sine = norm(cross(m, z));
    out.push_back(Curve{Ellipse{frame_of(meet, m, n), a.radius / sine, a.radius, {0, two_pi}}});
  }
  return out;
}

MaybeCurves plane_torus(const Plane& p, const Torus& t, const Reach& r) {
  const Vector n = p.frame.z, axis = t.frame.z;
  if (std::abs(dot(n, axis)) > parallel || std::abs(dot(t.frame.origin - p.frame.origin, n)) > r.tolerance) return std::nullopt;
  const Vector x = normalized(cross(axis, n));
  return Curves{circle(t.frame.origin + t.major_radius * x, n, x, t.minor_radius),
                circle(t.frame.origin - t.major_radius * x, n, x, t.minor_radius)};
}

// Both given the way round that the functions above know.
MaybeCurves ordered(const Surface& a, const Surface& b, const Reach& r) {
  if (const auto* p = std::get_if<Plane>(&a.shape)) {
    if (const auto* q = std::get_if<Plane>(&b.shape)) return with_plane(*p, *q, r);
    if (const auto* q = std::get_if<Sphere>(&b.shape)) return with_plane(*p, *q, r);
    if (const auto* q = std::get_if<Cylinder>(&b.shape)) return with_plane(*p, *q, r);
    if (const auto* q = std::get_if<Cone>(&b.shape)) return with_plane(*p, *q, r);
    if (const auto* q = std::get_if<Torus>(&b.shape))
      if (auto found = plane_torus(*p, *q, r)) return found;
  }
  if (const auto* s = std::get_if<Sphere>(&a.shape))
    if (const auto* t = std::get_if<Sphere>(&b.shape)) {
      const Vector between = t->frame.origin - s->frame.origin;
      if (norm(between) <= r.tolerance) return Curves{};
      return coaxial(a, b, {s->frame.origin, normalized(between), {}}, r);
    }
  if (const auto axis = axis_of(a))
    if (auto found = coaxial(a, b, *axis, r)) return found;
  if (const auto* c = std::get_if<Cylinder>(&a.shape))
    if (const auto* d = std::get_if<Cylinder>(&b.shape)) return cylinders(*c, *d, r);
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<Curve>> section(const Surface& a, const Surface& b, const Box& reach, double tolerance_mm) {
  const Reach r{midpoint(reach.lo, reach.hi), 0.5 * reach.diagonal() + tolerance_mm, tolerance_mm};
  if (auto found = ordered(a, b, r)) return found;
  return ordered(b, a, r);
}

Coincidence coincidence(const Surface& a, const Surface& b, const Box& reach, double tolerance_mm) {
  if (a.shape.index() != b.shape.index()) return {};
  const Point centre = midpoint(reach.lo, reach.hi);
  const double radius = 0.5 * reach.diagonal();
  // Axes that are one line within the tolerance wherever it is looked at.
  const auto one_axis = [&](const Frame& f, const Frame& g) {
    const Point at = f.origin + dot(centre - f.origin, f.z) * f.z;
    return norm(cross(f.z, g.z)) * radius <= tolerance_mm && norm(cross(at - g.origin, g.z)) <= tolerance_mm;
  };
  const auto close = [&](double x, double y) { return std::abs(x - y) <= tolerance_mm; };
  if (const auto* p = std::get_if<Plane>(&a.shape)) {
    const Frame &f = p->frame, &g = std::get<Plane>(b.shape).frame;
    const Point at = centre - dot(centre - f.origin, f.z) * f.z;
    const bool same = norm(cross(f.z, g.z)) * radius <= tolerance_mm && std::abs(dot(at - g.origin, g.z)) <= tolerance_mm;
    return {same, dot(f.z, g.z) < 0};
  }
  if (const auto* p = std::get_if<Cylinder>(&a.shape)) {
    const auto& q = std::get<Cylinder>(b.shape);
    return {one_axis(p->frame, q.frame) && close(p->radius, q.radius), false};
  }
  if (const auto* p = std::get_if<Sphere>(&a.shape)) {
    const auto& q = std::get<Sphere>(b.shape);
    return {distance(p->frame.origin, q.frame.origin) <= tolerance_mm && close(p->radius, q.radius), false};
  }
  if (const auto* p = std::get_if<Torus>(&a.shape)) {
    const auto& q = std::get<Torus>(b.shape);
    return {one_axis(p->frame, q.frame) && distance(p->frame.origin, q.frame.origin) <= tolerance_mm &&
                close(p->major_radius, q.major_radius) && close(p->minor_radius, q.minor_radius),
            false};
  }
  if (const auto* p = std::get_if<Cone>(&a.shape)) {
    const auto& q = std::get<Cone>(b.shape);
    const auto apex = [](const Cone& c) { return c.frame.origin - c.radius / std::tan(c.half_angle_rad) * c.frame.z; };
    const double turn = dot(p->frame.z, q.frame.z) > 0 ? 1 : -1;
    const bool same = one_axis(p->frame, q.frame) && distance(apex(*p), apex(q)) <= tolerance_mm &&
                      std::abs(p->half_angle_rad - turn * q.half_angle_rad) * radius <= tolerance_mm;
    return {same, false};
  }
  return {};
}

}  // namespace trimloop::boolean
