// Faces -> 144 with its 142 loops: each loop a parameter-space curve and, where all its edges have one, a model curve.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/iges/records/trimming.h"
#include "io/iges/entity_writer.h"
#include "kernel/geometry/approximate.h"
#include "kernel/pcurve/lift.h"
#include "kernel/topology/parameter_box.h"

namespace trimloop::io::iges_export {

namespace {

// True when the only loop runs round the border of a bounded NURBS surface: the file needs no trimming then.
bool is_natural(const Body& body, const Face& face) {
  if (face.loops.size() != 1 || !std::holds_alternative<NurbsSurface>(face.surface->shape)) return false;
  const SurfaceDomain d = domain(*face.surface);
  double turned = 0;
  for (const Coedge& coedge : body[face.loops[0]].coedges) {
    const Edge& edge = body[coedge.edge];
    const Uv a = uv_at(body, coedge, edge.range.lo), m = uv_at(body, coedge, edge.range.mid()),
             b = uv_at(body, coedge, edge.range.hi);
    const auto on = [&](double p, double q, double r, double value) { return p == value && q == value && r == value; };
    const bool side = on(a.u, m.u, b.u, d.u.lo) || on(a.u, m.u, b.u, d.u.hi) || on(a.v, m.v, b.v, d.v.lo) ||
                      on(a.v, m.v, b.v, d.v.hi);
    if (!side || !std::holds_alternative<Line>(coedge.pcurve.curve.shape)) return false;
    turned += std::abs(b.u - a.u) / d.u.length() + std::abs(b.v - a.v) / d.v.length();
  }
  return std::abs(turned - 4) < 1e-9;
}

// How fast a point of the surface moves at most, per unit of the bent parameters, along a curve in parameter space.
double speed_along(const Surface& surface, const Bend& bend, const Curve& curve) {
  const auto stretch = [](const ParameterMap& m) {
    return (m.own.back() - m.own.front()) / (m.nurbs.back() - m.nurbs.front());
  };
  const Interval t = range(curve);
  double speed = 1e-300;
  for (int k = 0; k <= 8; ++k) {
    const Point p = evaluate(curve, t.lo + k / 8.0 * t.length());
    Point at;
    Vector du, dv;
    jet1(surface, {p.x, p.y}, at, du, dv);
    speed = std::max({speed, norm(du) * stretch(bend.u), norm(dv) * stretch(bend.v)});
  }
  return speed;
}

// A pcurve through a parameter map that is not affine. Isoparametric lines stay lines; others are approximated within a
// hundredth of the resolution; the deviation stated is measured on the surface.
Result<Curve> bent(EntityWriter& writer, const Surface& surface, const Curve& curve, const Bend& bend) {
  const auto uv = [](Point p) { return Uv{p.x, p.y}; };
  if (std::holds_alternative<Line>(curve.shape)) {
    const Uv a = uv(start_point(curve)), b = uv(end_point(curve));
    if (a.u == b.u || a.v == b.v) return make_line2(apply(bend, a), apply(bend, b)).curve;
  }
  // Half of it for the fit: speeds are sampled.
  const double tolerance = 0.005 * writer.model.resolution_mm / speed_along(surface, bend, curve);
  auto fitted = approximate([&](double t) { return apply(bend, uv(evaluate(curve, t))); }, breaks(curve), tolerance);
  if (!fitted) return tl::unexpected(fitted.error());
  double deviation = 0;
  const std::vector<double> joints = breaks(fitted->curve.curve);
  for (std::size_t i = 1; i < joints.size(); ++i) {
    for (const double s : {0.1, 0.3, 0.5, 0.7, 0.9}) {
      const double t = joints[i - 1] + s * (joints[i] - joints[i - 1]);
      const Point is = evaluate(surface, undo(bend, evaluate(fitted->curve, t)));
      deviation = std::max(deviation, distance(is, evaluate(surface, uv(evaluate(curve, t)))));
    }
  }
  ++writer.statement.approximated_pcurves;
  writer.statement.max_deviation_mm = std::max(writer.statement.max_deviation_mm, deviation);
  return fitted->curve.curve;
}

// The coedge's pcurve from its start to its end, in the record's parameters.
Result<Curve> pcurve_of(EntityWriter& writer, const Surface& own_surface, const Coedge& coedge,
                        const WrittenSurface& surface) {
  double lo = coedge.pcurve_range.lo, hi = coedge.pcurve_range.hi;
  bool backwards = coedge.reversed;
  if (lo > hi) {
    std::swap(lo, hi);
    backwards = !backwards;
  }
  const Interval own = range(coedge.pcurve);
  Curve curve = lo == own.lo && hi == own.hi ? coedge.pcurve.curve : with_range(coedge.pcurve.curve, {lo, hi});
  if (backwards) curve = reversed(curve);
  if (surface.bend) {
    auto changed = bent(writer, own_surface, curve, *surface.bend);
    if (!changed) return changed;
    curve = std::move(*changed);
  }
  return is_identity(surface.map) ? Result<Curve>(std::move(curve)) : transformed(curve, surface.map);
}

double rough_length(const Body& body, const Face& face, const Coedge& coedge) {
  constexpr int steps = 8;
  const Interval along = body[coedge.edge].range;
  double sum = 0;
  Point before = point_at(body, face, coedge, along.lo);
  for (int k = 1; k <= steps; ++k) {
    const Point p = point_at(body, face, coedge, along.at(double(k) / steps));
    sum += distance(before, p);
    before = p;
  }
  return sum;
}

// A straight step that closed a gap of the file and is of no size: written, it makes OpenCASCADE part the face in two.
// Left out, the file has the gap it came with, which every receiver closes by its own tolerance.
bool is_sliver(const Body& body, const Face& face, const Coedge& coedge, double perimeter) {
  constexpr double share = 2e-3;
  const Edge& edge = body[coedge.edge];
  const bool supplied = edge.source.empty() && !edge.curve && !edge.is_pole;
  return supplied && rough_length(body, face, coedge) <= share * perimeter;
}

// The edge's curve in the direction of the coedge. Where the body knows the edge by its pcurve alone, what that draws on
// the surface, within a tenth of the resolution or a millionth of its length: receivers that make a curve of their own there may break the face.
std::optional<Curve> space_curve_of(EntityWriter& writer, const Body& body, const Face& face, const Coedge& coedge) {
  const Edge& edge = body[coedge.edge];
  if (!edge.curve) {
    const Interval used{std::min(coedge.pcurve_range.lo, coedge.pcurve_range.hi),
                        std::max(coedge.pcurve_range.lo, coedge.pcurve_range.hi)};
    const double tolerance = std::max(0.1 * writer.model.resolution_mm, 1e-6 * rough_length(body, face, coedge));
    auto lifted = pcurve::lift(*face.surface, coedge.pcurve, used, tolerance);
    if (!lifted) return std::nullopt;
    writer.statement.max_lifted_mm = std::max(writer.statement.max_lifted_mm, lifted->deviation_mm);
    ++writer.statement.lifted_curves;
    const bool forward = (coedge.pcurve_range.lo < coedge.pcurve_range.hi) != coedge.reversed;
    return forward ? *lifted->curve : reversed(*lifted->curve);
  }
  const bool backwards = coedge.reversed;
  const Interval own = range(*edge.curve);
  Curve curve = edge.range.lo == own.lo && edge.range.hi == own.hi ? *edge.curve : with_range(*edge.curve, edge.range);
  return backwards ? reversed(curve) : curve;
}

iges::Ref write_edge_curve(EntityWriter& writer, Curve curve, bool as_nurbs) {
  if (as_nurbs) {
    if (auto nurbs = to_nurbs(curve)) {
      curve = Curve{std::move(nurbs->curve)};
      ++writer.statement.exact_curves;
    }
  }
  return write_curve(writer, curve, Role::Child);
}

iges::Ref join(EntityWriter& writer, const std::vector<iges::Ref>& members, Role role) {
  if (members.size() == 1) return members[0];
  iges::CompositeCurve out;
  out.members = members;
  return writer.add(out, role);
}

iges::Ref write_loop(EntityWriter& writer, const Body& body, const Face& face, LoopId id, const WrittenSurface& surface,
                     bool as_nurbs) {
  std::vector<Coedge> coedges = body[id].coedges;
  const bool turned = determinant(surface.map) < 0;  // a mirrored plane turns loops round; they go back the other way
  if (turned) {
    std::reverse(coedges.begin(), coedges.end());
    for (Coedge& c : coedges) c.reversed = !c.reversed;
  }
  double perimeter = 0;
  for (const Coedge& coedge : coedges) perimeter += rough_length(body, face, coedge);
  std::vector<iges::Ref> pcurves, curves;
  bool all_have_curves = true;
  for (const Coedge& coedge : coedges) {
    if (is_sliver(body, face, coedge, perimeter)) {
      ++writer.statement.slivers_left_out;
      continue;
    }
    const auto pcurve = pcurve_of(writer, *face.surface, coedge, surface);
    const iges::Ref ref = pcurve ? write_pcurve(writer, *pcurve, as_nurbs) : iges::Ref{};
    if (!ref) return {};
    pcurves.push_back(ref);
    const Edge& edge = body[coedge.edge];
    if (edge.is_pole) continue;
    if (!all_have_curves) continue;
    auto in_space = space_curve_of(writer, body, face, coedge);
    const iges::Ref curve = in_space ? write_edge_curve(writer, std::move(*in_space), as_nurbs) : iges::Ref{};
    if (!curve) all_have_curves = false;
    curves.push_back(curve);
  }
  iges::CurveOnSurface out;
  out.surface = surface.ref;
  out.pcurve = join(writer, pcurves, Role::ParameterCurve);
  if (all_have_curves && !curves.empty()) out.curve = join(writer, curves, Role::Child);
  out.preference = out.curve ? 3 : 1;
  return writer.add(out, Role::Child);
}

}  // namespace

void write_face(EntityWriter& writer, const Body& body, const Face& face, bool as_nurbs, Role role,
                std::vector<iges::Ref>& written) {
  if (face.status == FaceStatus::Failed || !face.surface) {
    writer.losses.push_back(fmt::format("a face that could not be made sound: {}", face.reason));
    return;
  }
  const ParameterBox box = parameter_box(body, face);
  const bool bare = writer.options.iges_profile == IgesProfile::Full && is_natural(body, face);
  const AttributesId attributes = face.attributes ? face.attributes : body.attributes;
  const auto surface = write_surface(writer, *face.surface, box.u, box.v, face.reversed, as_nurbs,
                                     bare ? role : Role::Child, bare ? attributes : AttributesId{});
  if (!surface) {
    writer.losses.push_back(fmt::format("a face whose surface cannot be written: {}", surface.error().text));
    return;
  }
  if (bare) {
    written.push_back(surface->ref);
    return;
  }
  iges::TrimmedSurface out;
  out.surface = surface->ref;
  out.outer_given = true;  // explicit even where it is the domain's border: some receivers misread its absence
  for (std::size_t i = 0; i < face.loops.size(); ++i) {
    const iges::Ref loop = write_loop(writer, body, face, face.loops[i], *surface, as_nurbs);
    if (!loop) {
      writer.losses.push_back("a face one of whose loops cannot be written");
      return;
    }
    if (i == 0) out.outer = loop;
    else out.inner.push_back(loop);
  }
  written.push_back(writer.add(out, role, 0, nullptr, attributes));
}

Result<Curve> record_pcurve(EntityWriter& writer, const Surface& own, const Coedge& coedge, const WrittenSurface& surface) {
  return pcurve_of(writer, own, coedge, surface);
}

}  // namespace trimloop::io::iges_export
