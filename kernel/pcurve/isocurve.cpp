#include "kernel/pcurve/isocurve.h"

namespace trimloop::pcurve {
namespace {

using MaybeCurve = std::optional<Curve>;

struct Question {
  const Surface& surface;
  bool constant_u;
  double value;
  Interval range;
  Uv at(double t) const { return constant_u ? Uv{value, t} : Uv{t, value}; }
};

// Straight in the free parameter.
Curve straight(const Question& q) {
  Line line;
  line.start = evaluate(q.surface, q.at(0));
  line.end = evaluate(q.surface, q.at(1));
  line.range = q.range;
  return Curve{line};
}

Curve arc(Point centre, Vector x, Vector y, double radius, Interval range) {
  Circle c;
  c.frame = {centre, x, y, cross(x, y)};
  c.radius = radius;
  c.range = range;
  return Curve{c};
}

// Unit vectors of the half plane at angle u.
Vector outward(const Frame& f, double u) { return std::cos(u) * f.x + std::sin(u) * f.y; }

Curve turned(const Frame& f, double height, double radius, Interval range) {
  const bool inverted = radius < 0;  // the other nappe of a cone
  return arc(f.origin + height * f.z, inverted ? -f.x : f.x, inverted ? -f.y : f.y, std::abs(radius), range);
}

MaybeCurve iso(const Plane&, const Question& q) { return straight(q); }
MaybeCurve iso(const Cylinder& s, const Question& q) {
  return q.constant_u ? straight(q) : turned(s.frame, q.value, s.radius, q.range);
}
MaybeCurve iso(const Cone& s, const Question& q) {
  return q.constant_u ? straight(q)
                      : turned(s.frame, q.value, s.radius + q.value * std::tan(s.half_angle_rad), q.range);
}
MaybeCurve iso(const Sphere& s, const Question& q) {
  if (q.constant_u) return arc(s.frame.origin, outward(s.frame, q.value), s.frame.z, s.radius, q.range);
  return turned(s.frame, s.radius * std::sin(q.value), s.radius * std::cos(q.value), q.range);
}
MaybeCurve iso(const Torus& s, const Question& q) {
  const Vector out = outward(s.frame, q.value);
  if (q.constant_u) return arc(s.frame.origin + s.major_radius * out, out, s.frame.z, s.minor_radius, q.range);
  return turned(s.frame, s.minor_radius * std::sin(q.value), s.major_radius + s.minor_radius * std::cos(q.value), q.range);
}
MaybeCurve iso(const Revolution& s, const Question& q) {
  if (!s.generatrix) return std::nullopt;
  if (q.constant_u) {
    auto c = transformed(*s.generatrix, Transform::rotation(s.axis_origin, s.axis, q.value));
    return c ? MaybeCurve(with_range(*c, q.range)) : std::nullopt;
  }
  const Point p = evaluate(*s.generatrix, q.value);
  const Point centre = s.axis_origin + dot(p - s.axis_origin, s.axis) * s.axis;
  const Vector x = normalized(p - centre);
  return arc(centre, x, cross(s.axis, x), distance(p, centre), q.range);
}
MaybeCurve iso(const Extrusion& s, const Question& q) {
  if (!s.directrix) return std::nullopt;
  if (q.constant_u) return straight(q);
  auto c = transformed(*s.directrix, Transform::translation(q.value * s.direction));
  return c ? MaybeCurve(with_range(*c, q.range)) : std::nullopt;
}
MaybeCurve iso(const Ruled&, const Question& q) { return q.constant_u ? MaybeCurve(straight(q)) : std::nullopt; }
MaybeCurve iso(const OffsetSurface&, const Question&) { return std::nullopt; }
MaybeCurve iso(const NurbsSurface& s, const Question& q) {
  return Curve{(q.constant_u ? isocurve_u(s, q.value) : isocurve_v(s, q.value)).with_range(q.range)};
}

// Cubic Hermite spline through points with their tangents.
MaybeCurve sampled(const Question& q) {
  constexpr int spans = 64;
  std::vector<Point> poles;
  std::vector<double> knots(4, q.range.lo);
  const double third = q.range.length() / spans / 3;
  for (int i = 0; i <= spans; ++i) {
    const double t = q.range.at(double(i) / spans);
    Point p;
    Vector du, dv;
    jet1(q.surface, q.at(t), p, du, dv);
    const Vector d = q.constant_u ? dv : du;
    if (!is_finite(p) || !is_finite(d)) return std::nullopt;
    if (i == 0) poles.push_back(p);
    if (i > 0) poles.push_back(p - third * d);
    if (i > 0 && i < spans) knots.insert(knots.end(), 2, t);
    if (i < spans) poles.push_back(p + third * d);
    if (i == spans) poles.push_back(p);
  }
  knots.insert(knots.end(), 4, q.range.hi);
  auto c = NurbsCurve::from_cartesian(3, std::move(knots), poles, {});
  return c ? MaybeCurve(Curve{std::move(*c)}) : std::nullopt;
}

}  // namespace

CurvePtr isocurve(const Surface& surface, bool constant_u, double value, Interval range) {
  if (!range.is_bounded() || !(range.lo < range.hi) || !std::isfinite(value)) return nullptr;
  const Question q{surface, constant_u, value, range};
  MaybeCurve c = std::visit([&](const auto& s) { return iso(s, q); }, surface.shape);
  if (!c) c = sampled(q);
  return c ? std::make_shared<const Curve>(std::move(*c)) : nullptr;
}

}  // namespace trimloop::pcurve
