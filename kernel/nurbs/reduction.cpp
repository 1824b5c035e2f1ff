#include "kernel/nurbs/reduction.h"

#include <fmt/format.h>

#include <Eigen/Dense>

#include "kernel/nurbs/builder.h"
#include "kernel/nurbs/deviation.h"
#include "kernel/nurbs/net.h"

namespace trimloop {
namespace {

using detail::Net;

// The knots of degree p - 1: end knots and inner multiplicities one less, but no inner knot vanishes.
std::vector<double> lower_knots(const Net& s) {
  std::vector<double> out;
  for (std::size_t i = 0, next = 0; i < s.knots.size(); i = next) {
    for (next = i + 1; next < s.knots.size() && s.knots[next] == s.knots[i];) ++next;
    out.insert(out.end(), std::max<std::size_t>(1, next - i - 1), s.knots[i]);
  }
  return out;
}

// Columns of the map from poles of degree p - 1 to those of degree p over the elevated knots.
struct Elevation {
  std::vector<double> knots;  // elevated
  Eigen::MatrixXd matrix;
};
Elevation elevation(int degree, const std::vector<double>& knots) {
  // One spline whose poles are the unit rows: a net as wide as it is long, in the first coordinate.
  const std::size_t rows = knots.size() - static_cast<std::size_t>(degree) - 1;
  Net units{degree, rows, knots, std::vector<Hpoint>(rows * rows, Hpoint{0, 0, 0, 0})};
  for (std::size_t i = 0; i < rows; ++i) units.poles[i * rows + i].x = 1;
  const Net raised = detail::elevated(units);
  Elevation out{raised.knots,
                Eigen::MatrixXd(static_cast<Eigen::Index>(raised.rows()), static_cast<Eigen::Index>(rows))};
  for (std::size_t i = 0; i < raised.rows(); ++i)
    for (std::size_t j = 0; j < rows; ++j)
      out.matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = raised.poles[i * rows + j].x;
  return out;
}

// Clamped net of degree p >= 2 to degree p - 1. `kept` poles at each end follow exactly from the elevated ones.
Net reduced_once(const Net& source, std::size_t kept) {
  Net out{source.degree - 1, source.width, lower_knots(source), {}};
  const Elevation up = elevation(out.degree, out.knots);
  std::vector<double> added;
  std::set_difference(up.knots.begin(), up.knots.end(), source.knots.begin(), source.knots.end(),
                      std::back_inserter(added));
  const Net target = detail::refined(source, added);
  const auto rows = static_cast<Eigen::Index>(target.rows()), columns = up.matrix.cols();
  const auto width = static_cast<Eigen::Index>(4 * source.width);
  Eigen::MatrixXd right(rows, width);
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index c = 0; c < width; c += 4) {
      const Hpoint& h = target.poles[static_cast<std::size_t>(i) * source.width + static_cast<std::size_t>(c / 4)];
      right(i, c) = h.x, right(i, c + 1) = h.y, right(i, c + 2) = h.z, right(i, c + 3) = h.w;
    }
  // The outermost poles first: they depend on one another only, in a triangle.
  const Eigen::Index fixed = std::min(static_cast<Eigen::Index>(kept), columns / 2);
  Eigen::MatrixXd solution(columns, width);
  for (Eigen::Index i = 0; i < fixed; ++i) {
    Eigen::MatrixXd a = right.row(i), b = right.row(rows - 1 - i);
    for (Eigen::Index j = 0; j < i; ++j) {
      a -= up.matrix(i, j) * solution.row(j);
      b -= up.matrix(rows - 1 - i, columns - 1 - j) * solution.row(columns - 1 - j);
    }
    solution.row(i) = a / up.matrix(i, i);
    solution.row(columns - 1 - i) = b / up.matrix(rows - 1 - i, columns - 1 - i);
  }
  const Eigen::Index free = columns - 2 * fixed;
  if (free > 0) {
    Eigen::MatrixXd rest = right;
    rest -= up.matrix.leftCols(fixed) * solution.topRows(fixed);
    rest -= up.matrix.rightCols(fixed) * solution.bottomRows(fixed);
    solution.middleRows(fixed, free) = up.matrix.middleCols(fixed, free).householderQr().solve(rest);
  }
  out.poles.resize(static_cast<std::size_t>(columns) * source.width);
  for (Eigen::Index i = 0; i < columns; ++i)
    for (Eigen::Index c = 0; c < width; c += 4)
      out.poles[static_cast<std::size_t>(i) * source.width + static_cast<std::size_t>(c / 4)] = {
          solution(i, c), solution(i, c + 1), solution(i, c + 2), solution(i, c + 3)};
  return out;
}

Result<Net> reduced(Net s, int by, int end_order) {
  if (by < 0 || s.degree - by < 1)
    return fail(ErrorCode::InvalidArgument, fmt::format("degree {} cannot be reduced by {}", s.degree, by),
                s.degree - by, 1);
  if (end_order < 0 || 2 * (end_order + 1) > s.degree - by + 1)
    return fail(ErrorCode::InvalidArgument,
                fmt::format("degree {} cannot keep {} derivatives at both ends", s.degree - by, end_order), end_order,
                (s.degree - by + 1) / 2 - 1);
  for (int i = 0; i < by; ++i) s = reduced_once(s, static_cast<std::size_t>(end_order) + 1);
  return s;
}

}  // namespace

Result<Reduction> reduce(const NurbsCurve& c, int by, int end_order) {
  if (by == 0) return Reduction{c, 0};
  const NurbsCurve whole = trimmed(c, c.domain());
  auto n = reduced({c.degree(), 1, whole.knots(), whole.poles()}, by, end_order);
  if (!n) return tl::unexpected<Error>(n.error());
  NurbsCurve out = NurbsBuilder::curve(n->degree, c.is_rational(), std::move(n->knots), std::move(n->poles), c.range());
  const double error = deviation_bound(c, out);
  return Reduction{std::move(out), error};
}

Reduction reduce_within(const NurbsCurve& c, double tolerance) {
  Reduction best{c, 0};
  for (int by = 1; by < c.degree(); ++by) {
    auto next = reduce(c, by);
    if (!next || !(next->error <= tolerance)) break;
    best = std::move(*next);
  }
  return best;
}

Result<SurfaceReduction> reduce(const NurbsSurface& s, int by_u, int by_v) {
  const auto along_u = [](const NurbsSurface& from, int by) -> Result<NurbsSurface> {
    if (by == 0) return from;
    const NurbsSurface whole = trimmed(from, from.domain_u(), from.domain_v());
    auto n = reduced({from.degree_u(), whole.poles_v(), whole.knots_u(), whole.poles()}, by, 0);
    if (!n) return tl::unexpected<Error>(n.error());
    return NurbsBuilder::surface(n->degree, from.degree_v(), from.is_rational(), std::move(n->knots), whole.knots_v(),
                                 std::move(n->poles), from.range_u(), from.range_v());
  };
  const auto u = along_u(s, by_u);
  if (!u) return tl::unexpected<Error>(u.error());
  const auto v = along_u(swapped(*u), by_v);
  if (!v) return tl::unexpected<Error>(v.error());
  NurbsSurface out = swapped(*v);
  const double error = deviation_bound(s, out);
  return SurfaceReduction{std::move(out), error};
}

}  // namespace trimloop
