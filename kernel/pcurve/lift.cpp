#include "kernel/pcurve/lift.h"

#include "kernel/geometry/approximate.h"
#include "kernel/pcurve/isocurve.h"

namespace trimloop::pcurve {

namespace {

// Of the part along a line of constant u or v; null where the pcurve is none.
CurvePtr along_isocurve(const Surface& surface, const Curve& pcurve) {
  if (!std::holds_alternative<Line>(pcurve.shape)) return nullptr;
  const Point a = start_point(pcurve), b = end_point(pcurve);
  const bool constant_u = a.x == b.x;
  if (constant_u == (a.y == b.y)) return nullptr;
  const double from = constant_u ? a.y : a.x, to = constant_u ? b.y : b.x;
  const CurvePtr iso = isocurve(surface, constant_u, constant_u ? a.x : a.y, {std::min(from, to), std::max(from, to)});
  if (!iso || from < to) return iso;
  return std::make_shared<const Curve>(reversed(*iso));
}

}  // namespace

Result<Lifted> lift(const Surface& surface, const Curve2& pcurve, Interval range, double tolerance_mm) {
  const Curve part = with_range(pcurve.curve, range);
  if (const auto* plane = std::get_if<Plane>(&surface.shape)) {
    const Frame& f = plane->frame;
    Transform into_space;
    into_space.r = {{{f.x.x, f.y.x, f.z.x}, {f.x.y, f.y.y, f.z.y}, {f.x.z, f.y.z, f.z.z}}};
    into_space.t = to_vector(f.origin);
    auto curve = transformed(part, into_space);
    if (!curve) return tl::unexpected(curve.error());
    return Lifted{std::make_shared<const Curve>(std::move(*curve)), 0};
  }
  if (!std::holds_alternative<OffsetSurface>(surface.shape)) {
    if (CurvePtr iso = along_isocurve(surface, part)) return Lifted{std::move(iso), 0};
  }
  auto fitted = approximate_in_space(
      [&](double t) {
        const Point p = evaluate(part, t);
        return evaluate(surface, Uv{p.x, p.y});
      },
      breaks(part), tolerance_mm);
  if (!fitted) return tl::unexpected(fitted.error());
  return Lifted{std::make_shared<const Curve>(std::move(fitted->curve)), fitted->deviation};
}

}  // namespace trimloop::pcurve
