// Local interpolation: each span from its neighbours only.

#include <fmt/format.h>

#include "kernel/nurbs/error_bound.h"
#include "kernel/nurbs/fit_detail.h"

namespace trimloop {
namespace detail {

std::vector<Vector> estimated_tangents(std::span<const Point> points) {
  const std::size_t n = points.size();
  std::vector<Vector> out(n);
  if (n < 2) return out;
  if (n == 2) return {points[1] - points[0], points[1] - points[0]};
  // Chords q[2] .. q[n], with two more on either side by q_0 = 2 q_1 - q_2 (eq. 9.33).
  std::vector<Vector> q(n + 3);
  for (std::size_t i = 1; i < n; ++i) q[i + 1] = points[i] - points[i - 1];
  q[1] = 2 * q[2] - q[3];
  q[0] = 2 * q[1] - q[2];
  q[n + 1] = 2 * q[n] - q[n - 1];
  q[n + 2] = 2 * q[n + 1] - q[n];
  for (std::size_t k = 0; k < n; ++k) {
    const double before = norm(cross(q[k], q[k + 1])), after = norm(cross(q[k + 2], q[k + 3]));
    const double alpha = before + after > 0 ? before / (before + after) : 0.5;
    out[k] = (1 - alpha) * q[k + 1] + alpha * q[k + 2];
  }
  return out;
}

}  // namespace detail

namespace {

// Section 9.3.4: the common speed at both ends and, by the middle, of one cubic (eq. 9.50):
// 16 a^2 ... = |t0 + t3|^2: (16 - |t0 + t3|^2) a^2 + 12 (p3 - p0).(t0 + t3) a - 36 |p3 - p0|^2 = 0, the positive root.
double common_speed(Vector chord, Vector t0, Vector t3) {
  const Vector sum = t0 + t3;
  const double a = 16 - dot(sum, sum), b = 12 * dot(chord, sum), c = -36 * dot(chord, chord);
  return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);  // a >= 12, c < 0
}

struct Slopes {
  std::vector<Vector> in, out;  // unit tangents on either side of each point
};

// At a point between two straight runs the formula has no answer: a corner.
Slopes slopes_of(std::span<const Point> points, bool keep_corners) {
  Slopes s;
  for (const Vector& v : detail::estimated_tangents(points)) s.out.push_back(normalized(v));
  s.in = s.out;
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    const Vector before = points[k] - points[k - 1], after = points[k + 1] - points[k];
    const auto straight = [&](std::size_t a, std::size_t b, std::size_t c) {
      const Vector x = points[b] - points[a], y = points[c] - points[b];
      return norm(cross(x, y)) <= 1e-12 * norm(x) * norm(y);
    };
    const bool corner = k >= 2 && k + 2 < points.size() && straight(k - 2, k - 1, k) && straight(k, k + 1, k + 2) &&
                        !straight(k - 1, k, k + 1);
    const bool none = norm(s.out[k]) == 0;  // a turn by pi
    if ((corner && keep_corners) || none) s.in[k] = normalized(before), s.out[k] = normalized(after);
  }
  return s;
}

Hpoint pole_of(Point p) { return {p.x, p.y, p.z, 1}; }
bool same(Vector a, Vector b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

// Derivative with respect to a parameter from three points (Bessel), one-sided at ends.
std::vector<Vector> bessel(const std::vector<Vector>& q, const std::vector<double>& t) {
  const std::size_t n = q.size();
  std::vector<Vector> slope(n);
  const auto chord = [&](std::size_t i) { return 1 / (t[i + 1] - t[i]) * (q[i + 1] - q[i]); };
  if (n == 2) return {chord(0), chord(0)};
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const double share = (t[k] - t[k - 1]) / (t[k + 1] - t[k - 1]);
    slope[k] = (1 - share) * chord(k - 1) + share * chord(k);
  }
  slope[0] = 2 * chord(0) - slope[1];
  slope[n - 1] = 2 * chord(n - 2) - slope[n - 2];
  return slope;
}

// Of an estimated direction with the speed of the Bessel derivative; the latter where there is no direction.
std::vector<Vector> derivatives_along(const std::vector<Point>& line, const std::vector<double>& t) {
  std::vector<Vector> q;
  for (const Point& p : line) q.push_back(to_vector(p));
  const std::vector<Vector> direction = detail::estimated_tangents(line);
  std::vector<Vector> out = bessel(q, t);
  for (std::size_t k = 0; k < out.size(); ++k) {
    const Vector unit = normalized(direction[k]);
    if (norm(unit) > 0 && norm(out[k]) > 0) out[k] = norm(out[k]) * unit;
  }
  return out;
}

std::vector<double> double_knots(const std::vector<double>& t) {
  std::vector<double> knots(2, t.front());
  for (const double v : t) knots.insert(knots.end(), 2, v);
  knots.insert(knots.end(), 2, t.back());
  return knots;
}

}  // namespace

Result<Fit> interpolate_local(std::span<const Point> points, bool keep_corners) {
  const auto d = detail::distinct(points);
  if (!d) return tl::unexpected<Error>(d.error());
  const std::vector<Point>& q = d->points;
  const Slopes s = slopes_of(q, keep_corners);
  std::vector<double> t{0};
  std::vector<Hpoint> poles{pole_of(q[0])};
  std::vector<double> knots(4, 0.0);
  for (std::size_t k = 0; k + 1 < q.size(); ++k) {
    const double a = common_speed(q[k + 1] - q[k], s.out[k], s.in[k + 1]);
    poles.push_back(pole_of(q[k] + a / 3 * s.out[k]));
    poles.push_back(pole_of(q[k + 1] - a / 3 * s.in[k + 1]));
    t.push_back(t.back() + a);
    const bool last = k + 2 == q.size(), corner = !same(s.in[k + 1], s.out[k + 1]);
    if (last || corner) poles.push_back(pole_of(q[k + 1]));
    knots.insert(knots.end(), last ? 4 : corner ? 3 : 2, t.back());
  }
  const double total = t.back();
  for (double& v : knots) v = v == total ? 1 : v / total;
  for (double& v : t) v = v == total ? 1 : v / total;
  auto curve = NurbsCurve::from_homogeneous(3, std::move(knots), std::move(poles));
  if (!curve) return tl::unexpected<Error>(curve.error());
  std::vector<double> parameters;
  for (const std::size_t place : d->place) parameters.push_back(t[place]);
  const double error = detail::error_at(*curve, points, parameters);
  return Fit{std::move(*curve), std::move(parameters), error};
}

Result<SurfaceFit> interpolate_net_local(std::span<const Point> points, std::size_t columns) {
  // Parameters and their checks are those of the global method at degree 1.
  const auto linear = interpolate_net(points, columns, 1, 1);
  if (!linear) return linear;
  const std::size_t rows = points.size() / columns;
  const std::vector<double>&u = linear->u, &v = linear->v;
  std::vector<Vector> du(points.size()), dv(points.size()), duv(points.size());
  const auto line = [&](const auto& from, std::size_t first, std::size_t count, std::size_t step) {
    std::remove_cvref_t<decltype(std::vector{from[0]})> out;
    for (std::size_t k = 0; k < count; ++k) out.push_back(from[first + k * step]);
    return out;
  };
  const auto scatter = [](const std::vector<Vector>& from, std::vector<Vector>& to, std::size_t first, std::size_t step,
                          double share) {
    for (std::size_t k = 0; k < from.size(); ++k) to[first + k * step] = to[first + k * step] + share * from[k];
  };
  for (std::size_t j = 0; j < columns; ++j)
    scatter(derivatives_along(line(points, j, rows, columns), u), du, j, columns, 1);
  for (std::size_t i = 0; i < rows; ++i)
    scatter(derivatives_along(line(points, i * columns, columns, 1), v), dv, i * columns, 1, 1);
  // Twists: the mean of both mixed differences.
  for (std::size_t j = 0; j < columns; ++j) scatter(bessel(line(dv, j, rows, columns), u), duv, j, columns, 0.5);
  for (std::size_t i = 0; i < rows; ++i)
    scatter(bessel(line(du, i * columns, columns, 1), v), duv, i * columns, 1, 0.5);
  // Over double knots the poles beside a point are its Hermite values a third of the spans away.
  const auto thirds = [](const std::vector<double>& t, std::size_t k) {
    return std::array<double, 2>{k > 0 ? -(t[k] - t[k - 1]) / 3 : 0, k + 1 < t.size() ? (t[k + 1] - t[k]) / 3 : 0};
  };
  std::vector<Hpoint> poles(4 * points.size());
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j)
      for (std::size_t a = 0; a < 2; ++a)
        for (std::size_t b = 0; b < 2; ++b) {
          const std::size_t at = i * columns + j;
          const double x = thirds(u, i)[a], y = thirds(v, j)[b];
          poles[(2 * i + a) * 2 * columns + 2 * j + b] =
              pole_of(points[at] + (x * du[at] + y * dv[at] + x * y * duv[at]));
        }
  auto surface = NurbsSurface::from_homogeneous(3, 3, double_knots(u), double_knots(v), std::move(poles));
  if (!surface) return tl::unexpected<Error>(surface.error());
  double error = 0;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j) {
      const BoundedPoint at = evaluate_bounded(*surface, {u[i], v[j]});
      error = std::max(error, distance(at.point, points[i * columns + j]) * (1 + 1e-15) + std::sqrt(3.0) * at.error);
    }
  return SurfaceFit{std::move(*surface), u, v, error};
}

}  // namespace trimloop
