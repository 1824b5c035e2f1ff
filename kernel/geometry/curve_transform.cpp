// Other forms of the same curve: a part of it, turned round, moved by an affine map; and its box.

#include "kernel/geometry/detail.h"

namespace trimloop {
namespace {

// ---- Part

Curve part_of(const NurbsCurve& c, Interval r) { return {c.with_range(r)}; }
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

}  // namespace

Curve with_range(const Curve& c, Interval r) {
  return std::visit([r](const auto& shape) { return part_of(shape, r); }, c.shape);
}
Curve reversed(const Curve& c) {
  return std::visit([](const auto& shape) { return reversed_of(shape); }, c.shape);
}

}  // namespace trimloop
