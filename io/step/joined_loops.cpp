#include "io/step/joined_loops.h"

#include <unordered_map>

namespace trimloop::io::step_export {

namespace {

using Uses = std::vector<const Coedge*>;

// Without the coedge at `from`, beginning behind it.
Uses opened(const Uses& loop, std::size_t from) {
  const auto at = loop.begin() + static_cast<std::ptrdiff_t>(from);
  Uses out(at + 1, loop.end());
  out.insert(out.end(), loop.begin(), at);
  return out;
}

std::size_t place_of(const Uses& loop, EdgeId edge, bool reversed) {
  for (std::size_t i = 0; i < loop.size(); ++i)
    if (loop[i]->edge == edge && loop[i]->reversed == reversed) return i;
  return loop.size();
}

// Pieces of the seam that go there and straight back.
void drop_spikes(const Body& body, Uses& loop) {
  Uses out;
  const auto back = [&](const Coedge* a, const Coedge* b) { return a->edge == b->edge && a->reversed != b->reversed && !body[a->edge].is_pole; };
  for (const Coedge* c : loop) {
    if (!out.empty() && back(out.back(), c)) out.pop_back();
    else out.push_back(c);
  }
  std::size_t first = 0;
  while (out.size() - first > 2 && back(out.back(), out[first])) out.pop_back(), ++first;
  if (!out.empty()) loop.assign(out.begin() + static_cast<std::ptrdiff_t>(first), out.end());
}

}  // namespace

JoinedLoops joined_loops(const Body& body, const Face& face) {
  JoinedLoops out;
  std::unordered_map<EdgeId, std::size_t> first_use;      // the loop that has it
  std::vector<std::pair<EdgeId, std::size_t>> again;      // used by a second loop
  for (std::size_t l = 0; l < face.loops.size(); ++l) {
    Uses& uses = out.loops.emplace_back();
    for (const Coedge& c : body[face.loops[l]].coedges) {
      uses.push_back(&c);
      if (body[c.edge].is_pole) continue;
      const auto [at, fresh] = first_use.try_emplace(c.edge, l);
      if (!fresh && at->second != l) again.emplace_back(c.edge, l);
    }
  }
  if (again.empty()) return out;
  std::vector<std::size_t> now(out.loops.size());  // where each loop has gone
  for (std::size_t l = 0; l < now.size(); ++l) now[l] = l;
  const auto find = [&](std::size_t l) {
    while (now[l] != l) l = now[l];
    return l;
  };
  for (const auto& [edge, l] : again) {
    const std::size_t a = find(first_use.at(edge)), b = find(l);
    if (a == b) continue;
    Uses &to = out.loops[std::min(a, b)], &from = out.loops[std::max(a, b)];
    for (const bool reversed : {false, true}) {
      const std::size_t i = place_of(to, edge, reversed), j = place_of(from, edge, !reversed);
      if (i == to.size() || j == from.size()) continue;
      Uses joined = opened(to, i);
      const Uses rest = opened(from, j);
      joined.insert(joined.end(), rest.begin(), rest.end());
      to = std::move(joined);
      from.clear();
      now[std::max(a, b)] = std::min(a, b);
      out.crosses_seam = true;
      break;
    }
  }
  if (!out.crosses_seam) return out;
  std::vector<Uses> kept;
  for (Uses& loop : out.loops) {
    if (loop.empty()) continue;
    drop_spikes(body, loop);
    kept.push_back(std::move(loop));
  }
  out.loops = std::move(kept);
  return out;
}

}  // namespace trimloop::io::step_export
