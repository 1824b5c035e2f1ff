#include "formats/iges/records/surfaces.h"

#include "formats/iges/rules.h"
#include "io/iges/curves.h"
#include "io/iges/placement.h"
#include "io/iges/surfaces.h"
#include "io/rules.h"
#include "kernel/nurbs/power.h"

namespace trimloop::io::iges_import {
namespace {

namespace igr = iges::rules;
constexpr double degree = pi / 180;

std::optional<PlacedSurface> refused(Context& context, const DirectoryEntry& entry, const Rule& rule,
                                     const Error& error) {
  context.add(entry, rule, error.text, error.measured, error.limit);
  return std::nullopt;
}

PlacedSurface placed(Surface surface, const UvMap& map = {}) {
  return {std::make_shared<const Surface>(std::move(surface)), map, {}, true};
}

UvMap scaled(double u, double v) {
  UvMap map;
  map.uu = u;
  map.vv = v;
  return map;
}

Point scaled_point(const Context& context, const iges::Xyz& p) {
  return {p.x * context.unit.scale, p.y * context.unit.scale, p.z * context.unit.scale};
}

// ---- 114, 128: the poles go through the matrix on the way in.

std::optional<PlacedSurface> power_surface(Context& context, const DirectoryEntry& entry) {
  auto r = context.decode<iges::ParametricSplineSurface>(entry);
  if (!r) return std::nullopt;
  for (auto& patch : r->coefficients)
    for (double& c : patch) c *= context.unit.scale;
  const std::size_t stride = r->breaks_v.size();  // the placeholder column is skipped, so is the placeholder row
  auto surface = from_power(r->breaks_u, r->breaks_v, r->coefficients, stride);
  if (!surface) return refused(context, entry, rules::erroneous_surface, surface.error());
  if (surface->largest_gap > context.resolution_mm)
    context.add(entry, igr::e114::patch_gap, "patches do not meet; each border is moved to the next patch",
                surface->largest_gap, context.resolution_mm);
  return placed({std::move(surface->surface)});
}

std::optional<PlacedSurface> spline_surface(Context& context, const DirectoryEntry& entry, const Transform& t) {
  auto r = context.decode<iges::RationalBSplineSurface>(entry);
  if (!r) return std::nullopt;
  const bool still = is_identity(t);
  const auto nu = static_cast<std::size_t>(r->upper_u) + 1, nv = static_cast<std::size_t>(r->upper_v) + 1;
  if (r->points.size() != nu * nv || r->knots_u.size() < nu + 1 || r->knots_v.size() < nv + 1) return std::nullopt;
  std::vector<Hpoint> poles(nu * nv);
  for (std::size_t j = 0; j < nv; ++j) {  // the file's first index runs fastest, the kernel's last
    for (std::size_t i = 0; i < nu; ++i) {
      const std::size_t at = j * nu + i;
      Point p = scaled_point(context, r->points[at]);
      if (!still) p = apply(t, p);
      const double w = at < r->weights.size() ? r->weights[at] : 1;
      poles[i * nv + j] = {w * p.x, w * p.y, w * p.z, w};
    }
  }
  const auto part = [](const std::vector<double>& knots, int d, std::size_t n, double lo, double hi) {
    const Interval domain{knots[static_cast<std::size_t>(d)], knots[n]};
    const Interval asked{domain.clamp(lo), domain.clamp(hi)};
    return asked.lo < asked.hi ? asked : domain;
  };
  const Interval u = part(r->knots_u, r->degree_u, nu, r->u0, r->u1), v = part(r->knots_v, r->degree_v, nv, r->v0, r->v1);
  auto surface = NurbsSurface::from_homogeneous(r->degree_u, r->degree_v, std::move(r->knots_u), std::move(r->knots_v),
                                                std::move(poles), u, v);
  if (!surface) return refused(context, entry, rules::erroneous_surface, surface.error());
  return placed({std::move(*surface)});
}

// ---- Surfaces over curves: 118, 120, 122.

// The model curve at `ref`, bounded; null after a finding.
CurvePtr bounded_curve(Context& context, const DirectoryEntry& entry, Ref ref, std::string_view role) {
  const DirectoryEntry* target = context.resolve(ref, is_curve, "a curve");
  CurvePtr curve = target ? model_curve(context, *target) : nullptr;
  if (curve && !is_bounded(*curve)) {
    context.add(entry, igr::target_type, "the " + std::string(role) + " " + name_of(*target) + " is not bounded");
    curve = nullptr;
  }
  return curve;
}

std::optional<PlacedSurface> ruled(Context& context, const DirectoryEntry& entry) {
  const auto* r = context.record<iges::RuledSurface>(entry);
  if (!r) return std::nullopt;
  CurvePtr first = bounded_curve(context, entry, r->first, "first rail");
  CurvePtr second = bounded_curve(context, entry, r->second, "second rail");
  if (!first || !second) return std::nullopt;
  return placed({Ruled{std::move(first), std::move(second), r->reverse_second, entry.form == 0}});
}

// Start and end angle of a revolution, made a sweep of at most one turn (IG-E120-02, IG-E120-03 say what was wrong).
Interval sweep(double start, double end) {
  constexpr double rounding = 1e-6;  // of a turn printed with seven digits
  if (end - start > two_pi + rounding && end - start <= 360 * (1 + rounding)) start *= degree, end *= degree;
  if (end <= start) end += two_pi * std::ceil((start - end) / two_pi);
  if (end <= start || end - start > two_pi - rounding) end = start + two_pi;
  return {start, end};
}

std::optional<PlacedSurface> revolution(Context& context, const DirectoryEntry& entry) {
  const auto* r = context.record<iges::SurfaceOfRevolution>(entry);
  if (!r) return std::nullopt;
  const DirectoryEntry* axis_entry =
      context.resolve(r->axis, [](const DirectoryEntry& e) { return e.type == 110; }, "a line (110)");
  CurvePtr axis = axis_entry ? model_curve(context, *axis_entry) : nullptr;
  CurvePtr generatrix = bounded_curve(context, entry, r->generatrix, "generatrix");
  if (!axis || !generatrix) return std::nullopt;
  const auto* line = std::get_if<Line>(&axis->shape);
  const Vector direction = line ? normalized(line->end - line->start) : Vector{};
  if (norm(direction) == 0) {
    context.add(entry, igr::e120::axis, "the axis " + name_of(*axis_entry) + " has no direction", 0.0);
    return std::nullopt;
  }
  if (!std::isfinite(r->start_angle) || !std::isfinite(r->end_angle)) return std::nullopt;
  UvMap swapped;
  swapped.uu = swapped.vv = 0;
  swapped.uv = swapped.vu = 1;
  const Interval turn = sweep(r->start_angle, r->end_angle);
  if (turn.length() < 0.5 * (r->end_angle - r->start_angle)) swapped.uv = degree;  // the file speaks in degrees
  return placed({Revolution{line->start, direction, std::move(generatrix), turn}}, swapped);
}

std::optional<PlacedSurface> extrusion(Context& context, const DirectoryEntry& entry) {
  const auto* r = context.record<iges::TabulatedCylinder>(entry);
  if (!r) return std::nullopt;
  CurvePtr directrix = bounded_curve(context, entry, r->directrix, "directrix");
  if (!directrix) return std::nullopt;
  // The record gives where the generatrix that starts at the directrix' start ends: a point, not a vector.
  const Vector direction = scaled_point(context, r->terminate_point) - start_point(*directrix);
  if (!(norm(direction) > 0) || !is_finite(direction)) {
    context.add(entry, igr::e122::vector, "the generatrix has no length; there is no surface", norm(direction));
    return std::nullopt;
  }
  const Interval t = range(*directrix);
  UvMap map = scaled(t.length(), 1);
  map.u0 = t.lo;
  return placed({Extrusion{std::move(directrix), direction, {0, 1}}}, map);
}

// ---- Planes and elementary surfaces: 108, 190-198.

std::optional<PlacedSurface> plane(Context& context, const DirectoryEntry& entry) {
  const auto* r = context.record<iges::PlaneRecord>(entry);
  if (!r) return std::nullopt;
  const Vector n{r->a, r->b, r->c};
  const double length = norm(n);
  if (!(length > 0) || !std::isfinite(length) || !std::isfinite(r->d)) return std::nullopt;
  const double to_plane = r->d / length * context.unit.scale;
  PlacedSurface out = placed({Plane{make_frame(to_point(to_plane * normalized(n)), n)}});
  out.has_parameters = false;
  return out;
}

// Frame of a 190-198 record; nothing after a finding. Form 0 has no reference direction: any frame does.
std::optional<Frame> frame(Context& context, const DirectoryEntry& entry, Ref location, Ref axis, Ref reference) {
  const DirectoryEntry* at = context.resolve(location, is_point, "a point (116)");
  if (!at) return std::nullopt;
  const std::vector<Point> points = model_points(context, *at);
  if (points.empty()) return std::nullopt;
  const auto direction = [&](Ref ref) -> Vector {
    const DirectoryEntry* e = context.resolve(ref, is_direction, "a direction (123)");
    const auto* record = e ? context.record<iges::Direction>(*e) : nullptr;
    if (!record) return {};
    return normalized(apply(model_placement(context, *e), Vector{record->vector.x, record->vector.y, record->vector.z}));
  };
  const Vector z = axis ? direction(axis) : Vector{0, 0, 1};
  if (norm(z) == 0) {
    context.add(entry, igr::e190::axes, "the surface's axis has no direction");
    return std::nullopt;
  }
  const Vector x = reference ? direction(reference) : Vector{};
  if (reference && !(norm(cross(x, z)) > 1e-6))
    context.add(entry, igr::e190::axes, "the reference direction is along the axis; another one is taken",
                norm(cross(x, z)), 1e-6);
  return make_frame(points.front(), z, x);
}

// IGES 5.3 4.33 ff. gives angles in degrees, files also use radians: degrees first, radians as the second reading.
PlacedSurface angular(Surface surface, const UvMap& in_degrees, const UvMap& in_radians) {
  PlacedSurface out = placed(std::move(surface), in_degrees);
  out.second_map = in_radians;
  return out;
}

std::optional<PlacedSurface> elementary(Context& context, const DirectoryEntry& entry) {
  const double mm = context.unit.scale;
  switch (entry.type) {
    case 190: {
      const auto* r = context.record<iges::PlaneSurface>(entry);
      const auto f = r ? frame(context, entry, r->location, r->normal, r->reference) : std::nullopt;
      if (!f) return std::nullopt;
      return placed({Plane{*f}}, scaled(mm, mm));
    }
    case 192: {
      const auto* r = context.record<iges::CylindricalSurface>(entry);
      const auto f = r ? frame(context, entry, r->location, r->axis, r->reference) : std::nullopt;
      if (!f) return std::nullopt;
      return angular({Cylinder{*f, r->radius * mm}}, scaled(degree, mm), scaled(1, mm));
    }
    case 194: {
      const auto* r = context.record<iges::ConicalSurface>(entry);
      const auto f = r ? frame(context, entry, r->location, r->axis, r->reference) : std::nullopt;
      if (!f) return std::nullopt;
      return angular({Cone{*f, r->radius * mm, r->half_angle_deg * degree}}, scaled(degree, mm), scaled(1, mm));
    }
    case 196: {
      const auto* r = context.record<iges::SphericalSurface>(entry);
      const auto f = r ? frame(context, entry, r->centre, r->axis, r->reference) : std::nullopt;
      if (!f) return std::nullopt;
      return angular({Sphere{*f, r->radius * mm}}, scaled(degree, degree), {});
    }
    default: {
      const auto* r = context.record<iges::ToroidalSurface>(entry);
      const auto f = r ? frame(context, entry, r->centre, r->axis, r->reference) : std::nullopt;
      if (!f) return std::nullopt;
      return angular({Torus{*f, r->major_radius * mm, r->minor_radius * mm}}, scaled(degree, degree), {});
    }
  }
}

// ---- 140

std::optional<PlacedSurface> offset(Context& context, const DirectoryEntry& entry) {
  const auto* r = context.record<iges::OffsetSurface>(entry);
  if (!r) return std::nullopt;
  const DirectoryEntry* target = context.resolve(r->basis, is_surface, "a surface");
  const PlacedSurface* basis = target ? model_surface(context, *target) : nullptr;
  if (!basis) return std::nullopt;
  const SurfaceDomain d = domain(*basis->surface);
  const Uv middle{d.u.is_bounded() ? d.u.mid() : 0, d.v.is_bounded() ? d.v.mid() : 0};
  const Vector indicator = normalized({r->indicator.x, r->indicator.y, r->indicator.z});
  const double side = dot(indicator, normal(*basis->surface, middle));
  constexpr double along = 0.999;  // cosine of about 2.5 degrees: clearly meant as the normal
  if (!(std::abs(side) > along))
    context.add(entry, igr::e140::indicator, Severity::Warning,
                side == 0 ? "the indicator names no side; the side of the normal is taken"
                          : "the indicator is not along the normal; the nearer side is taken",
                side, 1.0);
  // Without an indicator the file's own normal counts, which is against ours where the map turns it.
  const bool against = std::abs(side) > 0 ? side < 0 : basis->flipped();
  const double distance = r->distance * context.unit.scale * (against ? -1 : 1);
  if (!std::isfinite(distance * distance)) {
    context.add(entry, rules::non_finite, "the offset distance overflows", distance);
    return std::nullopt;
  }
  PlacedSurface out = *basis;
  out.surface = std::make_shared<const Surface>(Surface{OffsetSurface{basis->surface, distance}});
  return out;
}

std::optional<PlacedSurface> build(Context& context, const DirectoryEntry& entry) {
  Visit visit(context, entry);
  if (!visit) return std::nullopt;
  const Transform t = model_placement(context, entry);
  std::optional<PlacedSurface> surface;
  switch (entry.type) {
    case 108: surface = plane(context, entry); break;
    case 114: surface = power_surface(context, entry); break;
    case 118: surface = ruled(context, entry); break;
    case 120: surface = revolution(context, entry); break;
    case 122: surface = extrusion(context, entry); break;
    case 128: return spline_surface(context, entry, t);
    case 140: surface = offset(context, entry); break;
    default: surface = elementary(context, entry); break;
  }
  return surface ? moved(context, *surface, t) : std::nullopt;
}

UvMap then(const UvMap& first, const UvMap& second) {
  UvMap out;
  out.uu = second.uu * first.uu + second.uv * first.vu;
  out.uv = second.uu * first.uv + second.uv * first.vv;
  out.vu = second.vu * first.uu + second.vv * first.vu;
  out.vv = second.vu * first.uv + second.vv * first.vv;
  out.u0 = second.uu * first.u0 + second.uv * first.v0 + second.u0;
  out.v0 = second.vu * first.u0 + second.vv * first.v0 + second.v0;
  return out;
}

}  // namespace

const PlacedSurface* model_surface(Context& context, const DirectoryEntry& entry) {
  Context::State& state = context.state(entry);
  if (state.surface_known) return state.surface.get();
  auto surface = build(context, entry);
  if (state.busy) return nullptr;  // a cycle: the outer reading will know
  state.surface_known = true;
  if (surface) state.surface = std::make_unique<PlacedSurface>(std::move(*surface));
  return state.surface.get();
}

std::optional<PlacedSurface> moved(Context& context, const PlacedSurface& surface, const Transform& t) {
  if (is_identity(t)) return surface;
  auto shape = transformed(*surface.surface, t);
  if (!shape) {
    context.add(rules::non_finite, shape.error().text, shape.error().measured, shape.error().limit);
    return std::nullopt;
  }
  const UvMap change = parameter_map(*surface.surface, t);
  PlacedSurface out = placed(std::move(*shape), then(surface.map, change));
  if (surface.second_map) out.second_map = then(*surface.second_map, change);
  out.has_parameters = surface.has_parameters;
  return out;
}

Result<Curve2> mapped(const UvMap& map, Curve curve) {
  Transform t;
  t.r = {{{map.uu, map.uv, 0}, {map.vu, map.vv, 0}, {0, 0, 1}}};
  t.t = {map.u0, map.v0, 0};
  if (is_identity(t)) return Curve2{std::move(curve)};
  auto moved_curve = transformed(curve, t);
  if (!moved_curve) return tl::unexpected<Error>(moved_curve.error());
  return Curve2{std::move(*moved_curve)};
}

}  // namespace trimloop::io::iges_import
