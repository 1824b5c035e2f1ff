// Nearest points of trimmed faces: the boundary curves, then the stationary points of the surface that lie inside.

#include <algorithm>

#include "base/assert.h"
#include "kernel/closest/closest.h"
#include "kernel/closest/loops.h"
#include "kernel/closest/search.h"
#include "kernel/geometry/approximate.h"
#include "kernel/pcurve/deviation.h"

namespace trimloop {

using closest::Answer;
using closest::Foot;
using closest::Question;
using closest::Shape;
using closest::SquaredDistance;

namespace {

// An edge of the boundary as a NURBS, over the parameter `map` leads to.
struct Boundary {
  CurvePieces pieces;
  SquaredDistance field;
  std::optional<ParameterMap> map;  // from the edge's own parameter
  double slack = 0;                 // distance of the NURBS from the edge
  Edge edge;
  Coedge coedge;
  Boundary(const NurbsCurve& c, std::optional<ParameterMap> to_nurbs_map, double off, const Edge& e, const Coedge& use)
      : pieces(c),
        field(closest::squared_distance(pieces)),
        map(std::move(to_nurbs_map)),
        slack(off),
        edge(e),
        coedge(use) {}
  double edge_parameter(double t) const { return map ? map_from_nurbs(*map, t) : t; }
};

constexpr double approximation_mm = 1e-7;  // of edges that are no NURBS; its bound goes into the certificate

Result<Boundary> boundary_of(const Body& body, const Face& face, const Edge& edge, const Coedge& use) {
  if (edge.curve) {
    const Curve part = with_range(*edge.curve, edge.range);
    if (const auto* nurbs = std::get_if<NurbsCurve>(&part.shape)) return Boundary(*nurbs, {}, 0, edge, use);
    if (const auto exact = to_nurbs(part); exact && exact->deviation == 0)
      return Boundary(exact->curve, exact->map, 0, edge, use);
  }
  // Its own curve where that is no NURBS, else that of the pcurve: approximated, with a proven distance.
  std::vector<double> at{edge.range.lo, edge.range.hi};
  for (double t : edge.curve ? breaks(*edge.curve) : breaks(use.pcurve.curve)) {
    const double own = edge.curve ? t : edge_parameter(use, edge, t);
    if (own > edge.range.lo && own < edge.range.hi) at.push_back(own);
  }
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  const auto fitted =
      approximate_in_space([&](double t) { return point_at(body, face, use, t); }, at, approximation_mm);
  if (!fitted) return tl::unexpected(fitted.error());
  DeviationOptions options;
  options.enough_mm = 2 * approximation_mm;
  const Deviation off =
      edge.curve ? deviation(fitted->curve, edge.range, *edge.curve, edge.range, options)
                 : deviation(use.pcurve, use.pcurve_range, *face.surface, fitted->curve, edge.range, options);
  if (!off.proven()) return fail(ErrorCode::NoConvergence, "no proven distance of an edge from its approximation");
  const auto* nurbs = std::get_if<NurbsCurve>(&fitted->curve.shape);
  TRIMLOOP_ASSERT(nurbs, "approximations are splines");
  return Boundary(*nurbs, {}, off.bound_mm, edge, use);
}

}  // namespace

struct ClosestOnFace::Data {
  struct Inner {
    SurfacePieces pieces;
    SquaredDistance field;
    ToNurbsSurface nurbs;
    explicit Inner(ToNurbsSurface s)
        : pieces(s.surface), field(closest::squared_distance(pieces)), nurbs(std::move(s)) {}
  };
  std::vector<Boundary> boundary;
  std::vector<std::pair<Point, Uv>> poles;
  closest::Loops loops;
  std::optional<Inner> inner;
};

Result<ClosestOnFace> ClosestOnFace::make(const Body& body, FaceId id) {
  const Face& face = body.faces[id.index];
  if (face.status == FaceStatus::Failed || !face.surface)
    return fail(ErrorCode::Degenerate, "a failed face has no points");
  auto data = std::make_shared<Data>();
  for (LoopId loop : face.loops) {
    std::vector<Coedge> coedges;
    for (const Coedge& use : body[loop].coedges) {
      const Edge& edge = body[use.edge];
      coedges.push_back(use);
      if (edge.is_pole) {
        data->poles.emplace_back(body[edge.start].point, start_uv(body, use));
        continue;
      }
      auto boundary = boundary_of(body, face, edge, use);
      if (!boundary) return tl::unexpected(boundary.error());
      data->boundary.push_back(std::move(*boundary));
    }
    data->loops.add(coedges);
  }
  Interval u, v;
  if (face.loops.empty()) {
    const SurfaceDomain whole = domain(*face.surface);
    u = whole.u;
    v = whole.v;
  } else {
    u = data->loops.reach_u();
    v = data->loops.reach_v();
  }
  if (!u.is_bounded() || !v.is_bounded() || !(u.length() > 0) || !(v.length() > 0))
    return fail(ErrorCode::Degenerate, "the loops of the face enclose no area");
  if (const auto* nurbs = std::get_if<NurbsSurface>(&face.surface->shape)) {
    u = {nurbs->domain_u().clamp(u.lo), nurbs->domain_u().clamp(u.hi)};
    v = {nurbs->domain_v().clamp(v.lo), nurbs->domain_v().clamp(v.hi)};
  }
  auto nurbs = to_nurbs(*face.surface, u, v);
  if (!nurbs) return tl::unexpected(nurbs.error());
  data->inner.emplace(std::move(*nurbs));
  ClosestOnFace out;
  out.data_ = data;
  return out;
}

ClosestPoint ClosestOnFace::nearest(Point p, ClosestOptions options) const {
  const Data& d = *data_;
  const double rounding = 32 * std::numeric_limits<double>::epsilon() * (d.inner->field.size + norm(to_vector(p)));
  ClosestPoint best;
  double lower = infinity;
  for (const auto& [point, uv] : d.poles)
    if (const double to = distance(point, p); to < best.distance) best = {uv, point, to, to}, lower = to;

  Question ask;
  ask.p = p;
  ask.tolerance = std::max(options.tolerance_mm, rounding);
  for (const Boundary& b : d.boundary) {
    ask.at_most = best.distance * best.distance;
    const Answer answer = closest::search(b.field, Shape{nullptr, &b.pieces}, ask);
    lower = std::min(lower, std::sqrt(answer.lower) - b.slack);
    if (!(answer.best.squared < ask.at_most)) continue;
    const double t = b.edge_parameter(answer.best.uv.u);
    best.uv = evaluate(b.coedge.pcurve, pcurve_parameter(b.coedge, b.edge, t));
    best.point = answer.best.point;
    best.distance = std::sqrt(answer.best.squared);
  }

  ask.at_most = best.distance * best.distance;
  const auto own = [&](Uv uv) { return map_from_nurbs(d.inner->nurbs, uv); };
  if (!d.loops.empty()) {
    ask.inside = [&](Uv uv) { return d.loops.contains(own(uv)); };
    ask.outside = [&](Interval u, Interval v) {
      const Uv lo = own({u.lo, v.lo}), hi = own({u.hi, v.hi});
      return d.loops.misses({lo.u, hi.u}, {lo.v, hi.v});
    };
  }
  const Answer answer = closest::search(d.inner->field, Shape{&d.inner->pieces, nullptr}, ask);
  lower = std::min(lower, std::sqrt(answer.lower));
  if (answer.best.squared < ask.at_most) {
    best.uv = own(answer.best.uv);
    best.point = answer.best.point;
    best.distance = std::sqrt(answer.best.squared);
  }
  best.lower = std::max(0.0, std::min(lower, best.distance) - rounding);
  return best;
}

}  // namespace trimloop
