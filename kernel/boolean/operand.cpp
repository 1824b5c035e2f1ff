#include "kernel/boolean/operand.h"

#include "kernel/check/measure.h"

namespace trimloop::boolean {

Result<Operand> Operand::make(const Body& body, double tolerance_mm) {
  Operand out;
  out.body_ = &body;
  out.tolerance_ = tolerance_mm;
  out.edges_.resize(body.edges.size());
  for (std::size_t i = 0; i < body.edges.size(); ++i) {
    const Edge& e = body.edges[i];
    if (!e.curve) continue;
    EdgeOf& of = out.edges_[i];
    of.curve = with_range(*e.curve, e.range);
    of.box = bounding_box(of.curve);
  }
  for (std::size_t i = 0; i < body.faces.size(); ++i) {
    const Face& face = body.faces[i];
    if (face.status == FaceStatus::Failed || face.loops.empty())
      return fail(ErrorCode::InvalidArgument, "a face of the operand has no loops");
    FaceOf of;
    of.id = FaceId{static_cast<std::uint32_t>(i)};
    of.surface = face.surface.get();
    of.reversed = face.reversed;
    of.uv = parameter_box(body, face);
    if (!of.uv.u.is_bounded() || !of.uv.v.is_bounded())
      return fail(ErrorCode::InvalidArgument, "a face of the operand has no bounded parameters");
    of.box = bounding_box(*of.surface, of.uv.u, of.uv.v);
    const SurfaceDomain d = domain(*of.surface);
    of.period_u = d.period_u, of.period_v = d.period_v;
    for (const LoopId loop : face.loops) {
      of.loops.add(body[loop].coedges);
      for (const Coedge& c : body[loop].coedges) {
        const Edge& e = body[c.edge];
        if (e.is_pole) {
          of.poles.push_back(e.start);
          continue;
        }
        if (!e.curve) return fail(ErrorCode::Unsupported, "an edge of the operand has no curve in space");
        EdgeOf& edge = out.edges_[c.edge.index];
        edge.used = true;
        if (!edge.faces.empty() && edge.faces.back() == i) continue;  // a seam
        edge.faces.push_back(static_cast<std::uint32_t>(i));
        of.edges.push_back(c.edge);
      }
    }
    std::sort(of.edges.begin(), of.edges.end());
    of.edges.erase(std::unique(of.edges.begin(), of.edges.end()), of.edges.end());
    out.faces_.push_back(std::move(of));
  }
  return out;
}

std::optional<Uv> Operand::inside(const FaceOf& face, Uv at) const {
  const auto turns = [](double x, double period, Interval reach) {
    std::vector<double> out;
    if (!(period > 0)) return std::vector<double>{x};
    for (double k = std::ceil((reach.lo - x) / period - 1e-9); x + k * period <= reach.hi + 1e-9 * period; ++k)
      out.push_back(x + k * period);
    return out;
  };
  for (const double u : turns(at.u, face.period_u, face.uv.u))
    for (const double v : turns(at.v, face.period_v, face.uv.v))
      if (face.loops.contains({u, v})) return Uv{u, v};
  return std::nullopt;
}

Place Operand::locate(const FaceOf& face, Point p) const {
  if (apart(face.box, p, tolerance_)) return {};
  const auto reach = [](Interval box, double period) {
    return period > 0 ? Interval{box.lo, box.lo + period} : box;
  };
  const SurfaceFoot foot =
      closest_point(*face.surface, p, reach(face.uv.u, face.period_u), reach(face.uv.v, face.period_v));
  if (!(foot.distance <= tolerance_)) return {};
  Place out{Where::Outside, foot.uv, {}, 0};
  for (const VertexId pole : face.poles)
    if (distance((*body_)[pole].point, p) <= tolerance_) {
      out.where = Where::Border;
      return out;
    }
  for (const EdgeId e : face.edges) {
    const EdgeOf& edge = edges_[e.index];
    if (apart(edge.box, p, tolerance_)) continue;
    const CurveFoot on = closest_point(edge.curve, p);
    if (!(on.distance <= tolerance_)) continue;
    out.where = Where::Border, out.edge = e, out.t = on.t;
    return out;
  }
  if (const auto uv = inside(face, foot.uv)) out.where = Where::Inside, out.uv = *uv;
  return out;
}

}  // namespace trimloop::boolean
