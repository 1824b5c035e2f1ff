#include "kernel/pcurve/deviation.h"

#include <queue>

#include "kernel/geometry/detail.h"
#include "kernel/pcurve/shape_model.h"

namespace trimloop {
namespace {

using detail::ModelPoint;
using detail::TaylorModel;

double length_at(const ModelPoint& m, double x) {
  const auto value = [x](const TaylorModel& t) {
    double sum = 0;
    for (int k = TaylorModel::order; k >= 0; --k) sum = sum * x + t.coefficient(k);
    return sum;
  };
  return norm(Vector{value(m.x), value(m.y), value(m.z)});
}
double radius(const ModelPoint& m) { return norm(Vector{m.x.radius(), m.y.radius(), m.z.radius()}); }

struct Part {
  Interval over;
  double bound;
  std::size_t order;  // ties by age
  bool operator<(const Part& o) const { return bound != o.bound ? bound < o.bound : order > o.order; }
};

// `difference(t)`: model of the vector whose length is asked. `at_joints`: of pieces that begin or end there.
template <class Difference>
Deviation largest(const Difference& difference, const std::vector<double>& stops, const DeviationOptions& o) {
  Deviation out;
  std::priority_queue<Part> open;
  std::size_t parts = 0;
  const auto add = [&](Interval over) {
    const ModelPoint d = difference(TaylorModel::over(over.lo, over.hi));
    const double bound = detail::magnitude(d);
    open.push({over, std::isnan(bound) ? infinity : bound, parts++});
    if (!(bound < infinity)) return;
    for (const double x : {-1.0, -0.75, -0.45, 0.0, 0.45, 0.75, 1.0}) {
      const double seen = length_at(d, x) - radius(d);  // certainly reached
      if (seen > out.measured_mm) out.measured_mm = seen, out.at = over.at(0.5 * (1 + x));
    }
  };
  for (std::size_t i = 0; i + 1 < stops.size(); ++i)
    if (stops[i] < stops[i + 1]) add({stops[i], stops[i + 1]});
  while (!open.empty()) {
    const Part worst = open.top();
    const double good = std::max(o.ratio * out.measured_mm + o.floor_mm, o.enough_mm);
    const double mid = worst.over.mid();
    if (worst.bound <= good || parts >= o.parts + o.parts_of_piece * stops.size() || !(worst.over.lo < mid && mid < worst.over.hi))
      break;
    open.pop();
    add({worst.over.lo, mid});
    add({mid, worst.over.hi});
  }
  out.bound_mm = open.empty() ? infinity : open.top().bound;
  return out;
}

// Ends of `range`, and what of `at` lies inside.
void add_inside(std::vector<double>& stops, Interval range, const std::vector<double>& at) {
  for (const double t : at)
    if (range.lo < t && t < range.hi) stops.push_back(t);
}
std::vector<double> stops_of(const Curve& a, Interval range, const Curve& b, Interval on_b) {
  std::vector<double> stops{range.lo, range.hi};
  add_inside(stops, range, breaks(a));
  std::vector<double> there = breaks(b);
  for (double& t : there) t = range.lo + (t - on_b.lo) / on_b.length() * range.length();
  if (on_b.length() != 0) add_inside(stops, range, there);
  std::sort(stops.begin(), stops.end());
  return stops;
}
TaylorModel mapped(const TaylorModel& t, Interval from, Interval to) {
  if (from.lo == to.lo && from.hi == to.hi) return t;
  return TaylorModel(to.lo) + to.length() / from.length() * (t - TaylorModel(from.lo));
}

// How many turns lie between the parameter and the range, over the interval: one number, or two at a seam.
struct Turns {
  double first = 0, last = 0;
};
Turns turns(const TaylorModel& t, Interval range, double period) {
  if (!(period > 0)) return {};
  return {std::floor((t.lower() - range.lo) / period), std::floor((t.upper() - range.lo) / period)};
}

// The surface in its cover. Where a seam is crossed the point is on the one side or on the other.
ModelPoint in_cover(const Surface& s, const TaylorModel& u, const TaylorModel& v, const DeviationOptions& o) {
  const detail::Rectangle r = detail::rectangle(s);
  const Turns nu = turns(u, r.u, o.period_u), nv = turns(v, r.v, o.period_v);
  if (!(nu.last - nu.first <= 1) || !(nv.last - nv.first <= 1)) return {TaylorModel::unknown(), 0, 0};
  ModelPoint out;
  for (double i = nu.first; i <= nu.last; ++i)
    for (double j = nv.first; j <= nv.last; ++j) {
      const ModelPoint p =
          detail::model(s, u - TaylorModel(i * o.period_u), v - TaylorModel(j * o.period_v), false).point;
      if (i == nu.first && j == nv.first) {
        out = p;
        continue;
      }
      out.x.widen((out.x - p.x).magnitude());
      out.y.widen((out.y - p.y).magnitude());
      out.z.widen((out.z - p.z).magnitude());
    }
  return out;
}

}  // namespace

Deviation deviation(const Curve2& pcurve, Interval on_pcurve, const Surface& surface, const Curve& curve,
                    Interval range, const DeviationOptions& options) {
  const auto difference = [&](const TaylorModel& t) {
    const ModelPoint uv = detail::model(pcurve.curve, mapped(t, range, on_pcurve)).point;
    return in_cover(surface, uv.x, uv.y, options) - detail::model(curve, t).point;
  };
  return largest(difference, stops_of(curve, range, pcurve.curve, on_pcurve), options);
}

Deviation deviation(const Curve& a, Interval range, const Curve& b, Interval on_b, const DeviationOptions& options) {
  const auto difference = [&](const TaylorModel& t) {
    return detail::model(a, t).point - detail::model(b, mapped(t, range, on_b)).point;
  };
  return largest(difference, stops_of(a, range, b, on_b), options);
}

}  // namespace trimloop
