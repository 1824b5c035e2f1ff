// Loops of one face that cross each other. Inside is what lies inside more outer loops than holes: a hole over the border
// takes away what it covers, holes that overlap take away both, outer loops that overlap add up. The loops are strung together
// anew so that they bound just that.

#include <fmt/format.h>

#include <algorithm>

#include "kernel/heal/parting.h"
#include "kernel/heal/run_tree.h"

namespace trimloop::heal {
namespace {

class Parter {
 public:
  explicit Parter(Draft& draft) : draft_(draft), sheet_(draft.sheet) {}

  void run() {
    const Crossings crossings = mutual_crossings(sheet_, draft_.rings);
    if (crossings.found.size() > most_crossings) {
      const Point p = sheet_.point(crossings.found.front().at);
      draft_.failure = fmt::format("loops cross each other at more than {} places, one of them ({:.6g}, {:.6g}, {:.6g})", most_crossings,
                                   p.x, p.y, p.z);
      return;
    }
    if (!crossings.complete) draft_.record(Step::SearchEnded, -1, -1, 0, 0, sheet_.point(first_uv(draft_.rings[0].pieces[0])), false);
    if (crossings.found.empty()) return;
    const std::vector<bool> crosses = rings_of(crossings);
    std::vector<Ring> others, crossing;
    for (std::size_t r = 0; r < draft_.rings.size(); ++r) (crosses[r] ? crossing : others).push_back(draft_.rings[r]);
    std::vector<Ring> made = strung_anew(crossing, mutual_crossings(sheet_, crossing));
    const std::size_t given = crossing.size();
    others.insert(others.end(), std::make_move_iterator(made.begin()), std::make_move_iterator(made.end()));
    std::vector<bool> kept;
    if (!decide(others, kept, others.size() - made.size())) return;  // too little to be seen: they touch
    std::vector<Ring> rings;
    for (std::size_t r = 0; r < others.size(); ++r)
      if (kept[r]) rings.push_back(std::move(others[r]));
    if (rings.empty()) {
      draft_.failure = fmt::format("its {} loops that cross each other leave nothing of the surface", given);
      draft_.bounds_nothing = true;
      return;
    }
    for (Ring& ring : rings) ring.area = area_of(ring);
    std::stable_sort(rings.begin(), rings.end(), [](const Ring& a, const Ring& b) { return a.area > b.area; });
    draft_.rings = std::move(rings);
  }

 private:
  std::vector<bool> rings_of(const Crossings& crossings) const {
    std::vector<std::size_t> ring_of_piece;
    for (std::size_t r = 0; r < draft_.rings.size(); ++r) ring_of_piece.resize(ring_of_piece.size() + draft_.rings[r].pieces.size(), r);
    std::vector<bool> crosses(draft_.rings.size(), false);
    for (const Crossing& c : crossings.found) crosses[ring_of_piece[c.piece[0]]] = crosses[ring_of_piece[c.piece[1]]] = true;
    return crosses;
  }

  std::vector<Ring> strung_anew(const std::vector<Ring>& rings, const Crossings& crossings) {
    Strands strands = cut_at(draft_, rings, crossings.found);
    std::vector<Ring> out;
    for (const std::vector<std::size_t>& cycle : strung(strands)) {
      const Ring& first = rings[strands.ring[cycle.front()]];
      Ring ring;
      ring.loop = first.loop;
      ring.source = first.source;
      ring.is_joined = ring.is_part = true;
      for (const std::size_t i : cycle) ring.pieces.push_back(std::move(strands.pieces[i]));
      out.push_back(std::move(ring));
    }
    return out;
  }

  // Which rings have the inside on their left and the outside on their right. False when all that falls away is too slim
  // to be seen; `first_new` and those after it were strung anew.
  bool decide(const std::vector<Ring>& rings, std::vector<bool>& kept, std::size_t first_new) {
    std::vector<RunTree> polygons;
    for (const Ring& ring : rings) polygons.push_back(polygon_of(ring));
    bool is_visible = false;
    for (std::size_t r = 0; r < rings.size(); ++r) {
      const double area = area_of(rings[r]);
      const Uv at = middle_of_longest(rings[r]);
      int around = 0;  // outer loops less holes
      for (std::size_t k = 0; k < rings.size(); ++k)
        if (k != r && polygons[k].is_inside(at)) around += area_of(rings[k]) > 0 ? 1 : -1;
      kept.push_back(area > 0 ? around == 0 : around == 1);
      if (kept.back()) continue;
      const double width = width_mm(rings[r], area);
      is_visible = is_visible || width > draft_.tolerance_mm;
      if (r < first_new) continue;  // lies in what fell away
      fallen_.push_back({r, width});
    }
    if (!is_visible && !fallen_.empty()) return false;
    if (fallen_.empty()) fallen_.push_back({first_new, 0});
    for (const auto& [r, width] : fallen_) {
      Box box;
      for (const Piece& p : rings[r].pieces)
        for (const Sample& s : p.samples) box.add(sheet_.point(s.uv));
      const Piece& at = rings[r].pieces.front();
      draft_.record(Step::LoopsParted, rings[r].loop, at.segment, width > 0 ? box.diagonal() : 0, 0,
                    draft_.nodes[static_cast<std::size_t>(at.start)].point, true);
    }
    return true;
  }

  static Uv middle_of_longest(const Ring& ring) {
    double longest = -1;
    Uv middle;
    for (const Piece& p : ring.pieces)
      for (std::size_t i = 0; i + 1 < p.samples.size(); ++i)
        if (const double l = norm(p.samples[i + 1].uv - p.samples[i].uv); l > longest)
          longest = l, middle = 0.5 * (p.samples[i].uv + p.samples[i + 1].uv);
    return middle;
  }

  // Twice the area over the length of the border.
  double width_mm(const Ring& ring, double area) const {
    const UvBox box = box_of(ring);
    Point p;
    Vector du, dv;
    sheet_.jet(0.5 * (box.lo + box.hi), p, du, dv);
    double length = 0;
    for (const Piece& piece : ring.pieces)
      for (std::size_t i = 0; i + 1 < piece.samples.size(); ++i) length += sheet_.millimetres(piece.samples[i].uv, piece.samples[i + 1].uv);
    return length > 0 ? 2 * std::abs(area) * norm(cross(du, dv)) / length : 0;
  }

  Draft& draft_;
  const Sheet& sheet_;
  std::vector<std::pair<std::size_t, double>> fallen_;  // rings strung anew that bound nothing, and their widths
};

}  // namespace

void part_loops(Draft& draft) {
  if (draft.rings.size() > 1) Parter(draft).run();
}

}  // namespace trimloop::heal
