// Surfaces: elementary, swept, spline, rectangular trimmed, offset, replicas. ISO 10303-42 4.6.

#include <fmt/format.h>

#include "formats/step/records/geometry.h"
#include "formats/step/rules.h"
#include "io/rules.h"
#include "io/step/geometry.h"
#include "io/step/knots.h"

namespace trimloop::io::step_import {

namespace sr = step::rules;

namespace {

PlacedSurface placed(Surface s, double scale_u = 1, double scale_v = 1) {
  PlacedSurface out;
  out.surface = std::make_shared<const Surface>(std::move(s));
  out.scale_u = scale_u;
  out.scale_v = scale_v;
  return out;
}

}  // namespace

std::optional<PlacedSurface> Geometry::surface(const Record& owner, Ref ref) {
  const Record* instance = context_.resolve(owner, ref, Entity::Surface);
  return instance ? surface(*instance) : std::nullopt;
}

std::optional<PlacedSurface> Geometry::surface(const Record& instance) {
  const std::size_t key = context_.index(instance);
  if (const auto known = surfaces_.find(key); known != surfaces_.end()) return known->second;
  Visit visit(context_, instance);
  if (!visit) return std::nullopt;
  auto made = make_surface(instance);
  surfaces_.emplace(key, made);
  context_.consume(instance);
  return made;
}

std::optional<PlacedSurface> Geometry::make_surface(const Record& i) {
  const auto is = [&](Entity e) { return context_.is(i, e); };
  if (is(Entity::ElementarySurface)) return elementary(i);
  if (is(Entity::BSplineSurface)) return spline_surface(i);
  if (is(Entity::SweptSurface)) return swept(i);
  if (is(Entity::RectangularTrimmedSurface)) return rectangular(i);
  if (is(Entity::OffsetSurface)) return offset_surface(i);
  if (is(Entity::SurfaceReplica)) return replica_surface(i);
  if (is(Entity::CurveBoundedSurface)) {  // its basis; the bounds make a face of it elsewhere
    const auto r = context_.read<step::CurveBounded>(i);
    return r ? surface(i, r->basis) : std::nullopt;
  }
  context_.add(i, rules::unsupported, fmt::format("surfaces of kind {} are not supported", context_.file.keyword(i).name));
  return std::nullopt;
}

std::optional<PlacedSurface> Geometry::elementary(const Record& i) {
  const auto r = context_.read<step::ElementarySurface>(i);
  const auto f = r ? frame(i, r->position) : std::nullopt;
  if (!f) return std::nullopt;
  const double s = mm(), rad = units_.rad;
  const auto refuse = [&](const Rule& rule, std::string text, double measured) {
    context_.add(i, rule, std::move(text), measured, 0);
    return std::nullopt;
  };
  if (context_.is(i, Entity::Plane)) return placed({Plane{*f}}, s, s);
  const double a = r->a * s;
  if (!std::isfinite(a)) return refuse(sr::real_overflow, "a radius overflows", a);
  if (context_.is(i, Entity::CylindricalSurface)) {
    if (!(a > 0)) return refuse(sr::conic_size, "the radius of a cylinder is not positive", a);
    return placed({Cylinder{*f, a}}, rad, s);
  }
  if (context_.is(i, Entity::SphericalSurface)) {
    if (!(a > 0)) return refuse(sr::conic_size, "the radius of a sphere is not positive", a);
    return placed({Sphere{*f, a}}, rad, rad);
  }
  if (context_.is(i, Entity::ConicalSurface)) {
    const double angle = r->b * rad;
    if (!(std::abs(angle) > 0) || !(std::abs(angle) < pi / 2))
      return refuse(sr::cone_angle, fmt::format("the half angle of the cone is {:.6g} degrees", angle * 180 / pi), angle);
    if (angle < 0 || a < 0)
      context_.add(i, sr::cone_angle, Severity::Warning, "the half angle or the radius of the cone is negative; it is read as it stands",
                   angle < 0 ? angle : a, 0);
    if (a < 0) return std::nullopt;
    return placed({Cone{*f, a, angle}}, rad, s);
  }
  return torus(i, *f, a, r->b * s, r->degenerate, r->select_outer);
}

std::optional<PlacedSurface> Geometry::torus(const Record& i, const Frame& f, double a, double b, bool degenerate, bool outer) {
  if (!(std::abs(a) > 0) || !(std::abs(b) > 0) || !std::isfinite(b)) {
    context_.add(i, sr::torus_size, "a radius of the torus is not positive", a > 0 ? b : a, 0);
    return std::nullopt;
  }
  if (a < 0 || b < 0) context_.add(i, sr::torus_size, "a radius of the torus is negative; its size is taken", std::min(a, b), 0);
  const Torus whole{f, std::abs(a), std::abs(b)};
  if (whole.minor_radius >= whole.major_radius && !degenerate)
    context_.add(i, sr::torus_size, Severity::Warning, "the torus goes through itself and is not said to be degenerate", whole.minor_radius,
                 whole.major_radius).unit = "mm";
  PlacedSurface out = placed({whole}, units_.rad, units_.rad);
  if (degenerate && whole.minor_radius > whole.major_radius) out.surface = spindle_sheet(whole, outer);
  out.turned_inside = a < 0;
  return out;
}

std::optional<PlacedSurface> Geometry::swept(const Record& i) {
  const auto r = context_.read<step::SweptSurface>(i);
  const Record* curve_instance = r ? context_.resolve(i, r->curve, Entity::Curve) : nullptr;
  const CurvePtr c = curve_instance ? curve(*curve_instance) : nullptr;
  if (!c) return std::nullopt;
  const double scale = parameter_scale(*curve_instance);
  if (context_.is(i, Entity::SurfaceOfRevolution)) {
    const auto a = axis(i, r->axis);
    if (!a) return std::nullopt;
    Revolution out;
    out.axis_origin = a->origin;
    out.axis = a->z;
    out.generatrix = c;
    return placed({std::move(out)}, units_.rad, scale);
  }
  const Record* vector = context_.resolve(i, r->axis, Entity::VectorEntity);
  const auto v = vector ? context_.read<step::VectorRecord>(*vector) : std::nullopt;
  const auto d = v ? direction(*vector, v->orientation) : std::nullopt;
  if (!d) return std::nullopt;
  double magnitude = v->magnitude;
  if (!(std::abs(magnitude) > 0)) {
    context_.add(*vector, sr::vector_magnitude, "the magnitude is not positive; 1 is taken", magnitude, 0);
    magnitude = 1;
  }
  Extrusion out;
  out.directrix = c;
  out.direction = magnitude * mm() * *d;
  out.range_v = {-infinity, infinity};
  if (const auto* l = std::get_if<Line>(&c->shape); l && norm(cross(normalized(l->end - l->start), *d)) < 1e-9) {
    context_.add(i, sr::swept_degenerate, "a line is extruded along itself");
    return std::nullopt;
  }
  return placed({std::move(out)}, scale, 1);
}

std::optional<PlacedSurface> Geometry::spline_surface(const Record& i) {
  auto r = context_.read<step::SplineSurface>(i);
  if (!r) return std::nullopt;
  const std::size_t nu = r->poles.size(), nv = nu ? r->poles.front().size() : 0;
  std::vector<Point> points;
  std::vector<double> weights;
  points.reserve(nu * nv);
  for (const auto& row : r->poles) {
    if (row.size() != nv) {
      context_.add(i, sr::surface_sums, "the rows of poles are not of one length", static_cast<double>(row.size()), static_cast<double>(nv));
      return std::nullopt;
    }
    for (const Ref ref : row) {
      const auto p = point(i, ref);
      if (!p) return std::nullopt;
      points.push_back(*p);
    }
  }
  if (!r->weights.empty()) {
    bool fits = r->weights.size() == nu;
    for (const auto& row : r->weights) {
      fits = fits && row.size() == nv;
      weights.insert(weights.end(), row.begin(), row.end());
    }
    if (!fits) {
      context_.add(i, sr::weights, "there is not one weight for each pole", static_cast<double>(weights.size()), static_cast<double>(nu * nv));
      return std::nullopt;
    }
    if (!check_weights(context_, i, weights)) return std::nullopt;
  }
  auto u = full_knots(context_, i, r->degree_u, nu, r->form, r->multiplicities_u, r->knots_u, sr::surface_sums);
  auto v = full_knots(context_, i, r->degree_v, nv, r->form, r->multiplicities_v, r->knots_v, sr::surface_sums);
  if (!u || !v) return std::nullopt;
  const UnusedPoles in_u = drop_excess(context_, i, r->degree_u, *u, sr::surface_sums);
  const UnusedPoles in_v = drop_excess(context_, i, r->degree_v, *v, sr::surface_sums);
  if (in_u.front + in_u.back + in_v.front + in_v.back > 0) {
    const auto cut = [&](auto& grid) {
      if (grid.empty()) return;
      std::remove_reference_t<decltype(grid)> kept;
      for (std::size_t a = in_u.front; a + in_u.back < nu; ++a)
        for (std::size_t b = in_v.front; b + in_v.back < nv; ++b) kept.push_back(grid[a * nv + b]);
      grid = std::move(kept);
    };
    cut(points);
    cut(weights);
  }
  auto made = NurbsSurface::from_cartesian(r->degree_u, r->degree_v, std::move(*u), std::move(*v), points, weights);
  if (made) return placed({std::move(*made)});
  context_.add(i, rules::erroneous_surface, made.error().text, made.error().measured, made.error().limit);
  return std::nullopt;
}

std::optional<PlacedSurface> Geometry::rectangular(const Record& i) {
  const auto r = context_.read<step::RectangularTrimmed>(i);
  auto basis = r ? surface(i, r->basis) : std::nullopt;
  if (!basis) return std::nullopt;
  const SurfaceDomain d = domain(*basis->surface);
  // From u1 to u2 in the stated sense; over the seam where the direction is periodic.
  const auto part = [](double from, double to, bool sense, double period) {
    double lo = sense ? from : to, hi = sense ? to : from;
    if (hi <= lo && period > 0) hi += period * (std::floor((lo - hi) / period) + 1);
    if (hi < lo) std::swap(lo, hi);
    return Interval{lo, hi};
  };
  const Interval u = part(r->u1 * basis->scale_u, r->u2 * basis->scale_u, r->u_sense, d.period_u);
  const Interval v = part(r->v1 * basis->scale_v, r->v2 * basis->scale_v, r->v_sense, d.period_v);
  if (!(u.lo < u.hi) || !(v.lo < v.hi)) {
    context_.add(i, sr::rectangular_trim, "the trimmed surface has no extent", std::min(u.length(), v.length()), 0);
    return std::nullopt;
  }
  basis->range_u = u;
  basis->range_v = v;
  if (r->u_sense != r->v_sense) basis->flipped = !basis->flipped;
  if (const auto* n = std::get_if<NurbsSurface>(&basis->surface->shape))
    basis->surface = std::make_shared<const Surface>(Surface{n->with_range(u, v)});
  return basis;
}

std::optional<PlacedSurface> Geometry::offset_surface(const Record& i) {
  const auto r = context_.read<step::OffsetSurfaceRecord>(i);
  auto basis = r ? surface(i, r->basis) : std::nullopt;
  if (!basis) return std::nullopt;
  const double d = r->distance * mm() * (basis->flipped ? -1 : 1);
  if (!std::isfinite(d)) {
    context_.add(i, sr::real_overflow, "the offset distance overflows");
    return std::nullopt;
  }
  // Elementary surfaces stay elementary where their radius stays positive.
  const auto moved = [&](Surface s) {
    basis->surface = std::make_shared<const Surface>(std::move(s));
    return basis;
  };
  const auto& shape = basis->surface->shape;
  if (const auto* p = std::get_if<Plane>(&shape)) {
    Plane q = *p;
    q.frame.origin = q.frame.origin + d * q.frame.z;
    return moved({q});
  }
  if (const auto* c = std::get_if<Cylinder>(&shape); c && c->radius + d > 0) return moved({Cylinder{c->frame, c->radius + d}});
  if (const auto* c = std::get_if<Sphere>(&shape); c && c->radius + d > 0) return moved({Sphere{c->frame, c->radius + d}});
  if (const auto* c = std::get_if<Torus>(&shape); c && c->minor_radius + d > 0)
    return moved({Torus{c->frame, c->major_radius, c->minor_radius + d}});
  return moved({OffsetSurface{basis->surface, d}});
}

std::optional<PlacedSurface> Geometry::replica_surface(const Record& i) {
  const auto r = context_.read<step::Replica>(i);
  auto parent = r ? surface(i, r->parent) : std::nullopt;
  const Record* by = parent ? context_.resolve(i, r->transformation, Entity::CartesianTransformationOperator) : nullptr;
  const auto t = by ? transform(*by) : std::nullopt;
  if (!t) return std::nullopt;
  auto moved = transformed(*parent->surface, *t);
  if (!moved) {
    context_.add(i, rules::unsupported, moved.error().text);
    return std::nullopt;
  }
  parent->surface = std::make_shared<const Surface>(std::move(*moved));
  if (determinant(*t) < 0) parent->flipped = !parent->flipped;
  return parent;
}

SurfacePtr spindle_sheet(const Torus& torus, bool outer) {
  const Frame& f = torus.frame;
  const double at_axis = std::acos(-torus.major_radius / torus.minor_radius);
  const Interval arc = outer ? Interval{-at_axis, at_axis} : Interval{at_axis, two_pi - at_axis};
  const Frame meridian = make_frame(f.origin + torus.major_radius * f.x, -1.0 * f.y, f.x);
  Revolution sheet;
  sheet.axis_origin = f.origin;
  sheet.axis = f.z;
  sheet.generatrix = std::make_shared<const Curve>(Curve{Circle{meridian, torus.minor_radius, arc}});
  return std::make_shared<const Surface>(Surface{std::move(sheet)});
}

namespace {

// Parameters of a line between the feet of the corners of a box, with room around.
CurvePtr bounded_curve(const CurvePtr& curve, const Box& box) {
  const auto* l = curve ? std::get_if<Line>(&curve->shape) : nullptr;
  if (is_bounded(*curve)) return curve;
  Interval reach{infinity, -infinity};
  for (int corner = 0; corner < 8; ++corner) {
    const Point p{corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y, corner & 4 ? box.hi.z : box.lo.z};
    const double t = parameter_near(*curve, p);
    reach = {std::min(reach.lo, t), std::max(reach.hi, t)};
  }
  const double room = 0.1 * reach.length() + (l ? 1e-3 / std::max(norm(l->end - l->start), 1e-300) : 1e-3);
  return std::make_shared<const Curve>(with_range(*curve, {reach.lo - room, reach.hi + room}));
}

}  // namespace

SurfacePtr bounded_for(const SurfacePtr& surface, const Box& box) {
  if (box.empty()) return surface;
  if (const auto* o = std::get_if<OffsetSurface>(&surface->shape)) {
    Box grown = box;
    const double d = std::abs(o->distance);
    grown.lo = grown.lo - Vector{d, d, d};
    grown.hi = grown.hi + Vector{d, d, d};
    const SurfacePtr basis = bounded_for(o->basis, grown);
    return basis == o->basis ? surface : std::make_shared<const Surface>(Surface{OffsetSurface{basis, o->distance}});
  }
  if (const auto* r = std::get_if<Revolution>(&surface->shape)) {
    if (is_bounded(*r->generatrix)) return surface;
    // What the box sweeps out about the axis, where the generatrix lies.
    const Vector axis = r->axis;
    double reach = 0, lo = infinity, hi = -infinity;
    for (int corner = 0; corner < 8; ++corner) {
      const Point p{corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y, corner & 4 ? box.hi.z : box.lo.z};
      const Vector d = p - r->axis_origin;
      const double along = dot(d, axis);
      lo = std::min(lo, along);
      hi = std::max(hi, along);
      reach = std::max(reach, norm(d - along * axis));
    }
    const Point middle = r->axis_origin + 0.5 * (lo + hi) * axis;
    const double half = std::max(reach, 0.5 * (hi - lo)) * 1.5;
    Box around;
    around.add(middle - Vector{half, half, half});
    around.add(middle + Vector{half, half, half});
    Revolution bounded = *r;
    bounded.generatrix = bounded_curve(r->generatrix, around);
    return std::make_shared<const Surface>(Surface{std::move(bounded)});
  }
  if (const auto* e = std::get_if<Extrusion>(&surface->shape)) {
    if (is_bounded(*e->directrix) && e->range_v.is_bounded()) return surface;
    Extrusion bounded = *e;
    const double size = norm(e->direction);
    if (!is_bounded(*e->directrix)) {
      // The box seen along the direction: a box around it has all its shadows on the directrix's plane.
      Box around = box;
      const double room = box.diagonal();
      const Point c = midpoint(box.lo, box.hi);
      const auto* l = std::get_if<Line>(&e->directrix->shape);
      const Vector n = l ? normalized(cross(cross(l->end - l->start, e->direction), e->direction)) : Vector{};
      if (l && norm(n) > 0) {
        // Where the plane of the surface meets: solve for the parameter along the line, across the direction.
        const Vector d = l->end - l->start;
        const double across = dot(d, n);
        Interval reach{infinity, -infinity};
        for (int corner = 0; corner < 8; ++corner) {
          const Point p{corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y, corner & 4 ? box.hi.z : box.lo.z};
          const double t = dot(p - l->start, n) / across;
          reach = {std::min(reach.lo, t), std::max(reach.hi, t)};
        }
        const double more = 0.1 * reach.length() + 1e-3 / std::abs(across);
        bounded.directrix = std::make_shared<const Curve>(with_range(*e->directrix, {reach.lo - more, reach.hi + more}));
      } else {
        around.add(c - Vector{room, room, room});
        around.add(c + Vector{room, room, room});
        bounded.directrix = bounded_curve(e->directrix, around);
      }
    }
    Box curve_box = bounding_box(*bounded.directrix);
    const Vector unit = e->direction / size;
    double lo = infinity, hi = -infinity, from = infinity, to = -infinity;
    for (int corner = 0; corner < 8; ++corner) {
      const Point p{corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y, corner & 4 ? box.hi.z : box.lo.z};
      const Point q{corner & 1 ? curve_box.hi.x : curve_box.lo.x, corner & 2 ? curve_box.hi.y : curve_box.lo.y,
                    corner & 4 ? curve_box.hi.z : curve_box.lo.z};
      lo = std::min(lo, dot(to_vector(p), unit));
      hi = std::max(hi, dot(to_vector(p), unit));
      from = std::min(from, dot(to_vector(q), unit));
      to = std::max(to, dot(to_vector(q), unit));
    }
    const double more = 0.05 * (hi - lo + to - from) + 1e-3;
    bounded.range_v = {(lo - to - more) / size, (hi - from + more) / size};
    return std::make_shared<const Surface>(Surface{std::move(bounded)});
  }
  return surface;
}

}  // namespace trimloop::io::step_import
