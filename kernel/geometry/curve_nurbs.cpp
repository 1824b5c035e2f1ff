// Every curve type as an exact rational B-spline (The NURBS Book, 7.3 - 7.5), and the map between the two parameters.

#include "kernel/geometry/conic_arcs.h"
#include "kernel/geometry/detail.h"

namespace trimloop {
namespace {

using Kind = ParameterMap::Kind;

ParameterMap identity(Interval r) { return {{r.lo, r.hi}, {r.lo, r.hi}, {ParameterMap::Piece{}}}; }

Result<ToNurbsCurve> packed(Result<NurbsCurve> curve, ParameterMap map) {
  if (!curve) return tl::unexpected<Error>(curve.error());
  return ToNurbsCurve{std::move(*curve), std::move(map)};
}

Hpoint with_weight(Point p, double w) { return {w * p.x, w * p.y, w * p.z, w}; }

Result<ToNurbsCurve> convert(const Line& c) {
  const Interval r = c.range;
  return packed(NurbsCurve::from_homogeneous(
                    1, {r.lo, r.lo, r.hi, r.hi},
                    {with_weight(evaluate(Curve{c}, r.lo), 1), with_weight(evaluate(Curve{c}, r.hi), 1)}),
                identity(r));
}

Result<ToNurbsCurve> convert(const Polyline& c) {
  const std::size_t n = c.points.size();
  if (n < 2)
    return fail(ErrorCode::Degenerate, "a polyline needs two points to be a spline", static_cast<double>(n), 2);
  std::vector<double> knots{0};
  for (std::size_t i = 0; i < n; ++i) knots.push_back(static_cast<double>(i));
  knots.push_back(static_cast<double>(n - 1));
  return packed(NurbsCurve::from_cartesian(1, std::move(knots), c.points, {}),
                identity({0, static_cast<double>(n - 1)}));
}

Result<ToNurbsCurve> on_frame(const Frame& f, double a, double b, const detail::Arcs& arcs, Kind kind) {
  std::vector<Hpoint> poles;
  poles.reserve(arcs.poles.size());
  for (const detail::ArcPole& k : arcs.poles) {
    const Vector v = k.w * to_vector(f.origin) + k.c * a * f.x + k.s * b * f.y;
    poles.push_back({v.x, v.y, v.z, k.w});
  }
  return packed(NurbsCurve::from_homogeneous(2, arcs.knots(), std::move(poles)), arcs.map(kind));
}
Result<ToNurbsCurve> convert(const Circle& c) {
  return on_frame(c.frame, c.radius, c.radius, detail::circular_arcs(c.range), Kind::HalfAngle);
}
Result<ToNurbsCurve> convert(const Ellipse& c) {
  return on_frame(c.frame, c.a, c.b, detail::circular_arcs(c.range), Kind::HalfAngle);
}
Result<ToNurbsCurve> convert(const Hyperbola& c) {
  return on_frame(c.frame, c.a, c.b, detail::hyperbolic_arcs(c.range), Kind::HalfHyperbolic);
}
// The middle pole is the blossom at (lo, hi): t^2 -> lo hi, t -> (lo + hi) / 2.
Result<ToNurbsCurve> convert(const Parabola& c) {
  const Interval r = c.range;
  const double f = c.focal_length;
  const Point middle = c.frame.origin + (f * r.lo * r.hi * c.frame.x + f * (r.lo + r.hi) * c.frame.y);
  return packed(NurbsCurve::from_homogeneous(2, {r.lo, r.lo, r.lo, r.hi, r.hi, r.hi},
                                             {with_weight(evaluate(Curve{c}, r.lo), 1), with_weight(middle, 1),
                                              with_weight(evaluate(Curve{c}, r.hi), 1)}),
                identity(r));
}
Result<ToNurbsCurve> convert(const NurbsCurve& c) { return ToNurbsCurve{c, identity(c.range())}; }
Result<ToNurbsCurve> convert(const OffsetCurve&) {
  return fail(ErrorCode::Unsupported, "an offset curve is no rational spline; it has to be approximated");
}

// ---- Composite

// A child in the composite's parameter, clamped.
Result<ToNurbsCurve> placed(const CompositeCurve::Segment& s, Interval place) {
  Result<ToNurbsCurve> child = to_nurbs(*s.curve);
  if (!child) return child;
  if (!(child->curve.range().length() > 0))
    return fail(ErrorCode::Degenerate, "a child of the composite has no span", 0.0);
  NurbsCurve curve = trimmed(child->curve, child->curve.range());
  if (s.reversed) curve = reversed(curve);
  ParameterMap& map = child->map;
  const Interval own{map.own.front(), map.own.back()}, nurbs{map.nurbs.front(), map.nurbs.back()};
  const auto into = [&](std::vector<double>& at, Interval from) {
    for (double& t : at) t = place.at((s.reversed ? from.hi - t : t - from.lo) / from.length());
    if (s.reversed) std::reverse(at.begin(), at.end());
  };
  into(map.own, own);
  into(map.nurbs, nurbs);
  if (s.reversed) std::reverse(map.pieces.begin(), map.pieces.end());
  child->curve = reparametrized(curve, place);
  return child;
}

// Appends `next`, which begins where `all` ends, with a knot of multiplicity degree at the joint. Weights are scaled to
// agree there; the pole of the joint is that of `all`.
Result<void> append(std::vector<double>& knots, std::vector<Hpoint>& poles, const NurbsCurve& next, double& gap) {
  if (poles.empty()) {
    knots = next.knots();
    poles = next.poles();
    return {};
  }
  const Hpoint end = poles.back(), start = next.poles().front();
  const double scale = end.w / start.w;
  if (!std::isfinite(scale) || scale == 0)
    return fail(ErrorCode::Degenerate, "a joint of the composite has zero weight", start.w);
  const Point at = project(end);
  const double jump = distance(at, project(start));
  if (jump > 16 * std::numeric_limits<double>::epsilon() * (norm(to_vector(at)))) gap = std::max(gap, jump);
  knots.pop_back();
  knots.insert(knots.end(), next.knots().begin() + next.degree() + 1, next.knots().end());
  for (std::size_t i = 1; i < next.poles().size(); ++i) poles.push_back(scale * next.poles()[i]);
  return {};
}

Result<ToNurbsCurve> convert(const CompositeCurve& c) {
  std::vector<ToNurbsCurve> children;
  int degree = 1;
  for (std::size_t i = 0; i < c.segments.size(); ++i) {
    const Interval place{c.starts[i], c.starts[i + 1]};
    if (!(place.length() > 0)) continue;  // a point
    Result<ToNurbsCurve> child = placed(c.segments[i], place);
    if (!child) return child;
    degree = std::max(degree, child->curve.degree());
    children.push_back(std::move(*child));
  }
  if (children.empty()) return fail(ErrorCode::Degenerate, "the composite has no child with a span", 0.0);
  std::vector<double> knots;
  std::vector<Hpoint> poles;
  ParameterMap map;
  double gap = 0;
  for (ToNurbsCurve& child : children) {
    const NurbsCurve raised =
        child.curve.degree() < degree ? elevate(child.curve, degree - child.curve.degree()) : child.curve;
    const Result<void> joined = append(knots, poles, raised, gap);
    if (!joined) return tl::unexpected<Error>(joined.error());
    gap = std::max(gap, child.deviation);
    const std::ptrdiff_t skip = map.own.empty() ? 0 : 1;
    map.own.insert(map.own.end(), child.map.own.begin() + skip, child.map.own.end());
    map.nurbs.insert(map.nurbs.end(), child.map.nurbs.begin() + skip, child.map.nurbs.end());
    map.pieces.insert(map.pieces.end(), child.map.pieces.begin(), child.map.pieces.end());
  }
  Result<ToNurbsCurve> out =
      packed(NurbsCurve::from_homogeneous(degree, std::move(knots), std::move(poles)), std::move(map));
  if (out) out->deviation = gap;
  return out;
}

// ---- Maps

// x in [-1, 1] -> y in [-1, 1]
double forward(ParameterMap::Piece piece, double x) {
  const double h = piece.half_span;
  if (piece.kind == Kind::HalfAngle) return std::tan(0.5 * x * h) / std::tan(0.5 * h);
  if (piece.kind == Kind::HalfHyperbolic) return std::tanh(0.5 * x * h) / std::tanh(0.5 * h);
  return x;
}
double backward(ParameterMap::Piece piece, double y) {
  const double h = piece.half_span;
  if (piece.kind == Kind::HalfAngle) return 2 / h * std::atan(y * std::tan(0.5 * h));
  if (piece.kind == Kind::HalfHyperbolic) return 2 / h * std::atanh(y * std::tanh(0.5 * h));
  return y;
}

template <class Inside>
double mapped(const std::vector<double>& from, const std::vector<double>& to, double t, Inside inside) {
  if (!(t > from.front())) return to.front();
  if (t >= from.back()) return to.back();
  const auto i = static_cast<std::size_t>(std::upper_bound(from.begin(), from.end(), t) - from.begin()) - 1;
  if (t == from[i]) return to[i];
  const double x = 2 * ((t - from[i]) / (from[i + 1] - from[i])) - 1;
  const double y = inside(i, x);
  return Interval{to[i], to[i + 1]}.clamp(to[i] + 0.5 * (1 + y) * (to[i + 1] - to[i]));
}
bool is_same(const ParameterMap& m, double t) {  // the piece of t is mapped onto itself, affinely
  const auto next = std::upper_bound(m.own.begin(), m.own.end(), t);
  if (next == m.own.begin() || next == m.own.end()) return false;
  const auto i = static_cast<std::size_t>(next - m.own.begin()) - 1;
  return m.pieces[i].kind == Kind::Affine && m.own[i] == m.nurbs[i] && m.own[i + 1] == m.nurbs[i + 1];
}

}  // namespace

double map_to_nurbs(const ParameterMap& m, double t) {
  if (is_same(m, t)) return t;
  return mapped(m.own, m.nurbs, t, [&](std::size_t i, double x) { return forward(m.pieces[i], x); });
}
double map_from_nurbs(const ParameterMap& m, double s) {
  if (is_same(m, s)) return s;
  return mapped(m.nurbs, m.own, s, [&](std::size_t i, double y) { return backward(m.pieces[i], y); });
}

Result<ToNurbsCurve> to_nurbs(const Curve& c) {
  const Interval r = range(c);
  if (!r.is_bounded()) return fail(ErrorCode::InvalidArgument, "an unbounded curve is no spline");
  return std::visit([](const auto& shape) { return convert(shape); }, c.shape);
}

}  // namespace trimloop
