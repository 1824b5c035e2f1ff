#include "kernel/nurbs/removal.h"

#include "kernel/nurbs/builder.h"
#include "kernel/nurbs/homogeneous.h"
#include "kernel/nurbs/net.h"

namespace trimloop {
namespace {

using detail::Net;

struct Removed {
  Net net;
  double error = infinity;          // bound on the change of shape
  std::size_t first = 0, last = 0;  // knot spans it concerns: knots[first] .. knots[last] of the net before
};

// One occurrence of the knot at index r (the last of its value), by A5.8 with one removal: new rows from the left and
// from the right, the mean of both where they meet.
Net without_knot(const Net& s, std::size_t r, std::size_t multiplicity) {
  const std::size_t p = s.p(), w = s.width, first = r - p, last = r - multiplicity;
  const double t = s.knots[r];
  Net out{s.degree, w, s.knots, {}};
  out.knots.erase(out.knots.begin() + static_cast<std::ptrdiff_t>(r));
  // Old rows first .. last become last - first new ones, which take the places first .. last - 1.
  std::vector<Hpoint> fresh((last - first) * w);
  const auto old = [&](std::size_t i, std::size_t c) { return s.poles[i * w + c]; };
  const auto alpha = [&](std::size_t i) { return (t - s.knots[i]) / (s.knots[i + p + 1] - s.knots[i]); };
  const std::size_t count = last - first, from_left = (count + 1) / 2;
  for (std::size_t n = 0; n < from_left; ++n) {  // Q_i = (P_i - (1 - a_i) Q_i-1) / a_i
    const std::size_t i = first + n;
    for (std::size_t c = 0; c < w; ++c) {
      const Hpoint before = n == 0 ? old(i - 1, c) : fresh[(n - 1) * w + c];
      fresh[n * w + c] = before + 1 / alpha(i) * (old(i, c) - before);
    }
  }
  for (std::size_t n = count; n-- > count / 2;) {  // Q_i-1 = (P_i - a_i Q_i) / (1 - a_i), i = first + n + 1
    const std::size_t i = first + n + 1;
    for (std::size_t c = 0; c < w; ++c) {
      const Hpoint after = n + 1 == count ? old(i + 1, c) : fresh[(n + 1) * w + c];
      const Hpoint q = after + 1 / (1 - alpha(i)) * (old(i, c) - after);
      fresh[n * w + c] = n < from_left ? 0.5 * (fresh[n * w + c] + q) : q;
    }
  }
  const auto row = [&](std::size_t i) { return s.poles.begin() + static_cast<std::ptrdiff_t>(i * w); };
  out.poles.assign(s.poles.begin(), row(first));
  out.poles.insert(out.poles.end(), fresh.begin(), fresh.end());
  out.poles.insert(out.poles.end(), row(last + 1), s.poles.end());
  return out;
}

// Distance between the shapes of two nets over the same knots, from rows first .. last where they may differ.
double distance_bound(const Net& a, const Net& b, std::size_t first, std::size_t last) {
  double apart = 0, weights_apart = 0, least = infinity, point = 0, size = 0;
  const std::size_t p = a.p();
  const std::size_t from = first > p ? first - p : 0, to = std::min(a.rows() - 1, last + p);
  for (std::size_t i = from * a.width; i < (to + 1) * a.width; ++i) {
    const Hpoint &f = a.poles[i], &g = b.poles[i];
    apart = std::max(apart, norm(detail::xyz(f - g)));
    weights_apart = std::max(weights_apart, std::abs(f.w - g.w));
    least = std::min({least, f.w, g.w});
    point = std::max(point, norm(detail::xyz(g)) / g.w);
    size = std::max({size, norm(detail::xyz(f)), norm(detail::xyz(g))});
  }
  if (!(least > 0)) return infinity;
  // Inserting the knot again rounds by a few units per step.
  apart += 8 * static_cast<double>(p + 1) * std::numeric_limits<double>::epsilon() * size;
  return (apart + point * weights_apart) / least;
}

// Nothing when the knot is at an end of the domain or not there.
Removed try_removal(const Net& s, double t) {
  Removed out;
  const std::size_t p = s.p();
  const auto after = std::upper_bound(s.knots.begin(), s.knots.end(), t);
  const std::size_t r = static_cast<std::size_t>(after - s.knots.begin()) - 1;
  if (!(s.domain().lo < t && t < s.domain().hi) || s.knots[r] != t) return out;
  std::size_t multiplicity = 0;
  while (multiplicity <= r && s.knots[r - multiplicity] == t) ++multiplicity;
  out.first = r - p;
  out.last = r - multiplicity;
  // At full multiplicity the row in the middle has no neighbours to be found from: it is left out, and the curve is the
  // one whose rows are those beside it.
  out.net = without_knot(s, r, multiplicity);
  const Net again = detail::refined(out.net, std::vector<double>{t});
  out.error = distance_bound(s, again, out.first, out.last);
  return out;
}

// The same from what it looks at and no more. The `net` of the result is of no use.
Removed removal_cost(int degree, std::size_t width, std::span<const double> knots, std::span<const Hpoint> poles,
                     double t) {
  const std::size_t p = static_cast<std::size_t>(degree), rows = knots.size() - p - 1;
  if (!(knots[p] < t && t < knots[rows])) return {};
  const std::size_t r = static_cast<std::size_t>(std::upper_bound(knots.begin(), knots.end(), t) - knots.begin()) - 1;
  const std::size_t lo = r > 2 * p + 1 ? r - 2 * p - 1 : 0, hi = std::min(knots.size() - 1, r + 2 * p + 1);
  const auto near_knots = knots.subspan(lo, hi + 1 - lo);
  const auto near_poles = poles.subspan(lo * width, (hi - p - lo) * width);
  Removed out =
      try_removal({degree, width, {near_knots.begin(), near_knots.end()}, {near_poles.begin(), near_poles.end()}}, t);
  out.first += lo;
  out.last += lo;
  return out;
}

// The running sum of bounds per knot span of the domain, by the position of spans in a sorted list of all breaks.
class Spent {
 public:
  explicit Spent(const Net& s) : at_(s.knots), spent_(s.knots.size(), 0.0) {}
  double after(const Net& s, const Removed& r) const {
    return range(s, r, [](double worst, double v) { return std::max(worst, v); }) + r.error;
  }
  void add(const Net& s, const Removed& r) {
    const auto [a, b] = places(s, r);
    for (std::size_t i = a; i < b; ++i) spent_[i] += r.error;
  }
  double worst() const { return *std::max_element(spent_.begin(), spent_.end()); }

 private:
  std::pair<std::size_t, std::size_t> places(const Net& s, const Removed& r) const {
    const double lo = s.knots[r.first], hi = s.knots[r.last + s.p() + 1];
    return {static_cast<std::size_t>(std::lower_bound(at_.begin(), at_.end(), lo) - at_.begin()),
            static_cast<std::size_t>(std::lower_bound(at_.begin(), at_.end(), hi) - at_.begin())};
  }
  template <class F>
  double range(const Net& s, const Removed& r, F fold) const {
    const auto [a, b] = places(s, r);
    double out = 0;
    for (std::size_t i = a; i < b; ++i) out = fold(out, spent_[i]);
    return out;
  }
  std::vector<double> at_, spent_;
};

struct Outcome {
  Net net;
  int removed = 0;
  double error = 0;
};

Outcome remove_one_knot(Net s, double t, int times, double tolerance) {
  Outcome out{std::move(s)};
  for (; out.removed < times; ++out.removed) {
    Removed r = try_removal(out.net, t);
    if (!(out.error + r.error <= tolerance)) break;
    out.error += r.error;
    out.net = std::move(r.net);
  }
  return out;
}

Outcome remove_all_knots(Net s, double tolerance) {
  Outcome out{std::move(s)};
  Spent spent(out.net);
  std::vector<double> candidates;
  for (const double t : out.net.knots)
    if (out.net.domain().lo < t && t < out.net.domain().hi && (candidates.empty() || candidates.back() != t))
      candidates.push_back(t);
  std::vector<double> cost(candidates.size());
  const auto price = [&](std::size_t i) {
    const Removed r = removal_cost(out.net.degree, out.net.width, out.net.knots, out.net.poles, candidates[i]);
    cost[i] = r.error < infinity ? spent.after(out.net, r) : infinity;
  };
  for (std::size_t i = 0; i < candidates.size(); ++i) price(i);
  while (!candidates.empty()) {
    const std::size_t best = static_cast<std::size_t>(std::min_element(cost.begin(), cost.end()) - cost.begin());
    if (!(cost[best] <= tolerance)) break;
    Removed r = try_removal(out.net, candidates[best]);
    spent.add(out.net, r);
    out.net = std::move(r.net);
    ++out.removed;
    const std::size_t reach = out.net.p() + 1;
    if (!std::binary_search(out.net.knots.begin(), out.net.knots.end(), candidates[best])) {
      candidates.erase(candidates.begin() + static_cast<std::ptrdiff_t>(best));
      cost.erase(cost.begin() + static_cast<std::ptrdiff_t>(best));
    }
    const std::size_t from = best > reach ? best - reach : 0;
    for (std::size_t i = from; i < std::min(candidates.size(), best + reach + 1); ++i) price(i);
  }
  out.error = spent.worst();
  return out;
}

Net net(const NurbsCurve& c) { return {c.degree(), 1, c.knots(), c.poles()}; }
Net net(const NurbsSurface& s) { return {s.degree_u(), s.poles_v(), s.knots_u(), s.poles()}; }

KnotRemoval packed(const NurbsCurve& c, Outcome o) {
  if (o.removed == 0) return {c, 0, 0};
  return {NurbsBuilder::curve(o.net.degree, c.is_rational(), std::move(o.net.knots), std::move(o.net.poles), c.range()),
          o.removed, o.error};
}
SurfaceKnotRemoval packed(const NurbsSurface& s, Outcome o) {
  if (o.removed == 0) return {s, 0, 0};
  return {NurbsBuilder::surface(o.net.degree, s.degree_v(), s.is_rational(), std::move(o.net.knots), s.knots_v(),
                                std::move(o.net.poles), s.range_u(), s.range_v()),
          o.removed, o.error};
}

}  // namespace

double removal_bound(const NurbsCurve& c, double t) {
  return removal_cost(c.degree(), 1, c.knots(), c.poles(), t).error;
}

KnotRemoval remove_knot(const NurbsCurve& c, double t, int times, double tolerance) {
  return packed(c, remove_one_knot(net(c), t, times, tolerance));
}
KnotRemoval remove_knots(const NurbsCurve& c, double tolerance) {
  return packed(c, remove_all_knots(net(c), tolerance));
}

SurfaceKnotRemoval remove_knot_u(const NurbsSurface& s, double u, int times, double tolerance) {
  return packed(s, remove_one_knot(net(s), u, times, tolerance));
}
SurfaceKnotRemoval remove_knot_v(const NurbsSurface& s, double v, int times, double tolerance) {
  SurfaceKnotRemoval out = remove_knot_u(swapped(s), v, times, tolerance);
  out.surface = swapped(out.surface);
  return out;
}
SurfaceKnotRemoval remove_knots(const NurbsSurface& s, double tolerance) {
  const SurfaceKnotRemoval u = packed(s, remove_all_knots(net(s), tolerance));
  const NurbsSurface turned = swapped(u.surface);
  const SurfaceKnotRemoval v = packed(turned, remove_all_knots(net(turned), tolerance - u.error));
  return {swapped(v.surface), u.removed + v.removed, u.error + v.error};
}

}  // namespace trimloop
