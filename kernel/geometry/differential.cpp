#include "kernel/geometry/differential.h"

#include <fmt/format.h>

#include "kernel/geometry/detail.h"

namespace trimloop {

Result<FrenetFrame> frenet_frame(const Curve& c, double t) {
  const CurveJet j = jet(c, t);
  FrenetFrame f{j.point, normalized(j.d1), {}, {}, norm(j.d1)};
  if (!(f.speed > 0) || !is_finite(j.d1))
    return fail(ErrorCode::Degenerate, fmt::format("the curve stands still at {}", t), f.speed, 0);
  const Vector b = cross(j.d1, j.d2);
  f.curvature = norm(b) / (f.speed * f.speed * f.speed);
  if (!(norm(b) > 0)) return f;
  f.binormal = normalized(b);
  f.normal = cross(f.binormal, f.tangent);
  f.torsion = dot(b, detail::third_derivative(c, t)) / dot(b, b);
  if (!std::isfinite(f.torsion)) f.torsion = 0;  // b is too small to be squared
  return f;
}

Result<OsculatingCircle> osculating_circle(const Curve& c, double t) {
  const auto f = frenet_frame(c, t);
  if (!f) return tl::unexpected<Error>(f.error());
  if (!(f->curvature > 0)) return fail(ErrorCode::Degenerate, fmt::format("the curve is straight at {}", t), 0);
  const double radius = 1 / f->curvature;
  return OsculatingCircle{f->point + radius * f->normal, radius};
}

namespace {

struct Forms {  // first and second fundamental form
  double e, f, g, l, m, n;
  Vector normal;
};
Result<Forms> forms(const SurfaceJet& j, Uv uv) {
  const Vector n = cross(j.du, j.dv);
  if (!(norm(n) > 1e-14 * std::max(dot(j.du, j.du), dot(j.dv, j.dv))) || !is_finite(n))
    return fail(ErrorCode::Degenerate,
                fmt::format("the surface has no tangent plane by its derivatives at ({}, {})", uv.u, uv.v), norm(n), 0);
  const Vector unit = normalized(n);
  return Forms{
      dot(j.du, j.du), dot(j.du, j.dv), dot(j.dv, j.dv), dot(j.duu, unit), dot(j.duv, unit), dot(j.dvv, unit), unit};
}

}  // namespace

// In an orthonormal basis of the tangent plane the shape operator is symmetric, [a b; b c]; its eigenvalues are the
// mean of a and c, plus and minus the length of ((a - c) / 2, b): no difference of squares.
Result<SurfaceCurvature> curvature(const Surface& s, Uv uv) {
  const SurfaceJet j = jet(s, uv);
  const auto q = forms(j, uv);
  if (!q) return tl::unexpected<Error>(q.error());
  SurfaceCurvature out;
  out.point = j.point;
  out.normal = q->normal;
  const Vector x = normalized(j.du), y = cross(q->normal, x);
  // x = Su / |Su|, y = (Sv - (f / e) Su) / h with h = its length.
  const double root = std::sqrt(q->e), share = q->f / q->e, h = dot(j.dv, y);
  const double a = q->l / q->e, b = (q->m - share * q->l) / (root * h);
  const double c = (q->n - 2 * share * q->m + share * share * q->l) / (h * h);
  const double half = 0.5 * (a - c), radius = std::hypot(half, b), mean = 0.5 * (a + c);
  out.k1 = mean + radius;
  out.k2 = mean - radius;
  out.gaussian = a * c - b * b;
  out.mean = mean;
  out.umbilic = 2 * radius <= 1e-9 * std::max(std::abs(out.k1), std::abs(out.k2));
  const double angle = radius > 0 ? 0.5 * std::atan2(b, half) : 0;
  out.direction1 = std::cos(angle) * x + std::sin(angle) * y;
  out.direction2 = cross(out.normal, out.direction1);
  return out;
}

Result<double> normal_curvature(const Surface& s, Uv uv, Uv d) {
  const auto q = forms(jet(s, uv), uv);
  if (!q) return tl::unexpected<Error>(q.error());
  const double first = q->e * d.u * d.u + 2 * q->f * d.u * d.v + q->g * d.v * d.v;
  if (!(first > 0)) return fail(ErrorCode::InvalidArgument, "a direction is not zero", first, 0);
  return (q->l * d.u * d.u + 2 * q->m * d.u * d.v + q->n * d.v * d.v) / first;
}

}  // namespace trimloop
