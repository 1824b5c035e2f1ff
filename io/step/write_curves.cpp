// Curves -> LINE, CIRCLE, ELLIPSE, PARABOLA, HYPERBOLA, POLYLINE, B_SPLINE_CURVE_WITH_KNOTS, COMPOSITE_CURVE,
// OFFSET_CURVE_3D (ISO 10303-42 4.4).

#include <fmt/format.h>

#include "io/step/entity_writer.h"
#include "io/step/splines.h"

namespace trimloop::io::step_export {

using step::Derived;
using step::Enumeration;
using step::Measure;
using step::partial;

ShortKnots short_knots(const std::vector<double>& full) {
  ShortKnots out;
  for (const double knot : full) {
    if (out.values.empty() || knot != out.values.back()) {
      out.values.push_back(knot);
      out.multiplicities.push_back(1);
    } else {
      ++out.multiplicities.back();
    }
  }
  return out;
}

namespace {

constexpr Enumeration unspecified{"UNSPECIFIED"}, unknown{"U"};

// `pole_ids`: one for each pole.
InstanceId write_spline(EntityWriter& w, const NurbsCurve& c, const std::vector<InstanceId>& pole_ids, bool closed) {
  const ShortKnots knots = short_knots(c.knots());
  const Enumeration closed_flag{closed ? "T" : "F"};
  if (!c.is_rational()) {
    return w.out.add("B_SPLINE_CURVE_WITH_KNOTS", "", c.degree(), pole_ids, unspecified, closed_flag, unknown,
                     knots.multiplicities, knots.values, unspecified);
  }
  std::vector<double> weights;
  for (const Hpoint& h : c.poles()) weights.push_back(h.w);
  return w.out.add_complex({partial("BOUNDED_CURVE"),
                            partial("B_SPLINE_CURVE", c.degree(), pole_ids, unspecified, closed_flag, unknown),
                            partial("B_SPLINE_CURVE_WITH_KNOTS", knots.multiplicities, knots.values, unspecified),
                            partial("CURVE"), partial("GEOMETRIC_REPRESENTATION_ITEM"),
                            partial("RATIONAL_B_SPLINE_CURVE", weights), partial("REPRESENTATION_ITEM", "")});
}

NurbsCurve over_its_range(const NurbsCurve& c) {
  const Interval r = c.range(), d = c.domain();
  return r.lo == d.lo && r.hi == d.hi && is_clamped(c.degree(), c.knots()) ? c : trimmed(c, r);
}

InstanceId write_nurbs(EntityWriter& w, const NurbsCurve& whole) {
  const NurbsCurve c = over_its_range(whole);
  std::vector<InstanceId> poles;
  for (const Hpoint& h : c.poles()) poles.push_back(w.point(cartesian(h)));
  const Interval r = c.range();
  return write_spline(w, c, poles, distance(evaluate(c, r.lo), evaluate(c, r.hi)) <= w.model.resolution_mm);
}

// An ellipse with the short axis first is legal and misread; a quarter turn puts the long one there.
WrittenCurve write_ellipse(EntityWriter& w, const Ellipse& e) {
  if (e.a >= e.b) {
    return {w.out.add("ELLIPSE", "", w.placement(e.frame), w.units.length(e.a), w.units.length(e.b)), {}};
  }
  Frame turned = e.frame;
  turned.x = e.frame.y;
  turned.y = -e.frame.x;
  return {w.out.add("ELLIPSE", "", w.placement(turned), w.units.length(e.b), w.units.length(e.a)), {1, -pi / 2}};
}

WrittenCurve written_spline(EntityWriter& w, const ToNurbsCurve& n) {
  return {write_nurbs(w, n.curve), {}, n.curve.range(), std::make_shared<const Curve>(Curve{n.curve})};
}

struct CurveWriter {
  EntityWriter& w;

  Result<WrittenCurve> operator()(const Line& s) const {
    const Vector along = s.end - s.start;
    if (!(norm(along) > 0)) return fail(ErrorCode::Degenerate, "a line without direction");
    const InstanceId start = w.point(s.start), vector = w.vector(normalized(along), 1);
    return WrittenCurve{w.out.add("LINE", "", start, vector), {norm(along) / w.units.factor(), 0}};
  }
  Result<WrittenCurve> operator()(const Circle& s) const {
    return WrittenCurve{w.out.add("CIRCLE", "", w.placement(s.frame), w.units.length(s.radius)), {}};
  }
  Result<WrittenCurve> operator()(const Ellipse& s) const { return write_ellipse(w, s); }
  Result<WrittenCurve> operator()(const Parabola& s) const {
    return WrittenCurve{w.out.add("PARABOLA", "", w.placement(s.frame), w.units.length(s.focal_length)), {}};
  }
  Result<WrittenCurve> operator()(const Hyperbola& s) const {
    return WrittenCurve{w.out.add("HYPERBOLA", "", w.placement(s.frame), w.units.length(s.a), w.units.length(s.b)), {}};
  }
  Result<WrittenCurve> operator()(const Polyline& s) const {
    std::vector<InstanceId> points;
    for (const Point& p : s.points) {
      if (const InstanceId id = w.point(p); points.empty() || !(id == points.back())) points.push_back(id);
    }
    if (points.size() < 2) return fail(ErrorCode::Degenerate, "a polyline of one point");
    return WrittenCurve{w.out.add("POLYLINE", "", points), {}};
  }
  Result<WrittenCurve> operator()(const NurbsCurve& s) const { return WrittenCurve{write_nurbs(w, s), {}}; }
  // Part 42 moves along V x T, our OffsetCurve along T x n.
  Result<WrittenCurve> operator()(const OffsetCurve& s) const {
    const auto basis = write_curve(w, *s.basis);
    if (!basis) return basis;
    return WrittenCurve{w.out.add("OFFSET_CURVE_3D", "", basis->id, w.units.length(-s.distance), unknown,
                                  w.direction(normalized(s.normal))),
                        basis->shift};
  }
  Result<WrittenCurve> operator()(const CompositeCurve& s) const {
    const auto nurbs = trimloop::to_nurbs(Curve{s});
    if (!nurbs) return tl::unexpected(nurbs.error());
    return written_spline(w, *nurbs);
  }
};

bool is_whole_turn(const Curve& c) { return range(c).length() >= two_pi * (1 - 1e-15); }

Result<InstanceId> write_composite(EntityWriter& w, const CompositeCurve& c) {
  std::vector<InstanceId> segments;
  for (const CompositeCurve::Segment& s : c.segments) {
    const auto part = write_bounded_curve(w, *s.curve);
    if (!part) return part;
    const bool last = &s == &c.segments.back();
    segments.push_back(w.out.add("COMPOSITE_CURVE_SEGMENT", Enumeration{last ? "DISCONTINUOUS" : "CONTINUOUS"},
                                 !s.reversed, *part));
  }
  if (segments.empty()) return fail(ErrorCode::Degenerate, "a composite curve without parts");
  return w.out.add("COMPOSITE_CURVE", "", segments, unknown);
}

// Both ways of saying each end. The parameter counts, except of a parabola: OpenCASCADE takes it by another measure.
InstanceId write_trimmed(EntityWriter& w, const Curve& curve, const WrittenCurve& basis) {
  const Interval r = range(curve);
  const InstanceId from = w.point(start_point(curve)), to = w.point(end_point(curve));
  return w.out.add("TRIMMED_CURVE", "", basis.id, step::TrimSelect{from, apply(basis.shift, r.lo)},
                   step::TrimSelect{to, apply(basis.shift, r.hi)}, true,
                   Enumeration{std::holds_alternative<Parabola>(curve.shape) ? "CARTESIAN" : "PARAMETER"});
}

}  // namespace

Result<WrittenCurve> write_curve(EntityWriter& w, const Curve& curve) {
  if (w.to_nurbs && is_bounded(curve)) {
    if (const auto nurbs = trimloop::to_nurbs(curve)) {
      ++w.statement.exact_curves;
      return written_spline(w, *nurbs);
    }
  }
  auto written = std::visit(CurveWriter{w}, curve.shape);
  if (written && written->range.length() == 0) {
    const Interval own = range(curve);
    written->range = {apply(written->shift, own.lo), apply(written->shift, own.hi)};
  }
  return written;
}

// Swept profiles: a part of a conic is cut to its range, since the whole of it may sweep over itself.
Result<WrittenCurve> write_profile(EntityWriter& w, const Curve& curve) {
  auto basis = write_curve(w, curve);
  const bool is_conic = std::holds_alternative<Circle>(curve.shape) || std::holds_alternative<Ellipse>(curve.shape);
  if (!basis || w.to_nurbs || !is_conic || is_whole_turn(curve)) return basis;
  basis->id = write_trimmed(w, curve, *basis);
  return basis;
}

Result<InstanceId> write_bounded_curve(EntityWriter& w, const Curve& curve) {
  if (!is_bounded(curve)) return fail(ErrorCode::Unsupported, "a curve without end");
  const auto* composite = std::get_if<CompositeCurve>(&curve.shape);
  if (composite && !w.to_nurbs) return write_composite(w, *composite);
  auto basis = write_curve(w, curve);
  if (!basis) return tl::unexpected(basis.error());
  const bool has_ends = w.to_nurbs || std::holds_alternative<NurbsCurve>(curve.shape) ||
                        std::holds_alternative<Polyline>(curve.shape);
  const bool is_circle = std::holds_alternative<Circle>(curve.shape) || std::holds_alternative<Ellipse>(curve.shape);
  if (has_ends || (is_circle && is_whole_turn(curve))) return basis->id;
  return write_trimmed(w, curve, *basis);
}

InstanceId write_pcurve(EntityWriter& w, const NurbsCurve& c) {
  const auto point2 = [&](Point p) { return w.out.add_shared("CARTESIAN_POINT", "", std::array{p.x, p.y}); };
  std::vector<InstanceId> poles;
  for (const Hpoint& h : c.poles()) poles.push_back(point2(cartesian(h)));
  return write_spline(w, c, poles, false);
}

}  // namespace trimloop::io::step_export
