// From the segments of the input to pieces that have a pcurve, and a 3D curve where the two agree.

#include "kernel/heal/draft.h"

namespace trimloop::heal {
namespace {

bool usable(const Curve& c) {
  const Interval r = range(c);
  return r.is_bounded() && r.lo < r.hi && is_finite(evaluate(c, r.lo)) && is_finite(evaluate(c, r.mid())) &&
         is_finite(evaluate(c, r.hi));
}

bool take_pcurve(Piece& p, const TrimSegment& s) {
  if (!s.pcurve) return false;
  const Interval r = range(*s.pcurve);
  if (!r.is_bounded() || !(r.lo < r.hi)) return false;
  p.pcurve = *s.pcurve;
  p.t0 = s.pcurve_reversed ? r.hi : r.lo;
  p.t1 = s.pcurve_reversed ? r.lo : r.hi;
  return take_samples(p);
}

bool take_curve(Piece& p, const Body& body, const TrimSegment& s) {
  Interval r;
  if (s.edge) {
    const Edge& e = body[s.edge];
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

class Drawer {
 public:
  explicit Drawer(Draft& draft) : draft_(draft), sheet_(draft.sheet) {}

  void draw(const TrimLoop& loop, int index) {
    Ring ring;
    ring.loop = index;
    ring.claimed_outer = loop.claimed_outer;
    ring.source = loop.source;
    ring.pieces.reserve(loop.segments.size());
    for (std::size_t i = 0; i < loop.segments.size() && draft_.failure.empty(); ++i)
      draw(ring, loop, loop.segments[i], static_cast<int>(i));
    if (!ring.pieces.empty()) draft_.rings.push_back(std::move(ring));
  }

 private:
  void draw(Ring& ring, const TrimLoop& loop, const TrimSegment& segment, int index) {
    Piece p;
    p.segment = index;
    p.source = segment.source;
    const bool has_pcurve = take_pcurve(p, segment);
    const bool has_curve = take_curve(p, draft_.body, segment);
    static_cast<void>(loop);
    if (!has_pcurve) {
      draft_.failure = "segment has no parameter curve";
      return;
    }
    if (has_curve) compare(p);
    ring.pieces.push_back(std::move(p));
  }

  void compare(Piece& p) {
    constexpr int n = 8;
    double worst = 0;
    for (int i = 0; i <= n; ++i) {
      const double f = double(i) / n;
      const Point c = evaluate(*p.curve, p.c0 + f * (p.c1 - p.c0));
      const Point s = sheet_.point(uv_of(p, p.t0 + f * (p.t1 - p.t0)));
      worst = std::max(worst, distance(c, s));
    }
    p.gap_mm = worst;
    if (!(worst <= draft_.tolerance_mm) && !p.existing) {
      p.curve = nullptr;
      p.gap_mm = 0;
    }
  }

  Draft& draft_;
  const Sheet& sheet_;
};

}  // namespace

void draw_segments(Draft& draft) {
  Drawer drawer(draft);
  for (std::size_t i = 0; i < draft.input.loops.size() && draft.failure.empty(); ++i)
    drawer.draw(draft.input.loops[i], static_cast<int>(i));
}

}  // namespace trimloop::heal
