// Cutting a closed sheet open along one line, so that every ring becomes closed in parameter space.
//
// Rings are cut where they cross the line x = c (modulo the period). Going up the line, inside begins where a ring
// crosses in +x direction (inside is on its left) and ends where one crosses in -x direction; a pole may stand in for
// either end. Each inside interval is a seam: one edge, used upwards at x = c + period and downwards at x = c. Pieces
// between two crossings are strung together along these seams. This serves rings that wind around (two on a
// cylinder, one around a pole), rings that cross the seam of a surface that cannot be evaluated beyond it, and holes
// that do so. For cuts across u: x = u, y = v; for cuts across v: x = v, y = -u, which keeps orientation.

#include <algorithm>

#include "kernel/heal/run_tree.h"

namespace trimloop::heal {
namespace {

struct Arc {  // of a ring between two crossings of the line; in the strip [c, c + period]
  std::vector<Piece> pieces;
  int from = -1, to = -1;  // crossings
  int loop = -1;
};

struct Crossing {
  double y = 0;
  int sign = 0;        // +1 in x direction
  int node = -1;
  int arc_before = -1, arc_after = -1;
};

struct Seam {  // an inside interval of the line, from below to above; -1: a pole
  int from = -1, to = -1;
  double y_from = 0, y_to = 0;
  int node_from = -1, node_to = -1;
  int number = -1;
};

class Cutter {
 public:
  Cutter(Draft& draft, bool across_u) : draft_(draft), sheet_(draft.sheet), across_u_(across_u) {
    period_ = across_u ? sheet_.period_u() : sheet_.period_v();
    covers_ = across_u ? sheet_.covers_u() : sheet_.covers_v();
    const Interval range = across_u ? sheet_.domain().u : sheet_.domain().v;
    first_x_ = range.is_bounded() ? range.lo : 0;
  }

  bool is_needed() {
    if (!(period_ > 0)) return false;
    if (across_u_ ? draft_.whole_u : draft_.whole_v) return true;
    for (const Ring& ring : draft_.rings)
      if (turns(ring) != 0) return true;
    if (covers_) return false;
    bool needed = false;
    for (Ring& ring : draft_.rings) needed = !move_into_domain(ring) || needed;
    return needed;
  }

  void run() {
    for (const Ring& ring : draft_.rings)
      if (std::abs(turns(ring)) > 1 || (across_u_ ? ring.turns_v : ring.turns_u) != 0)
        return fail("a loop winds around the surface more than once");
    settle_winding_rings();
    if (!draft_.failure.empty()) return;
    choose_line();
    std::vector<Ring> rings = std::move(draft_.rings);
    draft_.rings.clear();
    for (Ring& ring : rings) {
      cut(ring);
      if (!draft_.failure.empty()) return;
    }
    find_seams();
    if (!draft_.failure.empty()) return;
    string_together();
    (across_u_ ? draft_.whole_u : draft_.whole_v) = false;
  }

 private:
  double x(Uv p) const { return across_u_ ? p.u : p.v; }
  double y(Uv p) const { return across_u_ ? p.v : -p.u; }
  Uv uv(double px, double py) const { return across_u_ ? Uv{px, py} : Uv{-py, px}; }
  int turns(const Ring& r) const { return across_u_ ? r.turns_u : r.turns_v; }
  void fail(const char* reason) { draft_.failure = reason; }
  double period_y() const { return across_u_ ? sheet_.period_v() : sheet_.period_u(); }

  // Slack in x that is below the tolerance in space.
  double slack(Uv at) const {
    Point p;
    Vector du, dv;
    sheet_.jet(at, p, du, dv);
    const double speed = norm(across_u_ ? du : dv);
    const double most = 1e-4 * period_;
    return speed > 0 ? std::clamp(draft_.tolerance_mm / speed, 1e-9 * period_, most) : most;
  }

  // False when the ring reaches over the border of the rectangle whatever turn it is put in.
  bool move_into_domain(Ring& ring) const {
    const UvBox box = box_of(ring);
    const double lo = x(box.lo), hi = x(box.hi), eps = slack(first_uv(ring.pieces[0]));
    const double k = std::floor((lo + eps - first_x_) / period_);
    if (hi - k * period_ > first_x_ + period_ + eps) return false;
    if (k != 0) move_by(ring, uv_shift(-k * period_));
    return true;
  }

  Uv uv_shift(double dx) const { return across_u_ ? Uv{dx, 0} : Uv{0, dx}; }
  Uv uv_shift_y(double dy) const { return across_u_ ? Uv{0, dy} : Uv{-dy, 0}; }

  const Pole* pole(bool top) const {
    for (const Pole& p : sheet_.poles()) {
      if (p.at_v != across_u_) continue;
      const Interval range = across_u_ ? sheet_.domain().v : sheet_.domain().u;
      const bool at_lo = p.value == range.lo;
      const bool is_top = across_u_ ? !at_lo : at_lo;  // y = -u turns the order
      if (is_top == top) return &p;
    }
    return nullptr;
  }

  double mean_y(const Ring& ring) const {
    double sum = 0;
    std::size_t count = 0;
    for (const Piece& p : ring.pieces)
      for (const Sample& s : p.samples) sum += y(s.uv), ++count;
    return sum / double(std::max<std::size_t>(1, count));
  }

  // Directions of the winding rings, from below: inside lies above +, below -. A single one is completed by a pole.
  void settle_winding_rings() {
    std::vector<Ring*> winding;
    for (Ring& ring : draft_.rings)
      if (turns(ring) != 0) winding.push_back(&ring);
    if (winding.empty()) return;
    std::stable_sort(winding.begin(), winding.end(), [&](Ring* a, Ring* b) { return mean_y(*a) < mean_y(*b); });
    const auto alternate = [&] {
      for (std::size_t i = 1; i < winding.size(); ++i)
        if (turns(*winding[i]) == turns(*winding[i - 1])) return false;
      return true;
    };
    const bool bottom = pole(false) != nullptr, top = pole(true) != nullptr, odd = winding.size() % 2 == 1;
    const int first = turns(*winding.front());
    const bool wraps = period_y() > 0;
    // What an alternating sequence that begins with this direction needs at either end of the line.
    const auto possible = [&](int begin) {
      const int last = odd ? begin : -begin;
      if (wraps) return !odd;
      return (begin > 0 || bottom) && (last < 0 || top);
    };
    int wanted = first;
    if (!(alternate() && possible(first) && (draft_.input.brep_sense || first > 0 || odd))) {
      if (possible(1) && !(odd && possible(-1))) wanted = 1;
      else if (possible(-1) && !possible(1)) wanted = -1;
      else if (!possible(first)) return add_missing_border(winding);
    }
    for (std::size_t i = 0; i < winding.size(); ++i, wanted = -wanted)
      if (turns(*winding[i]) != wanted) {
        turn_around(*winding[i]);
        if (winding[i]->loop >= 0)
          draft_.record(Step::LoopReoriented, winding[i]->loop, -1, 0, 0,
                        sheet_.point(first_uv(winding[i]->pieces[0])), false);
      }
    // Inside the other way around a torus: the lowest ring is also the next one above the highest.
    if (wraps && turns(*winding.front()) < 0) move_by(*winding.front(), uv_shift_y(period_y()));
  }

  // An odd number of rings and no pole: the border of the surface on the side that the direction names, if it has one.
  void add_missing_border(std::vector<Ring*>& winding) {
    const Interval range = across_u_ ? sheet_.domain().v : sheet_.domain().u;
    const bool to_top = turns(*winding.back()) > 0;
    const double border_y = across_u_ ? (to_top ? range.hi : range.lo) : (to_top ? -range.lo : -range.hi);
    if (!std::isfinite(border_y) || period_y() > 0 || winding.size() % 2 == 0)
      return fail("a loop winds around the surface and nothing bounds its other side");
    const double from = first_x_, to = first_x_ + period_;
    Ring border;
    border.pieces.push_back(to_top ? border_piece(sheet_, uv(to, border_y), uv(from, border_y))
                                   : border_piece(sheet_, uv(from, border_y), uv(to, border_y)));
    Piece& p = border.pieces.front();
    p.start = p.end = draft_.add_node(sheet_.point(first_uv(p)));
    (across_u_ ? border.turns_u : border.turns_v) = to_top ? -1 : 1;
    draft_.record(Step::OuterAdded, -1, -1, 0, 0, sheet_.point(first_uv(p)), true);
    int wanted = to_top ? 1 : -1;
    for (std::size_t i = winding.size(); i-- > 0; wanted = -wanted) {
      const std::size_t k = to_top ? i : winding.size() - 1 - i;
      if (turns(*winding[k]) != wanted) turn_around(*winding[k]);
    }
    draft_.rings.push_back(std::move(border));
  }

  // A line through a vertex of the winding rings that no other ring crosses; the seam where the surface has its own.
  void choose_line() {
    line_ = first_x_;
    if (!covers_) return;
    std::vector<double> candidates;
    constexpr std::size_t most = 64;
    for (const Ring& ring : draft_.rings)
      if (turns(ring) != 0)
        for (const Piece& p : ring.pieces)
          if (candidates.size() < most) candidates.push_back(x(first_uv(p)));
    candidates.push_back(first_x_);
    if (std::none_of(draft_.rings.begin(), draft_.rings.end(), [&](const Ring& r) { return turns(r) != 0; }))
      for (int i = 1; i < 16; ++i) candidates.push_back(first_x_ + period_ * i / 16);
    double best = infinity;
    for (double c : candidates) {
      double cost = 0;
      for (const Ring& ring : draft_.rings) cost += turns(ring) != 0 ? (has_vertex_at(ring, c) ? 0 : 1) : 1000 * crosses(ring, c);
      if (cost < best) best = cost, line_ = c;
    }
    line_ -= period_ * std::floor((line_ - first_x_) / period_ + 1e-12);
  }

  bool has_vertex_at(const Ring& ring, double c) const {
    const double eps = slack(first_uv(ring.pieces[0]));
    return std::any_of(ring.pieces.begin(), ring.pieces.end(), [&](const Piece& p) {
      return std::abs(std::remainder(x(first_uv(p)) - c, period_)) <= eps;
    });
  }

  bool crosses(const Ring& ring, double c) const {
    const UvBox box = box_of(ring);
    return std::floor((x(box.lo) - c) / period_) != std::floor((x(box.hi) - c) / period_);
  }

  // ---- Cutting rings into arcs

  double strip_of(double px) const { return (px - line_) / period_; }

  // Pieces that lie in one strip each. A sample within `eps` of a line is on it and belongs to either side.
  void cut_piece(Piece piece, double eps, std::vector<Piece>& out) {
    for (;;) {
      bool known = false;
      double strip = 0, t = 0, on_line_t = 0;
      bool found = false, have_on_line = false;
      for (std::size_t i = 0; i < piece.samples.size() && !found; ++i) {
        const Sample& s = piece.samples[i];
        const double z = strip_of(x(s.uv)), nearest = std::round(z);
        if (std::abs(z - nearest) <= eps) {
          have_on_line = i > 0;
          on_line_t = s.t;
          continue;
        }
        if (!known) {
          strip = std::floor(z), known = true;
        } else if (std::floor(z) != strip) {
          const double line = std::floor(z) > strip ? strip + 1 : strip;
          t = have_on_line ? on_line_t : crossing(piece, piece.samples[i - 1].t, s.t, line);
          found = true;
          break;
        }
        have_on_line = false;
      }
      if (!found || t == piece.t0 || t == piece.t1 || out.size() > most_pieces) break;
      const int node = draft_.add_node(piece.curve ? evaluate(*piece.curve, curve_parameter(piece, t))
                                                   : sheet_.point(uv_of(piece, t)));
      auto [before, after] = split(piece, t, node);
      out.push_back(std::move(before));
      piece = std::move(after);
    }
    out.push_back(std::move(piece));
  }

  double crossing(const Piece& p, double before, double after, double line) const {
    const bool below = strip_of(x(uv_of(p, before))) < line;
    for (int i = 0; i < 60; ++i) {
      const double mid = 0.5 * (before + after);
      if (mid == before || mid == after) break;
      ((strip_of(x(uv_of(p, mid))) < line) == below ? before : after) = mid;
    }
    return 0.5 * (before + after);
  }

  // The strip of a piece by its sample farthest from a line; nothing when all of it lies on one.
  std::optional<double> strip_of(const Piece& p, double eps) const {
    double best = eps, strip = 0;
    for (std::size_t i = 0; i < p.samples.size(); ++i) {
      for (const Uv s : {p.samples[i].uv, i > 0 ? 0.5 * (p.samples[i].uv + p.samples[i - 1].uv) : p.samples[i].uv}) {
        const double z = strip_of(x(s)), off = std::abs(z - std::round(z));
        if (off > best) best = off, strip = std::floor(z);
      }
    }
    return best > eps ? std::optional<double>(strip) : std::nullopt;
  }

  void cut(Ring& ring) {
    const double eps = slack(first_uv(ring.pieces[0])) / period_;
    std::vector<Piece> pieces;
    for (Piece& p : ring.pieces) cut_piece(std::move(p), eps, pieces);
    if (pieces.size() > most_pieces) return fail("a loop crosses the seam too often");
    const std::size_t n = pieces.size();
    std::vector<std::optional<double>> known(n);
    std::size_t first = n;
    for (std::size_t i = 0; i < n; ++i) {
      known[i] = strip_of(pieces[i], eps);
      if (known[i] && first == n) first = i;
    }
    if (first == n) return fail("a loop lies on the seam of the surface");
    // Pieces on a line belong with the one before them.
    std::vector<double> strip(n);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = (first + k) % n, before = (i + n - 1) % n;
      strip[i] = known[i] ? *known[i] : strip[before] - (i == 0 ? turns(ring) : 0);
    }
    std::vector<int> jump(n);  // at the end of piece i
    bool any = false;
    for (std::size_t i = 0; i < n; ++i) {
      const double next = i + 1 < n ? strip[i + 1] : strip[0] + turns(ring);
      jump[i] = static_cast<int>(next - strip[i]);
      if (std::abs(jump[i]) > 1) return fail("a loop jumps across the surface");
      any = any || jump[i] != 0;
    }
    for (std::size_t i = 0; i < n; ++i) move_by(pieces[i], uv_shift(-strip[i] * period_));
    if (!any) {
      ring.pieces = std::move(pieces);
      draft_.rings.push_back(std::move(ring));
      return;
    }
    make_arcs(ring.loop, pieces, jump);
  }

  void make_arcs(int loop, std::vector<Piece>& pieces, const std::vector<int>& jump) {
    const std::size_t n = pieces.size();
    std::size_t begin = 0;
    while (jump[begin] == 0) ++begin;
    const std::size_t first_crossing = crossings_.size();
    Arc arc;
    arc.loop = loop;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = (begin + 1 + k) % n;
      arc.pieces.push_back(std::move(pieces[i]));
      if (jump[i] == 0) continue;
      Crossing c;
      c.sign = jump[i];
      c.y = y(last_uv(arc.pieces.back()));
      c.node = arc.pieces.back().end;
      c.arc_before = static_cast<int>(arcs_.size());
      crossings_.push_back(c);
      arcs_.push_back(std::move(arc));
      arc = Arc{};
      arc.loop = loop;
    }
    // The arc after each crossing is the next one made, the first one again after the last.
    const std::size_t count = crossings_.size() - first_crossing, first_arc = arcs_.size() - count;
    for (std::size_t i = 0; i < count; ++i) {
      Crossing& c = crossings_[first_crossing + i];
      const std::size_t after = first_arc + (i + 1) % count;
      c.arc_after = static_cast<int>(after);
      arcs_[after].from = static_cast<int>(first_crossing + i);
      arcs_[first_arc + i].to = static_cast<int>(first_crossing + i);
    }
  }

  // ---- Seams

  void find_seams() {
    seam_at_.assign(crossings_.size(), -1);
    std::vector<int> order(crossings_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return at(a).y < at(b).y; });
    const bool whole = order.empty() && (across_u_ ? draft_.whole_u : draft_.whole_v);
    if (order.empty() && !whole) return;
    bool open = false;
    Seam seam;
    if (whole || at(order.front()).sign < 0) {
      if (!begin_at_pole(seam)) return;
      open = true;
    }
    for (int k : order) {
      const Crossing& c = at(k);
      if ((c.sign > 0) == open) return fail("loops cross each other at the seam of the surface");
      if (c.sign > 0) {
        seam = Seam{};
        seam.from = k, seam.y_from = c.y, seam.node_from = c.node;
        open = true;
      } else {
        seam.to = k, seam.y_to = c.y, seam.node_to = c.node;
        add_seam(seam);
        open = false;
      }
    }
    if (open) {
      const Pole* top = pole(true);
      if (!top) return fail("a loop winds around the surface and nothing bounds its upper side");
      seam.to = -1;
      seam.y_to = across_u_ ? top->value : -top->value;
      seam.node_to = draft_.add_node(top->point);
      add_seam(seam);
    }
  }

  bool begin_at_pole(Seam& seam) {
    const Pole* bottom = pole(false);
    if (!bottom) {
      fail("a loop winds around the surface and nothing bounds its lower side");
      return false;
    }
    seam = Seam{};
    seam.y_from = across_u_ ? bottom->value : -bottom->value;
    seam.node_from = draft_.add_node(bottom->point);
    return true;
  }

  const Crossing& at(int k) const { return crossings_[static_cast<std::size_t>(k)]; }

  void add_seam(Seam seam) {
    seam.number = draft_.seams++;
    const int index = static_cast<int>(seams_.size());
    if (seam.from >= 0) seam_at_[static_cast<std::size_t>(seam.from)] = index;
    if (seam.to >= 0) seam_at_[static_cast<std::size_t>(seam.to)] = index;
    seams_.push_back(seam);
    const int loop = seam.from >= 0 ? arcs_[static_cast<std::size_t>(at(seam.from).arc_before)].loop
                     : seam.to >= 0 ? arcs_[static_cast<std::size_t>(at(seam.to).arc_before)].loop
                                    : -1;
    draft_.record(Step::SeamInserted, loop, -1, 0, 0, draft_.nodes[static_cast<std::size_t>(seam.node_from)].point, false);
    for (bool top : {false, true})
      if ((top ? seam.to : seam.from) < 0)
        draft_.record(Step::PoleInserted, loop, -1, 0, 0,
                      draft_.nodes[static_cast<std::size_t>(top ? seam.node_to : seam.node_from)].point, false);
  }

  // ---- Stringing together

  Piece along(const Seam& s, bool up) const {
    const double px = up ? line_ + period_ : line_;
    Piece p = up ? border_piece(sheet_, uv(px, s.y_from), uv(px, s.y_to)) : border_piece(sheet_, uv(px, s.y_to), uv(px, s.y_from));
    p.start = up ? s.node_from : s.node_to;
    p.end = up ? s.node_to : s.node_from;
    p.seam = s.number;
    return p;
  }

  Piece around(const Seam& s, bool top) const {
    const double py = top ? s.y_to : s.y_from;
    Piece p = top ? straight_piece(uv(line_ + period_, py), uv(line_, py)) : straight_piece(uv(line_, py), uv(line_ + period_, py));
    p.is_pole = true;
    p.start = p.end = top ? s.node_to : s.node_from;
    return p;
  }

  // Follows seams from a crossing on until an arc begins there; its index. -1: back at the beginning without an arc.
  int follow_seam(int crossing, std::vector<Piece>& out) const {
    const Seam& s = seams_[static_cast<std::size_t>(seam_at_[static_cast<std::size_t>(crossing)])];
    if (at(crossing).sign > 0) {
      out.push_back(along(s, true));
      if (s.to >= 0) return at(s.to).arc_after;
      out.push_back(around(s, true));
      out.push_back(along(s, false));
      return at(s.from).arc_after;
    }
    out.push_back(along(s, false));
    if (s.from >= 0) return at(s.from).arc_after;
    out.push_back(around(s, false));
    out.push_back(along(s, true));
    return at(s.to).arc_after;
  }

  void string_together() {
    std::vector<bool> used(arcs_.size(), false);
    for (std::size_t i = 0; i < arcs_.size(); ++i) {
      if (used[i]) continue;
      Ring ring;
      ring.loop = arcs_[i].loop;
      ring.is_joined = true;
      for (std::size_t k = i; !used[k];) {
        used[k] = true;
        for (Piece& p : arcs_[k].pieces) ring.pieces.push_back(std::move(p));
        k = static_cast<std::size_t>(follow_seam(arcs_[k].to, ring.pieces));
      }
      draft_.rings.push_back(std::move(ring));
    }
    for (const Seam& s : seams_) {
      if (s.from >= 0 || s.to >= 0) continue;
      Ring ring;  // from pole to pole
      ring.is_joined = true;
      ring.pieces = {around(s, false), along(s, true), around(s, true), along(s, false)};
      draft_.rings.push_back(std::move(ring));
    }
  }

  static constexpr std::size_t most_pieces = 1'000'000;

  Draft& draft_;
  const Sheet& sheet_;
  bool across_u_;
  bool covers_ = false;
  double period_ = 0, first_x_ = 0, line_ = 0;
  std::vector<Arc> arcs_;
  std::vector<Crossing> crossings_;
  std::vector<Seam> seams_;
  std::vector<int> seam_at_;  // by crossing
};

}  // namespace

void cut_open(Draft& draft) {
  bool is_cut = false;
  for (const bool across_u : {true, false}) {
    Cutter cutter(draft, across_u);
    if (!cutter.is_needed()) continue;
    cutter.run();
    if (!draft.failure.empty()) return;
    is_cut = true;
  }
  if (!is_cut) return;
  for (Ring& ring : draft.rings) ring.area = area_of(ring);
  std::stable_sort(draft.rings.begin(), draft.rings.end(), [](const Ring& a, const Ring& b) { return a.area > b.area; });
  const RunTree outer = polygon_of(draft.rings.front());
  for (Ring& ring : draft.rings)
    if (ring.area < 0) bring_together(draft.sheet, outer, ring);
}

}  // namespace trimloop::heal
