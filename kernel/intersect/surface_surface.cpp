// Surface with surface: pairs of pieces, then whole branches.

#include <numeric>

#include "kernel/geometry/detail.h"
#include "kernel/intersect/points.h"
#include "kernel/intersect/scale.h"
#include "kernel/intersect/strand.h"

namespace trimloop {
namespace {

using detail::Bezier;
using detail::PairOfPieces;
using detail::Side;

// The two pieces are the same surface where they meet: samples of each with a foot inside the other.
bool coincide(const Bezier& a, const Bezier& b, double near, double& gap) {
  constexpr int n = 5;
  constexpr Interval unit{0, 1};
  int inside = 0;
  double worst = 0;
  for (const bool swapped : {false, true}) {
    const Bezier &from = swapped ? b : a, &to = swapped ? a : b;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const Point p = detail::evaluate(from, (i + 0.37) / n, (j + 0.41) / n);
        const Bezier point{1, 0, false, {{p.x, p.y, p.z, 1}, {p.x, p.y, p.z, 1}}, unit, unit, 0, 0};
        detail::NearestPair best;
        for (const double u : {0.5, 0.1, 0.9})
          for (const double v : {0.5, 0.1, 0.9}) {
            if (best.distance <= near) continue;
            const auto pair = detail::nearest_pair(point, to, {Interval{0, 0}, unit, unit}, {0, u, v});
            if (pair.distance < best.distance) best = pair;
          }
        if (best.distance <= near) {
          ++inside;
          worst = std::max(worst, best.distance);
          continue;
        }
        // A foot inside that is not on it: they differ. A foot on the border says nothing.
        const double u = best.at[1], v = best.at[2];
        if (u > 0 && u < 1 && v > 0 && v < 1) return false;
      }
  }
  gap = std::max(gap, worst);
  return inside >= 2;
}

// Parts of the sides of each surface that lie in the other.
void add_outline(const Side& side, const NurbsSurface& other, bool of_first, const IntersectOptions& options,
                 std::vector<SideInSurface>& out) {
  const NurbsSurface& s = side.nurbs.surface;
  for (const bool at_u : {true, false})
    for (const bool hi : {false, true}) {
      const Interval across = at_u ? s.range_u() : s.range_v();
      const double value = hi ? across.hi : across.lo;
      const NurbsCurve curve =
          at_u ? isocurve_u(s, value).with_range(s.range_v()) : isocurve_v(s, value).with_range(s.range_u());
      const auto found = intersect(curve, other, options);
      if (!found) continue;
      for (const CurveSurfaceOverlap& o : found->overlaps) {
        const auto own = [&](double t) { return map_from_nurbs(at_u ? side.nurbs.map_v : side.nurbs.map_u, t); };
        out.push_back({of_first,
                       at_u,
                       map_from_nurbs(at_u ? side.nurbs.map_u : side.nurbs.map_v, value),
                       {own(o.on_curve.lo), own(o.on_curve.hi)},
                       o.bound_mm});
      }
    }
}

Result<Side> make_side(const Surface& surface, const ToNurbsSurface& nurbs, Point origin) {
  auto pieces = detail::bezier_pieces(nurbs.surface, origin);
  if (!pieces) return tl::unexpected<Error>(pieces.error());
  const detail::Rectangle r = detail::rectangle(surface);
  return Side{surface, nurbs, std::move(*pieces), r.free_u ? two_pi : 0, r.free_v ? two_pi : 0};
}

class Assembler {
 public:
  Assembler(const Side& a, const Side& b, const std::vector<PairOfPieces>& pairs, const detail::Scale& scale)
      : a_(a), b_(b), pairs_(pairs), scale_(scale), near_(1e-5 * scale.size) {}

  void add_points(SurfaceSurfaceIntersection& out) const {
    for (const PairOfPieces& pair : pairs_) {
      const Bezier &p = a_.pieces[pair.a], &q = b_.pieces[pair.b];
      for (const detail::SurfaceTouch& t : pair.cells.touches) {
        const Point at = t.point + to_vector(scale_.origin);
        bool known = t.pole;
        for (const SurfaceSurfacePoint& o : out.points) known = known || distance(o.point, at) <= near_;
        if (known) continue;
        out.points.push_back({map_from_nurbs(a_.nurbs, {p.u.at(t.at[0]), p.v.at(t.at[1])}),
                              map_from_nurbs(b_.nurbs, {q.u.at(t.at[2]), q.v.at(t.at[3])}), at, t.gap, t.branching});
      }
      add_doubts(pair, out);
    }
  }

  // Places where a side or corner of one surface meets the other and no branch passes.
  void add_side_contacts(SurfaceSurfaceIntersection& out, bool of_first, const IntersectOptions& options) const {
    const NurbsSurface &s = (of_first ? a_ : b_).nurbs.surface, &other = (of_first ? b_ : a_).nurbs.surface;
    for (const bool at_u : {true, false})
      for (const bool hi : {false, true}) {
        const Interval across = at_u ? s.range_u() : s.range_v();
        const double value = hi ? across.hi : across.lo;
        const NurbsCurve side =
            at_u ? isocurve_u(s, value).with_range(s.range_v()) : isocurve_v(s, value).with_range(s.range_u());
        if (!(bounding_box(side).diagonal() > near_)) continue;  // a pole
        const auto found = intersect(side, other, options);
        if (!found) continue;
        for (const CurveSurfaceDoubt& d : found->undecided) {
          const Interval fixed{value, value};
          const SurfaceSurfaceDoubt doubt =
              of_first ? SurfaceSurfaceDoubt{at_u ? fixed : d.on_curve, at_u ? d.on_curve : fixed, d.u, d.v}
                       : SurfaceSurfaceDoubt{d.u, d.v, at_u ? fixed : d.on_curve, at_u ? d.on_curve : fixed};
          out.undecided.push_back(doubt);
        }
        for (const CurveSurfacePoint& c : found->points) {
          if (is_known(out, c.point)) continue;
          const Uv here = at_u ? Uv{value, c.t} : Uv{c.t, value};
          const Uv first = map_from_nurbs(a_.nurbs, of_first ? here : c.uv),
                   second = map_from_nurbs(b_.nurbs, of_first ? c.uv : here);
          out.points.push_back({first, second, c.point, c.gap_mm, false});
        }
      }
  }

  // Branches that meet at ends, and points on them, are one component.
  void count_components(SurfaceSurfaceIntersection& out) const {
    const std::size_t n = out.branches.size(), all = n + out.points.size();
    std::vector<std::size_t> group(all);
    std::iota(group.begin(), group.end(), std::size_t{0});
    const auto root = [&](std::size_t i) {
      while (group[i] != i) i = group[i];
      return i;
    };
    std::vector<std::vector<Point>> ends(all);
    for (std::size_t i = 0; i < n; ++i)
      ends[i] = {start_point(out.branches[i].curve), end_point(out.branches[i].curve)};
    for (std::size_t i = n; i < all; ++i) ends[i] = {out.points[i - n].point};
    for (std::size_t i = 0; i < all; ++i)
      for (std::size_t j = 0; j < i; ++j)
        for (const Point& p : ends[i])
          for (const Point& q : ends[j])
            if (distance(p, q) <= near_) group[root(i)] = root(j);
    std::vector<int> number(all, -1);
    for (std::size_t i = 0; i < all; ++i) {
      const std::size_t r = root(i);
      if (number[r] < 0) number[r] = out.components++;
      if (i < n) out.branches[i].component = number[r];
    }
  }

 private:
  bool is_known(const SurfaceSurfaceIntersection& out, Point p) const {
    if (!out.overlaps.empty()) return true;  // its outline tells
    for (const SurfaceSurfacePoint& o : out.points)
      if (distance(o.point, p) <= near_) return true;
    for (const IntersectionBranch& b : out.branches)
      if (distance(start_point(b.curve), p) <= near_ || distance(end_point(b.curve), p) <= near_) return true;
    for (const IntersectionBranch& b : out.branches)
      if (closest_point(b.curve, p).distance <= near_) return true;
    return false;
  }

  void add_doubts(const PairOfPieces& pair, SurfaceSurfaceIntersection& out) const {
    const Bezier &p = a_.pieces[pair.a], &q = b_.pieces[pair.b];
    const auto own = [](const ParameterMap& m, Interval piece, Interval part) {
      return Interval{map_from_nurbs(m, piece.at(part.lo)), map_from_nurbs(m, piece.at(part.hi))};
    };
    std::vector<detail::Cell4> boxes;
    constexpr std::size_t most = 64;  // beyond that their hull
    for (const detail::Cell4& cell : pair.cells.undecided) {
      if (boxes.size() < most) {
        boxes.push_back(cell);
        continue;
      }
      for (int i = 0; i < 4; ++i)
        boxes[0][i] = {std::min(boxes[0][i].lo, cell[i].lo), std::max(boxes[0][i].hi, cell[i].hi)};
    }
    for (const detail::Cell4& c : boxes)
      out.undecided.push_back({own(a_.nurbs.map_u, p.u, c[0]), own(a_.nurbs.map_v, p.v, c[1]),
                               own(b_.nurbs.map_u, q.u, c[2]), own(b_.nurbs.map_v, q.v, c[3])});
  }

  const Side &a_, &b_;
  const std::vector<PairOfPieces>& pairs_;
  const detail::Scale& scale_;
  const double near_;
};

Result<SurfaceSurfaceIntersection> by_pieces(const Side& a, const Side& b, const detail::Scale& scale,
                                             const SurfaceIntersectOptions& options) {
  SurfaceSurfaceIntersection out;
  std::vector<Box> boxes;
  for (const Bezier& q : b.pieces) boxes.push_back(detail::hull(q, q.net));
  std::size_t cells = options.cells;
  std::vector<PairOfPieces> pairs;
  bool overlap = false;
  double gap = 0;
  for (std::size_t i = 0; i < a.pieces.size(); ++i) {
    const Box box = detail::hull(a.pieces[i], a.pieces[i].net);
    for (std::size_t j = 0; j < b.pieces.size(); ++j) {
      if (detail::apart(box, boxes[j], scale.tolerance)) continue;
      // Pieces that coincide never come to an end; asking all pairs whether they do would cost more than most of them.
      constexpr std::size_t before_asking = 3000;
      std::size_t few = std::min(before_asking, cells);
      const std::size_t given = few;
      PairOfPieces pair{i, j, detail::common_arcs(a.pieces[i], b.pieces[j], scale.tolerance, few)};
      cells -= given - few;
      if (few == 0 && cells > 0) {
        if (coincide(a.pieces[i], b.pieces[j], 16 * scale.tolerance, gap)) {
          overlap = true;
          continue;
        }
        pair.cells = detail::common_arcs(a.pieces[i], b.pieces[j], scale.tolerance, cells);
      }
      pairs.push_back(std::move(pair));
    }
  }
  out.cells = options.cells - cells;
  detail::Weaver weaver(a, b, pairs, scale.origin, scale.size);
  for (std::size_t k = 0; k < pairs.size(); ++k)
    for (const detail::Chain& c : detail::chains(a.pieces[pairs[k].a], b.pieces[pairs[k].b], pairs[k].cells))
      weaver.add(k, c);
  auto branches = weaver.branches(options.fit_mm > 0 ? options.fit_mm : 1e-8 * scale.size);
  if (!branches) return tl::unexpected<Error>(branches.error());
  out.branches = std::move(*branches);
  if (overlap) {
    SurfaceOverlap o;
    o.gap_mm = gap;
    add_outline(a, b.nurbs.surface, true, options, o.outline);
    add_outline(b, a.nurbs.surface, false, options, o.outline);
    out.overlaps.push_back(std::move(o));
  }
  const Assembler assembler(a, b, pairs, scale);
  assembler.add_points(out);
  assembler.add_side_contacts(out, true, options);
  assembler.add_side_contacts(out, false, options);
  assembler.count_components(out);
  return out;
}

// Two planes without borders.
SurfaceSurfaceIntersection intersect_planes(const Frame& a, const Frame& b, double tolerance_mm) {
  SurfaceSurfaceIntersection out;
  const Vector along = cross(a.z, b.z);
  const double offset = dot(b.origin - a.origin, b.z), size = dot(along, along);
  const double reach = std::max({norm(to_vector(a.origin)), norm(to_vector(b.origin)), 1e-300});
  if (!(size > 1e-24)) {  // parallel
    const double gap = std::abs(offset);
    if (gap <= (tolerance_mm > 0 ? tolerance_mm : 1e-12 * reach)) out.overlaps.push_back({{}, gap});
    return out;
  }
  // From a's origin, inside plane a, across the line to plane b.
  const Vector across = cross(along, a.z);
  const Point start = a.origin + offset / dot(across, b.z) * across, end = start + along / std::sqrt(size);
  const auto image = [&](const Frame& f) {
    const auto uv = [&](Point p) { return Point{dot(p - f.origin, f.x), dot(p - f.origin, f.y), 0}; };
    return Curve2{Curve{Line{uv(start), uv(end), {-infinity, infinity}}}};
  };
  IntersectionBranch branch{Curve{Line{start, end, {-infinity, infinity}}}, image(a), image(b), 0, false, false, 0};
  const double off_a = std::abs(dot(start - a.origin, a.z)), off_b = std::abs(dot(start - b.origin, b.z));
  branch.bound_mm = std::max(off_a, off_b) + 1e-15 * reach;
  out.branches.push_back(std::move(branch));
  out.components = 1;
  return out;
}

}  // namespace

Result<SurfaceSurfaceIntersection> intersect(const Surface& a, const Surface& b, const SurfaceIntersectOptions& options,
                                             std::optional<Interval> u_first, std::optional<Interval> v_first,
                                             std::optional<Interval> u_second, std::optional<Interval> v_second) {
  const Plane *plane_a = std::get_if<Plane>(&a.shape), *plane_b = std::get_if<Plane>(&b.shape);
  if (plane_a && plane_b && !u_first && !v_first && !u_second && !v_second)
    return intersect_planes(plane_a->frame, plane_b->frame, options.tolerance_mm);
  const auto box_of = [](const Surface& s, detail::Patch p) {
    return p.u.is_bounded() && p.v.is_bounded() ? bounding_box(s, p.u, p.v) : Box{};
  };
  detail::Patch pa = detail::cut_to(a, u_first, v_first, Box{}), pb = detail::cut_to(b, u_second, v_second, Box{});
  const Box box_b = box_of(b, pb);
  pa = detail::cut_to(a, u_first, v_first, box_b);
  pb = detail::cut_to(b, u_second, v_second, box_of(a, pa));
  if (!pa.u.is_bounded() || !pa.v.is_bounded() || !pb.u.is_bounded() || !pb.v.is_bounded())
    return fail(ErrorCode::InvalidArgument, "two unbounded surfaces: one of them needs a range");
  const auto na = to_nurbs(a, pa.u, pa.v), nb = to_nurbs(b, pb.u, pb.v);
  if (!na || !nb) return tl::unexpected<Error>(na ? nb.error() : na.error());
  const detail::Scale scale =
      detail::scale_of(bounding_box(na->surface), bounding_box(nb->surface), options.tolerance_mm);
  const auto side_a = make_side(a, *na, scale.origin), side_b = make_side(b, *nb, scale.origin);
  if (!side_a || !side_b) return tl::unexpected<Error>(side_a ? side_b.error() : side_a.error());
  return by_pieces(*side_a, *side_b, scale, options);
}

}  // namespace trimloop
