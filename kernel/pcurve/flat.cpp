#include "kernel/pcurve/flat.h"

namespace trimloop::pcurve {
namespace {

// Space -> (u, v, height).
std::optional<Transform> flat_coordinates(const Surface& surface) {
  Point origin;
  Vector du, dv;
  Uv at;
  if (const auto* plane = std::get_if<Plane>(&surface.shape)) {
    origin = plane->frame.origin, du = plane->frame.x, dv = plane->frame.y;
  } else if (const auto* n = std::get_if<NurbsSurface>(&surface.shape)) {
    if (n->is_rational() || n->degree_u() != 1 || n->degree_v() != 1 || n->poles_u() != 2 || n->poles_v() != 2)
      return std::nullopt;
    const Interval u = n->domain_u(), v = n->domain_v();
    const Point p[] = {project(n->pole(0, 0)), project(n->pole(1, 0)), project(n->pole(0, 1)), project(n->pole(1, 1))};
    const Vector twist = (p[3] - p[2]) - (p[1] - p[0]);
    if (!(norm(twist) <= 1e-12 * (norm(p[1] - p[0]) + norm(p[2] - p[0])))) return std::nullopt;
    origin = p[0], at = {u.lo, v.lo};
    du = (p[1] - p[0]) / u.length(), dv = (p[2] - p[0]) / v.length();
  } else {
    return std::nullopt;
  }
  const Vector n = normalized(cross(du, dv));
  const double det = dot(cross(du, dv), n);
  if (!(det > 1e-9 * norm(du) * norm(dv))) return std::nullopt;
  const Vector row_u = cross(dv, n) / det, row_v = cross(n, du) / det;  // dual basis
  Transform t;
  const Vector rows[] = {row_u, row_v, n};
  const Vector o = to_vector(origin);
  for (std::size_t i = 0; i < 3; ++i) t.r[i] = {rows[i].x, rows[i].y, rows[i].z};
  t.t = {at.u - dot(row_u, o), at.v - dot(row_v, o), -dot(n, o)};
  return t;
}

// The projection along z of a curve in (u, v, height), where its type can say it.
std::optional<Curve> without_height(const Curve& c) {
  constexpr double level = 1e-10;  // of a unit vector: how flat a conic must lie to stay what it is
  const auto lies_flat = [&](const Frame& f) { return std::abs(f.x.z) < level && std::abs(f.y.z) < level; };
  const auto flat = [](Frame f) {
    f.origin.z = f.x.z = f.y.z = 0;
    f.z = {0, 0, f.z.z < 0 ? -1.0 : 1.0};
    return f;
  };
  if (const auto* line = std::get_if<Line>(&c.shape)) {
    Line l = *line;
    l.start.z = l.end.z = 0;
    return Curve{l};
  }
  if (const auto* polyline = std::get_if<Polyline>(&c.shape)) {
    Polyline p = *polyline;
    for (Point& q : p.points) q.z = 0;
    return Curve{std::move(p)};
  }
  if (const auto* n = std::get_if<NurbsCurve>(&c.shape)) {
    std::vector<Hpoint> poles = n->poles();
    for (Hpoint& p : poles) p.z = 0;
    auto made = NurbsCurve::from_homogeneous(n->degree(), n->knots(), std::move(poles), n->range());
    return made ? std::optional<Curve>(Curve{std::move(*made)}) : std::nullopt;
  }
  if (const auto* circle = std::get_if<Circle>(&c.shape); circle && lies_flat(circle->frame)) {
    Circle k = *circle;
    k.frame = flat(k.frame);
    return Curve{k};
  }
  if (const auto* ellipse = std::get_if<Ellipse>(&c.shape); ellipse && lies_flat(ellipse->frame)) {
    Ellipse k = *ellipse;
    k.frame = flat(k.frame);
    return Curve{k};
  }
  return std::nullopt;
}

}  // namespace

std::optional<FittedPcurve> flattened(const Sheet& sheet, const Curve& curve, Interval range) {
  const auto to_flat = flat_coordinates(sheet.surface());
  if (!to_flat) return std::nullopt;
  const Interval own = trimloop::range(curve);
  const bool whole = own.lo == range.lo && own.hi == range.hi;
  const auto turned = transformed(whole ? curve : with_range(curve, range), *to_flat);
  if (!turned) return std::nullopt;
  auto flat = without_height(*turned);
  if (!flat) return std::nullopt;
  FittedPcurve out{{std::move(*flat)}, {}, 0};
  out.range = trimloop::range(out.pcurve);
  constexpr int samples = 16;
  for (int i = 0; i <= samples; ++i) {
    const double f = double(i) / samples;
    const Point p = evaluate(curve, range.at(f));
    // Measured on the endless plane: what lies beyond a patch is held at its border later, and said there.
    out.gap_mm = std::max(out.gap_mm, std::abs(apply(*to_flat, p).z));
    const Uv uv = evaluate(out.pcurve, out.range.at(f));
    if (!is_finite(uv)) return std::nullopt;
  }
  return out;
}

}  // namespace trimloop::pcurve
