// Parts of a pcurve beyond a border at which the surface holds still are drawn along the border.

#include "kernel/heal/draft.h"

namespace trimloop::heal {
namespace {

class Holder {
 public:
  explicit Holder(const Sheet& sheet) {
    if (sheet.period_u() == 0) u_ = sheet.hold_u();
    if (sheet.period_v() == 0) v_ = sheet.hold_v();
  }
  Uv held(Uv p) const { return {u_.clamp(p.u), v_.clamp(p.v)}; }
  bool is_inside(Uv p) const { return u_.contains(p.u) && v_.contains(p.v); }

 private:
  Interval u_{-infinity, infinity}, v_{-infinity, infinity};
};

struct Corner {
  double t;
  Uv uv;
};

// Fewer corners: those left out lie within `within_mm` of what is left, compared at the same parameter. Between corners both
// are straight, so that holds for all of it. Halving: n log n distances.
std::vector<Corner> thinned(const Sheet& sheet, const std::vector<Corner>& all, double within_mm) {
  if (all.size() < 3) return all;
  std::vector<Corner> kept{all.front()};
  std::vector<std::pair<std::size_t, std::size_t>> todo{{0, all.size() - 1}};
  while (!todo.empty()) {
    const auto [first, last] = todo.back();
    todo.pop_back();
    const Corner &a = all[first], &b = all[last];
    bool is_straight = true;
    for (std::size_t i = first + 1; i < last && is_straight; ++i) {
      const Uv on = a.uv + (all[i].t - a.t) / (b.t - a.t) * (b.uv - a.uv);
      is_straight = sheet.millimetres(on, all[i].uv) <= within_mm;
    }
    if (is_straight) {
      kept.push_back(b);
      continue;
    }
    const std::size_t middle = (first + last) / 2;
    todo.push_back({middle, last});
    todo.push_back({first, middle});
  }
  return kept;
}

// Polyline in the parameters of the piece, so that maps stay what they are.
bool draw_along_border(Piece& p, const Holder& holder, const Sheet& sheet, double within_mm) {
  constexpr int refined = 4;
  std::vector<double> ts;
  const auto add = [&](double t) {
    if (ts.empty() || t > ts.back()) ts.push_back(t);
  };
  const bool backwards = p.t0 > p.t1;
  if (backwards) std::reverse(p.samples.begin(), p.samples.end());
  for (std::size_t i = 0; i + 1 < p.samples.size(); ++i) {
    double before = p.samples[i].t;
    add(before);
    for (int k = 1; k <= refined; ++k) {
      const double t = Interval{p.samples[i].t, p.samples[i + 1].t}.at(double(k) / refined);
      if (holder.is_inside(uv_of(p, before)) != holder.is_inside(uv_of(p, t))) {
        double in = before, out = t;
        const bool first_is_inside = holder.is_inside(uv_of(p, before));
        for (int j = 0; j < 50; ++j) {
          const double mid = 0.5 * (in + out);
          (holder.is_inside(uv_of(p, mid)) == first_is_inside ? in : out) = mid;
        }
        add(in);
      }
      add(t);
      before = t;
    }
  }
  std::vector<Corner> corners;
  for (double t : ts) corners.push_back({t, holder.held(uv_of(p, t))});
  corners = thinned(sheet, corners, within_mm);
  std::vector<Point> points;
  std::vector<double> knots{ts.front()};
  for (const Corner& c : corners) {
    const Uv uv = c.uv - p.shift;
    points.push_back({uv.u, uv.v, 0});
    knots.push_back(c.t);
  }
  knots.push_back(ts.back());
  auto drawn = NurbsCurve::from_cartesian(1, std::move(knots), points, {});
  if (backwards) std::reverse(p.samples.begin(), p.samples.end());
  if (!drawn) return false;
  p.pcurve = Curve2{Curve{std::move(*drawn)}};
  return take_samples(p);
}

}  // namespace

double overshoot_mm(const Sheet& sheet, const Piece& p, Uv* where) {
  const Holder holder(sheet);
  double worst = 0;
  for (const Sample& s : p.samples) {
    const Uv held = holder.held(s.uv);
    if (held.u == s.uv.u && held.v == s.uv.v) continue;
    const double mm = sheet.millimetres(held, s.uv);
    if (mm > worst) {
      worst = mm;
      if (where) *where = held;
    }
  }
  return worst;
}

void hold(Draft& draft, Piece& p, int loop) {
  Uv where;
  const double beyond = overshoot_mm(draft.sheet, p, &where);
  if (!(beyond > 0.1 * draft.tolerance_mm)) return;
  constexpr double share = 0.1;  // of the tolerance, for corners left out
  if (!draw_along_border(p, Holder(draft.sheet), draft.sheet, share * draft.tolerance_mm)) {
    draft.failure = "a parameter curve lies outside the surface and could not be held at its border";
    return;
  }
  if (p.curve)  // it still ends beyond the border: how far is measured again
    for (const Sample& s : p.samples)
      p.gap_mm = std::max(p.gap_mm, distance(evaluate(*p.curve, curve_parameter(p, s.t)), draft.sheet.point(s.uv)));
  if (beyond > draft.tolerance_mm)
    draft.record(Step::Clamped, loop, p.segment, beyond, 0, draft.sheet.point(where), true);
}

}  // namespace trimloop::heal
