#include "kernel/geometry/elementary.h"

#include <cmath>

namespace trimloop {

namespace {

constexpr double rounding = 1e-11;

Frame frame_of(Point origin, Vector x, Vector z) { return {origin, x, cross(z, x), z}; }

// A line turned about an axis it is coplanar with.
std::optional<Elementary> turned_line(const Revolution& s, const Line& line, Interval v) {
  const Vector axis = s.axis, along = line.end - line.start, from = line.start - s.axis_origin;
  const auto radial = [&](Vector a) { return a - dot(a, axis) * axis; };
  const Vector r0 = radial(from), rd = radial(along);
  const double size = norm(from) + norm(along), climb = dot(along, axis);
  const Point foot = s.axis_origin + dot(from, axis) * axis;
  UvMap map;
  map.vv = climb;
  if (norm(rd) <= rounding * norm(along)) {  // parallel
    if (norm(r0) <= rounding * size) return std::nullopt;
    return Elementary{{Cylinder{frame_of(foot, normalized(r0), axis), norm(r0)}}, map};
  }
  if (std::abs(climb) <= rounding * norm(along)) return std::nullopt;  // flat: (u, v) is polar there
  Vector x = normalized(rd);
  if (norm(r0 - dot(r0, x) * x) > rounding * size) return std::nullopt;  // skew: a hyperboloid
  const double a = dot(r0, x) + v.lo * dot(rd, x), b = dot(r0, x) + v.hi * dot(rd, x);
  if (std::min(a, b) < -rounding * size && std::max(a, b) > rounding * size) return std::nullopt;
  if (a + b < 0) x = -x;
  return Elementary{{Cone{frame_of(foot, x, axis), dot(r0, x), std::atan(dot(rd, x) / climb)}}, map};
}

// Angles by which an arc goes over into the profile of a sphere or torus: sign t + shift, turned near to zero.
UvMap arc_map(const Circle& c, Vector x, Vector axis, Interval v) {
  UvMap map;
  map.vv = dot(cross(x, axis), c.frame.z) > 0 ? 1 : -1;
  map.v0 = std::atan2(dot(c.frame.x, axis), dot(c.frame.x, x));
  map.v0 -= two_pi * std::round((map.v0 + map.vv * v.mid()) / two_pi);
  return map;
}

std::optional<Elementary> turned_arc(const Revolution& s, const Circle& c, Interval v) {
  const Vector axis = s.axis, from = c.frame.origin - s.axis_origin;
  const double size = norm(from) + c.radius;
  if (std::abs(dot(c.frame.z, axis)) > rounding || std::abs(dot(from, c.frame.z)) > rounding * size) return std::nullopt;
  Vector x = cross(c.frame.z, axis);
  const Point foot = s.axis_origin + dot(from, axis) * axis;
  double major = dot(from, x);
  if (std::abs(major) > rounding * size) {
    if (major < 0) x = -x, major = -major;
    if (!(c.radius < major)) return std::nullopt;
    return Elementary{{Torus{frame_of(foot, normalized(x), axis), major, c.radius}}, arc_map(c, x, axis, v)};
  }
  const Vector mid = std::cos(v.mid()) * c.frame.x + std::sin(v.mid()) * c.frame.y;
  if (dot(mid, x) < 0) x = -x;
  const UvMap map = arc_map(c, x, axis, v);
  const double a = map.vv * v.lo + map.v0, b = map.vv * v.hi + map.v0;
  if (std::max(std::abs(a), std::abs(b)) > pi / 2 + 1e-9) return std::nullopt;
  return Elementary{{Sphere{frame_of(foot, normalized(x), axis), c.radius}}, map};
}

std::optional<Elementary> moved_line(const Extrusion& s, const Line& line) {
  const Vector along = line.end - line.start, across = s.direction;
  const Vector x = normalized(along), z = normalized(cross(along, across));
  if (!(norm(cross(x, normalized(across))) > 1e-6)) return std::nullopt;
  const Frame frame = frame_of(line.start, x, z);
  UvMap map;
  map.uu = norm(along);
  map.uv = dot(across, x);
  map.vv = dot(across, frame.y);
  return Elementary{{Plane{frame}}, map};
}

std::optional<Elementary> moved_arc(const Extrusion& s, const Circle& c) {
  const double climb = dot(s.direction, c.frame.z);
  if (norm(s.direction - climb * c.frame.z) > rounding * norm(s.direction)) return std::nullopt;
  UvMap map;
  map.vv = climb;
  return Elementary{{Cylinder{c.frame, c.radius}}, map};
}

}  // namespace

std::optional<Elementary> as_elementary(const Surface& surface, Interval v) {
  if (const auto* s = std::get_if<Revolution>(&surface.shape)) {
    if (const auto* line = std::get_if<Line>(&s->generatrix->shape)) return turned_line(*s, *line, v);
    if (const auto* arc = std::get_if<Circle>(&s->generatrix->shape)) return turned_arc(*s, *arc, v);
  }
  if (const auto* s = std::get_if<Extrusion>(&surface.shape)) {
    if (const auto* line = std::get_if<Line>(&s->directrix->shape)) return moved_line(*s, *line);
    if (const auto* arc = std::get_if<Circle>(&s->directrix->shape)) return moved_arc(*s, *arc);
  }
  return std::nullopt;
}

}  // namespace trimloop
