// Elementary, revolved, extruded and ruled surfaces among NURBS surfaces, by what their isocurves are.

#include "kernel/geometry/recognize.h"
#include "kernel/nurbs/construct_surface.h"

namespace trimloop {
namespace {

struct Size {
  double value = 0;
  bool positive = true;
};
Size size_of(const NurbsSurface& s) {
  Box box;
  Size out;
  for (const Hpoint& h : s.poles()) {
    out.positive = out.positive && h.w > 0;
    if (out.positive) box.add(project(h));
  }
  out.value = box.diagonal();
  return out;
}

// More places in each patch than the degree of a squared distance; `f` is asked for a deviation.
template <class F>
double largest_over(const NurbsSurface& s, F f) {
  double worst = 0;
  const std::vector<double> u = breaks_u(s), v = breaks_v(s);
  const int n = 2 * s.degree_u() + 2, m = 2 * s.degree_v() + 2;
  for (std::size_t i = 0; i + 1 < u.size(); ++i)
    for (std::size_t j = 0; j + 1 < v.size(); ++j)
      for (int k = 0; k <= n; ++k)
        for (int l = 0; l <= m; ++l) {
          const Uv at{Interval{u[i], u[i + 1]}.at(k / double(n)), Interval{v[j], v[j + 1]}.at(l / double(m))};
          const double d = f(at);
          worst = std::max(worst, std::isfinite(d) ? d : infinity);
        }
  return worst;
}

using Direction = RecognizedSurface::Direction;

double apply(const Direction& d, double s) { return d.relation ? d.offset + d.factor * d.relation->to_analytic(s) : s; }
double undo(const Direction& d, double t) { return d.relation ? d.relation->to_nurbs((t - d.offset) / d.factor) : t; }

struct Search {
  const NurbsSurface& s;
  double within;

  // Accepts a candidate when points at mapped parameters agree, or (elementary types) when points lie on it.
  std::optional<RecognizedSurface> checked(Surface surface, Direction u, Direction v) const {
    RecognizedSurface out{std::move(surface), false, true, 0, s, std::move(u), std::move(v)};
    out.deviation = largest_over(s, [&](Uv at) {
      return distance(trimloop::evaluate(s, at), evaluate(out.surface, {apply(out.u, at.u), apply(out.v, at.v)}));
    });
    if (out.deviation <= within) return out;
    return std::nullopt;
  }
  // Elementary types: points alone, parameters by the nearest point.
  std::optional<RecognizedSurface> on(Surface surface) const {
    RecognizedSurface out{std::move(surface), false, false, 0, s, {}, {}};
    out.deviation = largest_over(s, [&](Uv at) {
      const Point p = trimloop::evaluate(s, at);
      return closest_point(out.surface, p).distance;
    });
    if (out.deviation <= within) return out;
    return std::nullopt;
  }
};

// Where a point is about an axis.
struct Polar {
  double radius, height;
};
Polar polar(const Frame& f, Point p) {
  const Vector arm = p - f.origin;
  const double h = dot(arm, f.z);
  return {norm(arm - h * f.z), h};
}

std::optional<RecognizedSurface> plane(const Search& look) {
  const NurbsSurface& s = look.s;
  const Interval u = s.range_u(), v = s.range_v();
  const auto at = [&](double a, double b) { return evaluate(s, {u.at(a), v.at(b)}); };
  const Point o = at(0, 0);
  Vector x = at(1, 0) - o, y = at(0, 1) - o;
  if (!(norm(cross(x, y)) > 1e-6 * norm(x) * norm(y))) x = at(1, 0.5) - at(0, 0.5), y = at(0.5, 1) - at(0.5, 0);
  if (!(norm(cross(x, y)) > 1e-9 * norm(x) * norm(y))) return std::nullopt;
  Frame f;
  f.origin = o, f.z = normalized(cross(x, y)), f.x = normalized(x), f.y = cross(f.z, f.x);
  for (const Hpoint& h : s.poles())
    if (std::abs(dot(project(h) - o, f.z)) > look.within) return std::nullopt;
  // A parallelogram that is a rectangle has separate coordinates.
  const auto cu = recognize(isocurve_v(s, v.lo), 1e-11), cv = recognize(isocurve_u(s, u.lo), 1e-11);
  if (cu && cv && std::holds_alternative<Line>(cu->curve.shape) && std::holds_alternative<Line>(cv->curve.shape)) {
    if (auto out = look.checked(Surface{Plane{f}}, {cu->relation, 0, norm(x)}, {cv->relation, 0, dot(y, f.y)}))
      return out;
  }
  return look.on(Surface{Plane{f}});
}

// u runs round an axis along circles, v along a generatrix that is a line or a circle in a plane with the axis.
std::optional<RecognizedSurface> elementary(const Search& look) {
  const NurbsSurface& s = look.s;
  const Interval u = s.range_u(), v = s.range_v();
  const NurbsCurve generatrix = isocurve_u(s, u.lo);
  // The widest of three parallels gives the axis best.
  std::optional<RecognizedCurve> ring;
  double widest = 0;
  for (const double share : {0.5, 0.25, 0.75}) {
    auto next = recognize(isocurve_v(s, v.at(share)), 1e-11);
    const auto* circle = next ? std::get_if<Circle>(&next->curve.shape) : nullptr;
    if (circle && circle->radius > widest) widest = circle->radius, ring = std::move(next);
  }
  if (!ring) return std::nullopt;
  const Circle round = std::get<Circle>(ring->curve.shape);
  Frame f = round.frame;  // x through the start of the parallel, where the generatrix is
  const auto profile = recognize(generatrix, 1e-11);
  if (!profile) return std::nullopt;
  const Direction about{ring->relation, 0, 1};
  if (const auto* line = std::get_if<Line>(&profile->curve.shape)) {
    const Polar a = polar(f, line->start), b = polar(f, line->end);
    const double rise = b.height - a.height;
    if (!(std::abs(rise) > 1e-9 * look.within)) return std::nullopt;
    const Direction along{profile->relation, a.height, rise};
    if (std::abs(b.radius - a.radius) <= look.within)
      if (auto out = look.checked(Surface{Cylinder{f, round.radius}}, about, along)) return out;
    const double slope = (b.radius - a.radius) / rise;
    Cone cone{f, a.radius - slope * a.height, std::atan(slope)};
    return look.checked(Surface{cone}, about, along);
  }
  const auto* arc = std::get_if<Circle>(&profile->curve.shape);
  if (!arc) return std::nullopt;
  const Polar centre = polar(f, arc->frame.origin);
  f.origin = f.origin + centre.height * f.z;  // into the equator
  // Latitude at the arc's own angle: along the radial x and the axis z; its angle may run down.
  const bool upwards = dot(cross(f.x, f.z), arc->frame.z) > 0;
  const Vector zero = arc->frame.x;
  const double start = std::atan2(dot(zero, f.z), dot(zero, f.x));
  for (const double turn : {0.0, two_pi, -two_pi}) {
    const Direction latitude{profile->relation, start + turn, upwards ? 1.0 : -1.0};
    const double lo = start + turn, hi = lo + latitude.factor * arc->range.hi;
    const Interval reach{std::min(lo, hi), std::max(lo, hi)};
    if (centre.radius <= look.within) {
      if (reach.lo < -0.5 * pi - 1e-9 || reach.hi > 0.5 * pi + 1e-9) continue;
      if (auto out = look.checked(Surface{Sphere{f, arc->radius}}, about, latitude)) return out;
    } else if (turn == 0) {
      if (auto out = look.checked(Surface{Torus{f, centre.radius, arc->radius}}, about, latitude)) return out;
    }
  }
  return std::nullopt;
}

std::optional<RecognizedSurface> revolution(const Search& look) {
  const NurbsSurface& s = look.s;
  const Interval v = s.range_v();
  std::optional<RecognizedCurve> ring;
  double widest = 0;
  for (const double share : {0.5, 0.0, 1.0, 0.25, 0.75}) {
    auto next = recognize(isocurve_v(s, v.at(share)), 1e-11);
    const auto* circle = next ? std::get_if<Circle>(&next->curve.shape) : nullptr;
    if (circle && circle->radius > widest) widest = circle->radius, ring = std::move(next);
  }
  if (!ring) return std::nullopt;
  const Circle& round = std::get<Circle>(ring->curve.shape);
  const NurbsCurve generatrix = isocurve_u(s, s.range_u().lo);
  Revolution r{
      round.frame.origin, round.frame.z, std::make_shared<const Curve>(Curve{generatrix}), {0, round.range.hi}};
  return look.checked(Surface{r}, {ring->relation, 0, 1}, {});
}

std::optional<RecognizedSurface> extrusion(const Search& look) {
  const NurbsSurface& s = look.s;
  const Interval u = s.range_u(), v = s.range_v();
  const auto ruling = recognize(isocurve_u(s, u.mid()), 1e-11);
  if (!ruling || !std::holds_alternative<Line>(ruling->curve.shape)) return std::nullopt;
  const Line& line = std::get<Line>(ruling->curve.shape);
  const NurbsCurve directrix = isocurve_v(s, v.lo);
  Extrusion e{std::make_shared<const Curve>(Curve{directrix}), line.end - line.start, {0, 1}};
  return look.checked(Surface{e}, {}, {ruling->relation, 0, 1});
}

std::optional<RecognizedSurface> ruled_of(const Search& look) {
  const NurbsSurface& s = look.s;
  const Interval u = s.range_u(), v = s.range_v();
  const auto ruling = recognize(isocurve_u(s, u.mid()), 1e-11);
  if (!ruling || !std::holds_alternative<Line>(ruling->curve.shape)) return std::nullopt;
  const auto side = [&](double at) { return std::make_shared<const Curve>(Curve{isocurve_v(s, at)}); };
  // The analytic u runs over [0, 1]: a relation to a unit line says so.
  const NurbsCurve unit =
      NurbsCurve::from_homogeneous(1, {u.lo, u.lo, u.hi, u.hi}, {{0, 0, 0, 1}, {1, 0, 0, 1}}).value();
  const CurveRelation affine(unit, Curve{Line{{0, 0, 0}, {1, 0, 0}, {0, 1}}});
  return look.checked(Surface{make_ruled(side(v.lo), side(v.hi))}, {affine, 0, 1}, {ruling->relation, 0, 1});
}

}  // namespace

std::optional<RecognizedSurface> recognize(const NurbsSurface& given, double relative) {
  if (!(given.range_u().lo < given.range_u().hi) || !(given.range_v().lo < given.range_v().hi)) return std::nullopt;
  const NurbsSurface s = trimmed(given, given.range_u(), given.range_v()), turned = swapped(s);
  const Size size = size_of(s);
  if (!size.positive || !(size.value > 0)) return std::nullopt;
  const Search straight{s, relative * size.value}, crosswise{turned, relative * size.value};
  if (auto out = plane(straight)) return out;
  using Find = std::optional<RecognizedSurface> (*)(const Search&);
  for (const Find find : {Find{elementary}, Find{extrusion}, Find{revolution}, Find{ruled_of}})
    for (const bool swap : {false, true})
      if (auto out = find(swap ? crosswise : straight)) {
        out->swapped = swap;
        return out;
      }
  return std::nullopt;
}

Uv map_to_analytic(const RecognizedSurface& r, Uv at) {
  if (r.swapped) at = {at.v, at.u};
  if (r.separable) return {apply(r.u, at.u), apply(r.v, at.v)};
  return closest_point(r.surface, evaluate(r.nurbs, at)).uv;
}

Uv map_to_nurbs(const RecognizedSurface& r, Uv at) {
  const Uv own =
      r.separable ? Uv{undo(r.u, at.u), undo(r.v, at.v)} : closest_point(Surface{r.nurbs}, evaluate(r.surface, at)).uv;
  return r.swapped ? Uv{own.v, own.u} : own;
}

}  // namespace trimloop
