#include "io/step/edge_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "kernel/topology/parameter_box.h"

namespace trimloop::io::step_export {

namespace {

class EdgePlanner {
 public:
  EdgePlanner(EntityWriter& writer, const Body& body) : writer_(writer), body_(body) {
    plan_.uses.resize(body.edges.size());
    plan_.left_out.resize(body.edges.size(), false);
    for (const Face& f : body.faces) {
      for (const LoopId id : f.loops) {
        for (const Coedge& c : body[id].coedges) plan_.uses[c.edge.index].push_back({&f, &c});
      }
    }
    for (std::uint32_t e = 0; e < body.edges.size(); ++e) plan_.twins.push_back({EdgeId{e}, false});
    for (std::uint32_t v = 0; v < body.vertices.size(); ++v) plan_.same_vertex.push_back(VertexId{v});
  }
  EdgePlan run() {
    for (const Face& f : body_.faces) join_seams(f);
    for (const Face& f : body_.faces) close_slivers(f);
    return std::move(plan_);
  }

 private:
  bool try_join(const Face& face, const Coedge& a, const Coedge& b);
  void join_seams(const Face& face);
  void close_slivers(const Face& face);

  EntityWriter& writer_;
  const Body& body_;
  EdgePlan plan_;
};

// Whether one runs where the surface closes and the other on the opposite side; edges may also coincide in space alone, as
// where a flat tube ends.
bool lie_opposite(const Body& body, const SurfaceDomain& d, const Coedge& a, const Coedge& b) {
  const auto apart = [](bool closed, double period, Interval range, double x, double y) {
    const double width = period > 0 ? period : range.length();
    return (closed || period > 0) && std::abs(std::abs(x - y) - width) <= 1e-2 * width;
  };
  const Uv a0 = start_uv(body, a), a1 = end_uv(body, a), b0 = start_uv(body, b), b1 = end_uv(body, b);
  return (apart(d.closed_u, d.period_u, d.u, a0.u, b1.u) && apart(d.closed_u, d.period_u, d.u, a1.u, b0.u)) ||
         (apart(d.closed_v, d.period_v, d.v, a0.v, b1.v) && apart(d.closed_v, d.period_v, d.v, a1.v, b0.v));
}

// A seam that came as two edges, up and down, is one edge to the file: receivers look for it.
bool EdgePlanner::try_join(const Face& face, const Coedge& a, const Coedge& b) {
  const Edge &p = body_[a.edge], &q = body_[b.edge];
  if (!p.curve || !q.curve) return false;
  const double tolerance = 2 * writer_.model.resolution_mm;
  const auto at = [&](VertexId v) { return body_[v].point; };
  if (distance(at(p.start), evaluate(*p.curve, p.range.mid())) < 10 * tolerance) return false;  // too short to tell
  if (distance(at(start_vertex(body_, a)), at(end_vertex(body_, b))) > tolerance) return false;
  if (distance(at(end_vertex(body_, a)), at(start_vertex(body_, b))) > tolerance) return false;
  double apart = 0;
  for (const double s : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const Point on = evaluate(*p.curve, p.range.at(s));
    apart = std::max(apart, closest_point(with_range(*q.curve, q.range), on).distance);
    if (apart > tolerance) return false;
  }
  const ParameterBox box = parameter_box(body_, face);
  if (apart > 1e-9 * bounding_box(*face.surface, box.u, box.v).diagonal()) {
    writer_.lose(face.source, fmt::format("one of the two edges of a seam: within {:.3g} mm of the other, which is written", apart));
  }
  const bool against = a.reversed == b.reversed;  // the coedges run against each other
  plan_.twins[b.edge.index] = {a.edge, against};
  plan_.uses[a.edge.index].push_back({&face, &b, against});
  plan_.same_vertex[plan_.vertex(q.start).index] = plan_.vertex(against ? p.end : p.start);
  plan_.same_vertex[plan_.vertex(q.end).index] = plan_.vertex(against ? p.start : p.end);
  return true;
}

void EdgePlanner::join_seams(const Face& face) {
  if (face.status == FaceStatus::Failed || !face.surface) return;
  const SurfaceDomain d = domain(*face.surface, writer_.model.resolution_mm);
  if (!d.closed_u && !d.closed_v && d.period_u == 0 && d.period_v == 0) return;
  std::vector<const Coedge*> alone;
  for (const LoopId id : face.loops) {
    for (const Coedge& c : body_[id].coedges) {
      if (!body_[c.edge].is_pole && plan_.uses[c.edge.index].size() == 1) alone.push_back(&c);
    }
  }
  constexpr std::size_t most = 2000;  // pairs are tried
  if (alone.size() > most) return;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    for (std::size_t j = i + 1; j < alone.size(); ++j) {
      if (plan_.uses[alone[i]->edge.index].size() != 1) break;
      if (plan_.twins[alone[j]->edge.index].edge != alone[j]->edge || plan_.uses[alone[j]->edge.index].size() != 1) continue;
      if (lie_opposite(body_, d, *alone[i], *alone[j])) try_join(face, *alone[i], *alone[j]);
    }
  }
}

// A straight step that healing put into a gap of the file and that is of no size: an edge of it makes receivers part the
// face in two. Its two vertices are written as one, and the gap stays what it was.
void EdgePlanner::close_slivers(const Face& face) {
  if (face.status == FaceStatus::Failed) return;
  for (const LoopId id : face.loops) {
    const auto chord = [&](const Coedge& c) { return distance(body_[body_[c.edge].start].point, body_[body_[c.edge].end].point); };
    Box box;
    for (const Coedge& c : body_[id].coedges) box.add(body_[body_[c.edge].start].point);
    for (const Coedge& c : body_[id].coedges) {
      const Edge& e = body_[c.edge];
      constexpr double share = 1e-3;
      const bool supplied = e.source.empty() && !e.curve && !e.is_pole && plan_.uses[c.edge.index].size() == 1;
      if (!supplied || !(chord(c) <= share * box.diagonal()) || body_[id].coedges.size() < 3) continue;
      plan_.left_out[c.edge.index] = true;
      plan_.same_vertex[plan_.vertex(e.end).index] = plan_.vertex(e.start);
    }
  }
}

}  // namespace

EdgePlan plan_edges(EntityWriter& writer, const Body& body) { return EdgePlanner(writer, body).run(); }

}  // namespace trimloop::io::step_export
