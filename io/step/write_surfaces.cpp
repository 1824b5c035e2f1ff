// Surfaces -> PLANE, CYLINDRICAL_SURFACE, CONICAL_SURFACE, SPHERICAL_SURFACE, TOROIDAL_SURFACE, SURFACE_OF_REVOLUTION,
// SURFACE_OF_LINEAR_EXTRUSION, OFFSET_SURFACE, B_SPLINE_SURFACE_WITH_KNOTS (ISO 10303-42 4.5), with the shift from our
// parameters to the record's.

#include <fmt/format.h>

#include <cmath>

#include "io/step/entity_writer.h"
#include "io/step/splines.h"
#include "kernel/geometry/approximate.h"
#include "kernel/geometry/elementary.h"

namespace trimloop::io::step_export {

using step::Enumeration;
using step::partial;

namespace {

constexpr Enumeration unspecified{"UNSPECIFIED"}, unknown{"U"};

// A strict part is cut out exactly: a receiver has no other way to know that the rest is not meant.
NurbsSurface over_its_range(const NurbsSurface& s) {
  const auto same = [](Interval a, Interval b) { return a.lo == b.lo && a.hi == b.hi; };
  const bool clamped = is_clamped(s.degree_u(), s.knots_u()) && is_clamped(s.degree_v(), s.knots_v());
  if (clamped && same(s.range_u(), s.domain_u()) && same(s.range_v(), s.domain_v())) return s;
  return trimmed(s, s.range_u(), s.range_v());
}

InstanceId write_nurbs(EntityWriter& w, const NurbsSurface& whole) {
  const NurbsSurface s = over_its_range(whole);
  const SurfaceDomain d = domain(Surface{s}, w.model.resolution_mm);
  const ShortKnots u = short_knots(s.knots_u()), v = short_knots(s.knots_v());
  std::vector<std::vector<InstanceId>> poles(s.poles_u());
  std::vector<std::vector<double>> weights(s.poles_u());
  for (std::size_t i = 0; i < s.poles_u(); ++i) {
    for (std::size_t j = 0; j < s.poles_v(); ++j) {
      poles[i].push_back(w.point(cartesian(s.pole(i, j))));
      weights[i].push_back(s.pole(i, j).w);
    }
  }
  const Enumeration closed_u{d.closed_u ? "T" : "F"}, closed_v{d.closed_v ? "T" : "F"};
  if (!s.is_rational()) {
    return w.out.add("B_SPLINE_SURFACE_WITH_KNOTS", "", s.degree_u(), s.degree_v(), poles, unspecified, closed_u,
                     closed_v, unknown, u.multiplicities, v.multiplicities, u.values, v.values, unspecified);
  }
  return w.out.add_complex(
      {partial("BOUNDED_SURFACE"),
       partial("B_SPLINE_SURFACE", s.degree_u(), s.degree_v(), poles, unspecified, closed_u, closed_v, unknown),
       partial("B_SPLINE_SURFACE_WITH_KNOTS", u.multiplicities, v.multiplicities, u.values, v.values, unspecified),
       partial("GEOMETRIC_REPRESENTATION_ITEM"), partial("RATIONAL_B_SPLINE_SURFACE", weights),
       partial("REPRESENTATION_ITEM", ""), partial("SURFACE")});
}

// First `before`, then `map`.
UvMap after(const UvMap& map, const UvMap& before) {
  UvMap out;
  out.uu = map.uu * before.uu + map.uv * before.vu;
  out.uv = map.uu * before.uv + map.uv * before.vv;
  out.vu = map.vu * before.uu + map.vv * before.vu;
  out.vv = map.vu * before.uv + map.vv * before.vv;
  const Uv origin = apply(map, {before.u0, before.v0});
  out.u0 = origin.u;
  out.v0 = origin.v;
  return out;
}

struct SurfaceWriter {
  EntityWriter& w;
  const Surface& whole;
  Interval u, v;

  double length(double mm) const { return w.units.length(mm); }
  // Parameters that are lengths count in file units.
  UvMap with_lengths(bool in_u, bool in_v) const {
    UvMap map;
    if (in_u) map.uu = 1 / w.units.factor();
    if (in_v) map.vv = 1 / w.units.factor();
    return map;
  }

  Result<WrittenSurface> exact_nurbs() const {
    const auto nurbs = trimloop::to_nurbs(whole, u, v);
    if (!nurbs) return tl::unexpected(nurbs.error());
    WrittenSurface out{write_nurbs(w, nurbs->surface), {}};
    const auto is_affine = [](const ParameterMap& m) {
      return m.pieces.size() == 1 && m.pieces[0].kind == ParameterMap::Kind::Affine;
    };
    out.bent = !is_affine(nurbs->map_u) || !is_affine(nurbs->map_v);
    if (out.bent) return out;
    const auto scale = [](const ParameterMap& m) { return (m.nurbs[1] - m.nurbs[0]) / (m.own[1] - m.own[0]); };
    out.map.uu = scale(nurbs->map_u);
    out.map.u0 = nurbs->map_u.nurbs[0] - out.map.uu * nurbs->map_u.own[0];
    out.map.vv = scale(nurbs->map_v);
    out.map.v0 = nurbs->map_v.nurbs[0] - out.map.vv * nurbs->map_v.own[0];
    return out;
  }
  Result<WrittenSurface> operator()(const NurbsSurface& s) const { return WrittenSurface{write_nurbs(w, s), {}}; }
  Result<WrittenSurface> operator()(const Plane& s) const {
    return WrittenSurface{w.out.add("PLANE", "", w.placement(s.frame)), with_lengths(true, true)};
  }
  Result<WrittenSurface> operator()(const Cylinder& s) const {
    return WrittenSurface{w.out.add("CYLINDRICAL_SURFACE", "", w.placement(s.frame), length(s.radius)), with_lengths(false, true)};
  }
  // Part 42 wants an angle above zero and a radius not below it: a cone that narrows along its axis is turned over, and
  // one whose radius is negative is moved along the axis to its apex.
  Result<WrittenSurface> operator()(const Cone& s) const {
    Frame frame = s.frame;
    double angle = s.half_angle_rad, radius = s.radius;
    UvMap map = with_lengths(false, true);
    if (angle < 0) {
      frame.z = -frame.z;
      frame.y = -frame.y;
      angle = -angle;
      map.uu = -1;
      map.vv = -map.vv;
    }
    if (radius < 0) {
      const double to_apex = -radius / std::tan(angle);
      frame.origin = frame.origin + to_apex * frame.z;
      map.v0 = -to_apex / w.units.factor();
      radius = 0;
    }
    return WrittenSurface{w.out.add("CONICAL_SURFACE", "", w.placement(frame), length(radius), angle), map};
  }
  Result<WrittenSurface> operator()(const Sphere& s) const {
    return WrittenSurface{w.out.add("SPHERICAL_SURFACE", "", w.placement(s.frame), length(s.radius)), {}};
  }
  Result<WrittenSurface> operator()(const Torus& s) const {
    const InstanceId at = w.placement(s.frame);
    const double major = length(s.major_radius), minor = length(s.minor_radius);
    if (s.minor_radius > s.major_radius) {
      return WrittenSurface{w.out.add("DEGENERATE_TOROIDAL_SURFACE", "", at, major, minor, true), {}};
    }
    return WrittenSurface{w.out.add("TOROIDAL_SURFACE", "", at, major, minor), {}};
  }
  Result<WrittenSurface> operator()(const Revolution& s) const {
    if (const auto known = elementary()) return *known;
    if (const auto sheet = spindle_sheet(s)) return *sheet;
    const auto profile = write_profile(w, *s.generatrix);
    if (!profile) return tl::unexpected(profile.error());
    UvMap map;
    map.vv = profile->shift.scale;
    map.v0 = profile->shift.offset;
    return WrittenSurface{w.out.add("SURFACE_OF_REVOLUTION", "", profile->id, w.axis(s.axis_origin, s.axis)), map};
  }
  // An arc that is turned about the axis on which both its ends lie, further than its centre is from it.
  std::optional<WrittenSurface> spindle_sheet(const Revolution& s) const {
    const auto* c = std::get_if<Circle>(&s.generatrix->shape);
    if (!c || s.range_u.lo != 0) return std::nullopt;
    const Vector from = c->frame.origin - s.axis_origin, across = from - dot(from, s.axis) * s.axis;
    const double major = norm(across), same = 1e-9;
    if (!(major > 0) || !(c->radius > major) || distance(Point{} + c->frame.x, Point{} + across / major) > same ||
        distance(Point{} + c->frame.y, Point{} + s.axis) > same)
      return std::nullopt;
    const double at_axis = std::acos(-major / c->radius);
    const bool outer = std::abs(c->range.lo + at_axis) + std::abs(c->range.hi - at_axis) < same;
    const bool inner = std::abs(c->range.lo - at_axis) + std::abs(c->range.hi - two_pi + at_axis) < same;
    if (!outer && !inner) return std::nullopt;
    const Frame frame = make_frame(c->frame.origin - across, s.axis, c->frame.x);
    return WrittenSurface{w.out.add("DEGENERATE_TOROIDAL_SURFACE", "", w.placement(frame), length(major), length(c->radius), outer), {}};
  }
  // The vector has length 1 in file units, so that readers with and without its magnitude agree.
  Result<WrittenSurface> operator()(const Extrusion& s) const {
    if (const auto known = elementary()) return *known;
    const auto profile = write_profile(w, *s.directrix);
    if (!profile) return tl::unexpected(profile.error());
    const double size = norm(s.direction);
    if (!(size > 0)) return fail(ErrorCode::Degenerate, "an extrusion without direction");
    UvMap map;
    map.uu = profile->shift.scale;
    map.u0 = profile->shift.offset;
    map.vv = size / w.units.factor();
    return WrittenSurface{w.out.add("SURFACE_OF_LINEAR_EXTRUSION", "", profile->id, w.vector(normalized(s.direction), 1)),
                          map};
  }
  std::optional<WrittenSurface> elementary() const {
    const auto found = as_elementary(whole, v);
    if (!found) return std::nullopt;
    auto written = std::visit(SurfaceWriter{w, found->surface, u, v}, found->surface.shape);
    if (!written) return std::nullopt;
    written->map = after(written->map, found->map);
    // Angles alone: a seam given as two edges is told apart by them only.
    written->elementary =
        !std::holds_alternative<Sphere>(found->surface.shape) && !std::holds_alternative<Torus>(found->surface.shape);
    return *written;
  }
  Result<WrittenSurface> operator()(const Ruled& s) const {
    if (auto exact = exact_nurbs()) return exact;
    const auto near = approximate(s, 0.01 * w.model.resolution_mm);
    if (!near) return tl::unexpected(near.error());
    w.lose({}, fmt::format("a ruled surface between curves that no spline matches: within {:.3g} mm of one", near->deviation));
    return WrittenSurface{write_nurbs(w, near->surface), {}};
  }
  Result<WrittenSurface> operator()(const OffsetSurface& s) const {
    const auto basis = std::visit(SurfaceWriter{w, *s.basis, u, v}, s.basis->shape);
    if (!basis) return basis;
    WrittenSurface out = *basis;  // the distance counts along the normal of what was written
    const double distance = basis->turned() ? -s.distance : s.distance;
    out.id = w.out.add("OFFSET_SURFACE", "", basis->id, length(distance), unknown);
    return out;
  }
};

}  // namespace

Result<WrittenSurface> write_surface(EntityWriter& w, const Surface& surface, Interval u, Interval v) {
  const SurfaceWriter writer{w, surface, u, v};
  if (w.to_nurbs) {
    if (auto nurbs = writer.exact_nurbs()) {
      ++w.statement.exact_surfaces;
      return nurbs;
    }
  }
  return std::visit(writer, surface.shape);
}

}  // namespace trimloop::io::step_export
