// Points and derivatives of curves, ranges and smooth pieces. Each type has its own small set of functions; the public
// ones at the end pick the set.

#include "kernel/geometry/curve.h"

#include "kernel/geometry/detail.h"

namespace trimloop {
namespace {

// ---- Line

Point point_of(const Line& c, double t) {
  if (t == 1) return c.end;  // both end points are met exactly
  return c.start + t * (c.end - c.start);
}
CurveJet jet_of(const Line& c, double t) { return {point_of(c, t), c.end - c.start, {}}; }

// ---- Conics: origin + X(t) x + Y(t) y

struct Coordinates {
  double x, y, dx, dy, ddx, ddy;
};
Coordinates coordinates(const Circle& c, double t) {
  const double x = c.radius * std::cos(t), y = c.radius * std::sin(t);
  return {x, y, -y, x, -x, -y};
}
Coordinates coordinates(const Ellipse& c, double t) {
  const double cos_t = std::cos(t), sin_t = std::sin(t);
  return {c.a * cos_t, c.b * sin_t, -c.a * sin_t, c.b * cos_t, -c.a * cos_t, -c.b * sin_t};
}
Coordinates coordinates(const Parabola& c, double t) {
  const double f = c.focal_length;
  return {f * t * t, 2 * f * t, 2 * f * t, 2 * f, 2 * f, 0};
}
Coordinates coordinates(const Hyperbola& c, double t) {
  const double cosh_t = std::cosh(t), sinh_t = std::sinh(t);
  return {c.a * cosh_t, c.b * sinh_t, c.a * sinh_t, c.b * cosh_t, c.a * cosh_t, c.b * sinh_t};
}
template <class Conic>
CurveJet jet_of(const Conic& c, double t) {
  const Coordinates k = coordinates(c, t);
  const Frame& f = c.frame;
  return {f.origin + (k.x * f.x + k.y * f.y), k.dx * f.x + k.dy * f.y, k.ddx * f.x + k.ddy * f.y};
}
template <class Conic>
Point point_of(const Conic& c, double t) {
  const Coordinates k = coordinates(c, t);
  return c.frame.origin + (k.x * c.frame.x + k.y * c.frame.y);
}

// ---- Polyline

// Segment i and the place f in it; the segment that begins at t, the last one at the end.
struct Place {
  std::size_t i;
  double f;
};
Place place_of(const Polyline& c, double t) {  // at least two points
  const double last = static_cast<double>(c.points.size() - 1);
  const double clamped = t > 0 ? std::min(t, last) : 0;  // a NaN becomes 0
  const std::size_t i = std::min(static_cast<std::size_t>(clamped), c.points.size() - 2);
  return {i, clamped - static_cast<double>(i)};
}
CurveJet jet_of(const Polyline& c, double t) {
  if (c.points.size() < 2) return {c.points.empty() ? Point{} : c.points[0], {}, {}};
  const Place p = place_of(c, t);
  const Point a = c.points[p.i], b = c.points[p.i + 1];
  return {p.f == 1 ? b : a + p.f * (b - a), b - a, {}};
}
Point point_of(const Polyline& c, double t) { return jet_of(c, t).point; }

// ---- NURBS

Point point_of(const NurbsCurve& c, double t) { return evaluate(c, t); }
CurveJet jet_of(const NurbsCurve& c, double t) { return jet(c, t); }

// ---- Composite

struct Child {
  const Curve* curve;
  double t;
  bool reversed;
};
Child child_at(const CompositeCurve& c, double t) {  // at least one segment
  const std::size_t i = detail::segment_at(c, t);
  const CompositeCurve::Segment& s = c.segments[i];
  const Interval r = range(*s.curve);
  const double span = c.starts[i + 1] - c.starts[i], from_start = t - c.starts[i];
  // Both ends of the child are met exactly, whatever rounding the sum of spans has seen.
  const bool at_end = !(from_start < span), at_start = !(from_start > 0);
  const double lo = s.reversed ? r.hi : r.lo, hi = s.reversed ? r.lo : r.hi;
  if (at_start) return {s.curve.get(), lo, s.reversed};
  if (at_end) return {s.curve.get(), hi, s.reversed};
  return {s.curve.get(), r.clamp(s.reversed ? r.hi - from_start : r.lo + from_start), s.reversed};
}
Point point_of(const CompositeCurve& c, double t) {
  if (c.segments.empty()) return {};
  const Child child = child_at(c, t);
  return evaluate(*child.curve, child.t);
}
CurveJet jet_of(const CompositeCurve& c, double t) {
  if (c.segments.empty()) return {};
  const Child child = child_at(c, t);
  CurveJet j = jet(*child.curve, child.t);
  if (child.reversed) j.d1 = -j.d1;
  return j;
}

// ---- Offset

// Where the basis has no direction (a cusp, a repeated pole) the direction a little further in is taken.
CurveJet regular_jet(const Curve& basis, double t, Vector normal) {
  CurveJet j = jet(basis, t);
  const Interval r = range(basis);
  if (norm(cross(j.d1, normal)) > 0 || !r.is_bounded()) return j;
  const Point at = j.point;
  const double step = 1e-6 * r.length();
  j = jet(basis, t + step <= r.hi ? t + step : t - step);
  return {at, j.d1, {}};
}
Point point_of(const OffsetCurve& c, double t) {
  if (!c.basis) return {};
  const CurveJet j = regular_jet(*c.basis, t, c.normal);
  return j.point + c.distance * normalized(cross(j.d1, c.normal));
}
// With T = C' x n and N = T / |T|:  N' = (T' - |T|' N) / |T|,  N'' = (T'' - |T|'' N - 2 |T|' N') / |T|.
CurveJet jet_of(const OffsetCurve& c, double t) {
  if (!c.basis) return {};
  const CurveJet j = regular_jet(*c.basis, t, c.normal);
  const Vector t0 = cross(j.d1, c.normal), t1 = cross(j.d2, c.normal);
  const Vector t2 = cross(detail::third_derivative(*c.basis, t), c.normal);
  const double length = norm(t0);
  if (!(length > 0)) return j;
  const Vector n = t0 / length;
  const double length1 = dot(n, t1);
  const Vector n1 = (t1 - length1 * n) / length;
  const double length2 = dot(n1, t1) + dot(n, t2);
  const Vector n2 = (t2 - length2 * n - 2 * length1 * n1) / length;
  return {j.point + c.distance * n, j.d1 + c.distance * n1, j.d2 + c.distance * n2};
}

// ---- Ranges and smooth pieces

Interval range_of(const Polyline& c) { return {0, c.points.empty() ? 0 : static_cast<double>(c.points.size() - 1)}; }
Interval range_of(const NurbsCurve& c) { return c.range(); }
Interval range_of(const OffsetCurve& c) { return c.basis ? range(*c.basis) : Interval{}; }
Interval range_of(const CompositeCurve& c) {
  return c.starts.empty() ? Interval{} : Interval{c.starts.front(), c.starts.back()};
}
template <class Conic>  // and lines
Interval range_of(const Conic& c) {
  return c.range;
}

template <class C>
std::vector<double> breaks_of(const C& c) {
  const Interval r = range_of(c);
  std::vector<double> out;
  for (const double t : {r.lo, r.hi})
    if (std::isfinite(t)) out.push_back(t);
  return out;
}
std::vector<double> breaks_of(const Polyline& c) {
  std::vector<double> out(std::max<std::size_t>(c.points.size(), 2));
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = c.points.size() < 2 ? 0 : static_cast<double>(i);
  return out;
}
std::vector<double> breaks_of(const NurbsCurve& c) { return breaks(c); }
std::vector<double> breaks_of(const OffsetCurve& c) { return c.basis ? breaks(*c.basis) : std::vector<double>{0, 0}; }
std::vector<double> breaks_of(const CompositeCurve& c) {
  if (c.segments.empty()) return {0, 0};
  std::vector<double> out{c.starts.front()};
  for (std::size_t i = 0; i < c.segments.size(); ++i) {
    const Interval r = range(*c.segments[i].curve);
    std::vector<double> inner = breaks(*c.segments[i].curve);
    if (c.segments[i].reversed) {
      for (double& t : inner) t = r.hi - (t - r.lo);
      std::reverse(inner.begin(), inner.end());
    }
    for (const double t : inner) {
      const double own = c.starts[i] + (t - r.lo);
      if (own > out.back() && own < c.starts[i + 1]) out.push_back(own);
    }
    if (c.starts[i + 1] > out.back()) out.push_back(c.starts[i + 1]);
  }
  if (out.size() == 1) out.push_back(c.starts.back());
  return out;
}

}  // namespace

namespace detail {

std::size_t segment_at(const CompositeCurve& c, double t) {
  const auto next = std::upper_bound(c.starts.begin(), c.starts.end(), t);
  const auto count = static_cast<std::size_t>(next - c.starts.begin());
  return std::min(count == 0 ? 0 : count - 1, c.segments.size() - 1);
}

Vector third_derivative(const Curve& curve, double t) {
  if (const auto* nurbs = std::get_if<NurbsCurve>(&curve.shape)) return derivatives(*nurbs, t, 3)[3];
  if (std::holds_alternative<Circle>(curve.shape) || std::holds_alternative<Ellipse>(curve.shape))
    return -jet(curve, t).d1;
  if (const auto* h = std::get_if<Hyperbola>(&curve.shape)) return jet_of(*h, t).d1;
  if (const auto* c = std::get_if<CompositeCurve>(&curve.shape)) {
    if (c->segments.empty()) return {};
    const Child child = child_at(*c, t);
    const Vector d3 = third_derivative(*child.curve, child.t);
    return child.reversed ? -d3 : d3;
  }
  if (std::holds_alternative<OffsetCurve>(curve.shape)) {  // an offset of an offset: a difference has to do
    const Interval r = range(curve);
    const double h = 1e-5 * (r.is_bounded() ? r.length() : 1);
    if (!(h > 0)) return {};
    const double a = std::max(t - h, r.lo), b = std::min(t + h, r.hi);
    return (jet(curve, b).d2 - jet(curve, a).d2) / (b - a);
  }
  return {};  // line, parabola, polyline
}

}  // namespace detail

Interval range(const Curve& c) {
  return std::visit([](const auto& shape) { return range_of(shape); }, c.shape);
}
Point evaluate(const Curve& c, double t) {
  return std::visit([t](const auto& shape) { return point_of(shape, t); }, c.shape);
}
CurveJet jet(const Curve& c, double t) {
  return std::visit([t](const auto& shape) { return jet_of(shape, t); }, c.shape);
}
std::vector<double> breaks(const Curve& c) {
  return std::visit([](const auto& shape) { return breaks_of(shape); }, c.shape);
}
Point start_point(const Curve& c) { return evaluate(c, range(c).lo); }
Point end_point(const Curve& c) { return evaluate(c, range(c).hi); }
bool is_bounded(const Curve& c) { return range(c).is_bounded(); }

CompositeCurve make_composite(std::vector<CompositeCurve::Segment> segments) {
  CompositeCurve out;
  out.segments.reserve(segments.size());
  out.starts.reserve(segments.size() + 1);
  for (CompositeCurve::Segment& s : segments) {
    if (!s.curve) continue;
    const Interval r = range(*s.curve);
    if (!r.is_bounded()) {
      const double lo = std::isfinite(r.lo) ? r.lo : std::isfinite(r.hi) ? r.hi - 1 : 0;
      s.curve = std::make_shared<Curve>(with_range(*s.curve, {lo, lo + 1}));
    }
    if (out.starts.empty()) out.starts.push_back(0);
    out.starts.push_back(out.starts.back() + range(*s.curve).length());
    out.segments.push_back(std::move(s));
  }
  return out;
}

Curve2 make_line2(Uv a, Uv b) { return {{Line{{a.u, a.v, 0}, {b.u, b.v, 0}, {0, 1}}}}; }

Curve2 make_polyline2(const std::vector<Uv>& points) {
  Polyline line;
  line.points.reserve(points.size());
  for (const Uv p : points) line.points.push_back({p.u, p.v, 0});
  return {{std::move(line)}};
}

}  // namespace trimloop
