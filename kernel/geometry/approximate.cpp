#include "kernel/geometry/approximate.h"

#include <algorithm>
#include <array>

#include "kernel/nurbs/construct_surface.h"

namespace trimloop {

namespace {

struct Piece {
  double lo, hi;
  std::array<Vector, 4> control;
};

// Cubic Bezier through f at both ends and with its slopes there, taken as one-sided differences of third order so
// that corners at the ends do no harm.
Piece fit(const std::function<Vector(double)>& f, double lo, double hi) {
  const double h = (hi - lo) / 64;
  const Vector a = f(lo), b = f(hi);
  const Vector slope_a = (1 / (6 * h)) * (-11 * a + 18 * f(lo + h) + -9 * f(lo + 2 * h) + 2 * f(lo + 3 * h));
  const Vector slope_b = (1 / (6 * h)) * (11 * b + -18 * f(hi - h) + 9 * f(hi - 2 * h) + -2 * f(hi - 3 * h));
  const double third = (hi - lo) / 3;
  return {lo, hi, {a, a + third * slope_a, b - third * slope_b, b}};
}

Vector evaluate(const Piece& p, double fraction) {
  const double s = fraction, r = 1 - s;
  return r * r * r * p.control[0] + 3 * r * r * s * p.control[1] + 3 * r * s * s * p.control[2] + s * s * s * p.control[3];
}

double deviation(const std::function<Vector(double)>& f, const Piece& p) {
  double worst = 0;
  for (const double fraction : {0.2, 0.4, 0.6, 0.8}) {
    worst = std::max(worst, norm(evaluate(p, fraction) - f(p.lo + fraction * (p.hi - p.lo))));
  }
  return worst;
}

struct Fitted {
  NurbsCurve curve;
  double deviation;
};

Result<Fitted> approximate_vector(const std::function<Vector(double)>& f, const std::vector<double>& breaks,
                                  double tolerance, std::size_t max_pieces) {
  if (breaks.size() < 2) return fail(ErrorCode::InvalidArgument, "the range to approximate over has two ends");
  std::vector<Piece> done, open;  // `open` is a stack with the next piece on top
  for (std::size_t i = breaks.size() - 1; i > 0; --i) open.push_back(fit(f, breaks[i - 1], breaks[i]));
  double worst = 0;
  while (!open.empty()) {
    const Piece piece = open.back();
    open.pop_back();
    const double off = deviation(f, piece);
    if (off <= tolerance) {
      worst = std::max(worst, off);
      done.push_back(piece);
      continue;
    }
    const double mid = 0.5 * (piece.lo + piece.hi);
    if (done.size() + open.size() + 2 > max_pieces || !(piece.lo < mid && mid < piece.hi)) {
      return fail(ErrorCode::NoConvergence, "the curve needs more pieces than allowed", off, tolerance);
    }
    open.push_back(fit(f, mid, piece.hi));
    open.push_back(fit(f, piece.lo, mid));
  }

  std::vector<double> knots(4, done.front().lo);
  std::vector<Point> points{to_point(done.front().control[0])};
  for (const Piece& p : done) {
    knots.insert(knots.end(), 3, p.hi);
    for (std::size_t k = 1; k < 4; ++k) points.push_back(to_point(p.control[k]));
  }
  knots.push_back(done.back().hi);
  auto curve = NurbsCurve::from_cartesian(3, std::move(knots), points, {});
  if (!curve) return tl::unexpected(curve.error());
  return Fitted{std::move(*curve), worst};
}

}  // namespace

Result<Approximation> approximate(const std::function<Uv(double)>& f, const std::vector<double>& breaks, double tolerance,
                                  std::size_t max_pieces) {
  auto fitted = approximate_vector(
      [&](double t) {
        const Uv p = f(t);
        return Vector{p.u, p.v, 0};
      },
      breaks, tolerance, max_pieces);
  if (!fitted) return tl::unexpected(fitted.error());
  return Approximation{Curve2{Curve{std::move(fitted->curve)}}, fitted->deviation};
}

Result<SpaceApproximation> approximate_in_space(const std::function<Point(double)>& f,
                                                const std::vector<double>& breaks, double tolerance_mm,
                                                std::size_t max_pieces) {
  auto fitted =
      approximate_vector([&](double t) { return to_vector(f(t)); }, breaks, tolerance_mm, max_pieces);
  if (!fitted) return tl::unexpected(fitted.error());
  return SpaceApproximation{Curve{std::move(fitted->curve)}, fitted->deviation};
}

Result<RuledApproximation> approximate(const Ruled& ruled, double tolerance_mm) {
  const Surface surface{ruled};
  const std::vector<double> breaks = breaks_u(surface);
  const auto rail = [&](double v) {
    return approximate_vector([&](double u) { return to_vector(evaluate(surface, {u, v})); }, breaks, tolerance_mm, 4096);
  };
  auto a = rail(0), b = rail(1);
  if (!a) return tl::unexpected(a.error());
  if (!b) return tl::unexpected(b.error());
  auto made = trimloop::ruled(a->curve, b->curve);
  if (!made) return tl::unexpected(made.error());
  return RuledApproximation{std::move(*made), std::max(a->deviation, b->deviation)};
}

}  // namespace trimloop
