#include "kernel/intersect/common_stretch.h"

#include "kernel/geometry/detail.h"
#include "kernel/nurbs/builder.h"
#include "kernel/pcurve/shape_model.h"

namespace trimloop::detail {
namespace {

std::vector<double> unit_knots(int degree) {
  std::vector<double> knots(static_cast<std::size_t>(degree) + 1, 0.0);
  knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, 1.0);
  return knots;
}

// Nearest point of `b` to a(s), from several starts.
NearestPair foot(const Bezier& a, const Bezier& b, double s, Interval over, double tolerance) {
  NearestPair best;
  const Cell cell{Interval{s, s}, over, Interval{0, 0}};
  const int starts = 2 * b.degree_u + 1;
  for (int k = 0; k < starts && best.distance > tolerance; ++k) {
    const NearestPair pair = nearest_pair(a, b, cell, {s, over.at((k + 0.5) / starts), 0});
    if (pair.distance < best.distance) best = pair;
  }
  return best;
}

// What coincides goes on to do so when both are extended; about a tangency the gap grows.
bool is_contact_zone(const Bezier& a, const Bezier& b, Interval s, Interval t, double near) {
  if (s.length() > 0.05 || t.length() > 0.05) return false;
  const double by = std::max(4 * s.length(), telling_step(a, s.mid(), near));
  double most = 0;
  for (const double at : {s.lo - by, s.hi + by})
    most = std::max(
        most, nearest_pair(a, b, {Interval{at, at}, Interval{-0.3, 1.3}, Interval{0, 0}}, {at, t.mid(), 0}).distance);
  return most > 4 * near;
}

// A bound of the distance of a(s) from b over the interval, `t` being where to look; infinite when it is too long.
struct Prover {
  const Bezier &a, &b;
  NurbsCurve curve_a, curve_b;
  double allowed;

  double bound(Interval s, double t_lo, double t_hi) const {
    std::vector<Interval> open{s};
    double worst = 0;
    constexpr int most = 400;
    for (int pieces = 0; !open.empty(); ++pieces) {
      const Interval part = open.back();
      open.pop_back();
      const double off = part_bound(part, s, t_lo, t_hi);
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
  double part_bound(Interval part, Interval s, double t_lo, double t_hi) const {
    std::array<double, witness_nodes> values{};
    for (int k = 0; k < witness_nodes; ++k) {
      const double at = part.at(0.5 * (1 + witness_node(k)));
      const double guess = t_lo + (t_hi - t_lo) * (at - s.lo) / s.length();
      const Interval over{std::min(t_lo, t_hi), std::max(t_lo, t_hi)};
      NearestPair pair = nearest_pair(a, b, {Interval{at, at}, over, Interval{0, 0}}, {at, guess, 0});
      if (!(pair.distance <= allowed)) {
        pair = foot(a, b, at, over, allowed);
        if (!(pair.distance <= allowed)) return infinity;
      }
      values[static_cast<std::size_t>(k)] = pair.at[1];
    }
    const ModelPoint d =
        model(curve_a, TaylorModel::over(part.lo, part.hi)).point - model(curve_b, witness(values)).point;
    return magnitude(d);
  }
};

}  // namespace

double telling_step(const Bezier& curve, double s, double near) {
  const Box box = hull(curve, curve.net);
  const double speed = norm(jet(curve, s, 0).du);
  return speed > 0 ? std::min(0.05, 8 * std::sqrt(near * box.diagonal()) / speed) : 0.05;
}

double witness_node(int k) { return -std::cos(pi * (2 * k + 1) / (2.0 * witness_nodes)); }

TaylorModel witness(const std::array<double, witness_nodes>& values) {
  // Newton's divided differences, expanded.
  std::array<double, witness_nodes> d = values;
  for (int level = 1; level < witness_nodes; ++level)
    for (int k = witness_nodes - 1; k >= level; --k)
      d[k] = (d[k] - d[k - 1]) / (witness_node(k) - witness_node(k - level));
  TaylorModel sum(d[witness_nodes - 1]);
  for (int k = witness_nodes - 2; k >= 0; --k)
    sum = sum * (TaylorModel::over(-1, 1) - TaylorModel(witness_node(k))) + TaylorModel(d[k]);
  return sum;
}

NurbsCurve to_nurbs_curve(const Bezier& b) {
  return NurbsBuilder::curve(b.degree_u, b.rational, unit_knots(b.degree_u), b.net, {0, 1});
}
NurbsSurface to_nurbs_surface(const Bezier& b) {
  return NurbsBuilder::surface(b.degree_u, b.degree_v, b.rational, unit_knots(b.degree_u), unit_knots(b.degree_v),
                               b.net, {0, 1}, {0, 1});
}

std::optional<CommonStretch> common_stretch(const Bezier& a, const Bezier& b, double tolerance) {
  const double near = tolerance + blur(a) + blur(b);
  struct End {
    double s, t;
    Point p;
  };
  std::vector<End> ends;
  const auto add = [&](const NearestPair& pair, double s, double t) {
    if (!(pair.distance <= near)) return;
    for (const End& e : ends)
      if (distance(e.p, pair.a) <= 64 * near && std::abs(e.s - s) < 0.5 && std::abs(e.t - t) < 0.5) return;
    ends.push_back({s, t, pair.a});
  };
  const Box box_a = hull(a, a.net), box_b = hull(b, b.net);
  for (const double e : {0.0, 1.0}) {
    if (distance(box_b, evaluate(a, e, 0)) <= near) {
      const NearestPair on_b = foot(a, b, e, {0, 1}, near);
      add(on_b, e, on_b.at[1]);
    }
    if (distance(box_a, evaluate(b, e, 0)) <= near) {
      const NearestPair on_a = foot(b, a, e, {0, 1}, near);
      add(on_a, on_a.at[1], e);
    }
  }
  if (ends.size() < 2) return std::nullopt;
  std::sort(ends.begin(), ends.end(), [](const End& x, const End& y) { return x.s < y.s; });
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const End &x = ends[i], &y = ends[i + 1];
    if (!(y.s > x.s) || x.t == y.t) continue;
    const Interval over{std::min(x.t, y.t), std::max(x.t, y.t)};
    bool together = true;
    for (const double f : {0.5, 0.23, 0.81})
      together = together && foot(a, b, Interval{x.s, y.s}.at(f), over, near).distance <= near;
    if (!together || is_contact_zone(a, b, {x.s, y.s}, over, near)) continue;
    const Prover prover{a, b, to_nurbs_curve(a), to_nurbs_curve(b), 8 * near};
    const double bound = prover.bound({x.s, y.s}, x.t, y.t);
    if (bound <= 8 * near) return CommonStretch{{x.s, y.s}, over, y.t < x.t, bound};
  }
  return std::nullopt;
}

bool only_on_stretch(const void* context, const Cell& cell) {
  const StretchContext& c = *static_cast<const StretchContext*>(context);
  const double near = 16 * (c.tolerance + blur(c.a) + blur(c.b));
  Interval t = cell[1];
  for (const double s : {cell[0].lo, cell[0].hi}) {
    const NearestPair pair =
        nearest_pair(c.a, c.b, {Interval{s, s}, Interval{-0.3, 1.3}, Interval{0, 0}}, {s, cell[1].mid(), 0});
    if (!(pair.distance <= near)) return false;
    t = {std::min(t.lo, pair.at[1]), std::max(t.hi, pair.at[1])};
  }
  // The other curve runs one way over all of it: each of its points there has one parameter.
  std::vector<Hpoint> net;
  restrict_to(c.b, t, {0, 1}, net);
  const Enclosure e = enclose(c.b, net, false);
  return e.valid && dot(e.du.mid(), e.du).lo > 0;
}

}  // namespace trimloop::detail
