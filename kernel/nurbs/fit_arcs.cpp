// Local approximation by single conics and cubics, and by as long runs of them as a tolerance allows.

#include <fmt/format.h>

#include <array>

#include "kernel/nurbs/construct_conic.h"
#include "kernel/nurbs/fit_detail.h"

namespace trimloop {
namespace {

// The nearest parameter of a short smooth arc, by samples and Newton; a bound on the distance whatever it finds.
double nearest(const NurbsCurve& c, Point p, double lo) {
  double best = lo, least = infinity;
  constexpr int samples = 24;
  for (int i = 0; i <= samples; ++i) {
    const double t = std::lerp(lo, c.domain().hi, i / double{samples}), d = distance(evaluate(c, t), p);
    if (d < least) least = d, best = t;
  }
  for (int i = 0; i < 12; ++i) {
    const CurveJet j = jet(c, best);
    const Vector off = j.point - p;
    const double slope = dot(j.d1, j.d1) + dot(off, j.d2),
                 step = dot(off, j.d1) / (slope > 0 ? slope : dot(j.d1, j.d1));
    const double next = c.domain().clamp(best - step);
    if (!(distance(evaluate(c, next), p) < distance(evaluate(c, best), p))) break;
    best = next;
  }
  return best;
}

// Parameters in order and the largest distance.
Fit measured(NurbsCurve c, std::span<const Point> points) {
  std::vector<double> t{c.domain().lo};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) t.push_back(nearest(c, points[i], t.back()));
  if (points.size() > 1) t.push_back(c.domain().hi);
  const double error = detail::error_at(c, points, t);
  return {std::move(c), std::move(t), error};
}

Result<Fit> within(Fit fit, double tolerance) {
  if (fit.error <= tolerance) return fit;
  return fail(ErrorCode::NoConvergence, "one arc does not come within the tolerance of all points", fit.error,
              tolerance);
}

Result<void> check(std::span<const Point> points, Vector start, Vector end) {
  if (points.size() < 2 || !(distance(points.front(), points.back()) > 0))
    return fail(ErrorCode::Degenerate, "an arc needs two ends that differ");
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!is_finite(points[i])) return fail(ErrorCode::InvalidArgument, fmt::format("point {} is not finite", i));
  if (!(norm(normalized(start)) > 0) || !(norm(normalized(end)) > 0))
    return fail(ErrorCode::Degenerate, "an arc needs tangents at both ends");
  return {};
}

NurbsCurve cubic(Point p0, Point p1, Point p2, Point p3) {
  const std::array<Point, 4> poles{p0, p1, p2, p3};
  return NurbsCurve::from_cartesian(3, {0, 0, 0, 0, 1, 1, 1, 1}, poles, {}).value();
}

}  // namespace

// Each inner point gives a weight; in between lies the best one (the mean of w / (1 + w), as in A9.11).
Result<Fit> fit_conic(std::span<const Point> points, Vector start, Vector end, double tolerance) {
  if (auto ok = check(points, start, end); !ok) return tl::unexpected<Error>(ok.error());
  const Point a = points.front(), b = points.back();
  const Vector chord = b - a;
  if (norm(cross(start, chord)) <= 1e-12 * norm(start) * norm(chord) &&
      norm(cross(end, chord)) <= 1e-12 * norm(end) * norm(chord)) {
    const std::array<Point, 3> line{a, midpoint(a, b), b};  // a line
    return within(measured(NurbsCurve::from_cartesian(2, {0, 0, 0, 1, 1, 1}, line, {}).value(), points), tolerance);
  }
  const auto probe = one_conic_arc(a, start, b, end, midpoint(a, b) + 1e-3 * (start - norm(start) / norm(end) * end));
  double sum = 0;
  int count = 0;
  std::optional<Hpoint> middle;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    // Into the plane of the tangents first.
    const Vector n = normalized(cross(start, chord));
    const Point flat = points[i] - dot(points[i] - a, n) * n;
    const auto arc = one_conic_arc(a, start, b, end, flat);
    if (!arc) continue;
    middle = arc->poles()[1];
    if (middle->w == 0) {  // parallel tangents: the length of the ideal pole is what is averaged
      sum += dot(Vector{middle->x, middle->y, middle->z}, start) / norm(start);
    } else if (middle->w > -1) {
      sum += middle->w / (1 + middle->w);
    } else {
      continue;
    }
    ++count;
  }
  if (!middle && probe) middle = probe->poles()[1], sum = 0.5, count = 1;
  if (!middle || count == 0)
    return fail(ErrorCode::NoConvergence, "no conic with these tangents comes near the points", infinity, tolerance);
  const double mean = sum / count;
  Hpoint pole;
  if (middle->w == 0) {
    const Vector v = mean * normalized(start);
    pole = {v.x, v.y, v.z, 0};
  } else {
    const Point p = project(*middle);
    const double w = mean / (1 - mean);
    pole = {w * p.x, w * p.y, w * p.z, w};
  }
  auto arc = NurbsCurve::from_homogeneous(2, {0, 0, 0, 1, 1, 1}, {{a.x, a.y, a.z, 1}, pole, {b.x, b.y, b.z, 1}});
  if (!arc) return tl::unexpected<Error>(arc.error());
  return within(measured(std::move(*arc), points), tolerance);
}

// P1 = P0 + a T0 and P2 = P3 - b T3; a and b by Gauss and Newton's method on the distances from the curve: residuals
// and their derivatives are taken across the curve at the foot of each point.
Result<Fit> fit_cubic(std::span<const Point> points, Vector start, Vector end, double tolerance) {
  if (auto ok = check(points, start, end); !ok) return tl::unexpected<Error>(ok.error());
  const Vector t0 = normalized(start), t3 = normalized(end);
  const Point p0 = points.front(), p3 = points.back();
  const double chord = distance(p0, p3);
  double a = chord / 3, b = chord / 3;
  std::optional<Fit> best;
  for (int repeat = 0, idle = 0; repeat < 30 && idle < 3; ++repeat) {
    Fit fit = measured(cubic(p0, p0 + a * t0, p3 - b * t3, p3), points);
    double aa = 0, ab = 0, bb = 0, ra = 0, rb = 0;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      const double x = fit.parameters[i], y = 1 - x;
      const CurveJet j = jet(fit.curve, x);
      const Vector along = normalized(j.d1);
      const auto across = [&](Vector v) { return v - dot(v, along) * along; };
      const Vector u = across(3 * x * y * y * t0), v = across(-3 * x * x * y * t3), r = across(points[i] - j.point);
      aa += dot(u, u), ab += dot(u, v), bb += dot(v, v), ra += dot(u, r), rb += dot(v, r);
    }
    idle = best && !(fit.error < 0.98 * best->error) ? idle + 1 : 0;
    if (!best || fit.error < best->error) best = std::move(fit);
    const double det = aa * bb - ab * ab;
    if (best->error <= tolerance || !(det > 1e-14 * aa * bb)) break;
    // Poles go forwards, by no more than a few chords.
    a = std::clamp(a + (ra * bb - rb * ab) / det, 1e-3 * chord, 10 * chord);
    b = std::clamp(b + (rb * aa - ra * ab) / det, 1e-3 * chord, 10 * chord);
  }
  return within(std::move(*best), tolerance);
}

Result<Fit> fit_local(std::span<const Point> given, double tolerance, bool conics) {
  if (!(tolerance > 0)) return fail(ErrorCode::InvalidArgument, "a tolerance is positive", tolerance, 0);
  const auto d = detail::distinct(given);
  if (!d) return tl::unexpected<Error>(d.error());
  const std::vector<Point>& points = d->points;
  const std::vector<Vector> tangent = detail::estimated_tangents(points);
  const auto one = [&](std::size_t from, std::size_t to) {
    const std::span<const Point> run(points.data() + from, to - from + 1);
    if (conics) {
      auto fit = fit_conic(run, tangent[from], tangent[to], tolerance);
      if (fit) fit->curve = elevate(fit->curve, 1);
      if (fit) return fit;  // else, where the tangents lie in no plane, a cubic
    }
    return fit_cubic(run, tangent[from], tangent[to], tolerance);  // of two points it always fits
  };
  std::vector<double> knots(4, 0.0), parameters{0};
  std::vector<Hpoint> poles;
  double error = 0, end = 0;
  for (std::size_t from = 0; from + 1 < points.size();) {
    std::size_t good = from + 1, step = 1;
    auto fit = one(from, good);
    if (!fit) return fit;
    for (;; step *= 2) {  // as far as doubling steps carry, then back by halves
      const std::size_t to = std::min(points.size() - 1, good + step);
      if (to == good) break;
      auto longer = one(from, to);
      if (!longer) break;
      fit = std::move(longer), good = to;
    }
    for (; step > 0; step /= 2) {
      if (good + step >= points.size()) continue;
      if (auto longer = one(from, good + step)) fit = std::move(longer), good += step;
    }
    // A piece's length of parameter is its chord length, so that speeds are about one.
    double length = 0;
    for (std::size_t i = from; i < good; ++i) length += distance(points[i], points[i + 1]);
    const std::vector<Hpoint>& own = fit->curve.poles();
    poles.insert(poles.end(), own.begin() + (from > 0), own.end());
    for (std::size_t i = 1; i < fit->parameters.size(); ++i) parameters.push_back(end + length * fit->parameters[i]);
    end += length;
    knots.insert(knots.end(), 3, end);
    error = std::max(error, fit->error);
    from = good;
  }
  knots.push_back(end);
  auto curve = NurbsCurve::from_homogeneous(3, std::move(knots), std::move(poles));
  if (!curve) return tl::unexpected<Error>(curve.error());
  std::vector<double> all;
  for (const std::size_t place : d->place) all.push_back(parameters[place]);
  error = std::max(error, detail::error_at(*curve, given, all));
  return Fit{std::move(*curve), std::move(all), error};
}

}  // namespace trimloop
