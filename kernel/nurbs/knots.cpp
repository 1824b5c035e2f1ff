#include "kernel/nurbs/knots.h"

#include <fmt/format.h>

#include "base/limits.h"
#include "kernel/nurbs/basis.h"

namespace trimloop {

static_assert(Limits{}.degree <= detail::max_degree, "evaluators keep one value per pole of a span on the stack");

int find_span(int degree, std::span<const double> knots, std::size_t poles, double t) {
  const std::size_t p = static_cast<std::size_t>(degree);
  return static_cast<int>(detail::span_of(knots.data(), p, poles, Interval{knots[p], knots[poles]}.clamp(t)));
}

namespace detail {

namespace {

// Differences below this have no finite reciprocal to speak of; no program writes such knots on purpose.
constexpr double smallest_span = 1e-300;

Result<void> check_order(std::string_view where, std::span<const double> knots) {
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i]))
      return fail(ErrorCode::InvalidArgument, fmt::format("{}knot {} is not finite ({})", where, i, knots[i]),
                  knots[i]);
    if (i == 0) continue;
    const double step = knots[i] - knots[i - 1];
    if (step < 0)
      return fail(ErrorCode::InvalidArgument,
                  fmt::format("{}knots descend: knot {} is {}, knot {} is {}", where, i - 1, knots[i - 1], i, knots[i]),
                  step, 0);
    if (step > 0 && step < smallest_span)
      return fail(ErrorCode::InvalidArgument,
                  fmt::format("{}knots {} and {} differ by {}, too little to divide by", where, i - 1, i, step), step,
                  smallest_span);
  }
  if (!std::isfinite(knots.back() - knots.front()))
    return fail(ErrorCode::InvalidArgument,
                fmt::format("{}knots reach from {} to {}, which overflows", where, knots.front(), knots.back()));
  return {};
}

Result<void> check_multiplicities(std::string_view where, std::size_t degree, std::span<const double> knots,
                                  Interval domain) {
  for (std::size_t i = 0, next = 0; i < knots.size(); i = next) {
    for (next = i + 1; next < knots.size() && knots[next] == knots[i];) ++next;
    const bool is_end = knots[i] <= domain.lo || knots[i] >= domain.hi;
    const std::size_t allowed = is_end ? degree + 1 : degree;
    if (next - i > allowed)
      return fail(ErrorCode::InvalidArgument,
                  fmt::format("{}knot {} ({}) {} has multiplicity {}, but degree {} allows {} there", where, i,
                              knots[i], is_end ? "at an end" : "inside", next - i, degree, allowed),
                  static_cast<double>(next - i), static_cast<double>(allowed));
  }
  return {};
}

}  // namespace

Result<void> check_knots(std::string_view where, int degree, std::span<const double> knots, std::size_t poles) {
  if (degree < 1 || degree > max_degree)
    return fail(ErrorCode::InvalidArgument, fmt::format("{}degree is {}, not 1 to {}", where, degree, max_degree),
                degree, degree < 1 ? 1 : max_degree);
  const std::size_t p = static_cast<std::size_t>(degree);
  if (poles < p + 1)
    return fail(ErrorCode::InvalidArgument,
                fmt::format("{}degree {} needs at least {} poles, there are {}", where, degree, p + 1, poles),
                static_cast<double>(poles), static_cast<double>(p + 1));
  if (knots.size() <= p || knots.size() - p - 1 != poles)
    return fail(ErrorCode::InvalidArgument,
                fmt::format("{}{} poles of degree {} need {} knots, there are {}", where, poles, degree, poles + p + 1,
                            knots.size()),
                static_cast<double>(knots.size()), static_cast<double>(poles + p + 1));
  if (auto ok = check_order(where, knots); !ok) return ok;
  const Interval domain{knots[p], knots[poles]};
  if (!(domain.lo < domain.hi))
    return fail(ErrorCode::InvalidArgument,
                fmt::format("{}knot domain is empty: knots {} and {} are both {}", where, p, poles, domain.lo), 0);
  return check_multiplicities(where, p, knots, domain);
}

Result<Interval> check_range(std::string_view where, Interval domain, std::optional<Interval> wanted) {
  if (!wanted) return domain;
  const double slack = 1e-9 * domain.length();
  const double excess = std::max(domain.lo - wanted->lo, wanted->hi - domain.hi);
  if (!(wanted->lo < wanted->hi))
    return fail(ErrorCode::InvalidArgument, fmt::format("{}range [{}, {}] is empty", where, wanted->lo, wanted->hi),
                wanted->length(), 0);
  if (!(excess <= slack))
    return fail(ErrorCode::InvalidArgument,
                fmt::format("{}range [{}, {}] leaves the knot domain [{}, {}] by {}", where, wanted->lo, wanted->hi,
                            domain.lo, domain.hi, excess),
                excess, slack);
  const Interval range{domain.clamp(wanted->lo), domain.clamp(wanted->hi)};
  if (!(range.lo < range.hi))
    return fail(ErrorCode::InvalidArgument,
                fmt::format("{}range [{}, {}] has no length inside the knot domain [{}, {}]", where, wanted->lo,
                            wanted->hi, domain.lo, domain.hi),
                0, 0);
  return range;
}

Result<void> check_poles(std::span<const Hpoint> poles) {
  bool has_weight = false;
  for (std::size_t i = 0; i < poles.size(); ++i) {
    const Hpoint& h = poles[i];
    if (!std::isfinite(h.x) || !std::isfinite(h.y) || !std::isfinite(h.z) || !std::isfinite(h.w))
      return fail(ErrorCode::InvalidArgument,
                  fmt::format("pole {} is not finite: ({}, {}, {}), weight {}", i, h.x, h.y, h.z, h.w));
    has_weight = has_weight || h.w != 0;
  }
  if (!has_weight) return fail(ErrorCode::InvalidArgument, "all weights are zero", 0);
  return {};
}

bool divide_out_equal_weights(std::span<Hpoint> poles) {
  const double w = poles.front().w;
  for (const Hpoint& h : poles)
    if (h.w != w || !is_finite(project(h))) return true;
  for (Hpoint& h : poles) {
    const Point q = project(h);
    h = {q.x, q.y, q.z, 1};
  }
  return false;
}

Result<std::vector<Hpoint>> premultiply(std::span<const Point> points, std::span<const double> weights) {
  if (!weights.empty() && weights.size() != points.size())
    return fail(ErrorCode::InvalidArgument,
                fmt::format("there are {} weights for {} points", weights.size(), points.size()),
                static_cast<double>(weights.size()), static_cast<double>(points.size()));
  // Equal weights mean none; leaving them out keeps the digits of the points.
  const auto differs = [&](double w) { return w != weights.front(); };
  const bool equal = !weights.empty() && std::isfinite(weights.front()) && weights.front() != 0 &&
                     std::none_of(weights.begin(), weights.end(), differs);
  std::vector<Hpoint> poles;
  poles.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& p = points[i];
    const double w = weights.empty() || equal ? 1 : weights[i];
    const double factor = w == 0 ? 1 : w;  // an ideal pole keeps its direction
    poles.push_back({factor * p.x, factor * p.y, factor * p.z, w});
  }
  return poles;
}

std::size_t multiplicity(std::span<const double> knots, double t) {
  const auto [first, last] = std::equal_range(knots.begin(), knots.end(), t);
  return static_cast<std::size_t>(last - first);
}

std::vector<double> breaks(std::span<const double> knots, Interval range) {
  std::vector<double> result{range.lo};
  for (auto k = std::upper_bound(knots.begin(), knots.end(), range.lo); k != knots.end() && *k < range.hi; ++k)
    if (*k != result.back()) result.push_back(*k);
  result.push_back(range.hi);
  return result;
}

}  // namespace detail
}  // namespace trimloop
