// Which side of each ring is inside. Outer rings end up counter-clockwise, holes clockwise, and all rings of a face
// in the same turn of the cover. What the file claims about outer and inner is not believed; where it promises
// directions (brep_sense) they matter only where nothing else can tell: on surfaces without a border.

#include <algorithm>

#include "kernel/heal/run_tree.h"

namespace trimloop::heal {
namespace {

bool winds(const Ring& r) { return r.turns_u != 0 || r.turns_v != 0; }

double length_mm(const Sheet& sheet, const Ring& ring) {
  double sum = 0;
  for (const Piece& p : ring.pieces) {
    const std::size_t step = std::max<std::size_t>(1, (p.samples.size() - 1) / 4);
    Point before = sheet.point(p.samples.front().uv);
    for (std::size_t i = step; i < p.samples.size(); i += step) {
      const Point here = sheet.point(p.samples[i].uv);
      sum += distance(before, here);
      before = here;
    }
  }
  return sum;
}

class Orienter {
 public:
  explicit Orienter(Draft& draft) : draft_(draft), sheet_(draft.sheet) {}

  void run() {
    drop_empty_rings();
    if (!draft_.failure.empty()) return;
    add_outside();
    if (!draft_.failure.empty()) return;
    nest();
  }

 private:
  // A ring that goes there and back bounds nothing: its mean width is far below what the file resolves.
  void drop_empty_rings() {
    std::vector<Ring> kept;
    const bool had_rings = !draft_.rings.empty();
    for (Ring& ring : draft_.rings) {
      if (winds(ring)) {
        kept.push_back(std::move(ring));
        continue;
      }
      ring.area = area_of(ring);
      if (is_empty(ring)) {
        const Point at = sheet_.point(first_uv(ring.pieces[0]));
        draft_.record(Step::LoopDropped, ring.loop, -1, std::abs(ring.area), 0, at, true);
        continue;
      }
      kept.push_back(std::move(ring));
    }
    draft_.rings = std::move(kept);
    if (!had_rings || !draft_.rings.empty()) return;
    draft_.failure = "no loop encloses an area";
    draft_.bounds_nothing = true;
  }

  bool is_empty(const Ring& ring) const {
    const UvBox box = box_of(ring);
    const double rectangle = (box.hi.u - box.lo.u) * (box.hi.v - box.lo.v);
    if (std::abs(ring.area) > 1e-3 * rectangle) return !std::isfinite(ring.area);
    if (!(std::abs(ring.area) > 1e-14 * rectangle)) return true;
    // Slim: the width in mm decides.
    Point p;
    Vector du, dv;
    sheet_.jet(0.5 * (box.lo + box.hi), p, du, dv);
    const double mm2 = std::abs(ring.area) * norm(cross(du, dv)), length = length_mm(sheet_, ring);
    return mm2 > 0 && 2 * mm2 < 1e-3 * draft_.tolerance_mm * length;
  }

  // A closed surface of which every ring cuts something out: the file's direction says so.
  void add_outside() {
    if (!draft_.input.brep_sense || draft_.rings.empty() || draft_.input.outer_is_domain || !is_closed()) return;
    for (const Ring& ring : draft_.rings)
      if (winds(ring) || ring.area > 0) return;
    for (Ring& ring : draft_.rings)
      if (take_other_side(ring)) return;
    draft_.record(Step::OuterAdded, -1, -1, 0, 0, {}, false);
    add_natural_boundary(draft_);
  }

  // A clockwise ring over both poles: counter-clockwise it encloses the rest of the surface, when one of its two ways from
  // pole to pole is drawn a turn further on. As a hole it would lie along the seam and the poles of the whole surface.
  bool take_other_side(Ring& ring) {
    struct Visit {
      std::size_t before, after;  // pieces that are no poles
    };
    const std::size_t n = ring.pieces.size();
    const auto pole_of = [&](Uv uv) { return sheet_.pole_at(uv, sheet_.point(uv), draft_.tolerance_mm); };
    std::vector<Visit> visits;
    for (std::size_t i = 0; i < n; ++i) {
      if (ring.pieces[i].is_pole) continue;
      std::size_t next = (i + 1) % n;
      while (ring.pieces[next].is_pole) next = (next + 1) % n;
      const Pole* pole = pole_of(last_uv(ring.pieces[i]));
      if (pole && pole == pole_of(first_uv(ring.pieces[next]))) visits.push_back({i, next});
    }
    if (visits.size() != 2) return false;
    const Pole *one = pole_of(last_uv(ring.pieces[visits[0].before])), *two = pole_of(last_uv(ring.pieces[visits[1].before]));
    const double period = one->at_v ? sheet_.period_u() : sheet_.period_v();
    if (one == two || one->at_v != two->at_v || !(period > 0)) return false;
    const auto way = [&](const Visit& from, const Visit& to) {
      std::vector<Piece> pieces;
      for (std::size_t i = from.after;; i = (i + 1) % n) {
        pieces.push_back(ring.pieces[i]);
        if (i == to.before) return pieces;
      }
    };
    const auto pole_between = [](const Piece& before, const Piece& after) {
      Piece p = straight_piece(last_uv(before), first_uv(after));
      p.is_pole = true;
      p.start = p.end = before.end;
      return p;
    };
    for (const double by : {period, -period}) {
      Ring other = ring;
      other.pieces = way(visits[0], visits[1]);
      for (Piece& p : other.pieces) move_by(p, one->at_v ? Uv{by, 0} : Uv{0, by});
      const std::vector<Piece> back = way(visits[1], visits[0]);
      other.pieces.push_back(pole_between(other.pieces.back(), back.front()));
      other.pieces.insert(other.pieces.end(), back.begin(), back.end());
      other.pieces.push_back(pole_between(other.pieces.back(), other.pieces.front()));
      other.pieces.back().end = other.pieces.front().start;
      other.area = area_of(other);
      if (!(other.area > 0)) continue;
      ring = std::move(other);
      return true;
    }
    return false;
  }

  bool is_closed() const {
    const SurfaceDomain& d = sheet_.domain();
    const bool u = sheet_.period_u() > 0 || (d.pole_u_lo && d.pole_u_hi);
    const bool v = sheet_.period_v() > 0 || (d.pole_v_lo && d.pole_v_hi);
    return u && v;
  }

  // Largest first; each ring is in or out of the ones before it.
  void nest() {
    std::vector<Ring> winding, order;
    for (Ring& ring : draft_.rings) (winds(ring) ? winding : order).push_back(std::move(ring));
    for (Ring& ring : order) ring.area = area_of(ring);
    std::stable_sort(order.begin(), order.end(),
                     [](const Ring& a, const Ring& b) { return std::abs(a.area) > std::abs(b.area); });
    if (order.size() > 1 && (sheet_.period_u() > 0 || sheet_.period_v() > 0)) {
      const RunTree outer = polygon_of(order[0]);
      for (std::size_t i = 1; i < order.size(); ++i) bring_together(sheet_, outer, order[i]);
    }
    // Between winding rings, or on a whole closed sheet, everything else is a hole.
    const int base = !winding.empty() || draft_.whole_u || draft_.whole_v ? 1 : 0;
    const std::vector<int> depths = depths_of(order);
    for (std::size_t i = 0; i < order.size(); ++i) {
      Ring& ring = order[i];
      const int depth = base + depths[i];
      if (depth == 0 && i > 0 && order[0].claimed_outer && !ring.claimed_outer && !draft_.input.brep_sense)
        draft_.record(Step::Misplaced, ring.loop, -1, 0, 0, sheet_.point(first_uv(ring.pieces[0])), false);
      const bool outer = depth % 2 == 0;
      if ((ring.area > 0) == outer) continue;
      turn_around(ring);
      if (ring.loop >= 0 && !ring.is_part)
        draft_.record(Step::LoopReoriented, ring.loop, -1, 0, 0, sheet_.point(first_uv(ring.pieces[0])), false);
    }
    draft_.rings = std::move(order);
    for (Ring& ring : winding) draft_.rings.push_back(std::move(ring));
  }

  // In how many of the rings before it each one lies. Only rings whose boxes meet are asked: a sweep along u.
  std::vector<int> depths_of(const std::vector<Ring>& order) {
    const std::size_t n = order.size();
    std::vector<UvBox> boxes(n);
    std::vector<std::optional<RunTree>> polygons(n);
    std::vector<std::size_t> by_u(n), open;
    for (std::size_t i = 0; i < n; ++i) boxes[i] = box_of(order[i]), by_u[i] = i;
    std::stable_sort(by_u.begin(), by_u.end(), [&](std::size_t a, std::size_t b) { return boxes[a].lo.u < boxes[b].lo.u; });
    std::vector<int> depths(n, 0);
    std::vector<bool> touches(n, false);
    for (const std::size_t i : by_u) {
      std::erase_if(open, [&](std::size_t k) { return boxes[k].hi.u < boxes[i].lo.u; });
      for (const std::size_t k : open) {
        if (!overlap(boxes[k], boxes[i])) continue;
        const std::size_t larger = std::min(i, k), smaller = std::max(i, k);
        if (!polygons[larger]) polygons[larger].emplace(polygon_of(order[larger]));
        const Share in = share_inside(*polygons[larger], order[smaller]);
        depths[smaller] += in.inside > 0 && in.inside < in.all ? takes_away(order[larger], order[smaller], in) : 2 * in.inside > in.all;
        if ((in.inside > 0 && in.inside < in.all) || is_same(boxes[larger], boxes[smaller], order[larger], order[smaller]))
          touches[smaller] = true;
      }
      open.push_back(i);
    }
    for (std::size_t i = 0; i < n; ++i)
      if (touches[i])
        draft_.record(Step::SelfTouching, order[i].loop, -1, 0, 0, sheet_.point(first_uv(order[i].pieces[0])), false);
    return depths;
  }

  // Of two rings that cross, whether the smaller one is a hole: the file's directions say so, or its outer loop; else where
  // the larger part of it lies.
  struct Share {
    int inside = 0, all = 0;
  };
  bool takes_away(const Ring& larger, const Ring& smaller, Share in) const {
    if (larger.is_part || smaller.is_part) return 2 * in.inside > in.all;
    if (draft_.input.brep_sense) return (larger.area > 0) != (smaller.area > 0);
    if (larger.claimed_outer != smaller.claimed_outer) return true;
    return 2 * in.inside > in.all;
  }

  // One loop given twice: its points lie on the other, which tells neither in nor out.
  static bool is_same(const UvBox& a, const UvBox& b, const Ring& one, const Ring& two) {
    const double width = a.hi.u - a.lo.u, height = a.hi.v - a.lo.v;
    const auto near = [](double x, double y, double size) { return std::abs(x - y) <= 1e-9 * size; };
    return near(a.lo.u, b.lo.u, width) && near(a.hi.u, b.hi.u, width) && near(a.lo.v, b.lo.v, height) &&
           near(a.hi.v, b.hi.v, height) && near(std::abs(one.area), std::abs(two.area), width * height);
  }

  // By a few points: rings that touch or cross answer differently at different ones.
  static Share share_inside(const RunTree& outer, const Ring& inner) {
    constexpr std::size_t asked = 5;
    std::size_t count = 0;
    for (const Piece& p : inner.pieces) count += p.samples.size() - 1;
    const std::size_t stride = std::max<std::size_t>(1, count / asked);
    Share share;
    std::size_t index = 0;
    for (const Piece& p : inner.pieces)
      for (std::size_t i = 0; i + 1 < p.samples.size(); ++i, ++index) {
        if (index % stride != 0) continue;
        ++share.all;
        share.inside += outer.is_inside(0.5 * (p.samples[i].uv + p.samples[i + 1].uv));
      }
    return share;
  }

  Draft& draft_;
  const Sheet& sheet_;
};

}  // namespace

void bring_together(const Sheet& sheet, const RunTree& outer, Ring& ring) {
  const double pu = sheet.period_u(), pv = sheet.period_v();
  if (pu == 0 && pv == 0) return;
  const Piece& piece = ring.pieces[0];
  const Uv at = 0.5 * (piece.samples[0].uv + piece.samples[1].uv);
  if (outer.is_inside(at)) return;
  const UvBox box = box_of(ring), around = outer.box();
  const Uv middle = 0.5 * (around.lo + around.hi) - 0.5 * (box.lo + box.hi);
  const double a = pu > 0 ? std::round(middle.u / pu) : 0, b = pv > 0 ? std::round(middle.v / pv) : 0;
  for (const int i : {0, -1, 1})
    for (const int j : {0, -1, 1}) {
      if ((i != 0 && pu == 0) || (j != 0 && pv == 0)) continue;
      const Uv shift{(a + i) * pu, (b + j) * pv};
      if (outer.is_inside(at + shift)) return move_by(ring, shift);
    }
}

void orient(Draft& draft) { Orienter(draft).run(); }

}  // namespace trimloop::heal
