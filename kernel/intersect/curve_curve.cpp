// Curve with curve: by pieces, then the pieces' answers put together.

#include "kernel/intersect/common_stretch.h"
#include "kernel/intersect/intersect.h"
#include "kernel/intersect/scale.h"

namespace trimloop {
namespace {

using detail::Bezier;

struct Found {
  CurveCurvePoint p;
  Interval first, second;  // isolating
  bool grown = false;      // by others that turned out to be the same
};

Interval scaled(Interval piece, Interval part) { return {piece.at(part.lo), piece.at(part.hi)}; }
bool meet(Interval a, Interval b) {
  const double by = 0.05 * std::max(a.length(), b.length());
  return a.lo - by <= b.hi && b.lo - by <= a.hi;
}
Interval moved(Interval a, double by) { return {a.lo + by, a.hi + by}; }

class Joiner {
 public:
  Joiner(const NurbsCurve& a, const NurbsCurve& b, const detail::Scale& scale)
      : a_(a), b_(b), origin_(scale.origin), near_(64 * scale.tolerance + 1e-10 * scale.size) {
    const auto period = [&](const NurbsCurve& c) {
      const Interval r = c.range();
      return millimetres(c, r.lo, r.hi) <= near_ ? r.length() : 0;
    };
    period_a_ = period(a);
    period_b_ = period(b);
  }

  void add(const Bezier& a, const Bezier& b, const detail::PointContacts& contacts) {
    for (const detail::PointContact& c : contacts.contacts) {
      Found f;
      f.p = {a.u.at(c.at[0]),
             b.u.at(c.at[1]),
             c.point,
             c.gap,
             c.crossing ? ContactKind::Crossing : ContactKind::Touch,
             false,
             false};
      f.first = scaled(a.u, c.within[0]);
      f.second = scaled(b.u, c.within[1]);
      add(f);
    }
    for (const detail::Cell& cell : contacts.undecided)
      out_.undecided.push_back({scaled(a.u, cell[0]), scaled(b.u, cell[1])});
  }
  void add(const Bezier& a, const Bezier& b, const detail::CommonStretch& s) {
    const CurveCurveOverlap o{scaled(a.u, s.first), scaled(b.u, s.second), s.opposed, s.bound};
    overlaps_.push_back(o);
  }

  CurveCurveIntersection result() {
    join_overlaps();
    for (Found& f : found_) {
      place(f);
      if (!covered(f.p)) out_.points.push_back(f.p);
    }
    for (CurveCurvePoint& p : out_.points) {
      p.point = p.point + to_vector(origin_);
      p.end_first = at_end(a_, p.t_first);
      p.end_second = at_end(b_, p.t_second);
    }
    join_seams();
    std::sort(out_.points.begin(), out_.points.end(), [](const CurveCurvePoint& x, const CurveCurvePoint& y) {
      return x.t_first != y.t_first ? x.t_first < y.t_first : x.t_second < y.t_second;
    });
    return std::move(out_);
  }

 private:
  // Pieces that share a joint find what lies on it twice; so do the two ends of a closed curve.
  void add(const Found& f) {
    for (Found& g : found_) {
      const bool touch = f.p.kind == ContactKind::Touch || g.p.kind == ContactKind::Touch;
      const bool near = distance(f.p.point, g.p.point) <= near_;
      if (!(near || touch)) continue;
      for (const double da : {0.0, period_a_, -period_a_})
        for (const double db : {0.0, period_b_, -period_b_}) {
          const Interval first = moved(f.first, da), second = moved(f.second, db);
          if (!meet(first, g.first) || !meet(second, g.second)) continue;
          if (g.p.kind == ContactKind::Touch && f.p.kind == ContactKind::Crossing)
            g.p = f.p;
          else if (f.p.kind == g.p.kind && f.p.gap_mm < g.p.gap_mm && !touch)
            g.p = f.p;
          g.first = {std::min(first.lo, g.first.lo), std::max(first.hi, g.first.hi)};
          g.second = {std::min(second.lo, g.second.lo), std::max(second.hi, g.second.hi)};
          g.grown = true;
          return;
        }
    }
    found_.push_back(f);
  }
  // A touch put together from several pieces is placed in its middle.
  void place(Found& f) const {
    if (!f.grown || f.p.kind == ContactKind::Crossing) return;
    const auto home = [](const NurbsCurve& c, double period, double t) {
      return t < c.range().lo ? t + period : t > c.range().hi ? t - period : t;
    };
    const double t = home(a_, period_a_, f.first.mid());
    const Point p = evaluate(a_, t);
    const CurveFoot foot = closest_point_near(Curve{b_}, p, home(b_, period_b_, f.second.mid()));
    if (foot.distance > near_ / 64) return;
    f.p.t_first = t, f.p.t_second = foot.t, f.p.gap_mm = foot.distance;
    f.p.point = midpoint(p, foot.point) - to_vector(origin_);
  }

  double millimetres(const NurbsCurve& c, double t0, double t1) const {
    return distance(evaluate(c, t0), evaluate(c, t1));
  }
  bool same(const NurbsCurve& c, double t0, double t1) const {
    return std::abs(t0 - t1) <= 1e-6 * c.range().length() && millimetres(c, t0, t1) <= near_;
  }
  bool at_end(const NurbsCurve& c, double t) const { return same(c, t, c.range().lo) || same(c, t, c.range().hi); }

  void join_overlaps() {
    std::sort(overlaps_.begin(), overlaps_.end(), [](const CurveCurveOverlap& x, const CurveCurveOverlap& y) {
      return x.first.lo != y.first.lo ? x.first.lo < y.first.lo : x.second.lo < y.second.lo;
    });
    for (const CurveCurveOverlap& o : overlaps_) {
      bool joined = false;
      for (CurveCurveOverlap& g : out_.overlaps) {
        if (g.opposed != o.opposed || !same(a_, g.first.hi, o.first.lo)) continue;
        if (!(o.opposed ? same(b_, g.second.lo, o.second.hi) : same(b_, g.second.hi, o.second.lo))) continue;
        g.first.hi = o.first.hi;
        (o.opposed ? g.second.lo : g.second.hi) = o.opposed ? o.second.lo : o.second.hi;
        g.bound_mm = std::max(g.bound_mm, o.bound_mm);
        joined = true;
        break;
      }
      if (!joined) out_.overlaps.push_back(o);
    }
  }

  bool inside(const NurbsCurve& c, Interval i, double t) const {
    return i.contains(t) || same(c, t, i.lo) || same(c, t, i.hi);
  }
  bool covered(const CurveCurvePoint& p) const {
    for (const CurveCurveOverlap& o : out_.overlaps)
      if (inside(a_, o.first, p.t_first) && inside(b_, o.second, p.t_second)) return true;
    return false;
  }

  // The start of a closed curve is its end.
  void join_seams() {
    const bool closed_a = period_a_ > 0, closed_b = period_b_ > 0;
    if (!closed_a && !closed_b) return;
    const auto one = [&](const NurbsCurve& c, bool closed, double t0, double t1) {
      if (same(c, t0, t1)) return true;
      const Interval r = c.range();
      return closed && ((same(c, t0, r.lo) && same(c, t1, r.hi)) || (same(c, t0, r.hi) && same(c, t1, r.lo)));
    };
    std::vector<CurveCurvePoint> kept;
    for (const CurveCurvePoint& p : out_.points) {
      bool known = false;
      for (const CurveCurvePoint& q : kept)
        known = known || (distance(p.point, q.point) <= near_ && one(a_, closed_a, p.t_first, q.t_first) &&
                          one(b_, closed_b, p.t_second, q.t_second));
      // A stretch that begins at the seam covers its other parameter too.
      for (const CurveCurveOverlap& o : out_.overlaps)
        for (const auto& [t, s] : {std::pair{o.first.lo, o.opposed ? o.second.hi : o.second.lo},
                                   std::pair{o.first.hi, o.opposed ? o.second.lo : o.second.hi}})
          known = known || (one(a_, closed_a, p.t_first, t) && one(b_, closed_b, p.t_second, s));
      if (!known) kept.push_back(p);
    }
    out_.points = std::move(kept);
  }

  const NurbsCurve &a_, &b_;
  const Point origin_;
  const double near_;
  double period_a_ = 0, period_b_ = 0;  // of closed curves
  std::vector<Found> found_;
  std::vector<CurveCurveOverlap> overlaps_;
  CurveCurveIntersection out_;
};

}  // namespace

Result<CurveCurveIntersection> intersect(const NurbsCurve& a, const NurbsCurve& b, const IntersectOptions& options) {
  const detail::Scale scale = detail::scale_of(bounding_box(a), bounding_box(b), options.tolerance_mm);
  const auto pieces_a = detail::bezier_pieces(a, scale.origin), pieces_b = detail::bezier_pieces(b, scale.origin);
  if (!pieces_a || !pieces_b) return tl::unexpected<Error>(pieces_a ? pieces_b.error() : pieces_a.error());
  std::vector<Box> boxes_b;
  for (const Bezier& q : *pieces_b) boxes_b.push_back(detail::hull(q, q.net));
  Joiner joiner(a, b, scale);
  std::size_t cells = options.cells;
  for (const Bezier& p : *pieces_a) {
    const Box box = detail::hull(p, p.net);
    for (std::size_t j = 0; j < pieces_b->size(); ++j) {
      const Bezier& q = (*pieces_b)[j];
      if (detail::apart(box, boxes_b[j], scale.tolerance)) continue;
      const auto stretch = detail::common_stretch(p, q, scale.tolerance);
      if (stretch) joiner.add(p, q, *stretch);
      const detail::StretchContext context{p, q, scale.tolerance};
      joiner.add(
          p, q,
          detail::common_points(p, q, scale.tolerance, cells, stretch ? detail::only_on_stretch : nullptr, &context));
    }
  }
  CurveCurveIntersection out = joiner.result();
  out.cells = options.cells - cells;
  return out;
}

namespace {

// Two lines without ends: about their nearest points, in closed form.
Result<CurveCurveIntersection> intersect_lines(const Line& a, const Line& b, const IntersectOptions& options) {
  const Vector d = a.end - a.start, e = b.end - b.start, between = b.start - a.start;
  const double dd = dot(d, d), de = dot(d, e), ee = dot(e, e), det = dd * ee - de * de;
  if (!(dd > 0) || !(ee > 0)) return fail(ErrorCode::Degenerate, "a line without direction", 0.0);
  const double size = std::max({norm(between), norm(to_vector(a.start)), norm(to_vector(b.start))});
  if (!(det > 1e-24 * dd * ee)) {  // parallel
    const double gap = norm(between - dot(between, d) / dd * d);
    CurveCurveIntersection out;
    const double tolerance = options.tolerance_mm > 0 ? options.tolerance_mm : 1e-12 * size;
    if (gap <= tolerance) out.overlaps.push_back({a.range, b.range, de < 0, gap});
    return out;
  }
  const double s = (ee * dot(d, between) - de * dot(e, between)) / det;
  const double t = (de * dot(d, between) - dd * dot(e, between)) / det;
  const auto about = [](Line line, double at) {
    line.range = {at - 1, at + 1};
    return Curve{line};
  };
  return intersect(about(a, s), about(b, t), options);
}

}  // namespace

Result<CurveCurveIntersection> intersect(const Curve& a, const Curve& b, const IntersectOptions& options) {
  const Line *one = std::get_if<Line>(&a.shape), *other = std::get_if<Line>(&b.shape);
  if (one && other && one->range.lo == -infinity && one->range.hi == infinity && other->range.lo == -infinity &&
      other->range.hi == infinity)
    return intersect_lines(*one, *other, options);
  const Curve first = detail::cut_to(a, bounding_box(b)), second = detail::cut_to(b, bounding_box(a));
  const auto na = to_nurbs(first), nb = to_nurbs(second);
  if (!na || !nb) return tl::unexpected<Error>(na ? nb.error() : na.error());
  auto found = intersect(na->curve, nb->curve, options);
  if (!found) return found;
  const auto own = [](const ToNurbsCurve& n, Interval& i) { i = {map_from_nurbs(n, i.lo), map_from_nurbs(n, i.hi)}; };
  for (CurveCurvePoint& p : found->points) {
    p.t_first = map_from_nurbs(*na, p.t_first);
    p.t_second = map_from_nurbs(*nb, p.t_second);
    p.end_first = p.end_first && is_bounded(a);
    p.end_second = p.end_second && is_bounded(b);
  }
  for (CurveCurveOverlap& o : found->overlaps) own(*na, o.first), own(*nb, o.second);
  for (CurveCurveDoubt& d : found->undecided) own(*na, d.first), own(*nb, d.second);
  return found;
}

Result<CurveCurveIntersection> intersect(const Curve2& a, const Curve2& b, const IntersectOptions& options) {
  return intersect(a.curve, b.curve, options);
}

}  // namespace trimloop
