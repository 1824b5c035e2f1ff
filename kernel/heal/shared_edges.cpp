#include "kernel/heal/shared_edges.h"

#include <algorithm>

namespace trimloop::heal {

Coedge part_of(const Coedge& whole, const Edge& edge, Interval range) {
  Coedge part = whole;
  part.pcurve_range = {pcurve_parameter(whole, edge, range.lo), pcurve_parameter(whole, edge, range.hi)};
  part.map.clear();
  if (whole.map.size() < 2) return part;
  part.map.push_back({range.lo, part.pcurve_range.lo});
  for (const Uv knot : whole.map)
    if (knot.u > range.lo && knot.u < range.hi) part.map.push_back(knot);
  part.map.push_back({range.hi, part.pcurve_range.hi});
  const double direction = part.pcurve_range.hi - part.pcurve_range.lo;
  for (std::size_t i = 1; i < part.map.size();)
    if (!((part.map[i].v - part.map[i - 1].v) * direction > 0) && i + 1 < part.map.size()) part.map.erase(part.map.begin() + static_cast<std::ptrdiff_t>(i));
    else ++i;
  if (part.map.size() < 3) part.map.clear();
  return part;
}

std::vector<EdgeId> SharedEdges::parts(EdgeId edge) const {
  const auto at = parts_.find(edge);
  return at == parts_.end() ? std::vector<EdgeId>{edge} : at->second;
}

Edge SharedEdges::whole(const Body& body, EdgeId edge) const {
  const auto at = parts_.find(edge);
  if (at == parts_.end()) return body[edge];
  Edge e = body[at->second.front()];
  const Edge& last = body[at->second.back()];
  e.range.hi = last.range.hi;
  e.end = last.end;
  return e;
}

std::optional<VertexId> SharedEdges::vertex_at(const Body& body, EdgeId edge, double t, double same) const {
  for (const EdgeId part : parts(edge)) {
    const Edge& e = body[part];
    if (std::abs(t - e.range.lo) <= same) return e.start;
    if (std::abs(t - e.range.hi) <= same) return e.end;
  }
  return std::nullopt;
}

void SharedEdges::cut(Body& body, EdgeId edge, double t, VertexId vertex) {
  std::vector<EdgeId>& parts = parts_.try_emplace(edge, std::vector<EdgeId>{edge}).first->second;
  const auto at = std::find_if(parts.begin(), parts.end(), [&](EdgeId part) { return t > body[part].range.lo && t < body[part].range.hi; });
  if (at == parts.end()) return;
  const EdgeId first = *at;
  const Edge before = body[first];
  Edge after = before;
  after.range.lo = t;
  after.start = vertex;
  const EdgeId second = body.add(std::move(after));
  body[first].range.hi = t;
  body[first].end = vertex;
  parts.insert(at + 1, second);
  // Every coedge on it becomes two.
  std::vector<LoopId> users = loops_[first];
  std::sort(users.begin(), users.end());
  users.erase(std::unique(users.begin(), users.end()), users.end());
  for (const LoopId loop : users) {
    std::vector<Coedge> coedges;
    for (const Coedge& c : body[loop].coedges) {
      if (c.edge != first) {
        coedges.push_back(c);
        continue;
      }
      Coedge low = part_of(c, before, {before.range.lo, t}), high = part_of(c, before, {t, before.range.hi});
      high.edge = second;
      coedges.push_back(c.reversed ? high : low);
      coedges.push_back(c.reversed ? low : high);
    }
    body[loop].coedges = std::move(coedges);
  }
  loops_[second] = std::move(users);
}

void SharedEdges::use_all(const Body& body) {
  for (std::uint32_t l = 0; l < body.loops.size(); ++l)
    for (const Coedge& c : body.loops[l].coedges) use(c.edge, LoopId{l});
}

}  // namespace trimloop::heal
