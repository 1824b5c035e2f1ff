// Curves: lines, conics, splines, polylines, trimmed, composite, offset, replicas, curves on surfaces. ISO 10303-42 4.5.

#include <fmt/format.h>

#include "formats/step/records/geometry.h"
#include "formats/step/rules.h"
#include "io/rules.h"
#include "io/step/geometry.h"
#include "io/step/knots.h"

namespace trimloop::io::step_import {

namespace sr = step::rules;

bool is_closed_by_nature(const Curve& c) {
  return std::holds_alternative<Circle>(c.shape) || std::holds_alternative<Ellipse>(c.shape);
}

double parameter_near(const Curve& curve, Point p) {
  const auto local = [&p](const Frame& f) { return Uv{dot(p - f.origin, f.x), dot(p - f.origin, f.y)}; };
  if (const auto* l = std::get_if<Line>(&curve.shape)) {
    const Vector d = l->end - l->start;
    return dot(p - l->start, d) / dot(d, d);
  }
  if (const auto* c = std::get_if<Circle>(&curve.shape)) {
    const Uv q = local(c->frame);
    return std::atan2(q.v, q.u);
  }
  if (const auto* e = std::get_if<Ellipse>(&curve.shape)) {
    const Uv q = local(e->frame);
    return std::atan2(q.v / e->b, q.u / e->a);
  }
  if (const auto* c = std::get_if<Parabola>(&curve.shape)) return local(c->frame).v / (2 * c->focal_length);
  if (const auto* c = std::get_if<Hyperbola>(&curve.shape)) return std::asinh(local(c->frame).v / c->b);
  return closest_point(curve, p).t;
}

CurvePtr Geometry::curve(const Record& owner, Ref ref) {
  const Record* instance = context_.resolve(owner, ref, Entity::Curve);
  return instance ? curve(*instance) : nullptr;
}

CurvePtr Geometry::curve(const Record& instance) {
  const std::size_t key = context_.index(instance);
  if (const auto known = curves_.find(key); known != curves_.end()) return known->second;
  Visit visit(context_, instance);
  if (!visit) return nullptr;
  auto made = make_curve(instance);
  const CurvePtr shared = made ? std::make_shared<const Curve>(std::move(*made)) : nullptr;
  curves_.emplace(key, shared);
  context_.consume(instance);
  return shared;
}

std::optional<Curve> Geometry::make_curve(const Record& i) {
  const auto is = [&](Entity e) { return context_.is(i, e); };
  if (is(Entity::Line)) return line(i);
  if (is(Entity::Conic)) return conic(i);
  if (is(Entity::BSplineCurve)) return spline(i);
  if (is(Entity::TrimmedCurve)) return trimmed(i);
  if (is(Entity::CompositeCurve)) return composite(i);
  if (is(Entity::OffsetCurve3d) || is(Entity::OffsetCurve2d)) return offset(i);
  if (is(Entity::SurfaceCurve)) {
    const auto r = context_.read<step::SurfaceCurve>(i);
    const CurvePtr c = r ? curve(i, r->curve) : nullptr;
    return c ? std::optional(*c) : std::nullopt;
  }
  if (is(Entity::Pcurve)) return on_surface(i);
  if (is(Entity::Polyline)) {
    const auto r = context_.read<step::PolylineRecord>(i);
    if (!r) return std::nullopt;
    Polyline out;
    for (const Ref ref : r->points) {
      const auto p = point(i, ref);
      if (!p) return std::nullopt;
      out.points.push_back(*p);
    }
    if (out.points.size() >= 2) return Curve{std::move(out)};
    context_.add(i, sr::aggregate_bounds, "a polyline needs two points", static_cast<double>(out.points.size()), 2);
    return std::nullopt;
  }
  if (is(Entity::CurveReplica)) {
    const auto r = context_.read<step::Replica>(i);
    const CurvePtr parent = r ? curve(i, r->parent) : nullptr;
    const Record* by = parent ? context_.resolve(i, r->transformation, Entity::CartesianTransformationOperator) : nullptr;
    const auto t = by ? transform(*by) : std::nullopt;
    if (!t) return std::nullopt;
    auto moved = transformed(*parent, *t);
    if (moved) return std::move(*moved);
    context_.add(i, rules::unsupported, moved.error().text);
    return std::nullopt;
  }
  context_.add(i, rules::unsupported, fmt::format("curves of kind {} are not supported", context_.file.keyword(i).name));
  return std::nullopt;
}

std::optional<Curve> Geometry::line(const Record& i) {
  const auto r = context_.read<step::LineRecord>(i);
  if (!r) return std::nullopt;
  const auto p = point(i, r->point);
  const Record* vector = context_.resolve(i, r->direction, Entity::VectorEntity);
  const auto v = vector ? context_.read<step::VectorRecord>(*vector) : std::nullopt;
  const auto d = v ? direction(*vector, v->orientation) : std::nullopt;
  if (!p || !d) return std::nullopt;
  double magnitude = v->magnitude;
  if (!(magnitude > 0)) {
    context_.add(*vector, sr::vector_magnitude, "the magnitude is not positive; 1 is taken", magnitude, 0);
    magnitude = magnitude < 0 ? -magnitude : 1;
  }
  const Line line{*p, *p + magnitude * mm() * *d, {-infinity, infinity}};
  if (!is_finite(line.end)) return std::nullopt;
  return Curve{line};
}

std::optional<Curve> Geometry::conic(const Record& i) {
  const auto r = context_.read<step::ConicRecord>(i);
  const auto f = r ? frame(i, r->position) : std::nullopt;
  if (!f) return std::nullopt;
  const double a = r->a * mm(), b = r->b * mm();
  const bool two = !context_.is(i, Entity::Circle) && !context_.is(i, Entity::Parabola);
  if (!(a > 0) || (two && !(b > 0)) || !std::isfinite(a + b)) {
    context_.add(i, sr::conic_size, "a radius, semi-axis or focal distance is not positive", a > 0 ? b : a, 0).unit = "mm";
    return std::nullopt;
  }
  if (context_.is(i, Entity::Circle)) return Curve{Circle{*f, a}};
  if (context_.is(i, Entity::Ellipse)) return Curve{Ellipse{*f, a, b}};
  if (context_.is(i, Entity::Parabola)) return Curve{Parabola{*f, a, {-infinity, infinity}}};
  return Curve{Hyperbola{*f, a, b, {-infinity, infinity}}};
}

std::optional<Curve> Geometry::spline(const Record& i) {
  auto r = context_.read<step::SplineCurve>(i);
  if (!r) return std::nullopt;
  std::vector<Point> points;
  points.reserve(r->poles.size());
  for (const Ref ref : r->poles) {
    const auto p = point(i, ref);
    if (!p) return std::nullopt;
    points.push_back(*p);
  }
  if (!r->weights.empty() && r->weights.size() != points.size()) {
    context_.add(i, sr::weights, "there is not one weight for each pole", static_cast<double>(r->weights.size()),
                 static_cast<double>(points.size()));
    return std::nullopt;
  }
  auto knots = full_knots(context_, i, r->degree, points.size(), r->form, r->multiplicities, r->knots, sr::curve_sums);
  if (!knots) return std::nullopt;
  if (!check_weights(context_, i, r->weights)) return std::nullopt;
  if (points.size() == 2 && r->degree == 1 && distance(points[0], points[1]) == 0) return std::nullopt;
  if (const UnusedPoles unused = drop_excess(context_, i, r->degree, *knots, sr::curve_sums); unused.front + unused.back > 0) {
    const auto cut = [&](auto& list) {
      if (list.empty()) return;
      list.erase(list.end() - static_cast<std::ptrdiff_t>(unused.back), list.end());
      list.erase(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(unused.front));
    };
    cut(points);
    cut(r->weights);
  }
  auto made = NurbsCurve::from_cartesian(r->degree, std::move(*knots), points, r->weights);
  if (made) return Curve{std::move(*made)};
  context_.add(i, rules::erroneous_curve, made.error().text, made.error().measured, made.error().limit);
  return std::nullopt;
}

// Factor from a parameter in the file to ours: angles on circles and ellipses are in the angle unit of the context.
double Geometry::parameter_scale(const Record& i) {
  const Record* at = &i;
  for (int depth = 0; at && depth < 8; ++depth) {
    if (context_.is(*at, Entity::Circle) || context_.is(*at, Entity::Ellipse)) return units_.rad;
    Ref next;
    if (context_.is(*at, Entity::TrimmedCurve)) {
      if (const auto r = context_.read<step::TrimmedCurve>(*at)) next = r->basis;
    } else if (context_.is(*at, Entity::SurfaceCurve)) {
      if (const auto r = context_.read<step::SurfaceCurve>(*at)) next = r->curve;
    } else if (context_.is(*at, Entity::OffsetCurve3d) || context_.is(*at, Entity::OffsetCurve2d)) {
      if (const auto r = context_.read<step::OffsetCurveRecord>(*at)) next = r->basis;
    }
    at = next ? context_.find(next) : nullptr;
  }
  return 1;
}

std::optional<double> Geometry::trim_parameter(const Record& i, const std::vector<step::Select>& trim, const std::string& master,
                                               const Curve& basis, double scale) {
  std::optional<double> by_parameter, by_point;
  std::optional<Point> at;
  for (const step::Select& s : trim) {
    if (s.kind == step::Select::Kind::Number) by_parameter = s.number * scale;
    if (s.kind == step::Select::Kind::Reference) {
      at = point(i, s.ref);
      if (at) by_point = parameter_near(basis, *at);
    }
  }
  if (by_parameter && at && std::isfinite(*by_parameter)) {
    const double off = distance(evaluate(basis, *by_parameter), *at);
    const double allowed = std::max(10 * units_.uncertainty_mm, 1e-5);
    if (!flat_ && off > allowed)
      context_.add(i, sr::trimmed_curve, Severity::Warning,
                   fmt::format("point and parameter of a trim are {:.3g} mm apart; the {} is used", off,
                               master == "CARTESIAN" ? "point" : "parameter"),
                   off, allowed);
    return master == "CARTESIAN" ? by_point : by_parameter;
  }
  return by_parameter ? by_parameter : by_point;
}

std::optional<Curve> Geometry::trimmed(const Record& i) {
  const auto r = context_.read<step::TrimmedCurve>(i);
  const Record* basis_instance = r ? context_.resolve(i, r->basis, Entity::Curve) : nullptr;
  const CurvePtr basis = basis_instance ? curve(*basis_instance) : nullptr;
  if (!basis) return std::nullopt;
  const double scale = parameter_scale(*basis_instance);
  const auto t1 = trim_parameter(i, r->trim1, r->master, *basis, scale);
  const auto t2 = trim_parameter(i, r->trim2, r->master, *basis, scale);
  if (!t1 || !t2) {
    context_.add(i, sr::trimmed_curve, "a trim is missing or cannot be used");
    return std::nullopt;
  }
  double lo = r->sense ? *t1 : *t2, hi = r->sense ? *t2 : *t1;
  if (is_closed_by_nature(*basis)) {
    if (hi <= lo) hi += two_pi * std::ceil((lo - hi) / two_pi);
    if (hi <= lo) hi += two_pi;
    if (hi - lo > two_pi) hi = lo + std::fmod(hi - lo, two_pi);
    constexpr double rounding = 1e-9;  // 6.28318530718 is more than a turn; no arc is meant to be that short
    if (hi - lo < rounding) hi = lo + two_pi;
  } else if (hi < lo) {
    const Interval whole = range(*basis);
    const bool closed = whole.is_bounded() && distance(start_point(*basis), end_point(*basis)) <= units_.uncertainty_mm;
    if (closed) {  // over the end of a closed curve
      CompositeCurve parts = make_composite({{std::make_shared<const Curve>(with_range(*basis, {lo, whole.hi})), false},
                                             {std::make_shared<const Curve>(with_range(*basis, {whole.lo, hi})), false}});
      Curve joined{std::move(parts)};
      return r->sense ? joined : reversed(joined);
    }
    context_.add(i, sr::trimmed_curve, Severity::Warning, "the trims are against the sense that is stated; the part between is taken");
    std::swap(lo, hi);
  }
  if (!(lo < hi) || !std::isfinite(lo) || !std::isfinite(hi)) {
    context_.add(i, sr::trimmed_curve, "the trims are equal: nothing is left of the curve", hi - lo, 0);
    return std::nullopt;
  }
  Curve part = with_range(*basis, {lo, hi});
  return r->sense ? part : reversed(part);
}

std::optional<Curve> Geometry::composite(const Record& i) {
  const auto r = context_.read<step::CompositeRecord>(i);
  if (!r) return std::nullopt;
  std::vector<CompositeCurve::Segment> segments;
  for (const Ref ref : r->segments) {
    const Record* segment = context_.resolve(i, ref, Entity::CompositeCurveSegment);
    const auto s = segment ? context_.read<step::CompositeSegment>(*segment) : std::nullopt;
    const CurvePtr c = s ? curve(*segment, s->parent) : nullptr;
    if (c && r->segments.size() == 1 && !is_bounded(*c)) return s->same_sense ? *c : reversed(*c);  // whoever uses it cuts it
    if (!c || !is_bounded(*c)) {
      if (c) context_.add(i, sr::composite_transition, Severity::Error, "a segment of a composite curve is unbounded");
      return std::nullopt;
    }
    segments.push_back({c, !s->same_sense});
  }
  if (segments.empty()) {
    context_.add(i, sr::aggregate_bounds, "a composite curve without segments", 0, 1);
    return std::nullopt;
  }
  double gap = 0;
  for (std::size_t k = 0; !flat_ && k + 1 < segments.size(); ++k) {
    const auto& a = segments[k];
    const auto& b = segments[k + 1];
    gap = std::max(gap, distance(a.reversed ? start_point(*a.curve) : end_point(*a.curve),
                                 b.reversed ? end_point(*b.curve) : start_point(*b.curve)));
  }
  if (gap > std::max(10 * units_.uncertainty_mm, 1e-5))
    context_.add(i, sr::composite_transition, "segments of a composite curve do not meet", gap, units_.uncertainty_mm);
  return Curve{make_composite(std::move(segments))};
}

std::optional<Curve> Geometry::offset(const Record& i) {
  const auto r = context_.read<step::OffsetCurveRecord>(i);
  const CurvePtr basis = r ? curve(i, r->basis) : nullptr;
  if (!basis) return std::nullopt;
  Vector normal{0, 0, 1};
  if (r->direction) {
    const auto d = direction(i, r->direction);
    if (!d) return std::nullopt;
    normal = *d;
  }
  // ISO 10303-42: along V x T; ours along T x V.
  return Curve{OffsetCurve{basis, -r->distance * mm(), normal}};
}

// A curve that is given in the parameters of a surface only: nothing in space yet. A line or circle on a plane is one.
std::optional<Curve> Geometry::on_surface(const Record& i) {
  const auto r = context_.read<step::PcurveRecord>(i);
  const auto s = r ? surface(i, r->surface) : std::nullopt;
  const Record* representation = s ? context_.resolve(i, r->representation, Entity::Representation) : nullptr;
  const auto rep = representation ? context_.read<step::RepresentationRecord>(*representation) : std::nullopt;
  const Record* flat_instance = rep && !rep->items.empty() ? context_.resolve(*representation, rep->items.front(), Entity::Curve) : nullptr;
  if (!flat_instance) return std::nullopt;
  Geometry plane_reader(context_, units_, true);
  const CurvePtr flat = plane_reader.curve(*flat_instance);
  const Plane* plane = std::get_if<Plane>(&s->surface->shape);
  if (!flat || !plane) {
    if (flat) context_.add(i, rules::unsupported, "a curve given only in the parameters of a curved surface is not supported");
    return std::nullopt;
  }
  Transform t;
  const Frame& f = plane->frame;
  t.r = {{{f.x.x, f.y.x, f.z.x}, {f.x.y, f.y.y, f.z.y}, {f.x.z, f.y.z, f.z.z}}};
  t.t = to_vector(f.origin);
  auto moved = transformed(*flat, t * Transform::scale(units_.mm));
  return moved ? std::optional(std::move(*moved)) : std::nullopt;
}

}  // namespace trimloop::io::step_import
