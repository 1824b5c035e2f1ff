#include "kernel/check/graded_breaks.h"

#include <algorithm>
#include <cmath>

namespace trimloop::detail {
namespace {

const NurbsSurface* spline_of(const Surface& surface) {
  const Surface* s = &surface;
  while (const auto* offset = std::get_if<OffsetSurface>(&s->shape)) {
    if (!offset->basis) return nullptr;
    s = offset->basis.get();
  }
  return std::get_if<NurbsSurface>(&s->shape);
}

// The poles that count over a span, along one direction, and how they are found.
struct Direction {
  const std::vector<double>& knots;
  std::size_t degree, poles, across;
  bool along_u;
};

double weight(const NurbsSurface& s, const Direction& d, std::size_t along, std::size_t across) {
  return d.along_u ? s.pole(along, across).w : s.pole(across, along).w;
}

// The largest quotient of two weights in one row of poles of the span; 1 where a weight is not positive.
double spread(const NurbsSurface& s, const Direction& d, double inside) {
  const auto above = std::upper_bound(d.knots.begin(), d.knots.end(), inside);
  const std::size_t last = std::clamp<std::size_t>(static_cast<std::size_t>(above - d.knots.begin()) - 1, d.degree, d.poles - 1);
  double largest = 1;
  for (std::size_t across = 0; across < d.across; ++across) {
    double low = infinity, high = 0;
    for (std::size_t i = last - d.degree; i <= last; ++i) {
      const double w = weight(s, d, i, across);
      if (!(w > 0)) return 1;
      low = std::min(low, w), high = std::max(high, w);
    }
    largest = std::max(largest, high / low);
  }
  return largest;
}

std::vector<double> graded(const NurbsSurface& s, const Direction& d, std::vector<double> breaks) {
  constexpr double mild = 16, step = 8;
  constexpr int most_steps = 18;  // 8^18 = 2^54: closer to an end than doubles tell apart
  std::vector<double> out;
  for (std::size_t k = 0; k < breaks.size(); ++k) {
    out.push_back(breaks[k]);
    if (k + 1 == breaks.size()) break;
    const Interval span{breaks[k], breaks[k + 1]};
    const double r = spread(s, d, span.mid());
    if (!(r > mild)) continue;
    const int steps = static_cast<int>(std::min<double>(std::ceil(std::log(r) / std::log(step)), most_steps));
    for (int n = steps; n > 0; --n) out.push_back(span.lo + span.length() * std::pow(step, -n));
    for (int n = 1; n <= steps; ++n) out.push_back(span.hi - span.length() * std::pow(step, -n));
  }
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace

std::vector<double> graded_breaks_u(const Surface& surface, std::vector<double> breaks) {
  const NurbsSurface* s = spline_of(surface);
  if (!s || !s->is_rational()) return breaks;
  return graded(*s, {s->knots_u(), static_cast<std::size_t>(s->degree_u()), s->poles_u(), s->poles_v(), true}, std::move(breaks));
}

std::vector<double> graded_breaks_v(const Surface& surface, std::vector<double> breaks) {
  const NurbsSurface* s = spline_of(surface);
  if (!s || !s->is_rational()) return breaks;
  return graded(*s, {s->knots_v(), static_cast<std::size_t>(s->degree_v()), s->poles_v(), s->poles_u(), false}, std::move(breaks));
}

}  // namespace trimloop::detail
