// Curve with surface: by pieces, then the pieces' answers put together.

#include "kernel/intersect/common_stretch.h"
#include "kernel/intersect/intersect.h"
#include "kernel/intersect/scale.h"

namespace trimloop {
namespace {

using detail::Bezier;

struct Found {
  CurveSurfacePoint p;
  Interval within;  // of the curve
};
Interval scaled(Interval piece, Interval part) { return {piece.at(part.lo), piece.at(part.hi)}; }
Interval moved(Interval a, double by) { return {a.lo + by, a.hi + by}; }

class Joiner {
 public:
  Joiner(const NurbsCurve& curve, const detail::Scale& scale)
      : curve_(curve), origin_(scale.origin), near_(64 * scale.tolerance + 1e-10 * scale.size) {
    const Interval r = curve.range();
    if (distance(evaluate(curve, r.lo), evaluate(curve, r.hi)) <= near_) period_ = r.length();
  }

  void add(const Bezier& curve, const Bezier& patch, const detail::PointContacts& contacts) {
    for (const detail::PointContact& c : contacts.contacts) {
      Found f;
      f.p.t = curve.u.at(c.at[0]);
      f.p.uv = {patch.u.at(c.at[1]), patch.v.at(c.at[2])};
      f.p.point = c.point;
      f.p.gap_mm = c.gap;
      f.p.kind = c.crossing ? ContactKind::Crossing : ContactKind::Touch;
      f.within = scaled(curve.u, c.within[0]);
      add(f);
    }
    for (const detail::Cell& cell : contacts.undecided)
      out_.undecided.push_back({scaled(curve.u, cell[0]), scaled(patch.u, cell[1]), scaled(patch.v, cell[2])});
  }
  void add(const Bezier& curve, const detail::StretchInPatch& s) {
    stretches_.push_back({scaled(curve.u, s.on_curve), s.bound});
  }

  CurveSurfaceIntersection result() {
    join_stretches();
    for (Found& f : found_) {
      if (covered(f.p.t)) continue;
      f.p.point = f.p.point + to_vector(origin_);
      f.p.end = same(f.p.t, curve_.range().lo) || same(f.p.t, curve_.range().hi);
      out_.points.push_back(f.p);
    }
    std::sort(out_.points.begin(), out_.points.end(),
              [](const CurveSurfacePoint& a, const CurveSurfacePoint& b) { return a.t < b.t; });
    return std::move(out_);
  }

 private:
  double millimetres(Interval i) const {
    const Interval r = curve_.range();
    return distance(evaluate(curve_, r.clamp(i.lo)), evaluate(curve_, r.clamp(i.hi)));
  }
  bool same(double t0, double t1) const {
    return std::abs(t0 - t1) <= 1e-6 * curve_.range().length() && millimetres({t0, t1}) <= near_;
  }

  // One for each point of the curve: neighbouring pieces, seams and poles find it several times.
  void add(const Found& f) {
    for (Found& g : found_) {
      const bool touch = f.p.kind == ContactKind::Touch || g.p.kind == ContactKind::Touch;
      const double reach = touch ? near_ + 2 * (millimetres(f.within) + millimetres(g.within)) : near_;
      if (distance(f.p.point, g.p.point) > reach) continue;
      for (const double by : {0.0, period_, -period_}) {
        const Interval within = moved(f.within, by);
        const double slack = 0.05 * std::max(within.length(), g.within.length());
        if (within.lo - slack > g.within.hi || g.within.lo - slack > within.hi) continue;
        const bool better = f.p.kind == g.p.kind ? f.p.gap_mm < g.p.gap_mm : g.p.kind == ContactKind::Touch;
        if (better) g.p = f.p;
        g.within = {std::min(within.lo, g.within.lo), std::max(within.hi, g.within.hi)};
        return;
      }
    }
    found_.push_back(f);
  }

  void join_stretches() {
    std::sort(stretches_.begin(), stretches_.end(),
              [](const CurveSurfaceOverlap& a, const CurveSurfaceOverlap& b) { return a.on_curve.lo < b.on_curve.lo; });
    for (const CurveSurfaceOverlap& s : stretches_) {
      if (!out_.overlaps.empty()) {
        CurveSurfaceOverlap& last = out_.overlaps.back();
        if (s.on_curve.lo <= last.on_curve.hi || same(s.on_curve.lo, last.on_curve.hi)) {
          last.on_curve.hi = std::max(last.on_curve.hi, s.on_curve.hi);
          last.bound_mm = std::max(last.bound_mm, s.bound_mm);
          continue;
        }
      }
      out_.overlaps.push_back(s);
    }
  }
  bool covered(double t) const {
    for (const CurveSurfaceOverlap& o : out_.overlaps)
      for (const double at : {t, t + period_, t - period_})
        if (o.on_curve.contains(at) || same(at, o.on_curve.lo) || same(at, o.on_curve.hi)) return true;
    return false;
  }

  const NurbsCurve& curve_;
  const Point origin_;
  const double near_;
  double period_ = 0;
  std::vector<Found> found_;
  std::vector<CurveSurfaceOverlap> stretches_;
  CurveSurfaceIntersection out_;
};

}  // namespace

Result<CurveSurfaceIntersection> intersect(const NurbsCurve& curve, const NurbsSurface& surface,
                                           const IntersectOptions& options) {
  const detail::Scale scale = detail::scale_of(bounding_box(curve), bounding_box(surface), options.tolerance_mm);
  const auto pieces = detail::bezier_pieces(curve, scale.origin),
             patches = detail::bezier_pieces(surface, scale.origin);
  if (!pieces || !patches) return tl::unexpected<Error>(pieces ? patches.error() : pieces.error());
  std::vector<Box> boxes;
  for (const Bezier& q : *patches) boxes.push_back(detail::hull(q, q.net));
  Joiner joiner(curve, scale);
  std::size_t cells = options.cells;
  for (const Bezier& p : *pieces) {
    const Box box = detail::hull(p, p.net);
    for (std::size_t j = 0; j < patches->size(); ++j) {
      const Bezier& q = (*patches)[j];
      if (detail::apart(box, boxes[j], scale.tolerance)) continue;
      const auto stretches = detail::stretches_in_patch(p, q, scale.tolerance);
      for (const detail::StretchInPatch& s : stretches) joiner.add(p, s);
      const detail::StretchContext context{p, q, scale.tolerance};
      joiner.add(p, q,
                 detail::common_points(p, q, scale.tolerance, cells,
                                       stretches.empty() ? nullptr : detail::only_on_stretch_in_patch, &context));
    }
  }
  CurveSurfaceIntersection out = joiner.result();
  out.cells = options.cells - cells;
  return out;
}

Result<CurveSurfaceIntersection> intersect(const Curve& curve, const Surface& surface, const IntersectOptions& options,
                                           std::optional<Interval> u, std::optional<Interval> v) {
  const detail::Patch patch = detail::cut_to(surface, u, v, bounding_box(curve));
  if (!patch.u.is_bounded() || !patch.v.is_bounded())
    return fail(ErrorCode::InvalidArgument, "an unbounded curve and an unbounded surface: one of them needs a range");
  const Curve part = detail::cut_to(curve, bounding_box(surface, patch.u, patch.v));
  const auto nc = to_nurbs(part);
  const auto ns = to_nurbs(surface, patch.u, patch.v);
  if (!nc || !ns) return tl::unexpected<Error>(nc ? ns.error() : nc.error());
  auto found = intersect(nc->curve, ns->surface, options);
  if (!found) return found;
  for (CurveSurfacePoint& p : found->points) {
    p.t = map_from_nurbs(*nc, p.t);
    p.uv = map_from_nurbs(*ns, p.uv);
    p.end = p.end && is_bounded(curve);
  }
  const auto own = [](const ParameterMap& m, Interval& i) { i = {map_from_nurbs(m, i.lo), map_from_nurbs(m, i.hi)}; };
  for (CurveSurfaceOverlap& o : found->overlaps) own(nc->map, o.on_curve);
  for (CurveSurfaceDoubt& d : found->undecided) own(nc->map, d.on_curve), own(ns->map_u, d.u), own(ns->map_v, d.v);
  return found;
}

}  // namespace trimloop
