#include "formats/iges/records/splines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace trimloop::iges {

Order read_order(TokenReader& in, const SplineRules& rules, std::size_t parameter, int upper_index, int degree) {
  if (degree < 1 || upper_index < degree) {
    in.fault_at(parameter, rules.order,
                fmt::format("upper index {} and degree {}: the degree must be 1 to {}", upper_index, degree,
                            std::max(upper_index, 1)),
                degree, upper_index);
    return {};
  }
  Order order;
  order.poles = static_cast<std::size_t>(upper_index) + 1;
  order.knots = order.poles + static_cast<std::size_t>(degree) + 1;
  if (order.knots > in.left())
    in.fault_at(parameter, rules.knot_count,
                fmt::format("upper index {} and degree {} ask for {} knots; {} parameters follow", upper_index, degree,
                            order.knots, in.left()),
                static_cast<double>(in.left()), static_cast<double>(order.knots));
  return order;
}

bool KnotRow::ends_are_poles() const {
  return knots.front() == domain_start() && knots.back() == domain_end() && from == domain_start() &&
         to == domain_end();
}

namespace {

std::string knot_name(const KnotRow& row, std::size_t i) {
  return fmt::format("{}({})", row.name, static_cast<long long>(i) - row.degree);
}

// Returns false when the knots descend; everything else asked of them then makes no sense.
bool check_ascending(const KnotRow& row, const SplineRules& rules, TokenReader& in) {
  std::size_t first = 0, descents = 0;
  for (std::size_t i = 1; i < row.knots.size(); ++i)
    if (row.knots[i] < row.knots[i - 1] && descents++ == 0) first = i;
  if (descents == 0) return true;
  in.fault_at(row.parameter + first, rules.ascending,
              fmt::format("knot {} = {} is smaller than {} before it ({} such knots)", knot_name(row, first),
                          row.knots[first], row.knots[first - 1], descents),
              row.knots[first], row.knots[first - 1]);
  return false;
}

// Runs of equal knots: up to M + 1 at the ends, up to M inside, where M means that the curve may have a corner.
void check_multiplicity(const KnotRow& row, const SplineRules& rules, TokenReader& in) {
  const auto degree = static_cast<std::size_t>(row.degree);
  std::size_t corners = 0, first_corner = 0;
  for (std::size_t begin = 0, end = 0; begin < row.knots.size(); begin = end) {
    while (end < row.knots.size() && row.knots[end] == row.knots[begin]) ++end;
    const std::size_t times = end - begin;
    const bool inside = row.knots[begin] > row.domain_start() && row.knots[begin] < row.domain_end();
    const auto place = [&row, begin, times] {
      return fmt::format("knot {} = {} stands {} times", knot_name(row, begin), row.knots[begin], times);
    };
    if (times > degree + 1) {
      in.fault_at(row.parameter + begin, rules.multiplicity,
                  fmt::format("{}; degree {} allows {}", place(), degree, degree + 1), static_cast<double>(times),
                  static_cast<double>(degree + 1));
      return;
    }
    if (inside && times == degree + 1)
      in.remark_at(row.parameter + begin, rules.multiplicity, place() + ": the spline may fall apart there",
                   static_cast<double>(times), static_cast<double>(degree));
    if (inside && times == degree && degree > 1 && corners++ == 0) first_corner = begin;
  }
  if (corners > 0)
    in.remark_at(row.parameter + first_corner, Severity::Info, rules.multiplicity,
                 fmt::format("{} inner knots stand {} times, the first {} = {}: a corner is possible there", corners,
                             degree, knot_name(row, first_corner), row.knots[first_corner]),
                 static_cast<double>(degree), static_cast<double>(degree));
}

void check_range(const KnotRow& row, const SplineRules& rules, TokenReader& in) {
  const double start = row.domain_start(), end = row.domain_end();
  const std::string stated = fmt::format("the range {} to {}", row.from, row.to);
  if (!(row.from < row.to)) {
    in.fault_at(row.range_parameter, rules.range, stated + " is empty or runs backwards", row.from, row.to);
    return;
  }
  if (row.from >= end || row.to <= start) {
    in.fault_at(row.range_parameter, rules.range,
                fmt::format("{} lies outside the knots' {} to {}", stated, start, end), row.from, start);
    return;
  }
  const double slack = 1e-9 * (end - start);
  if (row.from < start - slack || row.to > end + slack)
    in.remark_at(row.range_parameter, rules.range, fmt::format("{} exceeds the knots' {} to {}", stated, start, end),
                 std::max(start - row.from, row.to - end), slack);
}

}  // namespace

void check_knots(const KnotRow& row, const SplineRules& rules, TokenReader& in) {
  if (!check_ascending(row, rules, in)) return;
  // A span whose square underflows cannot be evaluated.
  const double span = row.domain_end() - row.domain_start();
  if (!(span > 1e-150) || !std::isfinite(span)) {
    in.fault_at(row.parameter, rules.empty_span,
                fmt::format("the knots of {} span {} to {}: no interval is left for the curve", row.name,
                            row.domain_start(), row.domain_end()),
                span, 0);
    return;
  }
  check_multiplicity(row, rules, in);
  check_range(row, rules, in);
}

void check_weights(std::span<const double> weights, std::size_t parameter, const SplineRules& rules, TokenReader& in) {
  const auto bad = std::find_if(weights.begin(), weights.end(), [](double w) { return !(w > 0) || !std::isfinite(w); });
  if (bad == weights.end()) return;
  const std::size_t i = static_cast<std::size_t>(bad - weights.begin());
  in.fault_at(parameter + i, rules.weight,
              fmt::format("weight {} of {} is {}, weights are positive", i + 1, weights.size(), *bad), *bad, 0);
}

bool all_equal(std::span<const double> weights) {
  return std::all_of(weights.begin(), weights.end(),
                     [&](double w) { return std::fabs(w - weights[0]) <= 1e-12 * std::fabs(weights[0]); });
}

double extent(std::span<const Xyz> points, std::size_t first, std::size_t step, std::size_t count) {
  Xyz low = points[first], high = low;
  for (std::size_t i = 1; i < count; ++i) {
    const Xyz& p = points[first + i * step];
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

double size_of(std::span<const Xyz> points) { return points.empty() ? 0 : extent(points, 0, 1, points.size()); }

double distance(const Xyz& a, const Xyz& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

double coincidence(const TokenReader& in, double size) {
  constexpr int parameter_space = 5;
  const double resolution = in.global().resolution;
  if (in.entry().status.use == parameter_space || !(resolution > 0)) return 1e-6 * size;
  return std::max(resolution, 1e-7 * size);
}

}  // namespace trimloop::iges
