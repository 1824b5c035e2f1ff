#include "kernel/nurbs/knot_vectors.h"

#include "base/assert.h"
#include "kernel/nurbs/basis.h"
#include "kernel/nurbs/basis_functions.h"

namespace trimloop {

std::vector<double> uniform_knots(int degree, std::size_t poles) {
  TRIMLOOP_ASSERT(degree >= 1 && poles > static_cast<std::size_t>(degree), "a spline has degree + 1 poles or more");
  std::vector<double> knots;
  for (std::size_t i = 0; i < poles + static_cast<std::size_t>(degree) + 1; ++i)
    knots.push_back(static_cast<double>(i) - degree);
  return knots;
}

std::vector<double> clamped_knots(int degree, std::size_t poles) {
  std::vector<double> knots = uniform_knots(degree, poles);
  const double end = static_cast<double>(poles) - degree;
  for (double& t : knots) t = std::clamp(t, 0.0, end);
  return knots;
}

std::vector<double> from_short_knots(std::span<const double> knots) {
  TRIMLOOP_ASSERT(!knots.empty(), "there are knots");
  std::vector<double> out{knots.front()};
  out.insert(out.end(), knots.begin(), knots.end());
  out.push_back(knots.back());
  return out;
}

std::vector<double> to_short_knots(std::span<const double> knots) {
  TRIMLOOP_ASSERT(knots.size() > 2, "there are knots left without the outermost");
  return {knots.begin() + 1, knots.end() - 1};
}

Result<NurbsCurve> with_repeated_ends(int degree, std::span<const Point> points) {
  if (points.size() < 2)
    return fail(ErrorCode::InvalidArgument, "a curve has two points or more", static_cast<double>(points.size()), 2);
  if (degree < 1 || degree > detail::max_degree)
    return fail(ErrorCode::InvalidArgument, "the degree is not 1 to 64", degree);
  std::vector<Point> poles(static_cast<std::size_t>(degree) - 1, points.front());
  poles.insert(poles.end(), points.begin(), points.end());
  poles.insert(poles.end(), static_cast<std::size_t>(degree) - 1, points.back());
  return NurbsCurve::from_cartesian(degree, uniform_knots(degree, poles.size()), poles, {});
}

std::vector<double> spline_value(int degree, std::span<const double> knots, std::span<const double> values,
                                 std::size_t components, double t) {
  const std::size_t p = static_cast<std::size_t>(degree), poles = knots.size() - p - 1;
  TRIMLOOP_ASSERT(components > 0 && values.size() == poles * components, "each pole has all components");
  const std::vector<double> n = basis_functions(degree, knots, t);
  const std::size_t k = static_cast<std::size_t>(find_span(degree, knots, poles, t));
  std::vector<double> out(components, 0.0);
  for (std::size_t r = 0; r <= p; ++r)
    for (std::size_t c = 0; c < components; ++c) out[c] += n[r] * values[(k - p + r) * components + c];
  return out;
}

}  // namespace trimloop
