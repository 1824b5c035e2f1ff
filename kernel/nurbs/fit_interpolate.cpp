// Global interpolation of curves and surfaces.

#include <fmt/format.h>

#include "kernel/nurbs/banded.h"
#include "kernel/nurbs/basis.h"
#include "kernel/nurbs/error_bound.h"
#include "kernel/nurbs/fit_detail.h"
#include "kernel/nurbs/periodic.h"

namespace trimloop {
namespace detail {

Result<Distinct> distinct(std::span<const Point> points) {
  Distinct out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& p = points[i];
    if (!is_finite(p))
      return fail(ErrorCode::InvalidArgument, fmt::format("point {} is not finite ({}, {}, {})", i, p.x, p.y, p.z));
    if (out.points.empty() || distance(out.points.back(), p) > 0) out.points.push_back(p);
    out.place.push_back(out.points.size() - 1);
  }
  if (out.points.size() < 2)
    return fail(ErrorCode::Degenerate, fmt::format("{} distinct points make no curve", out.points.size()),
                static_cast<double>(out.points.size()), 2);
  return out;
}

std::vector<double> averaged_knots(std::span<const double> t, int degree) {
  const std::size_t p = static_cast<std::size_t>(degree);
  std::vector<double> knots(p + 1, t.front());
  for (std::size_t j = 1; j + p < t.size(); ++j) {
    double sum = 0;
    for (std::size_t i = j; i < j + p; ++i) sum += t[i];
    knots.push_back(std::clamp(sum / static_cast<double>(p), knots.back(), t.back()));
  }
  knots.insert(knots.end(), p + 1, t.back());
  return knots;
}

double error_at(const NurbsCurve& c, std::span<const Point> points, std::span<const double> parameters) {
  double worst = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const BoundedPoint at = evaluate_bounded(c, parameters[i]);
    worst = std::max(worst, distance(at.point, points[i]) * (1 + 1e-15) + std::sqrt(3.0) * at.error);
  }
  return worst;
}

bool collocate(int degree, std::span<const double> knots, const Conditions& at, std::vector<Hpoint>& right,
               std::size_t width) {
  const std::size_t p = static_cast<std::size_t>(degree), n = at.parameters.size();
  Banded system(n, p, p);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = at.parameters[i];
    const std::size_t k = span_of(knots.data(), p, n, t);
    double row[max_degree + 1];
    fill_derivative(degree, at.orders[i], knots.data() + k, t, row);
    for (std::size_t r = 0; r <= p; ++r) {
      const std::size_t j = k - p + r;
      if (row[r] == 0) continue;
      if (j + p < i || j > i + p) return false;  // the parameter is not where its knots are
      system.at(i, j) = row[r];
    }
  }
  return system.solve(right, width);
}

}  // namespace detail

namespace {

using detail::Conditions;

Result<void> check_degree(int degree, std::size_t conditions, const char* what) {
  if (degree < 1 || degree > detail::max_degree)
    return fail(ErrorCode::InvalidArgument, fmt::format("degree is {}, not 1 to {}", degree, detail::max_degree),
                degree);
  if (conditions < static_cast<std::size_t>(degree) + 1)
    return fail(ErrorCode::InvalidArgument,
                fmt::format("degree {} needs {} {}, there are {}", degree, degree + 1, what, conditions),
                static_cast<double>(conditions), degree + 1);
  return {};
}

Hpoint pole_of(Point p) { return {p.x, p.y, p.z, 1}; }
Hpoint pole_of(Vector v) { return {v.x, v.y, v.z, 0}; }

std::vector<double> all_parameters(const detail::Distinct& d, const std::vector<double>& t) {
  std::vector<double> out;
  for (const std::size_t place : d.place) out.push_back(t[place]);
  return out;
}

Result<Fit> solved(std::span<const Point> points, const detail::Distinct& d, const std::vector<double>& t, int degree,
                   const Conditions& conditions, std::vector<Hpoint> right) {
  std::vector<double> knots = detail::averaged_knots(conditions.parameters, degree);
  if (!detail::collocate(degree, knots, conditions, right, 1))
    return fail(ErrorCode::Degenerate, "the interpolation system is singular: points are spaced too unevenly");
  for (Hpoint& h : right) h.w = 1;
  auto curve = NurbsCurve::from_homogeneous(degree, std::move(knots), std::move(right));
  if (!curve) return tl::unexpected<Error>(curve.error());
  std::vector<double> parameters = all_parameters(d, t);
  const double error = detail::error_at(*curve, points, parameters);
  return Fit{std::move(*curve), std::move(parameters), error};
}

// Means of the parameters of the lines of a net, lines without length left out. A9.3.
Result<std::vector<double>> mean_parameters(std::span<const Point> net, std::size_t lines, std::size_t count,
                                            std::size_t line_step, std::size_t step, Spacing spacing,
                                            const char* what) {
  std::vector<double> mean(count, 0.0);
  double used = 0;
  for (std::size_t i = 0; i < lines; ++i) {
    std::vector<Point> line;
    for (std::size_t k = 0; k < count; ++k) line.push_back(net[i * line_step + k * step]);
    const std::vector<double> t = parameters_of(line, spacing);
    if (!(t.back() > 0)) continue;
    used += 1;
    for (std::size_t k = 0; k < count; ++k) mean[k] += (t[k] - mean[k]) / used;
  }
  if (used == 0) return fail(ErrorCode::Degenerate, fmt::format("all lines of the net along {} have no length", what));
  for (std::size_t k = 1; k < count; ++k)
    if (!(mean[k] > mean[k - 1]))
      return fail(ErrorCode::Degenerate, fmt::format("lines {} and {} of the net along {} coincide", k - 1, k, what));
  mean.back() = 1;
  return mean;
}

}  // namespace

std::vector<double> parameters_of(std::span<const Point> points, Spacing spacing) {
  std::vector<double> t(points.size(), 0.0);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double chord = distance(points[i - 1], points[i]);
    t[i] = t[i - 1] + (spacing == Spacing::Uniform ? 1 : spacing == Spacing::Centripetal ? std::sqrt(chord) : chord);
  }
  const double total = t.empty() ? 0 : t.back();
  if (total > 0)
    for (double& v : t) v = v == total ? 1 : v / total;
  return t;
}

Result<Fit> interpolate(std::span<const Point> points, int degree, Spacing spacing) {
  return interpolate(points, degree, std::nullopt, std::nullopt, spacing);
}

Result<Fit> interpolate(std::span<const Point> points, int degree, std::optional<Vector> start,
                        std::optional<Vector> end, Spacing spacing) {
  const auto d = detail::distinct(points);
  if (!d) return tl::unexpected<Error>(d.error());
  const std::size_t n = d->points.size();
  if (auto ok = check_degree(degree, n + (start ? 1 : 0) + (end ? 1 : 0), "distinct points and derivatives"); !ok)
    return tl::unexpected<Error>(ok.error());
  const std::vector<double> t = parameters_of(d->points, spacing);
  Conditions at;
  std::vector<Hpoint> right;
  const auto ask = [&](double parameter, int order, Hpoint value) {
    at.parameters.push_back(parameter);
    at.orders.push_back(order);
    right.push_back(value);
  };
  for (std::size_t i = 0; i < n; ++i) {
    if (i + 1 == n && end) ask(t[i], 1, pole_of(*end));
    ask(t[i], 0, pole_of(d->points[i]));
    if (i == 0 && start) ask(t[i], 1, pole_of(*start));
  }
  return solved(points, *d, t, degree, at, std::move(right));
}

Result<Fit> interpolate_with_derivatives(std::span<const Point> points, std::span<const Vector> derivatives, int degree,
                                         Spacing spacing) {
  if (derivatives.size() != points.size())
    return fail(ErrorCode::InvalidArgument,
                fmt::format("there are {} derivatives for {} points", derivatives.size(), points.size()));
  const auto d = detail::distinct(points);
  if (!d) return tl::unexpected<Error>(d.error());
  if (d->points.size() != points.size())
    return fail(ErrorCode::Degenerate, "points with derivatives of their own may not coincide");
  if (auto ok = check_degree(degree, 2 * points.size(), "conditions"); !ok) return tl::unexpected<Error>(ok.error());
  const std::vector<double> t = parameters_of(points, spacing);
  Conditions at;
  std::vector<Hpoint> right;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const int order : {0, 1}) {
      const bool last = i + 1 == points.size();  // the end's own derivative comes before the end
      at.parameters.push_back(t[i]);
      at.orders.push_back(last ? 1 - order : order);
      right.push_back(at.orders.back() == 0 ? pole_of(points[i]) : pole_of(derivatives[i]));
    }
  return solved(points, *d, t, degree, at, std::move(right));
}

Result<SurfaceFit> interpolate_net(std::span<const Point> points, std::size_t columns, int degree_u, int degree_v,
                                   Spacing spacing) {
  if (columns == 0 || points.size() % columns != 0)
    return fail(ErrorCode::InvalidArgument, fmt::format("{} points do not fill rows of {}", points.size(), columns));
  const std::size_t rows = points.size() / columns;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!is_finite(points[i])) return fail(ErrorCode::InvalidArgument, fmt::format("point {} is not finite", i));
  if (auto ok = check_degree(degree_u, rows, "rows of points"); !ok) return tl::unexpected<Error>(ok.error());
  if (auto ok = check_degree(degree_v, columns, "columns of points"); !ok) return tl::unexpected<Error>(ok.error());
  const auto u = mean_parameters(points, columns, rows, 1, columns, spacing, "u");
  if (!u) return tl::unexpected<Error>(u.error());
  const auto v = mean_parameters(points, rows, columns, columns, 1, spacing, "v");
  if (!v) return tl::unexpected<Error>(v.error());
  const std::vector<double> knots_u = detail::averaged_knots(*u, degree_u),
                            knots_v = detail::averaged_knots(*v, degree_v);
  std::vector<Hpoint> net;
  for (const Point& p : points) net.push_back(pole_of(p));
  bool solved = detail::collocate(degree_u, knots_u, {*u, std::vector<int>(rows, 0)}, net, columns);
  std::vector<Hpoint> turned(net.size());
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j) turned[j * rows + i] = net[i * columns + j];
  solved = solved && detail::collocate(degree_v, knots_v, {*v, std::vector<int>(columns, 0)}, turned, rows);
  if (!solved)
    return fail(ErrorCode::Degenerate, "the interpolation system is singular: points are spaced too unevenly");
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j) net[i * columns + j] = turned[j * rows + i], net[i * columns + j].w = 1;
  auto surface = NurbsSurface::from_homogeneous(degree_u, degree_v, knots_u, knots_v, std::move(net));
  if (!surface) return tl::unexpected<Error>(surface.error());
  double error = 0;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j) {
      const BoundedPoint at = evaluate_bounded(*surface, {(*u)[i], (*v)[j]});
      error = std::max(error, distance(at.point, points[i * columns + j]) * (1 + 1e-15) + std::sqrt(3.0) * at.error);
    }
  return SurfaceFit{std::move(*surface), *u, *v, error};
}

}  // namespace trimloop
