#include "kernel/intersect/scale.h"

#include "kernel/geometry/detail.h"

namespace trimloop::detail {

Scale scale_of(const Box& a, const Box& b, double tolerance_mm) {
  Scale s;
  Box both = a;
  both.add(b);
  if (both.empty() || !is_finite(both.lo) || !is_finite(both.hi)) {
    s.tolerance = tolerance_mm > 0 ? tolerance_mm : 1e-12;
    return s;
  }
  s.origin = midpoint(both.lo, both.hi);
  const double about = 0.5 * std::max({both.hi.x - both.lo.x, both.hi.y - both.lo.y, both.hi.z - both.lo.z});
  // Coordinates far from the origin carry their rounding along.
  const double far = std::max({std::abs(s.origin.x), std::abs(s.origin.y), std::abs(s.origin.z)});
  s.size = std::max(about, 1e-300);
  s.tolerance = tolerance_mm > 0 ? tolerance_mm : 1e-12 * std::max(s.size, far);
  return s;
}

Curve cut_to(const Curve& c, const Box& box) {
  const Line* line = std::get_if<Line>(&c.shape);
  if (!line || line->range.is_bounded() || box.empty() || !is_finite(box.lo) || !is_finite(box.hi)) return c;
  const Vector d = line->end - line->start;
  const double size = dot(d, d);
  if (!(size > 0)) return c;
  const double middle = dot(midpoint(box.lo, box.hi) - line->start, d) / size;
  const double reach = (0.51 * box.diagonal() + 1e-9) / std::sqrt(size) * (1 + 1e-9) + 1e-12;
  Line out = *line;
  out.range = {std::max(line->range.lo, middle - reach), std::min(line->range.hi, middle + reach)};
  if (!(out.range.lo < out.range.hi)) {  // the ray looks away: its first piece meets nothing either
    const double end = std::isfinite(line->range.lo) ? line->range.lo : line->range.hi;
    out.range = std::isfinite(line->range.lo) ? Interval{end, end + reach} : Interval{end - reach, end};
  }
  return Curve{out};
}

namespace {

Interval along(Point origin, Vector direction, const Box& box) {
  const double size = dot(direction, direction);
  Interval out{infinity, -infinity};
  for (int k = 0; k < 8; ++k) {
    const Point corner{k & 1 ? box.hi.x : box.lo.x, k & 2 ? box.hi.y : box.lo.y, k & 4 ? box.hi.z : box.lo.z};
    const double t = dot(corner - origin, direction) / size;
    out = {std::min(out.lo, t), std::max(out.hi, t)};
  }
  const double by = 0.01 * out.length() + 1e-6 * (1 + std::abs(out.lo) + std::abs(out.hi));
  return {out.lo - by, out.hi + by};
}
Interval common(Interval a, Interval b) {
  const Interval c{std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
  if (c.lo < c.hi) return c;
  // They do not meet: what of `a` is nearest to `b`, as short as it may be.
  return a.lo >= b.hi ? Interval{a.lo, a.lo + b.length()} : Interval{a.hi - b.length(), a.hi};
}

}  // namespace

Patch cut_to(const Surface& s, std::optional<Interval> u, std::optional<Interval> v, const Box& box) {
  const Rectangle whole = rectangle(s);
  Patch out{u.value_or(whole.u), v.value_or(whole.v)};
  if ((out.u.is_bounded() && out.v.is_bounded()) || box.empty() || !is_finite(box.lo) || !is_finite(box.hi)) return out;
  const auto cut = [&](Interval& i, Point origin, Vector direction) {
    if (!i.is_bounded()) i = common(i, along(origin, direction, box));
  };
  if (const Plane* p = std::get_if<Plane>(&s.shape)) {
    cut(out.u, p->frame.origin, p->frame.x);
    cut(out.v, p->frame.origin, p->frame.y);
  } else if (const Cylinder* c = std::get_if<Cylinder>(&s.shape)) {
    cut(out.v, c->frame.origin, c->frame.z);
  } else if (const Cone* k = std::get_if<Cone>(&s.shape)) {
    cut(out.v, k->frame.origin, k->frame.z);
  }
  return out;
}

}  // namespace trimloop::detail
