// Least squares, and approximation within a bound.

#include <fmt/format.h>

#include <Eigen/Dense>

#include "kernel/nurbs/banded.h"
#include "kernel/nurbs/basis.h"
#include "kernel/nurbs/error_bound.h"
#include "kernel/nurbs/fit_detail.h"
#include "kernel/nurbs/removal.h"

namespace trimloop {
namespace {

// One condition on the poles: a row of basis functions, what they should give, and how much that counts.
struct Equation {
  std::size_t first = 0;  // pole of the first entry
  std::vector<double> row;
  Hpoint right;
  double weight = 1;  // negative: a constraint
};

Equation equation(int degree, const std::vector<double>& knots, double t, int order, Vector value, double weight) {
  const std::size_t p = static_cast<std::size_t>(degree), n = knots.size() - p - 1;
  const std::size_t k = detail::span_of(knots.data(), p, n, t);
  Equation e{k - p, std::vector<double>(p + 1), {value.x, value.y, value.z, 0}, weight};
  detail::fill_derivative(degree, order, knots.data() + k, t, e.row.data());
  return e;
}

// (N^T W N) x = b for columns of points, banded.
class Normal {
 public:
  Normal(std::size_t poles, std::size_t degree, std::span<const Equation> equations)
      : n_(poles), p_(degree), equations_(equations) {}

  bool solve(std::vector<Hpoint>& b) const {
    detail::Banded m(n_, p_, p_);
    for (const Equation& e : equations_)
      for (std::size_t r = 0; r <= p_ && e.weight > 0; ++r)
        for (std::size_t c = 0; c <= p_; ++c) m.at(e.first + r, e.first + c) += e.weight * e.row[r] * e.row[c];
    return m.solve(b, 1);
  }
  std::vector<Hpoint> right() const {
    std::vector<Hpoint> b(n_, Hpoint{0, 0, 0, 0});
    for (const Equation& e : equations_)
      for (std::size_t r = 0; r <= p_ && e.weight > 0; ++r)
        b[e.first + r] = b[e.first + r] + e.weight * e.row[r] * e.right;
    return b;
  }
  // b - N^T W N x, for one step of refinement.
  std::vector<Hpoint> residual(const std::vector<Hpoint>& x) const {
    std::vector<Hpoint> out(n_, Hpoint{0, 0, 0, 0});
    for (const Equation& e : equations_) {
      if (!(e.weight > 0)) continue;
      Hpoint off = e.right;
      for (std::size_t c = 0; c <= p_; ++c) off = off - e.row[c] * x[e.first + c];
      for (std::size_t r = 0; r <= p_; ++r) out[e.first + r] = out[e.first + r] + e.weight * e.row[r] * off;
    }
    return out;
  }

 private:
  std::size_t n_, p_;
  std::span<const Equation> equations_;
};

// Eq. 9.71 - 9.76: least squares of the weighted equations, exactly subject to the constraints.
Result<std::vector<Hpoint>> weighted_constrained(std::size_t poles, std::size_t degree,
                                                 std::vector<Equation> equations) {
  // Poles that only constraints speak of make the normal matrix singular: constraints count as soft equations too,
  // which changes nothing where they hold.
  const std::size_t count = equations.size();
  std::vector<Equation> constraints;
  for (std::size_t i = 0; i < count; ++i)
    if (equations[i].weight < 0) {
      constraints.push_back(equations[i]);
      equations[i].weight = 1;
    }
  const Normal normal(poles, degree, equations);
  std::vector<Hpoint> x = normal.right();
  if (!normal.solve(x))
    return fail(ErrorCode::Degenerate, "some poles are not determined: too few points in a knot span");
  std::vector<Hpoint> fix = normal.residual(x);
  if (normal.solve(fix))
    for (std::size_t i = 0; i < poles; ++i) x[i] = x[i] + fix[i];
  if (constraints.empty()) return x;
  // x + (N^T W N)^-1 M^T a with M x = T.
  const auto m = static_cast<Eigen::Index>(constraints.size());
  std::vector<std::vector<Hpoint>> columns;
  for (const Equation& e : constraints) {
    std::vector<Hpoint> column(poles, Hpoint{0, 0, 0, 0});
    for (std::size_t r = 0; r <= degree; ++r) column[e.first + r].x = e.row[r];
    if (!normal.solve(column)) return fail(ErrorCode::Degenerate, "some poles are not determined");
    columns.push_back(std::move(column));
  }
  Eigen::MatrixXd a(m, m), off(m, 3);
  const auto dot_row = [&](const Equation& e, const std::vector<Hpoint>& v) {
    Hpoint sum{0, 0, 0, 0};
    for (std::size_t r = 0; r <= degree; ++r) sum = sum + e.row[r] * v[e.first + r];
    return sum;
  };
  for (int repeat = 0; repeat < 2; ++repeat) {
    for (Eigen::Index i = 0; i < m; ++i) {
      const Equation& e = constraints[static_cast<std::size_t>(i)];
      for (Eigen::Index j = 0; j < m; ++j) a(i, j) = dot_row(e, columns[static_cast<std::size_t>(j)]).x;
      const Hpoint missing = e.right - dot_row(e, x);
      off.row(i) << missing.x, missing.y, missing.z;
    }
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(a);
    if (qr.rank() < m) return fail(ErrorCode::Degenerate, "the constraints contradict or repeat one another");
    const Eigen::MatrixXd factor = qr.solve(off);
    for (Eigen::Index j = 0; j < m; ++j)
      for (std::size_t i = 0; i < poles; ++i) {
        const double s = columns[static_cast<std::size_t>(j)][i].x;
        x[i] = x[i] + Hpoint{s * factor(j, 0), s * factor(j, 1), s * factor(j, 2), 0};
      }
  }
  return x;
}

// Eq. 9.68 - 9.69: every span holds at least one parameter. With a pole to each point those of interpolation, whose
// system is better conditioned.
std::vector<double> spread_knots(const std::vector<double>& t, std::size_t poles, int degree) {
  const std::size_t p = static_cast<std::size_t>(degree);
  if (poles == t.size()) return detail::averaged_knots(t, degree);
  std::vector<double> knots(p + 1, t.front());
  const double d = static_cast<double>(t.size()) / static_cast<double>(poles - p);
  for (std::size_t j = 1; j < poles - p; ++j) {
    const double at = static_cast<double>(j) * d;
    const std::size_t i = static_cast<std::size_t>(at);
    const double share = at - static_cast<double>(i);
    knots.push_back((1 - share) * t[i - 1] + share * t[i]);
  }
  knots.insert(knots.end(), p + 1, t.back());
  return knots;
}

Vector arm(const Point& p) { return to_vector(p); }

Result<Fit> finished(std::span<const Point> points, int degree, std::vector<double> knots, std::vector<Hpoint> poles,
                     std::vector<double> parameters) {
  for (Hpoint& h : poles) h.w = 1;
  auto curve = NurbsCurve::from_homogeneous(degree, std::move(knots), std::move(poles));
  if (!curve) return tl::unexpected<Error>(curve.error());
  const double error = detail::error_at(*curve, points, parameters);
  return Fit{std::move(*curve), std::move(parameters), error};
}

// Least squares with both ends kept, over given knots.
Result<Fit> over_knots(std::span<const Point> points, const std::vector<double>& t, int degree,
                       std::vector<double> knots) {
  std::vector<Equation> equations;
  for (std::size_t i = 0; i < points.size(); ++i)
    equations.push_back(equation(degree, knots, t[i], 0, arm(points[i]), i == 0 || i + 1 == points.size() ? -1 : 1));
  const std::size_t n = knots.size() - static_cast<std::size_t>(degree) - 1;
  auto poles = weighted_constrained(n, static_cast<std::size_t>(degree), std::move(equations));
  if (!poles) return tl::unexpected<Error>(poles.error());
  return finished(points, degree, std::move(knots), std::move(*poles), t);
}

// A9.9 with the distances measured rather than bounded: knots go while every point beside them stays within the
// tolerance, those of the least bound (A9.8) first.
NurbsCurve without_spare_knots(NurbsCurve c, std::span<const Point> points, const std::vector<double>& t,
                               double tolerance) {
  struct Candidate {
    double t, cost;
  };
  std::vector<Candidate> open;
  for (const double k : breaks(c))
    if (c.domain().lo < k && k < c.domain().hi) open.push_back({k, removal_bound(c, k)});
  const std::size_t reach = static_cast<std::size_t>(c.degree()) + 1;
  while (!open.empty()) {
    const auto best = std::min_element(open.begin(), open.end(), [](auto& a, auto& b) { return a.cost < b.cost; });
    if (!(best->cost < infinity)) break;
    const KnotRemoval next = remove_knot(c, best->t, 1, infinity);
    const auto k = std::upper_bound(c.knots().begin(), c.knots().end(), best->t) - c.knots().begin();
    const auto last = static_cast<std::ptrdiff_t>(c.knots().size()) - 1, p = static_cast<std::ptrdiff_t>(reach);
    const double lo = c.knots()[static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, k - p - 1))];
    const double hi = c.knots()[static_cast<std::size_t>(std::min(last, k + p))];
    const auto from = std::lower_bound(t.begin(), t.end(), lo), to = std::upper_bound(t.begin(), t.end(), hi);
    const std::size_t first = static_cast<std::size_t>(from - t.begin()), count = static_cast<std::size_t>(to - from);
    const bool fits =
        next.removed == 1 && detail::error_at(next.curve, points.subspan(first, count),
                                              std::span<const double>(t).subspan(first, count)) <= tolerance;
    if (!fits) {
      best->cost = infinity;
      continue;
    }
    const auto at = best - open.begin();
    c = next.curve;
    if (!std::binary_search(c.knots().begin(), c.knots().end(), best->t)) open.erase(best);
    const auto size = static_cast<std::ptrdiff_t>(open.size());
    for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(0, at - p); i < std::min(size, at + p + 1); ++i) {
      Candidate& near = open[static_cast<std::size_t>(i)];
      near.cost = removal_bound(c, near.t);
    }
  }
  return c;
}

// Knots removed and poles fitted again in turn, while that helps.
NurbsCurve thinned(NurbsCurve c, std::span<const Point> points, const std::vector<double>& t, double tolerance) {
  for (std::size_t before = c.poles().size() + 1; c.poles().size() < before;) {
    before = c.poles().size();
    c = without_spare_knots(std::move(c), points, t, tolerance);
    const auto again = over_knots(points, t, c.degree(), c.knots());
    if (again && again->error <= tolerance && again->error <= detail::error_at(c, points, t)) c = again->curve;
  }
  return c;
}

std::vector<double> raised_knots(const NurbsCurve& c) {
  std::vector<double> out;
  for (std::size_t i = 0; i < c.knots().size(); ++i) {
    out.push_back(c.knots()[i]);
    if (i + 1 == c.knots().size() || c.knots()[i + 1] != c.knots()[i]) out.push_back(c.knots()[i]);
  }
  return out;
}

}  // namespace

Result<Fit> approximate(std::span<const Point> points, const LeastSquares& how) {
  const int degree = how.degree;
  if (degree < 1 || degree > detail::max_degree)
    return fail(ErrorCode::InvalidArgument, fmt::format("degree is {}, not 1 to {}", degree, detail::max_degree),
                degree);
  const auto d = detail::distinct(points);
  if (!d) return tl::unexpected<Error>(d.error());
  std::vector<double> t = how.parameters;
  if (t.empty()) {
    const std::vector<double> of_distinct = parameters_of(d->points, how.spacing);
    for (const std::size_t place : d->place) t.push_back(of_distinct[place]);
  }
  if (t.size() != points.size() || !std::is_sorted(t.begin(), t.end()) || !(0 <= t.front()) || !(t.back() <= 1))
    return fail(ErrorCode::InvalidArgument, "the parameters do not ascend in [0, 1], one to a point");
  if (!how.weights.empty() && how.weights.size() != points.size())
    return fail(ErrorCode::InvalidArgument,
                fmt::format("there are {} weights for {} points", how.weights.size(), points.size()));
  const std::size_t p = static_cast<std::size_t>(degree);
  std::vector<double> knots = how.knots;
  if (knots.empty()) {
    if (how.poles <= p || how.poles > d->points.size())
      return fail(ErrorCode::InvalidArgument,
                  fmt::format("{} poles of degree {} for {} distinct points", how.poles, degree, d->points.size()),
                  static_cast<double>(how.poles));
    std::vector<double> once = t;
    once.erase(std::unique(once.begin(), once.end()), once.end());
    knots = spread_knots(once, how.poles, degree);
  }
  if (knots.size() < 2 * (p + 1)) return fail(ErrorCode::InvalidArgument, "there are too few knots for the degree");
  const std::size_t n = knots.size() - p - 1;
  const auto frame = NurbsCurve::from_homogeneous(degree, knots, std::vector<Hpoint>(n));
  if (!frame) return tl::unexpected<Error>(frame.error());
  std::vector<Equation> equations;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool is_end = i == 0 || i + 1 == points.size();
    const double weight = how.weights.empty() ? (is_end ? -1 : 1) : how.weights[i];
    if (weight != 0) equations.push_back(equation(degree, knots, t[i], 0, arm(points[i]), weight));
  }
  for (const LeastSquares::Derivative& e : how.derivatives) {
    if (e.point >= points.size() || !is_finite(e.value))
      return fail(ErrorCode::InvalidArgument,
                  fmt::format("a derivative is given for point {} of {}", e.point, points.size()));
    if (e.weight != 0) equations.push_back(equation(degree, knots, t[e.point], 1, e.value, e.weight));
  }
  auto poles = weighted_constrained(n, p, std::move(equations));
  if (!poles) return tl::unexpected<Error>(poles.error());
  return finished(points, degree, std::move(knots), std::move(*poles), std::move(t));
}

Result<SurfaceFit> approximate_net(std::span<const Point> points, std::size_t columns, int degree_u, int degree_v,
                                   std::size_t poles_u, std::size_t poles_v, Spacing spacing) {
  const auto linear = interpolate_net(points, columns, 1, 1, spacing);  // parameters, and their checks
  if (!linear) return linear;
  const std::size_t rows = points.size() / columns;
  const auto allowed = [](int degree, std::size_t poles, std::size_t count) {
    return degree >= 1 && degree <= detail::max_degree && poles > static_cast<std::size_t>(degree) && poles <= count;
  };
  if (!allowed(degree_u, poles_u, rows) || !allowed(degree_v, poles_v, columns))
    return fail(ErrorCode::InvalidArgument, fmt::format("{} x {} poles of degrees {} and {} for {} x {} points",
                                                        poles_u, poles_v, degree_u, degree_v, rows, columns));
  // Columns first, then rows of what they gave: the ends of each line are kept.
  const auto fit_line = [](const std::vector<Point>& line, const std::vector<double>& t, int degree,
                           const std::vector<double>& knots) {
    std::vector<Equation> equations;
    for (std::size_t i = 0; i < line.size(); ++i)
      equations.push_back(equation(degree, knots, t[i], 0, arm(line[i]), i == 0 || i + 1 == line.size() ? -1 : 1));
    return weighted_constrained(knots.size() - static_cast<std::size_t>(degree) - 1, static_cast<std::size_t>(degree),
                                std::move(equations));
  };
  const std::vector<double> knots_u = spread_knots(linear->u, poles_u, degree_u),
                            knots_v = spread_knots(linear->v, poles_v, degree_v);
  std::vector<Point> half(poles_u * columns);
  for (std::size_t j = 0; j < columns; ++j) {
    std::vector<Point> line;
    for (std::size_t i = 0; i < rows; ++i) line.push_back(points[i * columns + j]);
    const auto poles = fit_line(line, linear->u, degree_u, knots_u);
    if (!poles) return tl::unexpected<Error>(poles.error());
    for (std::size_t i = 0; i < poles_u; ++i) half[i * columns + j] = {(*poles)[i].x, (*poles)[i].y, (*poles)[i].z};
  }
  std::vector<Hpoint> net;
  for (std::size_t i = 0; i < poles_u; ++i) {
    const auto first = half.begin() + static_cast<std::ptrdiff_t>(i * columns);
    const auto poles = fit_line({first, first + static_cast<std::ptrdiff_t>(columns)}, linear->v, degree_v, knots_v);
    if (!poles) return tl::unexpected<Error>(poles.error());
    net.insert(net.end(), poles->begin(), poles->end());
  }
  for (Hpoint& h : net) h.w = 1;
  auto surface = NurbsSurface::from_homogeneous(degree_u, degree_v, knots_u, knots_v, std::move(net));
  if (!surface) return tl::unexpected<Error>(surface.error());
  double error = 0;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j) {
      const BoundedPoint at = evaluate_bounded(*surface, {linear->u[i], linear->v[j]});
      error = std::max(error, distance(at.point, points[i * columns + j]) * (1 + 1e-15) + std::sqrt(3.0) * at.error);
    }
  return SurfaceFit{std::move(*surface), linear->u, linear->v, error};
}

Result<Fit> approximate_within(std::span<const Point> given, double tolerance, int degree, Spacing spacing) {
  if (!(tolerance > 0)) return fail(ErrorCode::InvalidArgument, "a tolerance is positive", tolerance, 0);
  if (degree < 1 || degree > detail::max_degree)
    return fail(ErrorCode::InvalidArgument, fmt::format("degree is {}, not 1 to {}", degree, detail::max_degree),
                degree);
  const auto d = detail::distinct(given);
  if (!d) return tl::unexpected<Error>(d.error());
  const std::vector<Point>& points = d->points;
  const std::vector<double> t = parameters_of(points, spacing);
  // From the polygon upwards where the tolerance is coarse against the spacing of the points, from the interpolant
  // where it is fine: whichever comes to fewer poles.
  const auto polygon = interpolate(points, 1, spacing), through = interpolate(points, degree, spacing);
  if (!polygon) return polygon;
  NurbsCurve c = thinned(polygon->curve, points, t, tolerance);
  for (int at = 2; at <= degree; ++at) {
    const auto higher = over_knots(points, t, at, raised_knots(c));
    c = thinned(higher && higher->error <= tolerance ? higher->curve : elevate(c, 1), points, t, tolerance);
  }
  const auto consider = [&](const Result<Fit>& fit) {
    if (!fit || !(fit->error <= tolerance)) return false;
    NurbsCurve other = thinned(fit->curve, points, t, tolerance);
    if (other.poles().size() < c.poles().size()) c = std::move(other);
    return true;
  };
  consider(through);
  for (std::size_t lo = static_cast<std::size_t>(degree), hi = std::min(points.size(), c.poles().size());
       lo + 1 < hi;) {
    const std::size_t count = (lo + hi) / 2;
    (consider(over_knots(points, t, degree, spread_knots(t, count, degree))) ? hi : lo) = count;
  }
  std::vector<double> parameters;
  for (const std::size_t place : d->place) parameters.push_back(t[place]);
  const double error = detail::error_at(c, given, parameters);
  if (!(error <= tolerance))
    return fail(ErrorCode::NoConvergence, "rounding alone is above the tolerance", error, tolerance);
  return Fit{std::move(c), std::move(parameters), error};
}

Result<SurfaceFit> approximate_net_within(std::span<const Point> points, std::size_t columns, double tolerance,
                                          int degree_u, int degree_v, Spacing spacing) {
  if (!(tolerance > 0)) return fail(ErrorCode::InvalidArgument, "a tolerance is positive", tolerance, 0);
  const auto all = interpolate_net(points, columns, degree_u, degree_v, spacing);
  if (!all) return all;
  if (!(all->error <= tolerance))
    return fail(ErrorCode::NoConvergence, "rounding alone is above the tolerance", all->error, tolerance);
  // The fewest poles, in equal shares of the points of both directions, by bisection over the share.
  const std::size_t rows = points.size() / columns;
  std::optional<SurfaceFit> best;
  double lo = 0, hi = 1;
  for (int i = 0; i < 8; ++i) {
    const double share = i == 0 ? 0 : 0.5 * (lo + hi);
    const auto count = [&](int degree, std::size_t points_along) {
      const double least = degree + 1;
      return static_cast<std::size_t>(std::lround(least + share * (static_cast<double>(points_along) - least)));
    };
    auto fit =
        approximate_net(points, columns, degree_u, degree_v, count(degree_u, rows), count(degree_v, columns), spacing);
    const bool fits = fit && fit->error <= tolerance;
    if (fits) best = std::move(*fit);
    if (fits && i == 0) break;
    (fits ? hi : lo) = share;
  }
  return best ? *best : *all;
}

}  // namespace trimloop
