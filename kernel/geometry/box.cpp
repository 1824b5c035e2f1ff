// Boxes that enclose curves and patches of surfaces: closed forms for the elementary types, hulls of control points
// elsewhere. They may be larger than needed, never smaller: what evaluation rounds is added.

#include <array>

#include "kernel/geometry/arc_length.h"
#include "kernel/geometry/detail.h"

namespace trimloop {
namespace {

Box grown(Box b, double by) {
  if (b.empty()) return b;
  return {b.lo - Vector{by, by, by}, b.hi + Vector{by, by, by}};
}
// By the rounding errors of evaluating points of about that size.
Box grown_by_rounding(const Box& b) {
  if (b.empty()) return b;
  return grown(b, 8 * std::numeric_limits<double>::epsilon() * (norm(to_vector(b.lo)) + norm(to_vector(b.hi))));
}
Box moved(const Box& b, Vector by) { return b.empty() ? b : Box{b.lo + by, b.hi + by}; }

std::array<Point, 8> corners(const Box& b) {
  std::array<Point, 8> out;
  for (std::size_t i = 0; i < 8; ++i)
    out[i] = {i & 1 ? b.hi.x : b.lo.x, i & 2 ? b.hi.y : b.lo.y, i & 4 ? b.hi.z : b.lo.z};
  return out;
}

// ---- Curves

// The ends and, for each coordinate, the parameters in the range where it is stationary. With X, Y the coordinate's
// components along the conic's axes: X sin t = Y cos t and so on.
template <class Conic, class Stationary>
Box conic_box(const Conic& c, Stationary add_stationary) {
  const Curve curve{c};
  Box box;
  box.add(evaluate(curve, c.range.lo));
  box.add(evaluate(curve, c.range.hi));
  const auto add = [&](double t) {
    if (c.range.contains(t)) box.add(evaluate(curve, t));
  };
  const Frame& f = c.frame;
  add_stationary(f.x.x, f.y.x, add);
  add_stationary(f.x.y, f.y.y, add);
  add_stationary(f.x.z, f.y.z, add);
  return grown_by_rounding(box);
}
template <class Add>
void add_turns(double lo, double angle, const Add& add) {
  add(detail::first_at_or_after(lo, angle));
  add(detail::first_at_or_after(lo, angle + pi));
}
Box box_of(const Circle& c) {
  return conic_box(c, [&](double x, double y, const auto& add) { add_turns(c.range.lo, std::atan2(y, x), add); });
}
Box box_of(const Ellipse& c) {
  return conic_box(
      c, [&](double x, double y, const auto& add) { add_turns(c.range.lo, std::atan2(c.b * y, c.a * x), add); });
}
Box box_of(const Parabola& c) {
  return conic_box(c, [](double x, double y, const auto& add) { add(-y / x); });
}
Box box_of(const Hyperbola& c) {
  return conic_box(c, [&](double x, double y, const auto& add) { add(std::atanh(-c.b * y / (c.a * x))); });
}
Box box_of(const Line& c) {
  Box box;
  if (!c.range.is_bounded()) return box;
  box.add(evaluate(Curve{c}, c.range.lo));
  box.add(evaluate(Curve{c}, c.range.hi));
  return grown_by_rounding(box);
}
Box box_of(const Polyline& c) {
  Box box;
  for (const Point p : c.points) box.add(p);
  return grown_by_rounding(box);
}
Box box_of(const NurbsCurve& c) { return grown_by_rounding(bounding_box(c)); }
Box box_of(const OffsetCurve& c) { return c.basis ? grown(bounding_box(*c.basis), std::abs(c.distance)) : Box{}; }
Box box_of(const CompositeCurve& c) {
  Box box;
  for (const CompositeCurve::Segment& s : c.segments) box.add(bounding_box(*s.curve));
  return box;
}

// ---- Surfaces of revolution

// Points whose hull holds the curve over the interval.
std::vector<Point> hull_points(const Curve& whole, Interval r) {
  const Curve c = with_range(whole, r);
  std::vector<Point> out;
  if (const auto* nurbs = std::get_if<NurbsCurve>(&c.shape)) {
    const bool hull = std::all_of(nurbs->poles().begin(), nurbs->poles().end(), [](Hpoint h) { return h.w > 0; });
    if (hull && nurbs->range().length() > 0) {
      const NurbsCurve part = trimmed(*nurbs, nurbs->range());
      for (const Hpoint& h : part.poles()) out.push_back(project(h));
      return out;
    }
  }
  if (const auto* line = std::get_if<Line>(&c.shape)) return {evaluate(c, line->range.lo), evaluate(c, line->range.hi)};
  const std::vector<double> at = breaks(c);
  constexpr int parts = 16;  // the corners of small boxes; the smaller, the tighter
  for (std::size_t i = 0; i + 1 < at.size(); ++i)
    for (int k = 0; k < parts; ++k) {
      const Interval smooth{at[i], at[i + 1]};
      const Box box = bounding_box(with_range(c, {smooth.at(double(k) / parts), smooth.at(double(k + 1) / parts)}));
      if (!box.empty())
        for (const Point p : corners(box)) out.push_back(p);
    }
  return out;
}

// Turning is linear in the turned point, so the swept curve lies in the hull of the arcs of its hull points.
Box patch_box(const Revolution& s, const Surface&, Interval u, Interval v) {
  Box box;
  if (!s.generatrix) return box;
  for (const Point p : hull_points(*s.generatrix, v)) {
    if (!is_finite(p)) return {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
    const Vector arm = p - s.axis_origin, along = dot(arm, s.axis) * s.axis, x = arm - along;
    Frame f;
    f.origin = s.axis_origin + along;
    f.x = normalized(x);
    f.z = s.axis;
    f.y = cross(f.z, f.x);
    box.add(box_of(Circle{f, norm(x), u}));
  }
  return grown_by_rounding(box);
}

// ---- Other surfaces

Box side_boxes(const Surface& s, Interval u, Interval v) {
  Box box;
  for (const double fixed : {u.lo, u.hi}) box.add(bounding_box(detail::elementary_isocurve(s, true, fixed, v)));
  for (const double fixed : {v.lo, v.hi}) box.add(bounding_box(detail::elementary_isocurve(s, false, fixed, u)));
  return grown_by_rounding(box);
}
Box patch_box(const Plane&, const Surface& s, Interval u, Interval v) { return side_boxes(s, u, v); }
Box patch_box(const Cylinder&, const Surface& s, Interval u, Interval v) { return side_boxes(s, u, v); }
Box patch_box(const Cone&, const Surface& s, Interval u, Interval v) { return side_boxes(s, u, v); }

// Sides, and the interior points where a coordinate is stationary: with (a, b, c) its components in the frame, u along
// or against (a, b), and there v along or against (+-|(a, b)|, c).
Box round_box(const Frame& f, const Surface& s, Interval u, Interval v) {
  Box box = side_boxes(s, u, v);
  const std::array<Vector, 3> coordinates{{{f.x.x, f.y.x, f.z.x}, {f.x.y, f.y.y, f.z.y}, {f.x.z, f.y.z, f.z.z}}};
  for (const Vector& k : coordinates)
    for (const double side : {1.0, -1.0}) {
      const double at_u = detail::first_at_or_after(u.lo, std::atan2(side * k.y, side * k.x));
      for (const double turn : {0.0, pi}) {
        const double at_v = detail::first_at_or_after(v.lo, std::atan2(k.z, side * std::hypot(k.x, k.y)) + turn);
        if (u.contains(at_u) && v.contains(at_v)) box.add(evaluate(s, {at_u, at_v}));
      }
    }
  return grown_by_rounding(box);
}
Box patch_box(const Sphere& sphere, const Surface& s, Interval u, Interval v) {
  return round_box(sphere.frame, s, u, v);
}
Box patch_box(const Torus& torus, const Surface& s, Interval u, Interval v) { return round_box(torus.frame, s, u, v); }

Box patch_box(const Extrusion& s, const Surface&, Interval u, Interval v) {
  if (!s.directrix) return {};
  const Box at_zero = bounding_box(with_range(*s.directrix, u));
  Box box = moved(at_zero, v.lo * s.direction);
  box.add(moved(at_zero, v.hi * s.direction));
  return grown_by_rounding(box);
}

// (1 - v) a + v b, coordinate by coordinate; either factor may be negative when v lies outside [0, 1].
Box mixed(const Box& a, const Box& b, double v) {
  Box box;
  for (const Point p : corners(a))
    for (const Point q :
         {b.lo, b.hi, Point{b.lo.x, b.lo.y, b.hi.z}, Point{b.lo.x, b.hi.y, b.lo.z}, Point{b.hi.x, b.lo.y, b.lo.z}})
      box.add(p + v * (q - p));
  return box;
}
Box ruled_side_box(const CurvePtr& curve, bool reverse, bool by_length, Interval u) {
  if (reverse) u = {1 - u.hi, 1 - u.lo};
  const Interval r = range(*curve);
  if (!by_length) return bounding_box(with_range(*curve, {r.at(u.lo), r.at(u.hi)}));
  const ArcLength table(curve);
  const double slack = 1e-9 * r.length();  // of the table's inversion
  return bounding_box(
      with_range(*curve, {r.clamp(table.parameter(u.lo) - slack), r.clamp(table.parameter(u.hi) + slack)}));
}
Box patch_box(const Ruled& s, const Surface&, Interval u, Interval v) {
  if (!s.first || !s.second) return {};
  const Box a = ruled_side_box(s.first, false, s.equal_arc_length, u);
  const Box b = ruled_side_box(s.second, s.second_reversed, s.equal_arc_length, u);
  if (a.empty() || b.empty()) return {};
  Box box = mixed(a, b, v.lo);
  box.add(mixed(a, b, v.hi));
  return grown_by_rounding(box);
}
Box patch_box(const OffsetSurface& s, const Surface&, Interval u, Interval v) {
  return s.basis ? grown(bounding_box(*s.basis, u, v), std::abs(s.distance)) : Box{};
}
Box patch_box(const NurbsSurface& s, const Surface&, Interval u, Interval v) {
  const auto inside = [](Interval domain, Interval r) { return Interval{domain.clamp(r.lo), domain.clamp(r.hi)}; };
  const Interval in_u = inside(s.domain_u(), u), in_v = inside(s.domain_v(), v);
  if (!(in_u.lo < in_u.hi) || !(in_v.lo < in_v.hi)) return grown_by_rounding(bounding_box(s));
  return grown_by_rounding(bounding_box(trimmed(s, in_u, in_v)));
}

}  // namespace

namespace detail {

Curve elementary_isocurve(const Surface& s, bool at_u, double fixed, Interval along) {
  const bool ruled_along_v = std::holds_alternative<Cylinder>(s.shape) || std::holds_alternative<Cone>(s.shape);
  const auto point = [&](double t) { return evaluate(s, at_u ? Uv{fixed, t} : Uv{t, fixed}); };
  if (std::holds_alternative<Plane>(s.shape) || (at_u && ruled_along_v)) return {Line{point(0), point(1), along}};
  // A circle is told by its points at 0, pi / 2 and pi.
  const Point p0 = point(0), p1 = point(pi / 2), p2 = point(pi);
  Frame f;
  f.origin = midpoint(p0, p2);
  f.x = normalized(p0 - f.origin);
  f.y = normalized(p1 - f.origin);
  f.z = cross(f.x, f.y);
  return {Circle{f, norm(p0 - f.origin), along}};
}

}  // namespace detail

Box bounding_box(const Curve& c) {
  return std::visit([](const auto& shape) { return box_of(shape); }, c.shape);
}
Box bounding_box(const Surface& s, Interval u, Interval v) {
  return std::visit([&](const auto& shape) { return patch_box(shape, s, u, v); }, s.shape);
}

}  // namespace trimloop
