// Curves in the parameter plane of a face, with the parameter of the model curve that is written beside them.

#include <array>

#include "io/step/edge_plan.h"
#include "io/step/splines.h"
#include "kernel/geometry/approximate.h"
#include "kernel/topology/parameter_box.h"

namespace trimloop::io::step_export {

namespace {

// Where a surface closes, the model curve does not say on which side of the seam it runs.
bool needs_pcurve(const Face& face, double tolerance_mm) {
  const SurfaceDomain d = domain(*face.surface, tolerance_mm);
  return d.closed_u || d.closed_v || d.period_u > 0 || d.period_v > 0;
}

// Receivers take a pcurve to have the parameter of the model curve.
bool runs_along(const NurbsCurve& pcurve, Interval range, const Curve& curve, const Surface& surface, double tolerance_mm) {
  const Interval own = trimloop::range(curve);
  for (const double s : {0.0, 0.043, 0.17, 0.29, 0.41, 0.53, 0.67, 0.79, 0.91, 1.0}) {  // where symmetry helps nobody
    const Point flat = evaluate(pcurve, range.at(s));
    if (distance(evaluate(surface, {flat.x, flat.y}), evaluate(curve, own.at(s))) > tolerance_mm) return false;
  }
  return true;
}

// The pcurve in the direction of the edge, over the parameters of its written model curve.
std::optional<NurbsCurve> pcurve_over(const Coedge& coedge, bool flipped, Interval range) {
  Interval r = coedge.pcurve_range;
  const bool backwards = (r.lo > r.hi) != flipped;
  if (r.lo > r.hi) std::swap(r.lo, r.hi);
  const Curve part = with_range(coedge.pcurve.curve, r);
  const auto nurbs = trimloop::to_nurbs(backwards ? reversed(part) : part);
  if (!nurbs) return std::nullopt;
  const Interval whole = nurbs->curve.domain(), used = nurbs->curve.range();
  const bool is_whole = whole.lo == used.lo && whole.hi == used.hi && is_clamped(nurbs->curve.degree(), nurbs->curve.knots());
  const NurbsCurve cut = is_whole ? nurbs->curve : trimmed(nurbs->curve, used);
  return reparametrized(cut, range);
}

// A pcurve whose parameter is another (an arc as a spline, a curve fitted by length) again, over that of the model curve.
std::optional<NurbsCurve> refitted(const Body& body, const EdgeUse& use, const Curve& curve, Interval range) {
  const Coedge& c = *use.coedge;
  const Interval own = trimloop::range(curve), of_edge = body[c.edge].range;
  const auto at = [&](double t) {  // `curve` runs as it was written, up to an affine change
    const double s = (t - range.lo) / range.length(), guess = of_edge.at(use.flipped ? 1 - s : s);
    return closest_point_near(*use.face->surface, evaluate(curve, own.at(s)), uv_at(body, c, guess)).uv;
  };
  std::vector<double> stops;
  for (const double b : breaks(curve)) stops.push_back(range.lo + (b - own.lo) / own.length() * range.length());
  constexpr std::size_t most = 200;  // smooth pieces: each costs searches on the surface
  if (stops.size() < 2 || stops.size() > most) return std::nullopt;
  stops.front() = range.lo;
  stops.back() = range.hi;
  const ParameterBox box = parameter_box(body, *use.face);
  constexpr double relative = 1e-10;
  auto fitted = approximate(at, stops, relative * std::max(box.u.length(), box.v.length()), 1024);
  if (!fitted) return std::nullopt;
  return std::get<NurbsCurve>(fitted->curve.curve.shape);
}

}  // namespace

std::optional<NurbsCurve> pcurve_along(const Body& body, const EdgeUse& use, const Curve& curve, Interval range,
                                       double tolerance_mm) {
  const auto good = [&](const std::optional<NurbsCurve>& p) {
    return p && runs_along(*p, range, curve, *use.face->surface, tolerance_mm);
  };
  auto own = pcurve_over(*use.coedge, use.flipped, range);
  if (!own || good(own)) return own;
  auto along = refitted(body, use, curve, range);
  if (good(along)) return along;
  if (!needs_pcurve(*use.face, tolerance_mm)) return std::nullopt;
  return own;
}

}  // namespace trimloop::io::step_export
