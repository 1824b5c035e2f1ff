// Points, directions and placements.

#include <fmt/format.h>

#include <limits>

#include "formats/step/records/geometry.h"
#include "formats/step/rules.h"
#include "io/step/geometry.h"

namespace trimloop::io::step_import {

namespace sr = step::rules;

std::optional<Point> Geometry::point(const Record& owner, Ref ref) {
  const Record* instance = context_.resolve(owner, ref, Entity::Point);
  return instance ? point(*instance) : std::nullopt;
}

std::optional<Point> Geometry::point(const Record& instance) {
  if (context_.is(instance, Entity::CartesianPoint)) {
    const auto r = context_.read<step::CartesianPoint>(instance);
    if (!r) return std::nullopt;
    const double s = mm();
    const Point p{r->at.xyz[0] * s, r->at.xyz[1] * s, flat_ ? 0 : r->at.xyz[2] * s};
    if (is_finite(p)) return p;
    context_.add(instance, sr::real_overflow, "the coordinates overflow");
    return std::nullopt;
  }
  if (context_.is(instance, Entity::PointOnCurve)) {
    Visit visit(context_, instance);
    step::Tape tape;
    step::Reader r(context_.file, instance, context_.execution.limits, tape, context_.report);
    if (!visit || !r.at(Entity::PointOnCurve)) return std::nullopt;
    const Ref basis = r.ref(0);
    const double t = r.real(1);
    const Record* curve_instance = r.ok() ? context_.resolve(instance, basis, Entity::Curve) : nullptr;
    const CurvePtr c = curve_instance ? curve(*curve_instance) : nullptr;
    if (c) return evaluate(*c, t * parameter_scale(*curve_instance));
    return std::nullopt;
  }
  if (context_.is(instance, Entity::PointOnSurface)) {
    Visit visit(context_, instance);
    step::Tape tape;
    step::Reader r(context_.file, instance, context_.execution.limits, tape, context_.report);
    if (!visit || !r.at(Entity::PointOnSurface)) return std::nullopt;
    const Ref basis = r.ref(0);
    const Uv uv{r.real(1), r.real(2)};
    const auto s = r.ok() ? surface(instance, basis) : std::nullopt;
    if (s) return evaluate(*s->surface, {uv.u * s->scale_u, uv.v * s->scale_v});
    return std::nullopt;
  }
  context_.add(instance, sr::attribute_type, fmt::format("a point of kind {} cannot be used", context_.file.keyword(instance).name));
  return std::nullopt;
}

std::optional<Vector> Geometry::direction(const Record& owner, Ref ref) {
  const Record* instance = context_.resolve(owner, ref, Entity::Direction);
  const auto r = instance ? context_.read<step::Direction>(*instance) : std::nullopt;
  if (!r) return std::nullopt;
  Vector v{r->ratios.xyz[0], r->ratios.xyz[1], flat_ ? 0 : r->ratios.xyz[2]};
  const double size = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(size > 0) || !std::isfinite(size)) {
    context_.add(*instance, sr::direction_zero, "the direction has no length", size, 0);
    return std::nullopt;
  }
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  if (std::abs(dot(v, v) - 1) <= rounding) return v;  // as written, so that nothing drifts from file to file
  return normalized(v / size);  // scaled first: components may be as small as doubles get
}

std::optional<Frame> Geometry::frame(const Record& owner, Ref ref) {
  const Record* instance = context_.resolve(owner, ref, Entity::Placement);
  const auto r = instance ? context_.read<step::Placement>(*instance) : std::nullopt;
  if (!r) return std::nullopt;
  const auto origin = point(*instance, r->location);
  if (!origin) return std::nullopt;
  if (flat_ || context_.is(*instance, Entity::Axis2Placement2d)) {
    const auto x = r->reference ? direction(*instance, r->reference) : std::optional(Vector{1, 0, 0});
    return make_frame(*origin, {0, 0, 1}, x.value_or(Vector{1, 0, 0}));
  }
  const auto z = r->axis ? direction(*instance, r->axis) : std::nullopt;
  const auto x = r->reference ? direction(*instance, r->reference) : std::nullopt;
  const Vector axis = z.value_or(Vector{0, 0, 1});
  // The default reference of ISO 10303-42 4.4.9: x, or y when the axis is x.
  const bool along_x = std::abs(axis.y) < 1e-12 && std::abs(axis.z) < 1e-12;
  Vector reference = x.value_or(along_x ? Vector{0, 1, 0} : Vector{1, 0, 0});
  if (x && norm(cross(axis, reference)) < 1e-6)
    context_.add(*instance, sr::axis_parallel, "axis and reference direction are parallel; another reference is taken",
                 norm(cross(axis, reference)), 1e-6);
  return make_frame(*origin, axis, reference);
}

std::optional<Frame> Geometry::axis(const Record& owner, Ref ref) {
  const Record* instance = context_.resolve(owner, ref, Entity::Placement);
  const auto r = instance ? context_.read<step::Placement>(*instance) : std::nullopt;
  if (!r) return std::nullopt;
  const auto origin = point(*instance, r->location);
  if (!origin) return std::nullopt;
  const auto z = r->axis ? direction(*instance, r->axis) : std::nullopt;
  return make_frame(*origin, z.value_or(Vector{0, 0, 1}));
}

std::optional<Transform> Geometry::transform(const Record& instance) {
  const auto from_frame = [](const Frame& f, double scale) {
    Transform t;
    t.r = {{{f.x.x * scale, f.y.x * scale, f.z.x * scale},
            {f.x.y * scale, f.y.y * scale, f.z.y * scale},
            {f.x.z * scale, f.y.z * scale, f.z.z * scale}}};
    t.t = to_vector(f.origin);
    return t;
  };
  if (context_.is(instance, Entity::Placement)) {
    const auto f = frame(instance, Ref{instance.id});
    return f ? std::optional(from_frame(*f, 1)) : std::nullopt;
  }
  if (!context_.is(instance, Entity::CartesianTransformationOperator)) {
    context_.add(instance, sr::attribute_type, fmt::format("{} is no placement", context_.file.keyword(instance).name));
    return std::nullopt;
  }
  const auto r = context_.read<step::TransformationOperator>(instance);
  if (!r) return std::nullopt;
  const auto origin = point(instance, r->origin);
  if (!origin) return std::nullopt;
  if (!(r->scale > 0) || !std::isfinite(r->scale)) {
    context_.add(instance, sr::transform_quality, "the scale of the operator is not positive; it is not used", r->scale, 0);
    return std::nullopt;
  }
  // ISO 10303-42 base_axis: axis3 leads, axis1 is made orthogonal to it, axis2 decides the hand.
  const auto given = [&](Ref ref) { return ref ? direction(instance, ref) : std::nullopt; };
  const auto a1 = given(r->axis1), a2 = given(r->axis2), a3 = given(r->axis3);
  Frame f = make_frame(*origin, a3.value_or(a1 && a2 ? cross(*a1, *a2) : Vector{0, 0, 1}), a1.value_or(Vector{1, 0, 0}));
  if (!a1 && a2) {
    f = make_frame(*origin, f.z, cross(*a2, f.z));
  }
  if (a2 && dot(*a2, f.y) < 0) f.y = -f.y;  // a mirror
  return from_frame(f, r->scale);
}

}  // namespace trimloop::io::step_import
