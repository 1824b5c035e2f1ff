#include "kernel/heal/parting.h"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace trimloop::heal {
namespace {

struct Cut {
  double t = 0;
  int node = -1;
};

// Cuts within rounding of the piece's ends join the nodes there instead.
void cut_piece(Piece piece, std::vector<Cut> cuts, std::vector<Piece>& out, std::vector<std::pair<int, int>>& same) {
  const bool up = piece.t0 < piece.t1;
  std::stable_sort(cuts.begin(), cuts.end(), [&](const Cut& a, const Cut& b) { return up ? a.t < b.t : a.t > b.t; });
  const double least = 1e-12 * std::abs(piece.t1 - piece.t0);
  for (const Cut& c : cuts) {
    if (std::abs(c.t - piece.t0) <= least) {
      same.push_back({piece.start, c.node});
    } else if (std::abs(c.t - piece.t1) <= least) {
      same.push_back({piece.end, c.node});
    } else {
      auto [before, after] = split(piece, c.t, c.node);
      out.push_back(std::move(before));
      piece = std::move(after);
    }
  }
  out.push_back(std::move(piece));
}

}  // namespace

Strands cut_at(Draft& draft, std::vector<Ring> rings, const std::vector<Crossing>& crossings) {
  std::vector<const Piece*> all;
  for (const Ring& ring : rings)
    for (const Piece& p : ring.pieces) all.push_back(&p);
  Strands out;
  std::vector<std::vector<Cut>> cuts(all.size());
  for (const Crossing& c : crossings) {
    const Piece& p = *all[c.piece[0]];
    const int node = draft.add_node(p.curve ? evaluate(*p.curve, curve_parameter(p, c.t[0])) : draft.sheet.point(c.at));
    out.crossed.push_back(node);
    for (int k = 0; k < 2; ++k) cuts[c.piece[k]].push_back({c.t[k], node});
  }
  std::vector<std::pair<int, int>> same;
  std::size_t index = 0;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const std::size_t first = out.pieces.size();
    for (Piece& p : rings[r].pieces) cut_piece(std::move(p), std::move(cuts[index++]), out.pieces, same);
    for (std::size_t i = first; i < out.pieces.size(); ++i) out.next.push_back(i + 1);
    if (out.pieces.size() > first) out.next.back() = first;
    out.ring.resize(out.pieces.size(), r);
  }
  join_nodes(out, same);
  return out;
}

void join_nodes(Strands& strands, const std::vector<std::pair<int, int>>& same) {
  std::unordered_map<int, int> up;
  const auto top = [&](int node) {
    for (auto at = up.find(node); at != up.end(); at = up.find(node)) node = at->second;
    return node;
  };
  for (const auto& [a, b] : same)
    if (const int x = top(a), y = top(b); x != y) up[std::max(x, y)] = std::min(x, y);
  for (Piece& p : strands.pieces) p.start = top(p.start), p.end = top(p.end);
  for (int& node : strands.crossed) node = top(node);
}

std::vector<std::vector<std::size_t>> strung(const Strands& strands) {
  std::map<int, std::vector<std::size_t>> passing;  // crossing -> pieces that end there
  for (const int node : strands.crossed) passing.try_emplace(node);
  for (std::size_t i = 0; i < strands.pieces.size(); ++i)
    if (const auto at = passing.find(strands.pieces[i].end); at != passing.end()) at->second.push_back(i);
  std::vector<std::size_t> next = strands.next;
  for (const auto& [node, ends] : passing)
    for (std::size_t k = 0; k < ends.size(); ++k) next[ends[k]] = strands.next[ends[(k + 1) % ends.size()]];
  std::vector<std::vector<std::size_t>> cycles;
  std::vector<bool> used(next.size(), false);
  for (std::size_t first = 0; first < next.size(); ++first) {
    if (used[first]) continue;
    std::vector<std::size_t>& cycle = cycles.emplace_back();
    for (std::size_t i = first; !used[i]; i = next[i]) used[i] = true, cycle.push_back(i);
  }
  return cycles;
}

}  // namespace trimloop::heal
