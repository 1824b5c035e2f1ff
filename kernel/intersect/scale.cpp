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

}  // namespace trimloop::detail
