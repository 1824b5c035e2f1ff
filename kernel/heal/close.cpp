// From pieces in order to a ring without gaps: every piece in the same turn of the cover as the one before it, poles
// and gaps bridged by pieces of their own, one node per joint.

#include "kernel/heal/draft.h"

namespace trimloop::heal {
namespace {

struct Joint {
  Uv from, to;       // end of one piece, start of the next
  Point p, q;        // their points
  bool at_pole = false;
};

double nearest_turn(double from, double to, double period) {
  return period > 0 ? std::round((from - to) / period) : 0;
}

// At a pole the free parameter may jump; only more than a whole period is folded back.
double pole_turn(double from, double to, double period) {
  return period > 0 && std::abs(from - to) > period * (1 + 1e-9) ? std::round((from - to) / period) : 0;
}

class Closer {
 public:
  Closer(Draft& draft, Ring& ring) : draft_(draft), sheet_(draft.sheet), ring_(ring) {}

  void run() {
    find_points();
    if (!unwrap() || !restore_sides()) count_turns();
    if (std::abs(ring_.turns_u) > 1 || std::abs(ring_.turns_v) > 1) turn_closed_piece();
    part_at_poles();
    join();
  }

 private:
  // 1. Points of the ends on the surface: two evaluations a piece.
  void find_points() {
    for (const Piece& p : ring_.pieces) {
      first_.push_back(sheet_.point(first_uv(p)));
      last_.push_back(sheet_.point(last_uv(p)));
    }
  }

  const Pole* common_pole(std::size_t i, std::size_t next) const {
    if (sheet_.poles().empty()) return nullptr;
    const Pole* a = sheet_.pole_at(last_uv(ring_.pieces[i]), last_[i], draft_.tolerance_mm);
    const Pole* b = sheet_.pole_at(first_uv(ring_.pieces[next]), first_[next], draft_.tolerance_mm);
    return a == b ? a : nullptr;
  }

  Uv turn_between(std::size_t i, std::size_t next) const {
    const Uv a = last_uv(ring_.pieces[i]), b = first_uv(ring_.pieces[next]);
    const Pole* pole = common_pole(i, next);
    const double u = pole && pole->at_v ? pole_turn(a.u, b.u, sheet_.period_u())
                                        : nearest_turn(a.u, b.u, sheet_.period_u());
    const double v = pole && !pole->at_v ? pole_turn(a.v, b.v, sheet_.period_v())
                                         : nearest_turn(a.v, b.v, sheet_.period_v());
    return {u, v};
  }

  Uv periods(Uv turns) const { return {turns.u * sheet_.period_u(), turns.v * sheet_.period_v()}; }

  // 2. Each piece into the turn where the one before it ended. True when one had to move.
  bool unwrap() {
    moves_.assign(ring_.pieces.size(), Uv{});
    if (sheet_.period_u() == 0 && sheet_.period_v() == 0) return false;
    bool moved = false;
    for (std::size_t i = 1; i < ring_.pieces.size(); ++i) {
      const Uv turn = turn_between(i - 1, i);
      if (turn.u == 0 && turn.v == 0) continue;
      moves_[i] = periods(turn);
      move_by(ring_.pieces[i], moves_[i]);
      moved = true;
    }
    return moved;
  }

  // A loop that is only a seam, up on one side and down on the other, leaves out the circles between the two. Put in
  // one turn it would go there and back; as drawn it encloses the whole width.
  bool restore_sides() {
    const double together = area_of(ring_);
    for (std::size_t i = 0; i < moves_.size(); ++i) move_by(ring_.pieces[i], -1.0 * moves_[i]);
    if (std::abs(together) <= 1e-12 * std::abs(area_of(ring_))) return true;
    for (std::size_t i = 0; i < moves_.size(); ++i) move_by(ring_.pieces[i], moves_[i]);
    return false;
  }

  // 3. What is missing at the end are whole turns. A ring through a pole does not wind: there the parameter jumps.
  void count_turns() {
    const std::size_t n = ring_.pieces.size();
    const Uv turn = turn_between(n - 1, 0);
    ring_.turns_u = static_cast<int>(turn.u);
    ring_.turns_v = static_cast<int>(turn.v);
    if (ring_.turns_u == 0 && ring_.turns_v == 0) return;
    for (std::size_t i = n - 1; i-- > 0;) {
      const Pole* pole = common_pole(i, i + 1);
      if (!pole || (pole->at_v ? ring_.turns_u : ring_.turns_v) == 0) continue;
      int& turns = pole->at_v ? ring_.turns_u : ring_.turns_v;
      const Uv back = periods(pole->at_v ? Uv{-double(turns), 0} : Uv{0, -double(turns)});
      for (std::size_t k = i + 1; k < n; ++k) move_by(ring_.pieces[k], back);
      turns = 0;
    }
  }

  // A loop that winds twice the same way, where one of its pieces goes round all by itself: as up a seam, round, and down
  // again. Ends do not tell the direction of such a piece; the other one makes the loop close.
  void turn_closed_piece() {
    for (std::size_t i = ring_.pieces.size(); i-- > 0;) {
      if (!(distance(first_[i], last_[i]) <= draft_.tolerance_mm) || norm(last_uv(ring_.pieces[i]) - first_uv(ring_.pieces[i])) == 0) continue;
      const Ring before = ring_;
      turn_around(ring_.pieces[i]);
      std::swap(first_[i], last_[i]);
      unwrap();
      count_turns();
      if (ring_.turns_u == 0 && ring_.turns_v == 0)
        return draft_.record(Step::SegmentReversed, ring_.loop, ring_.pieces[i].segment, 0, 0, first_[i], true);
      ring_ = before;
      std::swap(first_[i], last_[i]);
    }
  }

  // A loop that goes from one pole to the other and back the same way is the seam of the whole surface between them: at
  // the poles the parameter is free, so that nothing told the way back to take the other side.
  void part_at_poles() {
    const std::size_t n = ring_.pieces.size();
    std::vector<std::size_t> at;  // joints at poles
    for (std::size_t i = 0; i < n; ++i)
      if (common_pole(i, (i + 1) % n)) at.push_back(i);
    if (at.size() != 2) return;
    const Pole *one = common_pole(at[0], (at[0] + 1) % n), *two = common_pole(at[1], (at[1] + 1) % n);
    const double period = one->at_v ? sheet_.period_u() : sheet_.period_v();
    if (one == two || one->at_v != two->at_v || period == 0) return;
    const UvBox box = box_of(ring_);
    const double height = one->at_v ? box.hi.v - box.lo.v : box.hi.u - box.lo.u;
    if (std::abs(area_of(ring_)) > 1e-9 * period * height) return;
    // Counter-clockwise: what falls is on the left of what rises, or above it where v is the free parameter.
    const Uv from = first_uv(ring_.pieces[at[0] + 1]), to = last_uv(ring_.pieces[at[1]]);
    const bool back_rises = one->at_v ? to.v > from.v : to.u > from.u;
    const double by = back_rises == one->at_v ? period : -period;
    for (std::size_t i = at[0] + 1; i <= at[1]; ++i) move_by(ring_.pieces[i], one->at_v ? Uv{by, 0} : Uv{0, by});
  }

  // 4. One node a joint, or two with a piece between them.
  void join() {
    const UvBox box = box_of(ring_);
    const double size = sheet_.millimetres(box.lo, box.hi);
    snap_mm_ = std::max(std::min(draft_.tolerance_mm, 1e-3 * size), 1e-6 * size);
    const std::size_t n = ring_.pieces.size();
    std::vector<std::optional<std::vector<Piece>>> bridges(n);
    std::size_t needed = 0;
    for (std::size_t i = 0; i < n; ++i) {
      bridges[i] = bridge(i, (i + 1) % n);
      needed += bridges[i] ? bridges[i]->size() : 0;
    }
    if (needed == 0) return share_pole_nodes();
    std::vector<Piece> closed;
    closed.reserve(n + needed);
    for (std::size_t i = 0; i < n; ++i) {
      closed.push_back(std::move(ring_.pieces[i]));
      if (bridges[i])
        for (Piece& bridge : *bridges[i]) closed.push_back(std::move(bridge));
    }
    ring_.pieces = std::move(closed);
    share_pole_nodes();
  }

  // A piece that is a pole has one node: that of the body if it has one.
  void share_pole_nodes() {
    const std::size_t n = ring_.pieces.size();
    for (std::size_t i = 0; i < n; ++i) {
      Piece& p = ring_.pieces[i];
      if (!p.is_pole || p.start == p.end) continue;
      const bool keep_end = static_cast<bool>(draft_.nodes[static_cast<std::size_t>(p.end)].existing);
      (keep_end ? ring_.pieces[(i + n - 1) % n].end : ring_.pieces[(i + 1) % n].start) = keep_end ? p.end : p.start;
      (keep_end ? p.start : p.end) = keep_end ? p.end : p.start;
    }
  }

  // Sets the nodes of the joint between two pieces; the pieces that have to come between them, if any.
  std::optional<std::vector<Piece>> bridge(std::size_t i, std::size_t next) {
    Piece& before = ring_.pieces[i];
    Piece& after = ring_.pieces[next];
    Joint joint{last_uv(before), first_uv(after), last_[i], first_[next]};
    if (next == 0) joint.to = joint.to + periods({double(ring_.turns_u), double(ring_.turns_v)});
    const VertexId end = existing_vertex(before, false), start = existing_vertex(after, true);
    const Point at = before.curve ? evaluate(*before.curve, before.c1) : joint.p;
    before.end = after.start = end || start ? draft_.add_node(draft_.body[end ? end : start].point, end ? end : start)
                                            : draft_.add_node(at);
    if (const Pole* pole = common_pole(i, next)) {
      const double jump = pole->at_v ? joint.to.u - joint.from.u : joint.to.v - joint.from.v;
      const Interval side = pole->at_v ? sheet_.domain().u : sheet_.domain().v;
      if (!(std::abs(jump) > 1e-7 * (side.is_bounded() ? side.length() : 1))) return std::nullopt;
      Piece piece = straight_piece(joint.from, joint.to);
      piece.is_pole = true;
      piece.start = piece.end = before.end;
      draft_.record(Step::PoleInserted, ring_.loop, before.segment, 0, 0, joint.p, false);
      return std::vector<Piece>{std::move(piece)};
    }
    if (auto corner = round_corner(joint)) {
      for (Piece& piece : *corner) piece.start = piece.end = before.end;
      draft_.record(Step::PoleInserted, ring_.loop, before.segment, 0, 0, joint.p, false);
      return corner;
    }
    const bool two_vertices = end && start && end != start;
    double gap = distance(joint.p, joint.q);
    if (joint.from.u != joint.to.u || joint.from.v != joint.to.v)
      gap = std::max(gap, sheet_.millimetres(joint.from, joint.to));
    if (gap > draft_.tolerance_mm || !(gap <= snap_mm_))
      draft_.record(Step::GapClosed, ring_.loop, before.segment, gap, 0, joint.p, gap > draft_.tolerance_mm);
    if (gap <= snap_mm_ && !two_vertices) return std::nullopt;
    if (joint.from.u == joint.to.u && joint.from.v == joint.to.v) return std::nullopt;
    const Point there = after.curve ? evaluate(*after.curve, after.c0) : joint.q;
    if (!(end && end == start)) after.start = draft_.add_node(start ? draft_.body[start].point : there, start);
    const Uv step = joint.to - joint.from;
    const bool whole_turn = gap > snap_mm_ && distance(joint.p, joint.q) <= snap_mm_ && (step.u == 0 || step.v == 0);
    Piece piece = whole_turn ? border_piece(sheet_, joint.from, joint.to) : straight_piece(joint.from, joint.to);
    piece.start = before.end;
    piece.end = after.start;
    return std::vector<Piece>{std::move(piece)};
  }

  // Two sides of the surface that are the same point: the way from one to the other goes round their corner.
  std::optional<std::vector<Piece>> round_corner(const Joint& joint) const {
    if (sheet_.poles().size() < 2) return std::nullopt;
    const Pole* a = sheet_.pole_at(joint.from, joint.p, draft_.tolerance_mm);
    const Pole* b = sheet_.pole_at(joint.to, joint.q, draft_.tolerance_mm);
    if (!a || !b || a->at_v == b->at_v || !(distance(a->point, b->point) <= draft_.tolerance_mm)) return std::nullopt;
    const Uv corner = a->at_v ? Uv{b->value, a->value} : Uv{a->value, b->value};
    std::vector<Piece> pieces;
    if (norm(corner - joint.from) > 0) pieces.push_back(straight_piece(joint.from, corner));
    if (norm(joint.to - corner) > 0) pieces.push_back(straight_piece(corner, joint.to));
    for (Piece& piece : pieces) piece.is_pole = true;
    return pieces;
  }

  VertexId existing_vertex(const Piece& p, bool at_start) const {
    if (!p.existing) return {};
    const Edge e = draft_.shared.whole(draft_.body, p.existing);
    return (p.c0 < p.c1) == at_start ? e.start : e.end;
  }

  Draft& draft_;
  const Sheet& sheet_;
  Ring& ring_;
  std::vector<Point> first_, last_;  // ends of the pieces on the surface
  std::vector<Uv> moves_;            // by unwrap
  double snap_mm_ = 0;
};

}  // namespace

void close(Draft& draft, Ring& ring) { Closer(draft, ring).run(); }

}  // namespace trimloop::heal
