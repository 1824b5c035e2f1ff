#include "kernel/geometry/conic.h"

#include <utility>

namespace trimloop {
namespace {

// The equation in axes that remove the mixed term: a x^2 + c y^2 + d x + e y + f = 0 along `x` and `y`.
struct Principal {
  double a, c, d, e, f;
  Vector x, y;
};

Principal principal_axes(const ConicCoefficients& k) {
  if (k.b == 0) return {k.a, k.c, k.d, k.e, k.f, {1, 0, 0}, {0, 1, 0}};
  const double angle = 0.5 * std::atan2(k.b, k.a - k.c);
  const double cs = std::cos(angle), sn = std::sin(angle);
  return {k.a * cs * cs + k.b * cs * sn + k.c * sn * sn,
          k.a * sn * sn - k.b * cs * sn + k.c * cs * cs,
          k.d * cs + k.e * sn,
          -k.d * sn + k.e * cs,
          k.f,
          {cs, sn, 0},
          {-sn, cs, 0}};
}

// Frame at `origin` with z up, or down when `flip` asks for y to point the other way.
Frame plane_frame(Point origin, Vector x, bool flip) {
  const Vector z{0, 0, flip ? -1.0 : 1.0};
  return {origin, x, cross(z, x), z};
}

Curve ellipse(const Frame& frame, double a, double b, Point start, Point end) {
  const auto angle = [&](Point p) {
    const Vector d = p - frame.origin;
    return std::atan2(dot(d, frame.y) / b, dot(d, frame.x) / a);
  };
  double lo = angle(start), hi = angle(end);
  if (lo < 0) lo += two_pi;
  const bool whole = start.x == end.x && start.y == end.y;
  while (hi <= lo) hi += two_pi;
  if (whole) hi = lo + two_pi;
  if (a == b) return {Circle{frame, a, {lo, hi}}};
  return {Ellipse{frame, a, b, {lo, hi}}};
}

Result<ConicArc> central_conic(const Principal& k, Point start, Point end) {
  const double cx = -k.d / (2 * k.a), cy = -k.e / (2 * k.c);
  const double constant = k.f + 0.5 * (k.d * cx + k.e * cy);
  const Point centre = Point{0, 0, start.z} + cx * k.x + cy * k.y;
  const double aa = -constant / k.a, bb = -constant / k.c;
  ConicArc out;
  out.canonical = k.d == 0 && k.e == 0 && k.x.y == 0;
  if (k.a * k.c > 0) {
    if (!(aa > 0 && bb > 0)) return fail(ErrorCode::Degenerate, "the equation has no real points or only one");
    out.curve = ellipse(plane_frame(centre, k.x, false), std::sqrt(aa), std::sqrt(bb), start, end);
    return out;
  }
  out.kind = ConicKind::Hyperbola;
  if (!(std::abs(aa) > 0)) return fail(ErrorCode::Degenerate, "the hyperbola degenerates to two lines");
  // The axis that the branches open along, pointing to the branch of the start.
  Vector x = aa > 0 ? k.x : k.y;
  double a = std::sqrt(std::max(aa, bb)), b = std::sqrt(-std::min(aa, bb));
  const double s = dot(start - centre, x), e = dot(end - centre, x);
  if (!(s * e > 0)) return fail(ErrorCode::InvalidArgument, "the ends are on different branches of the hyperbola");
  if (s < 0) x = -x;
  Frame frame = plane_frame(centre, x, false);
  double lo = std::asinh(dot(start - centre, frame.y) / b), hi = std::asinh(dot(end - centre, frame.y) / b);
  if (lo > hi) frame = plane_frame(centre, x, true), lo = -lo, hi = -hi;
  if (!(lo < hi)) return fail(ErrorCode::Degenerate, "the hyperbola's ends are one point");
  out.curve = {Hyperbola{frame, a, b, {lo, hi}}};
  return out;
}

// c y^2 + d x + e y + f = 0 along (x, y).
Result<ConicArc> parabola(double c, double d, double e, double f, Vector x, Vector y, Point start, Point end) {
  if (d == 0) return fail(ErrorCode::Degenerate, "the equation is a pair of parallel lines");
  const double y0 = -e / (2 * c), x0 = -(f + 0.5 * e * y0) / d;
  const double focal = -d / (4 * c);
  const Point vertex = Point{0, 0, start.z} + x0 * x + y0 * y;
  const Vector axis = focal > 0 ? x : -x;
  const double length = std::abs(focal);
  Frame frame = plane_frame(vertex, axis, false);
  double lo = dot(start - vertex, frame.y) / (2 * length), hi = dot(end - vertex, frame.y) / (2 * length);
  if (lo > hi) frame = plane_frame(vertex, axis, true), lo = -lo, hi = -hi;
  if (!(lo < hi)) return fail(ErrorCode::Degenerate, "the parabola's ends are one point");
  ConicArc out;
  out.kind = ConicKind::Parabola;
  out.canonical = e == 0 && f == 0 && (x.y == 0 || x.x == 0);
  out.curve = {Parabola{frame, length, {lo, hi}}};
  return out;
}

}  // namespace

Result<ConicArc> conic_arc(const ConicCoefficients& k, Point start, Point end) {
  const double size = std::max({std::abs(k.a), std::abs(k.b), std::abs(k.c)});
  if (!(size > 0) || !std::isfinite(size + std::abs(k.d) + std::abs(k.e) + std::abs(k.f)) || !is_finite(start) ||
      !is_finite(end))
    return fail(ErrorCode::Degenerate, "the equation has no second-degree term");
  const Principal p = principal_axes(k);
  // A principal coefficient this far below the other is rounding: the curve would be 1e7 times longer than wide.
  const double zero = 1e-14 * std::max(std::abs(p.a), std::abs(p.c));
  Result<ConicArc> arc = std::abs(p.a) <= zero   ? parabola(p.c, p.d, p.e, p.f, p.x, p.y, start, end)
                         : std::abs(p.c) <= zero ? parabola(p.a, p.e, p.d, p.f, p.y, -p.x, start, end)
                                                 : central_conic(p, start, end);
  if (arc) arc->end_error = std::max(distance(start_point(arc->curve), start), distance(end_point(arc->curve), end));
  return arc;
}

}  // namespace trimloop
