// Where a Bézier curve lies in a Bézier patch.

#include "kernel/geometry/detail.h"
#include "kernel/intersect/common_stretch.h"
#include "kernel/pcurve/shape_model.h"

namespace trimloop::detail {
namespace {

constexpr Interval unit{0, 1};

NearestPair foot(const Bezier& curve, const Bezier& patch, double s, double near) {
  NearestPair best;
  const Cell cell{Interval{s, s}, unit, unit};
  const int nu = patch.degree_u + 1, nv = patch.degree_v + 1;
  for (int i = 0; i < nu && best.distance > near; ++i)
    for (int j = 0; j < nv && best.distance > near; ++j) {
      const NearestPair pair = nearest_pair(curve, patch, cell, {s, (i + 0.5) / nu, (j + 0.5) / nv});
      if (pair.distance < best.distance) best = pair;
    }
  return best;
}

// The four sides as curves.
std::vector<Bezier> sides(const Bezier& p) {
  std::vector<Bezier> out;
  const std::size_t rows = p.rows(), columns = p.columns();
  for (const std::size_t j : {std::size_t{0}, columns - 1}) {
    Bezier side{p.degree_u, 0, p.rational, {}, p.u, {0, 1}, p.noise, p.weight_noise};
    for (std::size_t i = 0; i < rows; ++i) side.net.push_back(p.net[i * columns + j]);
    out.push_back(std::move(side));
  }
  for (const std::size_t i : {std::size_t{0}, rows - 1}) {
    Bezier side{p.degree_v, 0, p.rational, {}, p.v, {0, 1}, p.noise, p.weight_noise};
    for (std::size_t j = 0; j < columns; ++j) side.net.push_back(p.net[i * columns + j]);
    out.push_back(std::move(side));
  }
  return out;
}

// What coincides goes on to do so when both are extended; about a tangency the gap grows.
bool is_contact_zone(const Bezier& curve, const Bezier& patch, Interval s, double near) {
  if (s.length() > 0.05) return false;
  constexpr Interval wide{-0.3, 1.3};
  const double by = std::max(4 * s.length(), telling_step(curve, s.mid(), near));
  double most = 0;
  for (const double at : {s.lo - by, s.hi + by}) {
    const NearestPair start = foot(curve, patch, s.mid(), near);
    most = std::max(
        most, nearest_pair(curve, patch, {Interval{at, at}, wide, wide}, {at, start.at[1], start.at[2]}).distance);
  }
  return most > 4 * near;
}

struct Prover {
  const Bezier &curve, &patch;
  NurbsCurve nurbs_curve;
  NurbsSurface nurbs_patch;
  double allowed;

  double bound(Interval s) const {
    std::vector<Interval> open{s};
    double worst = 0;
    constexpr int most = 400;
    for (int pieces = 0; !open.empty(); ++pieces) {
      const Interval part = open.back();
      open.pop_back();
      const double off = part_bound(part);
      if (off <= allowed) {
        worst = std::max(worst, off);
        continue;
      }
      if (pieces > most) return infinity;
      open.push_back({part.lo, part.mid()});
      open.push_back({part.mid(), part.hi});
    }
    return worst;
  }
  double part_bound(Interval part) const {
    std::array<double, witness_nodes> us{}, vs{};
    std::array<double, 3> start{0, -1, -1};
    for (int k = 0; k < witness_nodes; ++k) {
      const double at = part.at(0.5 * (1 + witness_node(k)));
      NearestPair pair;
      if (start[1] >= 0) pair = nearest_pair(curve, patch, {Interval{at, at}, unit, unit}, {at, start[1], start[2]});
      if (!(pair.distance <= allowed)) pair = foot(curve, patch, at, allowed);
      if (!(pair.distance <= allowed)) return infinity;
      start = pair.at;
      us[static_cast<std::size_t>(k)] = pair.at[1];
      vs[static_cast<std::size_t>(k)] = pair.at[2];
    }
    return magnitude(model(nurbs_curve, TaylorModel::over(part.lo, part.hi)).point -
                     model(nurbs_patch, witness(us), witness(vs)).point);
  }
};

}  // namespace

std::vector<StretchInPatch> stretches_in_patch(const Bezier& curve, const Bezier& patch, double tolerance) {
  const double near = tolerance + blur(curve) + blur(patch);
  std::vector<double> ends;
  const Box patch_box = hull(patch, patch.net), curve_box = hull(curve, curve.net);
  for (const double e : {0.0, 1.0})
    if (distance(patch_box, evaluate(curve, e, 0)) <= near && foot(curve, patch, e, near).distance <= near)
      ends.push_back(e);
  for (const Bezier& side : sides(patch)) {
    const Box a = hull(curve, curve.net), b = hull(side, side.net);
    if (a.lo.x - near > b.hi.x || b.lo.x - near > a.hi.x || a.lo.y - near > b.hi.y || b.lo.y - near > a.hi.y ||
        a.lo.z - near > b.hi.z || b.lo.z - near > a.hi.z)
      continue;
    if (common_stretch(curve, side, tolerance)) continue;  // its ends are corners or ends of the curve
    std::size_t cells = 2000;
    for (const PointContact& c : common_points(curve, side, tolerance, cells).contacts) ends.push_back(c.at[0]);
  }
  for (const Hpoint& corner : {patch.net.front(), patch.net[patch.columns() - 1],
                               patch.net[(patch.rows() - 1) * patch.columns()], patch.net.back()}) {
    const Point p = project(corner);
    if (distance(curve_box, p) > near) continue;
    const Bezier point{1, 0, false, {{p.x, p.y, p.z, 1}, {p.x, p.y, p.z, 1}}, {0, 1}, {0, 1}, 0, 0};
    const Cell cell{Interval{0, 0}, unit, Interval{0, 0}};
    for (int k = 0; k <= 2 * curve.degree_u; ++k) {
      const NearestPair pair = nearest_pair(point, curve, cell, {0, (k + 0.5) / (2 * curve.degree_u + 1), 0});
      if (pair.distance > near) continue;
      ends.push_back(pair.at[1]);
      break;
    }
  }
  std::sort(ends.begin(), ends.end());
  std::vector<StretchInPatch> out;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const Interval s{ends[i], ends[i + 1]};
    if (!(s.length() > 1e-9)) continue;
    bool together = true;
    for (const double f : {0.5, 0.23, 0.81}) together = together && foot(curve, patch, s.at(f), near).distance <= near;
    if (!together || is_contact_zone(curve, patch, s, near)) continue;
    const Prover prover{curve, patch, to_nurbs_curve(curve), to_nurbs_surface(patch), 8 * near};
    const double bound = prover.bound(s);
    if (!(bound <= 8 * near)) continue;
    if (!out.empty() && out.back().on_curve.hi == s.lo) {
      out.back().on_curve.hi = s.hi;
      out.back().bound = std::max(out.back().bound, bound);
    } else {
      out.push_back({s, bound});
    }
  }
  return out;
}

bool only_on_stretch_in_patch(const void* context, const Cell& cell) {
  const StretchContext& c = *static_cast<const StretchContext*>(context);
  const double near = 16 * (c.tolerance + blur(c.a) + blur(c.b));
  Interval u = cell[1], v = cell[2];
  constexpr Interval wide{-0.3, 1.3};
  for (const double f : {0.0, 0.5, 1.0}) {
    const double s = cell[0].at(f);
    const NearestPair pair = nearest_pair(c.a, c.b, {Interval{s, s}, wide, wide}, {s, cell[1].mid(), cell[2].mid()});
    if (!(pair.distance <= near)) return false;
    u = {std::min(u.lo, pair.at[1]), std::max(u.hi, pair.at[1])};
    v = {std::min(v.lo, pair.at[2]), std::max(v.hi, pair.at[2])};
  }
  // What the curve does between the three feet is covered by as much again on either side.
  // Neither side much shorter than the other: the test below sees slivers as folded.
  const BezierJet middle = jet(c.b, u.mid(), v.mid());
  const double du = norm(middle.du), dv = norm(middle.dv), size = std::max(u.length() * du, v.length() * dv);
  const auto widened = [size](Interval i, double speed) {
    const double by = std::max(0.5 * i.length(), speed > 0 ? std::min(0.25 * size / speed, 0.25) : 0.0);
    return Interval{i.lo - by, i.hi + by};
  };
  u = widened(u, du), v = widened(v, dv);
  // The patch is one to one there: a linear map makes it the identity up to a contraction.
  std::vector<Hpoint> net;
  restrict_to(c.b, u, v, net);
  const Enclosure e = enclose(c.b, net, false);
  if (!e.valid) return false;
  const Vector a = e.du.mid(), b = e.dv.mid();
  const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), det = aa * bb - ab * ab;
  if (!(det > 1e-20 * aa * bb)) return false;
  const Vector row_u = (bb * a - ab * b) / det, row_v = (aa * b - ab * a) / det;
  const auto off = [&](Vector row, double one, double other) {
    return (Range(one) - dot(row, e.du)).magnitude() + (Range(other) - dot(row, e.dv)).magnitude();
  };
  return off(row_u, 1, 0) < 1 && off(row_v, 0, 1) < 1;
}

}  // namespace trimloop::detail
