#include "kernel/geometry/inversion.h"

#include <fmt/format.h>

namespace trimloop {

Result<double> invert_point(const Curve& c, Point p, double tolerance) {
  if (!is_bounded(c)) return fail(ErrorCode::InvalidArgument, "a point is looked for on bounded curves only");
  const CurveFoot foot = closest_point(c, p);
  if (foot.distance <= tolerance) return foot.t;
  return fail(ErrorCode::NotFound, fmt::format("the point lies {} off the curve", foot.distance), foot.distance,
              tolerance);
}

Result<Uv> invert_point(const Surface& s, Point p, double tolerance) {
  const SurfaceFoot foot = closest_point(s, p);
  if (foot.distance <= tolerance) return foot.uv;
  return fail(ErrorCode::NotFound, fmt::format("the point lies {} off the surface", foot.distance), foot.distance,
              tolerance);
}

// Least squares by the cross products, which need no normal equations.
Result<TangentInversion> invert_tangent(const Surface& s, Uv uv, Vector v) {
  Point p;
  Vector du, dv;
  jet1(s, uv, p, du, dv);
  const Vector n = cross(du, dv);
  const double area = dot(n, n);
  if (!(area > 1e-28 * std::pow(std::max(dot(du, du), dot(dv, dv)), 2)))
    return fail(ErrorCode::Degenerate,
                fmt::format("the surface has no tangent plane by its derivatives at ({}, {})", uv.u, uv.v));
  TangentInversion out{{dot(cross(v, dv), n) / area, dot(cross(du, v), n) / area}, 0};
  out.off_plane = norm(v - (out.direction.u * du + out.direction.v * dv));
  return out;
}

}  // namespace trimloop
