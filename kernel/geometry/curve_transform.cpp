// Other forms of the same curve: a part of it, turned round, moved by an affine map.

#include "kernel/geometry/detail.h"

namespace trimloop {
namespace {

// ---- Part

Curve part_of(const NurbsCurve& c, Interval r) {
  const Interval whole = c.domain();
  return {c.with_range({whole.clamp(r.lo), whole.clamp(r.hi)})};
}
// A polyline has its range in its number of points, so a part of it is a NURBS of degree 1 with the same parameter.
Curve part_of(const Polyline& c, Interval r) {
  const std::size_t n = c.points.size();
  if (n < 2) return {c};
  const Interval whole{0, static_cast<double>(n - 1)};
  const Interval part{whole.clamp(r.lo), whole.clamp(r.hi)};
  if (part.lo == whole.lo && part.hi == whole.hi) return {c};
  std::vector<double> knots(n + 2);
  for (std::size_t i = 0; i < n; ++i) knots[i + 1] = static_cast<double>(i);
  knots.back() = whole.hi;
  const Result<NurbsCurve> nurbs = NurbsCurve::from_cartesian(1, std::move(knots), c.points, {}, part);
  return nurbs ? Curve{*nurbs} : Curve{c};
}
Curve part_of(const OffsetCurve& c, Interval r) {
  if (!c.basis) return {c};
  return {OffsetCurve{std::make_shared<const Curve>(with_range(*c.basis, r)), c.distance, c.normal}};
}
Curve part_of(const CompositeCurve& c, Interval r) {
  CompositeCurve out;
  for (std::size_t i = 0; i < c.segments.size(); ++i) {
    const double lo = std::max(c.starts[i], r.lo), hi = std::min(c.starts[i + 1], r.hi);
    const bool last_chance = i + 1 == c.segments.size() && out.segments.empty();
    if (!(lo < hi) && !last_chance) continue;
    CompositeCurve::Segment s = c.segments[i];
    if (lo > c.starts[i] || hi < c.starts[i + 1]) {
      const Interval child = range(*s.curve);
      const double from = std::max(lo - c.starts[i], 0.0), to = c.starts[i + 1] - hi;  // cut off at either end
      const Interval kept =
          s.reversed ? Interval{child.lo + to, child.hi - from} : Interval{child.lo + from, child.hi - to};
      s.curve = std::make_shared<const Curve>(with_range(*s.curve, {std::min(kept.lo, kept.hi), kept.hi}));
    }
    if (out.starts.empty()) out.starts.push_back(lo);
    out.starts.push_back(std::max(lo, hi));
    out.segments.push_back(std::move(s));
  }
  return {std::move(out)};
}
template <class Conic>  // and lines
Curve part_of(Conic c, Interval r) {
  c.range = r;
  return {c};
}

// ---- Reversed

// R(t) = L(lo + hi - t)
Curve reversed_of(const Line& c) {
  if (!c.range.is_bounded()) return {Line{c.start, c.start - (c.end - c.start), {-c.range.hi, -c.range.lo}}};
  if (c.range.lo == 0 && c.range.hi == 1) return {Line{c.end, c.start, c.range}};
  const double sum = c.range.lo + c.range.hi;
  const Vector along = c.end - c.start;
  return {Line{c.start + sum * along, c.start + (sum - 1) * along, c.range}};
}
// cos(s - t) x + sin(s - t) y = cos t (cos s x + sin s y) + sin t (sin s x - cos s y), s = lo + hi
Curve reversed_of(const Circle& c) {
  const Frame& f = c.frame;
  const double sum = c.range.lo + c.range.hi;
  const double cos_s = sum == two_pi ? 1 : std::cos(sum), sin_s = sum == two_pi ? 0 : std::sin(sum);
  return {Circle{{f.origin, cos_s * f.x + sin_s * f.y, sin_s * f.x - cos_s * f.y, -f.z}, c.radius, c.range}};
}
template <class Conic>  // their axes cannot turn: C(-t) in the frame with y and z turned over
Curve reversed_of(Conic c) {
  c.frame.y = -c.frame.y;
  c.frame.z = -c.frame.z;
  c.range = {-c.range.hi, -c.range.lo};
  return {c};
}
Curve reversed_of(Polyline c) {
  std::reverse(c.points.begin(), c.points.end());
  return {std::move(c)};
}
Curve reversed_of(const NurbsCurve& c) { return {reversed(c)}; }
Curve reversed_of(const OffsetCurve& c) {
  if (!c.basis) return {c};
  return {OffsetCurve{std::make_shared<const Curve>(reversed(*c.basis)), -c.distance, c.normal}};
}
Curve reversed_of(CompositeCurve c) {
  if (c.segments.empty()) return {c};
  const double sum = c.starts.front() + c.starts.back();
  std::reverse(c.segments.begin(), c.segments.end());
  for (CompositeCurve::Segment& s : c.segments) s.reversed = !s.reversed;
  std::reverse(c.starts.begin(), c.starts.end());
  for (double& t : c.starts) t = sum - t;
  return {std::move(c)};
}

// ---- Moved

tl::unexpected<Error> singular() {
  return fail(ErrorCode::Degenerate, "the transformation is singular: a conic would collapse");
}

Result<Curve> moved(const Line& c, const Transform& m, bool) {
  return Curve{Line{apply(m, c.start), apply(m, c.end), c.range}};
}
Result<Curve> moved(Polyline c, const Transform& m, bool) {
  for (Point& p : c.points) p = apply(m, p);
  return Curve{std::move(c)};
}
Result<Curve> moved(const NurbsCurve& c, const Transform& m, bool) { return Curve{transformed(c, m)}; }

Frame frame_of(Point origin, Vector x, Vector y) {
  const Vector unit = normalized(x);
  const Vector across = normalized(y - dot(y, unit) * unit);
  return {origin, unit, across, cross(unit, across)};
}

// P cos t + Q sin t with conjugate half diameters P, Q: the axes lie at the t for which the derivative is at right
// angles, tan 2t = 2 P.Q / (P.P - Q.Q).
Result<Curve> ellipse_of(Point centre, Vector p, Vector q, Interval range) {
  const double turn = 0.5 * std::atan2(2 * dot(p, q), dot(p, p) - dot(q, q));
  const double c = std::cos(turn), s = std::sin(turn);
  const Vector x = c * p + s * q, y = c * q - s * p;
  if (!(norm(x) > 0) || !(norm(y) > 1e-14 * norm(x))) return singular();
  return Curve{Ellipse{frame_of(centre, x, y), norm(x), norm(y), {range.lo - turn, range.hi - turn}}};
}
Result<Curve> moved(const Circle& c, const Transform& m, bool similar) {
  const Vector x = apply(m, c.frame.x), y = apply(m, c.frame.y);
  const Point centre = apply(m, c.frame.origin);
  if (similar) return Curve{Circle{frame_of(centre, x, y), c.radius * scale_factor(m), c.range}};
  return ellipse_of(centre, c.radius * x, c.radius * y, c.range);
}
Result<Curve> moved(const Ellipse& c, const Transform& m, bool similar) {
  const Vector x = apply(m, c.frame.x), y = apply(m, c.frame.y);
  const Point centre = apply(m, c.frame.origin);
  const double s = scale_factor(m);
  if (similar) return Curve{Ellipse{frame_of(centre, x, y), c.a * s, c.b * s, c.range}};
  return ellipse_of(centre, c.a * x, c.b * y, c.range);
}
// A sheared parabola has its vertex elsewhere and another scale of its parameter; a quadratic NURBS keeps the latter.
Result<Curve> moved(const Parabola& c, const Transform& m, bool similar) {
  if (similar)
    return Curve{Parabola{frame_of(apply(m, c.frame.origin), apply(m, c.frame.x), apply(m, c.frame.y)),
                          c.focal_length * scale_factor(m), c.range}};
  const auto nurbs = to_nurbs(Curve{c});
  if (!nurbs) return tl::unexpected<Error>(nurbs.error());
  return Curve{transformed(nurbs->curve, m)};
}
// P cosh t + Q sinh t: the vertex lies where tanh 2t = -2 P.Q / (P.P + Q.Q).
Result<Curve> moved(const Hyperbola& c, const Transform& m, bool similar) {
  const Vector x = apply(m, c.frame.x), y = apply(m, c.frame.y);
  const Point centre = apply(m, c.frame.origin);
  const double s = scale_factor(m);
  if (similar) return Curve{Hyperbola{frame_of(centre, x, y), c.a * s, c.b * s, c.range}};
  const Vector p = c.a * x, q = c.b * y;
  const double shift = 0.5 * std::atanh(-2 * dot(p, q) / (dot(p, p) + dot(q, q)));
  if (!std::isfinite(shift)) return singular();
  const double ch = std::cosh(shift), sh = std::sinh(shift);
  const Vector axis = ch * p + sh * q, across = sh * p + ch * q;
  if (!(norm(axis) > 0) || !(norm(across) > 0)) return singular();
  return Curve{
      Hyperbola{frame_of(centre, axis, across), norm(axis), norm(across), {c.range.lo - shift, c.range.hi - shift}}};
}
// A mirror turns C' x n round, so the offset goes along the mirrored normal's opposite.
Result<Curve> moved(const OffsetCurve& c, const Transform& m, bool similar) {
  if (!similar) return fail(ErrorCode::Unsupported, "an offset curve cannot be scaled unevenly");
  if (!c.basis) return Curve{c};
  Result<Curve> basis = transformed(*c.basis, m);
  if (!basis) return basis;
  const double s = scale_factor(m), side = determinant(m) < 0 ? -1 : 1;
  return Curve{
      OffsetCurve{std::make_shared<const Curve>(std::move(*basis)), c.distance * s, side / s * apply(m, c.normal)}};
}
Result<Curve> moved(CompositeCurve c, const Transform& m, bool) {
  for (CompositeCurve::Segment& s : c.segments) {
    Result<Curve> child = transformed(*s.curve, m);
    if (!child) return child;
    s.curve = std::make_shared<const Curve>(std::move(*child));
  }
  return Curve{std::move(c)};  // every type keeps its span, so the starts stay
}

}  // namespace

Result<Curve> transformed(const Curve& c, const Transform& m) {
  if (is_identity(m)) return c;
  if (!std::isfinite(determinant(m)) || !is_finite(m.t))
    return fail(ErrorCode::InvalidArgument, "the transformation has entries that are not finite");
  return std::visit([&](const auto& shape) { return moved(shape, m, detail::is_similarity(m)); }, c.shape);
}

Curve with_range(const Curve& c, Interval r) {
  return std::visit([r](const auto& shape) { return part_of(shape, r); }, c.shape);
}
Curve reversed(const Curve& c) {
  return std::visit([](const auto& shape) { return reversed_of(shape); }, c.shape);
}

}  // namespace trimloop
