// What is asked of arc length: a measured error, equal parts, extension by a length.

#include <fmt/format.h>

#include "kernel/math/gauss.h"
#include "kernel/geometry/arc_length.h"
#include "kernel/nurbs/join.h"

namespace trimloop {
namespace {

// The 15-point Kronrod rule with the difference from the 7-point Gauss rule inside it, raised to the power that
// QUADPACK found to be safe for smooth integrands.
MeasuredLength kronrod(const Curve& c, double lo, double hi) {
  const double mid = 0.5 * (lo + hi), half = 0.5 * (hi - lo);
  double whole = 0, inner = 0, spread = 0;
  std::array<double, 15> speed{};
  std::size_t i = 0;
  for (const KronrodNode& node : kronrod_15()) {
    speed[i] = norm(jet(c, mid + half * node.x).d1);
    whole += node.kronrod * speed[i];
    inner += node.gauss * speed[i++];
  }
  i = 0;
  for (const KronrodNode& node : kronrod_15()) spread += node.kronrod * std::abs(speed[i++] - 0.5 * whole);
  const double off = std::abs(whole - inner);
  const double error = spread > 0 ? spread * std::min(1.0, std::pow(200 * off / spread, 1.5)) : off;
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * whole;
  return {half * whole, half * std::max(error, rounding)};
}

}  // namespace

Result<MeasuredLength> measured_length(const Curve& c, double absolute_error) {
  if (!is_bounded(c)) return fail(ErrorCode::InvalidArgument, "an unbounded curve has no length");
  struct Part {
    double lo, hi;
    MeasuredLength length;
  };
  std::vector<Part> parts;
  const std::vector<double> at = breaks(c);
  for (std::size_t i = 0; i + 1 < at.size(); ++i)
    if (at[i] < at[i + 1]) parts.push_back({at[i], at[i + 1], kronrod(c, at[i], at[i + 1])});
  const auto less = [](const Part& a, const Part& b) { return a.length.error < b.length.error; };
  std::make_heap(parts.begin(), parts.end(), less);
  const auto sum = [&] {
    MeasuredLength out;
    for (const Part& p : parts) out.value += p.length.value, out.error += p.length.error;
    return out;
  };
  constexpr std::size_t most_parts = 1 << 14;
  double error = sum().error;
  while (error > absolute_error && !parts.empty() && parts.size() < most_parts) {
    std::pop_heap(parts.begin(), parts.end(), less);
    const Part worst = parts.back();
    parts.pop_back();
    const double mid = 0.5 * (worst.lo + worst.hi);
    const bool divisible = worst.lo < mid && mid < worst.hi &&
                           worst.length.error > 32 * std::numeric_limits<double>::epsilon() * worst.length.value;
    if (!divisible) {  // rounding is all that is left
      parts.push_back(worst);
      break;
    }
    for (const auto& [lo, hi] : {std::pair{worst.lo, mid}, std::pair{mid, worst.hi}}) {
      parts.push_back({lo, hi, kronrod(c, lo, hi)});
      error += parts.back().length.error;
      std::push_heap(parts.begin(), parts.end(), less);
    }
    error -= worst.length.error;
  }
  return sum();
}

double parameter_at_length(const ArcLength& a, double length) {
  return a.parameter(a.total() > 0 ? length / a.total() : 0);
}

Result<std::vector<double>> equal_length_parameters(const CurvePtr& curve, int count) {
  if (!curve || count < 1 || !is_bounded(*curve))
    return fail(ErrorCode::InvalidArgument, "a bounded curve is cut into one part or more", count, 1);
  const ArcLength length(curve);
  if (!(length.total() > 0)) return fail(ErrorCode::Degenerate, "the curve has no length", length.total(), 0);
  std::vector<double> out;
  for (int i = 0; i <= count; ++i) out.push_back(length.parameter(i / static_cast<double>(count)));
  return out;
}

Result<NurbsCurve> extended_by_length(const NurbsCurve& c, bool at_start, double wanted) {
  if (!(wanted > 0) || !std::isfinite(wanted))
    return fail(ErrorCode::InvalidArgument, "a length is positive", wanted, 0);
  const double at = at_start ? c.range().lo : c.range().hi, speed = norm(jet(c, at).d1);
  if (!(speed > 0)) return fail(ErrorCode::Degenerate, "the curve ends at rest", speed, 0);
  // Grow the parameter until the new part is long enough, then find the place in it.
  double by = 1.25 * wanted / speed;
  for (int i = 0; i < 40; ++i, by *= 2) {
    const auto longer = extended(c, at_start ? End::Start : End::Finish, by);
    if (!longer) break;
    const Interval added = at_start ? Interval{longer->range().lo, at} : Interval{at, longer->range().hi};
    const ArcLength length(std::make_shared<const Curve>(Curve{trimmed(*longer, added)}));
    if (!std::isfinite(length.total())) break;
    if (!(length.total() >= wanted)) continue;
    const double end = length.parameter(at_start ? 1 - wanted / length.total() : wanted / length.total());
    return trimmed(*longer, at_start ? Interval{end, c.range().hi} : Interval{c.range().lo, end});
  }
  return fail(ErrorCode::Degenerate, "the continuation of the curve does not become that long", wanted);
}

}  // namespace trimloop
