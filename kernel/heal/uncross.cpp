// A ring that crosses itself is taken apart at its crossings into rings that do not: at each one the two strands change
// partners, so that no direction turns. What is inside is then decided as for any other rings (orient.cpp): by parity.

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "kernel/heal/crossings.h"

namespace trimloop::heal {
namespace {

struct Cut {
  double t = 0;
  int node = -1;
};

class Uncrosser {
 public:
  Uncrosser(Draft& draft, Ring& ring) : draft_(draft), sheet_(draft.sheet), ring_(ring) {}

  // The ring's parts; empty when it does not cross itself.
  std::vector<Ring> run() {
    const SelfCrossings crossings = self_crossings(sheet_, ring_, draft_.tolerance_mm);
    if (crossings.found.size() > most_self_crossings) {
      const Point p = sheet_.point(crossings.found.front().at);
      draft_.failure = fmt::format("loop {} crosses itself at more than {} places, one of them ({:.6g}, {:.6g}, {:.6g})",
                                   ring_.loop + 1, most_self_crossings, p.x, p.y, p.z);
      return {};
    }
    if (!crossings.complete) draft_.record(Step::SearchEnded, ring_.loop, -1, 0, 0, sheet_.point(first_uv(ring_.pieces[0])), false);
    if (!crossings.found.empty()) {
      cut(crossings.found);
      return parts();
    }
    if (ring_.turns_u == 0 && ring_.turns_v == 0 && cancels_out()) return parted_at_touching();
    return {};
  }

 private:
  // Its parts run round in opposite directions.
  bool cancels_out() const {
    const UvBox box = box_of(ring_);
    constexpr double least_share = 1e-6;  // of its rectangle
    return std::abs(area_of(ring_)) < least_share * (box.hi.u - box.lo.u) * (box.hi.v - box.lo.v);
  }

  // A figure of eight whose strands touch at joints, or only there cross.
  std::vector<Ring> parted_at_touching() {
    const UvBox box = box_of(ring_);
    const double near = 1e-9 * (box.hi.u - box.lo.u + box.hi.v - box.lo.v);
    std::vector<std::size_t> order(ring_.pieces.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto at = [&](std::size_t i) { return first_uv(ring_.pieces[i]); };
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return at(a).u != at(b).u ? at(a).u < at(b).u : at(a).v != at(b).v ? at(a).v < at(b).v : a < b;
    });
    Ring whole = ring_;
    for (std::size_t k = 1; k < order.size(); ++k) {
      if (!(norm(at(order[k]) - at(order[k - 1])) <= near)) continue;
      const int a = ring_.pieces[order[k - 1]].start, b = ring_.pieces[order[k]].start;
      joined_.push_back({a, b});
      crossed_.push_back(a);
    }
    if (crossed_.empty()) return {};
    const std::size_t said = draft_.steps.size();
    std::vector<Ring> out = parts();
    const bool any = std::any_of(out.begin(), out.end(), [](const Ring& r) {
      const UvBox b = box_of(r);
      return std::abs(area_of(r)) > 1e-3 * (b.hi.u - b.lo.u) * (b.hi.v - b.lo.v);
    });
    if (any) return out;
    draft_.steps.resize(said);  // there and back: it bounds nothing
    ring_ = std::move(whole);
    return {};
  }

  void cut(const std::vector<SelfCrossing>& crossings) {
    std::vector<std::vector<Cut>> cuts(ring_.pieces.size());
    for (const SelfCrossing& c : crossings) {
      const Piece& p = ring_.pieces[c.piece[0]];
      const int node = draft_.add_node(p.curve ? evaluate(*p.curve, curve_parameter(p, c.t[0])) : sheet_.point(c.at));
      crossed_.push_back(node);
      for (int k = 0; k < 2; ++k) cuts[c.piece[k]].push_back({c.t[k], node});
    }
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < ring_.pieces.size(); ++i) cut(std::move(ring_.pieces[i]), std::move(cuts[i]), pieces);
    ring_.pieces = std::move(pieces);
  }

  void cut(Piece piece, std::vector<Cut> cuts, std::vector<Piece>& out) {
    const bool up = piece.t0 < piece.t1;
    std::stable_sort(cuts.begin(), cuts.end(), [&](const Cut& a, const Cut& b) { return up ? a.t < b.t : a.t > b.t; });
    const double least = 1e-12 * std::abs(piece.t1 - piece.t0);
    for (const Cut& c : cuts) {
      if (std::abs(c.t - piece.t0) <= least) {
        joined_.push_back({piece.start, c.node});
      } else if (std::abs(c.t - piece.t1) <= least) {
        joined_.push_back({piece.end, c.node});
      } else {
        auto [before, after] = split(piece, c.t, c.node);
        out.push_back(std::move(before));
        piece = std::move(after);
      }
    }
    out.push_back(std::move(piece));
  }

  // Nodes of crossings at the end of a piece are the node of that joint.
  void join_nodes() {
    std::unordered_map<int, int> same;
    const auto top = [&](int node) {
      for (auto at = same.find(node); at != same.end(); at = same.find(node)) node = at->second;
      return node;
    };
    for (const auto& [a, b] : joined_)
      if (const int x = top(a), y = top(b); x != y) same[std::max(x, y)] = std::min(x, y);
    for (Piece& p : ring_.pieces) p.start = top(p.start), p.end = top(p.end);
    for (int& node : crossed_) node = top(node);
  }

  // At each crossing every strand goes on where the next one that passes there does.
  std::vector<Ring> parts() {
    join_nodes();
    std::unordered_map<int, std::vector<std::size_t>> passing;  // crossing -> pieces that end there
    for (const int node : crossed_) passing.try_emplace(node);
    const std::size_t n = ring_.pieces.size();
    std::vector<std::size_t> next(n);
    for (std::size_t i = 0; i < n; ++i) {
      next[i] = (i + 1) % n;
      if (const auto at = passing.find(ring_.pieces[i].end); at != passing.end()) at->second.push_back(i);
    }
    for (const auto& [node, ends] : passing)
      for (std::size_t k = 0; k < ends.size(); ++k) next[ends[k]] = (ends[(k + 1) % ends.size()] + 1) % n;
    std::vector<Ring> out;
    std::vector<bool> used(n, false);
    for (std::size_t first = 0; first < n; ++first) {
      if (used[first]) continue;
      std::vector<Piece> pieces;
      bool has_end = false;
      for (std::size_t i = first; !used[i]; i = next[i]) {
        used[i] = true;
        has_end = has_end || i + 1 == n;
        pieces.push_back(std::move(ring_.pieces[i]));
      }
      out.push_back(part(std::move(pieces)));
      if (has_end) out.back().turns_u = ring_.turns_u, out.back().turns_v = ring_.turns_v;
    }
    record(out);
    return out;
  }

  Ring part(std::vector<Piece> pieces) const {
    Ring r;
    r.pieces = std::move(pieces);
    r.loop = ring_.loop;
    r.claimed_outer = ring_.claimed_outer;
    r.is_joined = true;
    r.is_part = true;
    r.source = ring_.source;
    return r;
  }

  // All parts but the largest are named.
  void record(const std::vector<Ring>& parts) {
    std::vector<double> size;
    for (const Ring& r : parts) {
      Box box;
      for (const Piece& p : r.pieces)
        for (const Sample& s : p.samples) box.add(sheet_.point(s.uv));
      size.push_back(box.diagonal());
    }
    const auto largest = static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Piece* at = &parts[i].pieces.front();
      for (const Piece& p : parts[i].pieces)
        if (std::find(crossed_.begin(), crossed_.end(), p.start) != crossed_.end()) at = &p;
      if (i != largest)
        draft_.record(Step::LoopSplit, ring_.loop, at->segment, size[i], 0, draft_.nodes[static_cast<std::size_t>(at->start)].point, true);
    }
  }

  Draft& draft_;
  const Sheet& sheet_;
  Ring& ring_;
  std::vector<int> crossed_;                 // nodes
  std::vector<std::pair<int, int>> joined_;  // nodes that are one
};

}  // namespace

void uncross(Draft& draft) {
  std::vector<Ring> rings;
  for (Ring& ring : draft.rings) {
    std::vector<Ring> parts = Uncrosser(draft, ring).run();
    if (!draft.failure.empty()) return;
    if (parts.empty()) rings.push_back(std::move(ring));
    for (Ring& part : parts) rings.push_back(std::move(part));
  }
  draft.rings = std::move(rings);
}

}  // namespace trimloop::heal
