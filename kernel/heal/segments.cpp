// From the segments of the input to pieces that have a pcurve, and a 3D curve where the two agree.

#include <fmt/format.h>

#include "kernel/pcurve/fit_pcurve.h"
#include "kernel/heal/match.h"

namespace trimloop::heal {
namespace {

bool usable(const Curve& c) {
  const Interval r = range(c);
  return r.is_bounded() && r.lo < r.hi && is_finite(evaluate(c, r.lo)) && is_finite(evaluate(c, r.mid())) &&
         is_finite(evaluate(c, r.hi));
}

const CompositeCurve* composite(const Curve& c) { return std::get_if<CompositeCurve>(&c.shape); }

// A composite curve as segments of its own. When both copies are composites, only if they have the same number.
// Composites inside composites are left to the general road.
std::vector<TrimSegment> taken_apart(const TrimSegment& s) {
  const CompositeCurve* p = s.pcurve ? composite(s.pcurve->curve) : nullptr;
  const CompositeCurve* c = !s.edge && s.curve ? composite(*s.curve) : nullptr;
  const bool p_alone = p && !s.edge && !s.curve, c_alone = c && !s.pcurve;
  if (!p_alone && !c_alone && !(p && c && p->segments.size() == c->segments.size())) return {};
  const std::size_t n = p ? p->segments.size() : c->segments.size();
  std::vector<TrimSegment> parts(n);
  for (std::size_t i = 0; i < n; ++i) {
    parts[i].source = s.source;
    if (p) {
      const CompositeCurve::Segment& child = p->segments[s.pcurve_reversed ? n - 1 - i : i];
      parts[i].pcurve = Curve2{*child.curve};
      parts[i].pcurve_reversed = child.reversed != s.pcurve_reversed;
    }
    if (c) {
      const CompositeCurve::Segment& child = c->segments[s.curve_reversed ? n - 1 - i : i];
      parts[i].curve = child.curve;
      parts[i].curve_reversed = child.reversed != s.curve_reversed;
    }
  }
  return parts;
}

// A segment with what is known about its two copies.
struct Candidate {
  Piece piece;
  bool has_pcurve = false;
  double off_mm = 0;        // what the copies contradict each other by, when both are there
  double allowed_mm = 0;    // and what is too little to matter
  double discarded_mm = -1; // the pcurve was of no use and so far from the curve; < 0: there was none
  Point from, to;           // of the pcurve on the surface, or of the curve when there is no pcurve
};

class Drawer {
 public:
  explicit Drawer(Draft& draft) : draft_(draft), sheet_(draft.sheet) {}

  void draw(const TrimLoop& loop, int index) {
    loop_ = index;
    trust_ = loop.trust;
    std::vector<Candidate> candidates;
    candidates.reserve(loop.segments.size());
    for (std::size_t i = 0; i < loop.segments.size() && draft_.failure.empty(); ++i) {
      const std::vector<TrimSegment> parts = taken_apart(loop.segments[i]);
      if (parts.empty()) add(loop.segments[i], static_cast<int>(i), candidates);
      for (const TrimSegment& part : parts) add(part, static_cast<int>(i), candidates);
    }
    if (!draft_.failure.empty()) return;
    if (candidates.empty()) return drop(loop);
    Ring ring;
    ring.loop = index;
    ring.claimed_outer = loop.claimed_outer;
    ring.source = loop.source;
    ring.pieces.reserve(candidates.size());
    for (std::size_t i = 0; i < candidates.size() && draft_.failure.empty(); ++i) {
      decide(candidates, i, ring);
      if (draft_.failure.empty()) {
        hold(draft_, candidates[i].piece, index);
        ring.pieces.push_back(std::move(candidates[i].piece));
      }
    }
    draft_.rings.push_back(std::move(ring));
  }

 private:
  // A loop that is nothing but a point: at a pole it says no more than the surface does.
  void drop(const TrimLoop& loop) {
    if (loop.pole) return;
    draft_.record(Step::LoopDropped, loop_, -1, 0, 0, {}, true);
    draft_.failure = fmt::format("loop {} has no extent", loop_ + 1);
  }

  bool take_pcurve(Piece& p, const TrimSegment& s) const {
    if (!s.pcurve) return false;
    const Interval r = range(*s.pcurve);
    if (!r.is_bounded() || !(r.lo < r.hi)) return false;
    p.pcurve = *s.pcurve;
    p.t0 = s.pcurve_reversed ? r.hi : r.lo;
    p.t1 = s.pcurve_reversed ? r.lo : r.hi;
    return take_samples(p);
  }

  bool take_curve(Piece& p, const TrimSegment& s) const {
    Interval r;
    if (s.edge) {
      if (s.edge.index >= draft_.body.edges.size()) return false;
      const Edge e = draft_.shared.whole(draft_.body, s.edge);
      if (!e.curve) return false;
      p.existing = s.edge;
      p.curve = e.curve;
      r = e.range;
    } else {
      if (!s.curve || !usable(*s.curve)) return false;
      p.curve = s.curve;
      r = range(*s.curve);
    }
    p.c0 = s.curve_reversed ? r.hi : r.lo;
    p.c1 = s.curve_reversed ? r.lo : r.hi;
    return true;
  }

  void add(const TrimSegment& segment, int index, std::vector<Candidate>& candidates) {
    Candidate k;
    Piece& p = k.piece;
    p.segment = index;
    p.source = segment.source;
    k.has_pcurve = take_pcurve(p, segment);
    if (!take_curve(p, segment) && !k.has_pcurve) {
      draft_.failure = fmt::format("segment {} of loop {} has no usable curve", index + 1, loop_ + 1);
      return;
    }
    if (k.has_pcurve) {
      if (p.curve) compare(k);
      k.from = sheet_.point(first_uv(p));
      k.to = sheet_.point(last_uv(p));
    } else {
      k.from = evaluate(*p.curve, p.c0);
      k.to = evaluate(*p.curve, p.c1);
    }
    if (!is_a_point(k)) return candidates.push_back(std::move(k));
    // A pcurve that shrinks to a point, which the curve in space does not: written in other parameters, held in a corner.
    if (k.has_pcurve && p.curve) {
      k.has_pcurve = false;
      k.discarded_mm = k.off_mm;
      k.from = evaluate(*p.curve, p.c0);
      k.to = evaluate(*p.curve, p.c1);
      if (!is_a_point(k)) return candidates.push_back(std::move(k));
      k.has_pcurve = true;
    }
    add_point(std::move(k), candidates);
  }

  // The side of a pole is kept, any other segment without extent says nothing.
  void add_point(Candidate k, std::vector<Candidate>& candidates) {
    Piece& p = k.piece;
    if (const Pole* pole = k.has_pcurve ? sheet_.pole_at(first_uv(p), k.from, draft_.tolerance_mm) : nullptr) {
      const Uv step = last_uv(p) - first_uv(p);
      if ((pole->at_v ? step.u : step.v) != 0) {
        p.is_pole = true;
        p.curve = nullptr;
        p.existing = EdgeId{};
        p.map.clear();
        k.off_mm = p.gap_mm = 0;
        return candidates.push_back(std::move(k));
      }
    }
    draft_.record(Step::DuplicateRemoved, loop_, p.segment, 0, 0, k.from, false);
  }

  // All of it within rounding of one place in space.
  bool is_a_point(const Candidate& k) const {
    const double rounding = 1e-3 * draft_.tolerance_mm;
    if (!(distance(k.from, k.to) <= rounding)) return false;
    const Piece& p = k.piece;
    for (int i = 1; i < 8; ++i) {
      const double f = i / 8.0;
      const Point at = k.has_pcurve ? sheet_.point(uv_of(p, Interval{p.t0, p.t1}.at(f)))
                                    : evaluate(*p.curve, Interval{p.c0, p.c1}.at(f));
      if (!(distance(at, k.from) <= rounding)) return false;
    }
    return true;
  }

  void compare(Candidate& k) {
    Piece& p = k.piece;
    Match m = match(sheet_, p, draft_.tolerance_mm);
    k.off_mm = m.off_mm;
    k.allowed_mm = m.allowed_mm;
    p.gap_mm = m.gap_mm;
    p.map = std::move(m.map);
    if (!m.against) return;
    // Which copy runs the wrong way shows when the loop is chained; until then the trusted one leads.
    if (p.existing || trust_ == Trust::Model) {
      std::swap(p.t0, p.t1);
      std::reverse(p.samples.begin(), p.samples.end());
    } else {
      std::swap(p.c0, p.c1);
    }
  }

  // Makes candidate i a piece to be used.
  void decide(std::vector<Candidate>& all, std::size_t i, const Ring& ring) {
    Candidate& k = all[i];
    Piece& p = k.piece;
    if (!k.has_pcurve) return fit(k, ring);
    if (!p.curve || k.off_mm <= k.allowed_mm) return;
    const Trust trust = p.existing ? Trust::Model : trust_ == Trust::Either ? better(all, i) : trust_;
    if (trust == Trust::Model && replace(k, ring)) return;
    if (p.existing) return;  // shared: the gap stays, measured
    draft_.record(Step::CurveDropped, loop_, p.segment, k.off_mm, 0, k.from, trust_ == Trust::Either);
    p.curve = nullptr;
    p.map.clear();
    p.gap_mm = 0;
  }

  // Neither copy is preferred: the one whose ends meet the neighbours; the pcurve when both do.
  Trust better(const std::vector<Candidate>& all, std::size_t i) const {
    const Candidate& k = all[i];
    if (overshoot_mm(sheet_, k.piece, nullptr) > 10 * draft_.tolerance_mm) return Trust::Model;
    const std::size_t n = all.size();
    const Candidate &before = all[(i + n - 1) % n], &after = all[(i + 1) % n];
    const auto ends = [](const Candidate& c, Point& from, Point& to) {
      from = evaluate(*c.piece.curve, c.piece.c0);
      to = evaluate(*c.piece.curve, c.piece.c1);
    };
    // A neighbour counts with whichever of its copies is nearer.
    const auto miss = [&](Point from, Point to) {
      double at_start = distance(before.to, from), at_end = distance(to, after.from);
      Point a, b;
      if (before.has_pcurve && before.piece.curve) ends(before, a, b), at_start = std::min(at_start, distance(b, from));
      if (after.has_pcurve && after.piece.curve) ends(after, a, b), at_end = std::min(at_end, distance(to, a));
      return at_start + at_end;
    };
    Point from, to;
    ends(k, from, to);
    if (n == 1) return Trust::Parameter;
    const double parameter = miss(k.from, k.to), model = miss(from, to);
    return model + draft_.tolerance_mm < 0.5 * parameter ? Trust::Model : Trust::Parameter;
  }

  static double size_of(const Piece& p) {
    Box box;
    for (int i = 0; i <= 8; ++i) box.add(evaluate(*p.curve, Interval{p.c0, p.c1}.at(i / 8.0)));
    return box.diagonal();
  }

  std::optional<pcurve::FittedPcurve> fitted(const Piece& p, const Ring& ring) const {
    const Interval r{std::min(p.c0, p.c1), std::max(p.c0, p.c1)};
    std::optional<pcurve::ParameterHint> hint;
    if (!ring.pieces.empty()) hint = pcurve::ParameterHint{p.c0, last_uv(ring.pieces.back())};
    const double fit_mm = std::max(std::min(0.1 * draft_.tolerance_mm, 1e-6 * size_of(p)), 1e-9);
    auto f = pcurve::fit_pcurve(sheet_, *p.curve, r, hint, fit_mm, draft_.tolerance_mm);
    if (!f) return std::nullopt;
    return std::move(*f);
  }

  static bool put(Piece& p, pcurve::FittedPcurve f) {
    p.pcurve = std::move(f.pcurve);
    p.t0 = p.c0 < p.c1 ? f.range.lo : f.range.hi;
    p.t1 = p.c0 < p.c1 ? f.range.hi : f.range.lo;
    p.shift = {};
    p.map.clear();
    p.gap_mm = f.gap_mm;
    return take_samples(p);
  }

  void fit(Candidate& k, const Ring& ring) {
    Piece& p = k.piece;
    std::optional<pcurve::FittedPcurve> f = fitted(p, ring);
    if (!f || !put(p, std::move(*f))) {
      draft_.failure = fmt::format("the curve of segment {} of loop {} could not be projected onto the surface",
                                   p.segment + 1, loop_ + 1);
      return;
    }
    const bool discarded = k.discarded_mm >= 0;
    draft_.record(discarded ? Step::PcurveReplaced : Step::PcurveFitted, loop_, p.segment, std::max(k.discarded_mm, 0.0),
                  p.gap_mm, k.from, p.gap_mm > draft_.tolerance_mm || (discarded && trust_ != Trust::Model));
    leave_if_off(p);
  }

  // A curve that does not lie on the surface is not the boundary; its projection is.
  void leave_if_off(Piece& p) const {
    if (p.existing || p.gap_mm <= std::max(draft_.tolerance_mm, invisible * size_of(p))) return;
    p.curve = nullptr;
    p.gap_mm = 0;
  }

  // Replaces the pcurve by the projection of the curve if that is clearly nearer to it.
  bool replace(Candidate& k, const Ring& ring) {
    Piece& p = k.piece;
    std::optional<pcurve::FittedPcurve> f = fitted(p, ring);
    if (!f || !(f->gap_mm < 0.5 * k.off_mm)) return false;
    Piece made = p;
    if (!put(made, std::move(*f))) return false;
    p = std::move(made);
    draft_.record(Step::PcurveReplaced, loop_, p.segment, k.off_mm, p.gap_mm, k.from, trust_ != Trust::Model);
    leave_if_off(p);
    return true;
  }

  Draft& draft_;
  const Sheet& sheet_;
  int loop_ = 0;
  Trust trust_ = Trust::Either;
};

}  // namespace

void draw_segments(Draft& draft) {
  Drawer drawer(draft);
  for (std::size_t i = 0; i < draft.input.loops.size() && draft.failure.empty(); ++i)
    drawer.draw(draft.input.loops[i], static_cast<int>(i));
}

}  // namespace trimloop::heal
