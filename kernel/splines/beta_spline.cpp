#include "kernel/splines/beta_spline.h"

#include <fmt/format.h>

namespace trimloop {

namespace {

// One direction: knots, and each pole as a combination of at most four control points.
struct Plan {
  struct Row {
    std::size_t first = 0;  // control point
    std::array<double, 4> factor{};
  };
  std::vector<double> knots;
  std::vector<Row> poles;
  Interval range;
};

constexpr double widest_progression = 1e9;

Result<void> check(std::size_t count, BetaShape shape) {
  if (count < 4)
    return fail(ErrorCode::InvalidArgument, fmt::format("{} control points, at least 4 are needed", count),
                static_cast<double>(count), 4);
  if (!(shape.bias > 0) || !std::isfinite(shape.bias))
    return fail(ErrorCode::InvalidArgument, fmt::format("bias {} is not positive", shape.bias), shape.bias, 0);
  const double b = shape.bias, sum = 2 * b * b * b + 4 * b * b + 4 * b + shape.tension + 2;
  if (!(sum > 0) || !std::isfinite(sum))
    return fail(ErrorCode::InvalidArgument, fmt::format("tension {} leaves no basis", shape.tension), shape.tension,
                shape.tension - sum);
  return {};
}

// Knots of multiplicity `inner` in geometric progression, clamped ends unless the poles are the control points.
Plan progression(std::size_t count, double bias) {
  Plan plan;
  const std::size_t segments = count - 3;
  double before = 0, step = 1;
  std::vector<double> lower;  // three knots below 0
  for (int i = 0; i < 3; ++i) {
    step /= bias;
    before -= step;
    lower.insert(lower.begin(), before);
  }
  plan.knots = lower;
  double at = 0;
  step = 1;
  for (std::size_t i = 0; i <= segments + 3; ++i) {
    plan.knots.push_back(at);
    at += step;
    step *= bias;
  }
  plan.range = {0, plan.knots[3 + segments]};
  for (std::size_t i = 0; i < count; ++i) plan.poles.push_back({std::min(i, count - 4), {}});
  for (std::size_t i = 0; i < count; ++i) plan.poles[i].factor[i - plan.poles[i].first] = 1;
  return plan;
}

Plan pieces(std::size_t count, BetaShape shape, bool uniform) {
  const Matrix<double> bezier = beta_to_bezier(shape.bias, shape.tension);
  const auto row = [&bezier](std::size_t k, std::size_t segment) {
    return Plan::Row{segment, {bezier(k, 0), bezier(k, 1), bezier(k, 2), bezier(k, 3)}};
  };
  Plan plan;
  const std::size_t segments = count - 3;
  plan.knots.assign(4, 0.0);
  plan.poles.push_back(row(0, 0));
  double at = 0, step = 1;
  for (std::size_t i = 0; i < segments; ++i) {
    at += step;
    if (!uniform) step *= shape.bias;
    const bool last = i + 1 == segments;
    plan.poles.push_back(row(1, i));
    plan.poles.push_back(row(2, i));
    if (last || uniform) plan.poles.push_back(row(3, i));
    plan.knots.insert(plan.knots.end(), last ? 4 : uniform ? 3 : 2, at);
  }
  plan.range = {0, at};
  return plan;
}

Plan plan(std::size_t count, BetaShape shape) {
  const double spread = std::pow(shape.bias, static_cast<double>(count));
  const bool wide = !(spread < widest_progression && spread > 1 / widest_progression);
  if (shape.tension == 0 && !wide) return progression(count, shape.bias);
  return pieces(count, shape, wide && shape.bias != 1);
}

template <class Get>
Point combined(const Plan::Row& row, Get get) {
  // One factor of 1 gives the point's own bits.
  Vector sum{};
  for (std::size_t r = 0; r < 4; ++r)
    if (row.factor[r] != 0) sum += row.factor[r] * to_vector(get(row.first + r));
  return to_point(sum);
}

}  // namespace

Result<NurbsCurve> beta_spline(std::span<const Point> points, BetaShape shape) {
  if (auto good = check(points.size(), shape); !good) return tl::unexpected(good.error());
  const Plan p = plan(points.size(), shape);
  std::vector<Point> poles;
  for (const Plan::Row& row : p.poles) poles.push_back(combined(row, [&](std::size_t i) { return points[i]; }));
  return NurbsCurve::from_cartesian(3, p.knots, poles, {}, p.range);
}

Result<NurbsSurface> beta_spline(std::span<const Point> points, std::size_t rows, std::size_t columns, BetaShape u,
                                 BetaShape v) {
  if (auto good = check(rows, u); !good) return tl::unexpected(good.error());
  if (auto good = check(columns, v); !good) return tl::unexpected(good.error());
  if (points.size() != rows * columns)
    return fail(ErrorCode::InvalidArgument, fmt::format("{} points are not {} x {}", points.size(), rows, columns));
  const Plan pu = plan(rows, u), pv = plan(columns, v);
  std::vector<Point> half;  // poles along u, control points along v
  for (const Plan::Row& row : pu.poles)
    for (std::size_t j = 0; j < columns; ++j)
      half.push_back(combined(row, [&](std::size_t i) { return points[i * columns + j]; }));
  std::vector<Point> poles;
  for (std::size_t i = 0; i < pu.poles.size(); ++i)
    for (const Plan::Row& row : pv.poles)
      poles.push_back(combined(row, [&](std::size_t j) { return half[i * columns + j]; }));
  return NurbsSurface::from_cartesian(3, 3, pu.knots, pv.knots, poles, {}, pu.range, pv.range);
}

}  // namespace trimloop
