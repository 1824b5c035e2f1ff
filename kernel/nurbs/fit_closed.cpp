// Periodic interpolation: a cyclic banded system.

#include <fmt/format.h>

#include <Eigen/SparseLU>

#include "kernel/nurbs/basis.h"
#include "kernel/nurbs/fit_detail.h"
#include "kernel/nurbs/periodic.h"

namespace trimloop {

Result<Fit> interpolate_closed(std::span<const Point> points, int degree, Spacing spacing) {
  auto d = detail::distinct(points);
  if (!d) return tl::unexpected<Error>(d.error());
  if (d->points.size() > 1 && distance(d->points.front(), d->points.back()) == 0) {
    const std::size_t last = d->points.size() - 1;
    d->points.pop_back();
    for (std::size_t& place : d->place) place = place == last ? 0 : place;
  }
  const std::size_t n = d->points.size();
  if (degree < 1 || degree > detail::max_degree || degree % 2 == 0)
    return fail(ErrorCode::InvalidArgument, fmt::format("a closed interpolant has an odd degree, not {}", degree),
                degree);
  if (n < static_cast<std::size_t>(degree))
    return fail(ErrorCode::InvalidArgument,
                fmt::format("degree {} needs {} distinct points, there are {}", degree, degree, n));
  std::vector<Point> ring = d->points;
  ring.push_back(ring.front());
  const std::vector<double> t = parameters_of(ring, spacing);
  std::vector<Hpoint> poles(n, Hpoint{});
  const auto frame = from_periodic(degree, t, poles);  // its full knots
  if (!frame) return tl::unexpected<Error>(frame.error());
  const std::size_t p = static_cast<std::size_t>(degree);
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixXd right(static_cast<Eigen::Index>(n), 3);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = detail::span_of(frame->knots().data(), p, frame->poles().size(), t[i]);
    double row[detail::max_degree + 1];
    detail::fill_derivative(degree, 0, frame->knots().data() + k, t[i], row);
    for (std::size_t r = 0; r <= p; ++r)
      entries.emplace_back(static_cast<int>(i), static_cast<int>((k - p + r) % n), row[r]);
    const Point& q = d->points[i];
    right.row(static_cast<Eigen::Index>(i)) << q.x, q.y, q.z;
  }
  Eigen::SparseMatrix<double> matrix(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(matrix);
  if (lu.info() != Eigen::Success) return fail(ErrorCode::Degenerate, "the periodic interpolation system is singular");
  const Eigen::MatrixXd x = lu.solve(right);
  for (std::size_t i = 0; i < n; ++i) {
    const auto r = static_cast<Eigen::Index>(i);
    poles[i] = {x(r, 0), x(r, 1), x(r, 2), 1};
  }
  auto curve = from_periodic(degree, t, poles);
  if (!curve) return tl::unexpected<Error>(curve.error());
  std::vector<double> parameters;
  for (const std::size_t place : d->place) parameters.push_back(t[place]);
  const double error = detail::error_at(*curve, points, parameters);
  return Fit{std::move(*curve), std::move(parameters), error};
}

}  // namespace trimloop
