// A ring that crosses itself is taken apart at its crossings into rings that do not: at each one the two strands change
// partners, so that no direction turns. What is inside is then decided as for any other rings (orient.cpp): by parity.

#include <fmt/format.h>

#include <algorithm>

#include "kernel/heal/parting.h"

namespace trimloop::heal {
namespace {

class Uncrosser {
 public:
  Uncrosser(Draft& draft, Ring& ring) : draft_(draft), sheet_(draft.sheet), ring_(ring) {}

  // The ring's parts; empty when it does not cross itself.
  std::vector<Ring> run() {
    const Crossings crossings = self_crossings(sheet_, ring_, draft_.tolerance_mm);
    if (crossings.found.size() > most_crossings) {
      const Point p = sheet_.point(crossings.found.front().at);
      draft_.failure = fmt::format("loop {} crosses itself at more than {} places, one of them ({:.6g}, {:.6g}, {:.6g})",
                                   ring_.loop + 1, most_crossings, p.x, p.y, p.z);
      return {};
    }
    if (!crossings.complete) draft_.record(Step::SearchEnded, ring_.loop, -1, 0, 0, sheet_.point(first_uv(ring_.pieces[0])), false);
    if (!crossings.found.empty()) return parts(cut_at(draft_, {ring_}, crossings.found));
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
    Strands strands = cut_at(draft_, {ring_}, {});
    std::vector<std::pair<int, int>> same;
    for (std::size_t k = 1; k < order.size(); ++k) {
      if (!(norm(at(order[k]) - at(order[k - 1])) <= near)) continue;
      const int a = ring_.pieces[order[k - 1]].start, b = ring_.pieces[order[k]].start;
      same.push_back({a, b});
      strands.crossed.push_back(a);
    }
    if (same.empty()) return {};
    join_nodes(strands, same);
    const std::size_t said = draft_.steps.size();
    std::vector<Ring> out = parts(std::move(strands));
    const bool any = std::any_of(out.begin(), out.end(), [](const Ring& r) {
      const UvBox b = box_of(r);
      return std::abs(area_of(r)) > 1e-3 * (b.hi.u - b.lo.u) * (b.hi.v - b.lo.v);
    });
    if (any) return out;
    draft_.steps.resize(said);  // there and back: it bounds nothing
    return {};
  }

  std::vector<Ring> parts(Strands strands) {
    std::vector<Ring> out;
    for (const std::vector<std::size_t>& cycle : strung(strands)) {
      std::vector<Piece> pieces;
      for (const std::size_t i : cycle) pieces.push_back(std::move(strands.pieces[i]));
      out.push_back(part(std::move(pieces)));
      if (std::find(cycle.begin(), cycle.end(), strands.pieces.size() - 1) != cycle.end())
        out.back().turns_u = ring_.turns_u, out.back().turns_v = ring_.turns_v;
    }
    record(out, strands.crossed);
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
  void record(const std::vector<Ring>& parts, const std::vector<int>& crossed) {
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
        if (std::find(crossed.begin(), crossed.end(), p.start) != crossed.end()) at = &p;
      if (i != largest)
        draft_.record(Step::LoopSplit, ring_.loop, at->segment, size[i], 0, draft_.nodes[static_cast<std::size_t>(at->start)].point, true);
    }
  }

  Draft& draft_;
  const Sheet& sheet_;
  Ring& ring_;
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
