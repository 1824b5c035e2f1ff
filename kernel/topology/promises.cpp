// broken_promises: what body.h promises, checked one by one.

#include <fmt/format.h>

#include "kernel/topology/body.h"

namespace trimloop {
namespace {

class Inspector {
 public:
  Inspector(const Body& body, double tolerance_mm) : body_(body), tolerance_(tolerance_mm) {}

  std::vector<std::string> run() {
    if (!handles_are_valid()) return std::move(broken_);
    count_uses();
    for (std::size_t i = 0; i < body_.edges.size(); ++i) inspect_edge(i);
    for (std::size_t i = 0; i < body_.faces.size(); ++i) inspect_face(i);
    for (std::size_t i = 0; i < body_.shells.size(); ++i) inspect_shell(i);
    return std::move(broken_);
  }

 private:
  template <class... Args>
  void complain(fmt::format_string<Args...> text, Args&&... args) {
    constexpr std::size_t enough = 100;
    if (broken_.size() < enough) broken_.push_back(fmt::format(text, std::forward<Args>(args)...));
  }

  // Everything else follows handles, so a wrong one ends the inspection.
  bool handles_are_valid() {
    for (std::size_t i = 0; i < body_.edges.size(); ++i) {
      const Edge& e = body_.edges[i];
      if (e.start.index >= body_.vertices.size() || e.end.index >= body_.vertices.size())
        complain("edge {} has no valid end vertices", i);
    }
    for (std::size_t i = 0; i < body_.loops.size(); ++i)
      for (const Coedge& c : body_.loops[i].coedges)
        if (c.edge.index >= body_.edges.size()) complain("loop {} has a coedge without a valid edge", i);
    for (std::size_t i = 0; i < body_.faces.size(); ++i) {
      if (!body_.faces[i].surface && body_.faces[i].status != FaceStatus::Failed) complain("face {} has no surface", i);
      for (LoopId l : body_.faces[i].loops)
        if (l.index >= body_.loops.size()) complain("face {} has an invalid loop", i);
    }
    for (std::size_t i = 0; i < body_.shells.size(); ++i)
      for (const Shell::Use& use : body_.shells[i].faces)
        if (use.face.index >= body_.faces.size()) complain("shell {} has an invalid face", i);
    return broken_.empty();
  }

  void count_uses() {
    uses_.assign(body_.edges.size(), 0);
    for (const Loop& loop : body_.loops)
      for (const Coedge& c : loop.coedges) ++uses_[c.edge.index];
  }

  void inspect_edge(std::size_t i) {
    const Edge& e = body_.edges[i];
    if (!e.range.is_bounded() || !(e.range.lo < e.range.hi)) return complain("edge {} has an empty range", i);
    if (e.is_pole && (e.curve || e.start != e.end)) complain("edge {} is a pole with a curve or two vertices", i);
    if (!e.curve && !e.is_pole && uses_[i] > 1) complain("edge {} has no curve and {} coedges", i, uses_[i]);
    if (!e.curve) return;
    check_end(i, e.start, evaluate(*e.curve, e.range.lo), "starts");
    check_end(i, e.end, evaluate(*e.curve, e.range.hi), "ends");
  }

  void check_end(std::size_t edge, VertexId vertex, Point end, const char* verb) {
    const double off = distance(end, body_[vertex].point);
    const double allowed = body_[vertex].gap_mm + rounding(end);
    if (!(off <= allowed))
      complain("edge {} {} {} mm from its vertex, which says {} mm", edge, verb, off, body_[vertex].gap_mm);
  }

  static double rounding(Point p) { return 1e-9 * (1 + std::abs(p.x) + std::abs(p.y) + std::abs(p.z)); }

  void inspect_face(std::size_t i) {
    const Face& f = body_.faces[i];
    if (f.status == FaceStatus::Failed) {
      if (!f.loops.empty()) complain("face {} failed and has loops", i);
      if (f.reason.empty()) complain("face {} failed without a reason", i);
      return;
    }
    if (f.status == FaceStatus::Healed && f.reason.empty()) complain("face {} was healed without a reason", i);
    if (f.loops.empty()) return complain("face {} has neither loops nor a failure", i);
    for (LoopId l : f.loops) inspect_loop(i, f, l);
    if (!(uv_area(body_[f.loops[0]]) > 0)) complain("face {}: the outer loop does not run counter-clockwise", i);
  }

  void inspect_loop(std::size_t face, const Face& f, LoopId id) {
    const Loop& loop = body_[id];
    if (loop.coedges.empty()) return complain("loop {} of face {} has no coedges", id.index, face);
    for (std::size_t k = 0; k < loop.coedges.size(); ++k) {
      const Coedge& c = loop.coedges[k];
      const Coedge& next = loop.coedges[(k + 1) % loop.coedges.size()];
      if (end_vertex(body_, c) != start_vertex(body_, next))
        complain("face {}, loop {}: coedge {} does not end at the vertex where the next begins", face, id.index, k);
      const double jump = millimetres(*f.surface, end_uv(body_, c), start_uv(body_, next));
      if (!(jump <= tolerance_))
        complain("face {}, loop {}: a jump of {} mm in parameter space after coedge {}", face, id.index, jump, k);
      inspect_coedge(face, f, id, k);
    }
  }

  void inspect_coedge(std::size_t face, const Face& f, LoopId id, std::size_t k) {
    const Coedge& c = body_[id].coedges[k];
    const Edge& e = body_[c.edge];
    if (!c.pcurve_range.is_bounded() || c.pcurve_range.lo == c.pcurve_range.hi)
      return complain("face {}, loop {}: coedge {} has no pcurve range", face, id.index, k);
    if (c.map.size() == 1) complain("face {}, loop {}: the map of coedge {} has one entry", face, id.index, k);
    const double direction = c.pcurve_range.hi - c.pcurve_range.lo;
    for (std::size_t j = 1; j < c.map.size(); ++j)
      if (!(c.map[j].u > c.map[j - 1].u) || !((c.map[j].v - c.map[j - 1].v) * direction > 0)) {
        complain("face {}, loop {}: the map of coedge {} is not monotone", face, id.index, k);
        break;
      }
    constexpr int samples = 5;
    for (int j = 0; j <= samples; ++j) {
      const double t = e.range.at(j / double(samples));
      const Uv uv = uv_at(body_, c, t);
      if (!is_finite(uv)) return complain("face {}, loop {}: coedge {} is not finite", face, id.index, k);
      const Point p = evaluate(*f.surface, uv);
      const double off = distance(p, point_at(body_, f, c, t));
      const double said = e.is_pole ? std::max(body_[e.start].gap_mm, c.gap_mm) : c.gap_mm;
      if (!(off <= 1.5 * said + tolerance_ + rounding(p)))
        complain("face {}, loop {}: coedge {} is {} mm off its edge and says {} mm", face, id.index, k, off, said);
    }
  }

  // Length in mm of the step from a to b on the surface, to first order.
  static double millimetres(const Surface& s, Uv a, Uv b) {
    Point p;
    Vector du, dv;
    jet1(s, a, p, du, dv);
    return norm((b.u - a.u) * du) + norm((b.v - a.v) * dv);
  }

  double uv_area(const Loop& loop) const {
    double twice = 0;
    Uv first, last;
    bool begun = false;
    for (const Coedge& c : loop.coedges) {
      const Edge& e = body_[c.edge];
      constexpr int samples = 16;
      std::vector<double> stops{e.range.lo};
      for (double b : breaks(c.pcurve.curve)) {
        const double t = edge_parameter(c, e, b);
        if (t > e.range.lo && t < e.range.hi) stops.push_back(t);
      }
      std::sort(stops.begin(), stops.end());
      stops.push_back(e.range.hi);
      const std::size_t n = (stops.size() - 1) * samples;
      for (std::size_t j = 0; j <= n; ++j) {
        const std::size_t i = c.reversed ? n - j : j;
        const std::size_t piece = std::min(i / samples, stops.size() - 2);
        const Interval part{stops[piece], stops[piece + 1]};
        const Uv p = uv_at(body_, c, part.at(double(i - piece * samples) / samples));
        if (begun) twice += cross(last - first, p - first);
        else first = p;
        begun = true;
        last = p;
      }
    }
    return twice / 2;
  }

  void inspect_shell(std::size_t i) {
    const Shell& shell = body_.shells[i];
    if (!shell.closed) return;
    std::vector<int> sum(body_.edges.size(), 0), uses(body_.edges.size(), 0);
    for (const Shell::Use& use : shell.faces) {
      const Face& f = body_[use.face];
      for (LoopId l : f.loops)
        for (const Coedge& c : body_[l].coedges) {
          ++uses[c.edge.index];
          sum[c.edge.index] += (c.reversed != f.reversed) != use.reversed ? -1 : 1;
        }
    }
    for (std::size_t e = 0; e < uses.size(); ++e)
      if (uses[e] != 0 && !body_.edges[e].is_pole && (uses[e] != 2 || sum[e] != 0))
        complain("shell {} is called closed, but edge {} is used {} times", i, e, uses[e]);
  }

  const Body& body_;
  double tolerance_;
  std::vector<std::size_t> uses_;
  std::vector<std::string> broken_;
};

}  // namespace

std::vector<std::string> broken_promises(const Body& body, double tolerance_mm) {
  return Inspector(body, tolerance_mm).run();
}

}  // namespace trimloop
