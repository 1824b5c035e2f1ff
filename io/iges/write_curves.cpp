// Curves -> 110, 100 (with its 124), 106 and 126 records.

#include <fmt/format.h>

#include "io/iges/entity_writer.h"
#include "formats/iges/records/surfaces.h"

namespace trimloop::io::iges_export {

namespace {

// Planarity as 126 states it: a unit normal when all poles lie in one plane (relative to their extent).
struct Planarity {
  bool planar = false;
  Vector normal;
};

Planarity planarity(const std::vector<Point>& points) {
  Box box;
  for (const Point& p : points) box.add(p);
  const double size = box.diagonal();
  Vector normal;
  for (std::size_t i = 1; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size() && j < i + 3; ++j) {
      const Vector n = cross(points[i] - points[0], points[j] - points[0]);
      if (norm(n) > norm(normal)) normal = n;
    }
  }
  if (norm(normal) <= 1e-12 * size * size) {  // collinear: planar in many planes, one of which is named
    const Vector d = box.hi - box.lo;
    const Vector least = d.x <= d.y && d.x <= d.z ? Vector{1, 0, 0} : d.y <= d.z ? Vector{0, 1, 0} : Vector{0, 0, 1};
    Vector along;
    for (const Point& p : points)
      if (distance(p, points[0]) > norm(along)) along = p - points[0];
    return {true, norm(along) > 0 ? normalized(cross(along, least)) : Vector{0, 0, 1}};
  }
  normal = normalized(normal);
  for (const Point& p : points) {
    if (std::abs(dot(p - points[0], normal)) > 1e-12 * size) return {};
  }
  return {true, normal};
}

// Turning a curve round can bring two knots together that were one step of a double apart; an inner knot then stands
// degree + 1 times and parts the curve between two poles at one place. One of each goes; nothing when there are none. A
// curve that really jumps stays.
std::optional<NurbsCurve> without_double_poles(const NurbsCurve& curve) {
  const std::size_t p = static_cast<std::size_t>(curve.degree()), count = curve.poles().size();
  bool may_part = false;
  for (std::size_t k = p + 1; k < count && !may_part; ++k) may_part = curve.knots()[k] == curve.knots()[k + p];
  if (!may_part) return std::nullopt;
  std::vector<double> knots = curve.knots();
  std::vector<Hpoint> poles(curve.poles().begin(), curve.poles().end());
  const double size = bounding_box(Curve{curve}).diagonal();
  const auto same = [&](const Hpoint& a, const Hpoint& b) {
    return a.w != 0 && b.w != 0 && std::abs(a.w - b.w) <= 1e-12 * std::abs(a.w) &&
           distance(project(a), project(b)) <= 1e-12 * size;
  };
  bool changed = false;
  for (std::size_t k = p + 1; k < poles.size(); ++k) {
    while (k < poles.size() && knots[k] == knots[k + p] && same(poles[k - 1], poles[k])) {
      poles.erase(poles.begin() + static_cast<std::ptrdiff_t>(k));
      knots.erase(knots.begin() + static_cast<std::ptrdiff_t>(k));
      changed = true;
    }
  }
  if (!changed) return std::nullopt;
  auto made = NurbsCurve::from_homogeneous(curve.degree(), std::move(knots), std::move(poles));
  return made ? std::optional(made->with_range(curve.range())) : std::nullopt;
}

// `closed_within`: how near the ends of a closed curve are, in the curve's own units.
iges::RationalBSplineCurve record_of(const NurbsCurve& given, const Units& units, double closed_within) {
  const std::optional<NurbsCurve> thinned = without_double_poles(given);
  const NurbsCurve& curve = thinned ? *thinned : given;
  iges::RationalBSplineCurve out;
  out.upper_index = static_cast<int>(curve.poles().size()) - 1;
  out.degree = curve.degree();
  out.knots = curve.knots();
  std::vector<Point> points;
  points.reserve(curve.poles().size());
  out.weights.reserve(curve.poles().size());
  out.points.reserve(curve.poles().size());
  for (const Hpoint& h : curve.poles()) {
    out.weights.push_back(h.w);
    points.push_back(h.w != 0 ? project(h) : Point{h.x, h.y, h.z});
    out.points.push_back(units.point(points.back()));
  }
  const Planarity plane = planarity(points);
  out.planar = plane.planar;
  out.normal = {plane.normal.x, plane.normal.y, plane.normal.z};
  out.polynomial = !curve.is_rational();
  const Interval r = curve.range();
  const Point a = evaluate(curve, r.lo), b = evaluate(curve, r.hi);
  out.closed = distance(a, b) <= closed_within;
  out.v0 = r.lo;
  out.v1 = r.hi;
  return out;
}

iges::Line record_of(const Line& line, const Units& units) {
  const Point from = line.start + line.range.lo * (line.end - line.start);
  const Point to = line.start + line.range.hi * (line.end - line.start);
  iges::Line out;
  out.start = units.point(line.range.lo == 0 ? line.start : from);
  out.end = units.point(line.range.hi == 1 ? line.end : to);
  return out;
}

}  // namespace

std::optional<Interval> recorded_range(const Curve& curve) {
  const Interval own = range(curve);
  if (std::holds_alternative<Line>(curve.shape)) return Interval{0, 1};
  if (std::holds_alternative<Circle>(curve.shape) && own.length() <= two_pi) return Interval{0, own.length()};
  if (std::holds_alternative<Polyline>(curve.shape) || std::holds_alternative<NurbsCurve>(curve.shape)) return own;
  if (const auto* offset = std::get_if<OffsetCurve>(&curve.shape)) return recorded_range(*offset->basis);
  return std::nullopt;
}

iges::Ref write_curve(EntityWriter& writer, const Curve& curve, Role role, AttributesId attributes) {
  const Units& units = writer.units;
  if (const auto* line = std::get_if<Line>(&curve.shape)) {
    if (line->range.is_bounded()) return writer.add(record_of(*line, units), role, 0, nullptr, attributes);
    iges::Line out;  // 110 form 1: from the first point through the second; form 2: unbounded both ways
    out.start = units.point(line->start);
    out.end = units.point(line->end);
    return writer.add(out, role, std::isfinite(line->range.lo) ? 1 : 2, nullptr, attributes);
  }
  if (const auto* circle = std::get_if<Circle>(&curve.shape); circle && circle->range.length() <= two_pi) {
    // Counter-clockwise in its own plane from the start of the range, which the matrix puts at angle 0.
    Frame f = circle->frame;
    const double a = circle->range.lo, sweep = circle->range.length();
    const Vector x = std::cos(a) * f.x + std::sin(a) * f.y;
    const Vector y = cross(f.z, x);
    Transform placement;
    placement.r = {{{x.x, y.x, f.z.x}, {x.y, y.y, f.z.y}, {x.z, y.z, f.z.z}}};
    placement.t = to_vector(f.origin);
    iges::CircularArc out;
    const double r = units.length(circle->radius);
    out.xs = r;
    out.xe = sweep == two_pi ? r : r * std::cos(sweep);
    out.ye = sweep == two_pi ? 0 : r * std::sin(sweep);
    return writer.add(out, role, 0, &placement, attributes);
  }
  if (const auto* polyline = std::get_if<Polyline>(&curve.shape)) {
    iges::CopiousData out;
    out.interpretation = 2;
    for (const Point& p : polyline->points) {
      const iges::Xyz q = units.point(p);
      out.values.insert(out.values.end(), {q.x, q.y, q.z});
    }
    return writer.add(out, role, 12, nullptr, attributes);
  }
  if (const auto* composite = std::get_if<CompositeCurve>(&curve.shape); composite && role != Role::Child) {
    iges::CompositeCurve out;
    for (const CompositeCurve::Segment& s : composite->segments) {
      const iges::Ref child = write_curve(writer, s.reversed ? reversed(*s.curve) : *s.curve, Role::Child);
      if (!child) return {};
      out.members.push_back(child);
    }
    return writer.add(out, role, 0, nullptr, attributes);
  }
  if (const auto* offset = std::get_if<OffsetCurve>(&curve.shape)) {
    Curve along = *offset->basis;
    std::optional<Interval> tt = recorded_range(along);
    if (!tt) {
      auto nurbs = to_nurbs(along);
      if (nurbs) along = Curve{std::move(nurbs->curve)};
      tt = range(along);
    }
    const iges::Ref basis = write_curve(writer, along, Role::Child);
    if (!basis) return {};
    iges::OffsetCurve out;  // 130 moves along V x T, OffsetCurve along T x n
    out.basis = basis;
    out.flag = 1;
    out.d1 = units.length(-offset->distance);
    out.normal = {offset->normal.x, offset->normal.y, offset->normal.z};
    out.tt1 = tt->lo;
    out.tt2 = tt->hi;
    return writer.add(out, role, 0, nullptr, attributes);
  }
  if (const auto* nurbs = std::get_if<NurbsCurve>(&curve.shape)) {
    return writer.add(record_of(*nurbs, units, writer.model.resolution_mm), role, 0, nullptr, attributes);
  }
  const auto nurbs = to_nurbs(curve);
  if (!nurbs) {
    writer.losses.push_back(fmt::format("a curve: {}", nurbs.error().text));
    return {};
  }
  return writer.add(record_of(nurbs->curve, units, writer.model.resolution_mm), role, 0, nullptr, attributes);
}

iges::Ref write_pcurve(EntityWriter& writer, const Curve& curve, bool as_nurbs) {
  const Units none(1);
  if (const auto* line = std::get_if<Line>(&curve.shape); line && !as_nurbs) {
    return writer.add(record_of(*line, none), Role::ParameterCurve);
  }
  const auto nurbs = to_nurbs(curve);
  if (!nurbs) {
    writer.losses.push_back(fmt::format("a parameter-space curve: {}", nurbs.error().text));
    return {};
  }
  iges::RationalBSplineCurve out = record_of(nurbs->curve, none, 0);
  out.planar = true;
  out.normal = {0, 0, 1};
  return writer.add(out, Role::ParameterCurve);
}

}  // namespace trimloop::io::iges_export
