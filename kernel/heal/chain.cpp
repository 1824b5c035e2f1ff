// Order and direction of the pieces of a ring. Most files have them right, which is seen from two points a piece;
// otherwise pieces are first turned where they stand, and only if that does not close the ring put in another order.

#include "kernel/heal/draft.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace trimloop::heal {
namespace {

// An end of a piece: its point in mm, and its parameters with a little weight, which tells the two sides of a seam apart.
using Place = std::array<double, 5>;

double distance_of(const Place& a, const Place& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

// Nearest unused place; places are taken out one by one. Balanced by construction, so a query costs about log n.
class PlaceTree {
 public:
  explicit PlaceTree(const std::vector<Place>& places) : places_(places), order_(places.size()), alive_(places.size(), 0) {
    for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = static_cast<std::uint32_t>(i);
    where_.resize(places.size());
    build(0, order_.size(), 0);
    for (std::size_t i = 0; i < order_.size(); ++i) where_[order_[i]] = i;
    dead_.assign(places.size(), false);
  }

  void remove(std::size_t place) {
    dead_[place] = true;
    std::size_t lo = 0, hi = order_.size();
    while (lo < hi) {
      const std::size_t mid = (lo + hi) / 2;
      --alive_[mid];
      if (where_[place] == mid) return;
      (where_[place] < mid ? hi : lo) = where_[place] < mid ? mid : mid + 1;
    }
  }

  // order_.size() when none is left.
  std::size_t nearest(const Place& p) const {
    std::size_t best = order_.size();
    double best_distance = infinity;
    search(0, order_.size(), 0, p, best, best_distance);
    return best;
  }

 private:
  static constexpr std::size_t axes = std::tuple_size_v<Place>;

  void build(std::size_t lo, std::size_t hi, std::size_t depth) {  // recursion: log2 of the number of places
    if (lo >= hi) return;
    const std::size_t mid = (lo + hi) / 2, axis = depth % axes;
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(lo), at(mid), at(hi), [&](std::uint32_t a, std::uint32_t b) {
      return places_[a][axis] != places_[b][axis] ? places_[a][axis] < places_[b][axis] : a < b;
    });
    alive_[mid] = static_cast<std::uint32_t>(hi - lo);
    build(lo, mid, depth + 1);
    build(mid + 1, hi, depth + 1);
  }

  void search(std::size_t lo, std::size_t hi, std::size_t depth, const Place& p, std::size_t& best,
              double& best_distance) const {
    if (lo >= hi) return;
    const std::size_t mid = (lo + hi) / 2;
    if (alive_[mid] == 0 || best_distance == 0) return;
    const std::size_t here = order_[mid];
    if (!dead_[here]) {
      const double d = distance_of(p, places_[here]);
      if (d < best_distance || (d == best_distance && here < best)) best = here, best_distance = d;
    }
    const double side = p[depth % axes] - places_[here][depth % axes];
    const bool left_first = side < 0;
    for (int k = 0; k < 2; ++k) {
      const bool left = (k == 0) == left_first;
      if (k == 1 && std::abs(side) > best_distance) return;
      left ? search(lo, mid, depth + 1, p, best, best_distance) : search(mid + 1, hi, depth + 1, p, best, best_distance);
    }
  }

  const std::vector<Place>& places_;
  std::vector<std::uint32_t> order_, alive_;
  std::vector<std::size_t> where_;
  std::vector<bool> dead_;
};

struct Walk {  // pieces in order, each along or against its own direction
  std::vector<std::uint32_t> piece;
  std::vector<bool> turned;
};

class Chainer {
 public:
  Chainer(Draft& draft, Ring& ring) : draft_(draft), sheet_(draft.sheet), ring_(ring) {}

  void run() {
    if (ring_.pieces.size() < 2) return;
    find_places();
    const Walk given = as_given();
    if (largest_gap(given) <= draft_.tolerance_mm) return;
    remove_duplicates();
    Walk best = as_given();
    double length = length_of(best);
    const auto take_if_better = [&](Walk walk) {
      const double l = length_of(walk);
      // Half of it at least: a loop with honest gaps is not shuffled for a small gain.
      if (l < 0.5 * length) best = std::move(walk), length = l;
    };
    take_if_better(turned_in_place());
    if (largest_gap(best) > draft_.tolerance_mm) take_if_better(reordered());
    apply(best);
  }

 private:
  std::size_t count() const { return ring_.pieces.size(); }

  // Places 2 i and 2 i + 1 are the start and the end of piece i.
  void find_places() {
    const UvBox box = box_of(ring_);
    const double size = sheet_.millimetres(box.lo, box.hi);
    const double weight_u = 1e-3 * size / std::max(box.hi.u - box.lo.u, 1e-300);
    const double weight_v = 1e-3 * size / std::max(box.hi.v - box.lo.v, 1e-300);
    places_.clear();
    for (const Piece& p : ring_.pieces)
      for (const Uv uv : {first_uv(p), last_uv(p)}) {
        const Point q = sheet_.point(uv);
        places_.push_back({q.x, q.y, q.z, weight_u * uv.u, weight_v * uv.v});
      }
  }

  Walk as_given() const {
    Walk w;
    for (std::uint32_t i = 0; i < count(); ++i) w.piece.push_back(i);
    w.turned.assign(count(), false);
    return w;
  }

  const Place& start_of(std::uint32_t piece, bool turned) const { return places_[2 * piece + turned]; }
  const Place& end_of(std::uint32_t piece, bool turned) const { return places_[2 * piece + !turned]; }

  // In space only: a loop given in order may jump in parameters, over a seam or at a pole.
  static double space_gap(const Place& a, const Place& b) {
    return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
  }

  template <class F>
  void each_joint(const Walk& w, const F& f) const {
    for (std::size_t i = 0; i < w.piece.size(); ++i) {
      const std::size_t next = (i + 1) % w.piece.size();
      f(end_of(w.piece[i], w.turned[i]), start_of(w.piece[next], w.turned[next]));
    }
  }
  double largest_gap(const Walk& w) const {
    double gap = 0;
    each_joint(w, [&](const Place& a, const Place& b) { gap = std::max(gap, space_gap(a, b)); });
    return gap;
  }
  double length_of(const Walk& w) const {
    double sum = 0;
    each_joint(w, [&](const Place& a, const Place& b) { sum += space_gap(a, b); });
    return sum;
  }

  // The best directions in the given order: shortest path over two states a piece, for either direction of the first.
  Walk turned_in_place() const {
    Walk best;
    double best_length = infinity;
    for (const bool first : {false, true}) {
      std::vector<std::array<bool, 2>> from(count());
      std::array<double, 2> cost{first ? infinity : 0.0, first ? 0.0 : infinity};
      for (std::uint32_t i = 1; i < count(); ++i) {
        std::array<double, 2> next{infinity, infinity};
        for (const bool a : {false, true})
          for (const bool b : {false, true}) {
            const double c = cost[a] + distance_of(end_of(i - 1, a), start_of(i, b));
            if (c < next[b]) next[b] = c, from[i][b] = a;
          }
        cost = next;
      }
      const auto last = static_cast<std::uint32_t>(count() - 1);
      for (const bool b : {false, true}) {
        const double whole = cost[b] + distance_of(end_of(last, b), start_of(0, first));
        if (!(whole < best_length)) continue;
        best_length = whole;
        best = as_given();
        bool state = b;
        for (std::size_t i = count(); i-- > 0;) {
          best.turned[i] = state;
          if (i > 0) state = from[i][state];
        }
      }
    }
    return best.piece.empty() ? as_given() : best;
  }

  Walk reordered() const {
    PlaceTree tree(places_);
    Walk w;
    std::uint32_t here = 0;
    bool turned = false;
    for (;;) {
      w.piece.push_back(here);
      w.turned.push_back(turned);
      tree.remove(2 * here);
      tree.remove(2 * here + 1);
      const std::size_t next = tree.nearest(end_of(here, turned));
      if (next >= places_.size()) return w;
      here = static_cast<std::uint32_t>(next / 2);
      turned = next % 2 == 1;
    }
  }

  // Pieces drawn twice between the same parameters. Only asked when the loop does not chain.
  void remove_duplicates() {
    std::vector<std::uint32_t> order(count());
    for (std::uint32_t i = 0; i < count(); ++i) order[i] = i;
    const auto middle = [&](std::uint32_t i) {
      const Piece& p = ring_.pieces[i];
      return uv_of(p, 0.5 * (p.t0 + p.t1));
    };
    std::vector<Uv> middles(count());
    for (std::uint32_t i = 0; i < count(); ++i) middles[i] = middle(i);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      const Uv p = middles[a], q = middles[b];
      return p.u != q.u ? p.u < q.u : p.v != q.v ? p.v < q.v : a < b;
    });
    std::vector<bool> repeated(count(), false);
    for (std::size_t k = 1; k < order.size(); ++k) {
      const std::uint32_t a = order[k - 1], b = order[k];
      const bool same_ends = distance_of(places_[2 * a], places_[2 * b]) <= rounding_ &&
                             distance_of(places_[2 * a + 1], places_[2 * b + 1]) <= rounding_;
      const bool swapped_ends = distance_of(places_[2 * a], places_[2 * b + 1]) <= rounding_ &&
                                distance_of(places_[2 * a + 1], places_[2 * b]) <= rounding_;
      if (!repeated[a] && (same_ends || swapped_ends) && sheet_.millimetres(middles[a], middles[b]) <= rounding_)
        repeated[b] = true;
    }
    std::vector<Piece> kept;
    for (std::uint32_t i = 0; i < count(); ++i) {
      if (!repeated[i]) {
        kept.push_back(std::move(ring_.pieces[i]));
      } else {
        draft_.record(Step::DuplicateRemoved, ring_.loop, ring_.pieces[i].segment, 0, 0,
                      sheet_.point(first_uv(ring_.pieces[i])), true);
      }
    }
    if (kept.size() == ring_.pieces.size()) {
      ring_.pieces = std::move(kept);
      return;
    }
    ring_.pieces = std::move(kept);
    find_places();
  }

  void apply(const Walk& w) {
    bool reordered = false;
    for (std::size_t i = 0; i < w.piece.size(); ++i) reordered = reordered || w.piece[i] != i;
    std::vector<Piece> chained;
    for (std::size_t i = 0; i < w.piece.size(); ++i) {
      chained.push_back(std::move(ring_.pieces[w.piece[i]]));
      if (!w.turned[i]) continue;
      turn_around(chained.back());
      draft_.record(Step::SegmentReversed, ring_.loop, chained.back().segment, 0, 0,
                    sheet_.point(first_uv(chained.back())), true);
    }
    ring_.pieces = std::move(chained);
    if (reordered)
      draft_.record(Step::SegmentsReordered, ring_.loop, -1, 0, 0, sheet_.point(first_uv(ring_.pieces[0])), true);
  }

  Draft& draft_;
  const Sheet& sheet_;
  Ring& ring_;
  std::vector<Place> places_;
  const double rounding_ = 1e-3 * draft_.tolerance_mm;
};

}  // namespace

void chain(Draft& draft, Ring& ring) { Chainer(draft, ring).run(); }

}  // namespace trimloop::heal
