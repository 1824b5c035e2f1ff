// Derivatives and directions, from the hulls of hodographs. With S = A / w: S_u = (A_u w - A w_u) / w^2; the derivative
// of N / w^2 along v is (N_v w - 2 N w_v) / w^3; S_u x S_v = (w A_u x A_v - w_u A x A_v - w_v A_u x A) / w^3.

#include <algorithm>

#include "kernel/bounds/bounds.h"
#include "kernel/bounds/polynomial.h"

namespace trimloop {

using bounds::Homogeneous;
using bounds::Polynomial;
using bounds::Vector3;

namespace {

// At most |numerator| / w^power.
double quotient(const Vector3& numerator, const Polynomial& w, int power) {
  const double lowest = w.lowest();
  if (!(lowest > 0)) return infinity;
  double out = bounds::largest_length(numerator);
  for (int i = 0; i < power; ++i) out = out / lowest * (1 + 2 * bounds::eps);
  return out;
}

Vector3 first_numerator(const Vector3& a, const Polynomial& w, const Vector3& da, const Polynomial& dw) {
  return w * da - dw * a;
}
// Of the derivative of n / w^2, with dn and dw along the same direction.
Vector3 second_numerator(const Vector3& n, const Polynomial& w, const Vector3& dn, const Polynomial& dw) {
  return w * dn - 2 * (dw * n);
}

DirectionCone cone_of(const Vector3& v) {
  Vector sum{};
  const auto at = [&](std::size_t k) { return Vector{v[0].c[k], v[1].c[k], v[2].c[k]}; };
  const std::size_t count = v[0].c.size();
  for (std::size_t k = 0; k < count; ++k) sum += normalized(at(k));
  const double error = v[0].error + v[1].error + v[2].error;
  DirectionCone cone;
  cone.axis = normalized(sum);
  if (norm(cone.axis) == 0) return DirectionCone{};
  double widest = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Vector x = at(k);
    const double length = norm(x);
    if (length == 0 && error == 0) continue;
    if (!(error < length)) return DirectionCone{};
    widest = std::max(widest, std::atan2(norm(cross(cone.axis, x)), dot(cone.axis, x)) + std::asin(error / length));
  }
  // Directions within less than a right angle of the axis make a convex cone; wider ones do not.
  widest += 16 * bounds::eps;
  if (!(widest < pi / 2)) return DirectionCone{};
  cone.half_angle_rad = widest;
  return cone;
}

Homogeneous of(const CurvePieces& c, std::size_t piece) { return bounds::homogeneous(c.bezier(piece), c.degree(), 0); }
Homogeneous of(const SurfacePieces& s, std::size_t a, std::size_t b) {
  return bounds::homogeneous(s.bezier(a, b), s.degree_u(), s.degree_v());
}

}  // namespace

CurveDerivativeBounds derivative_bounds(const CurvePieces& c, std::size_t piece) {
  const Homogeneous h = of(c, piece);
  const double slope = 1 / c.spans()[piece].length();
  if (!c.is_rational())
    return {slope * bounds::largest_length(along_u(h.a)),
            slope * slope * bounds::largest_length(along_u(along_u(h.a)))};
  const Polynomial dw = along_u(h.w);
  const Vector3 n = first_numerator(h.a, h.w, along_u(h.a), dw);
  return {slope * quotient(n, h.w, 2), slope * slope * quotient(second_numerator(n, h.w, along_u(n), dw), h.w, 3)};
}

SurfaceDerivativeBounds derivative_bounds(const SurfacePieces& s, std::size_t a, std::size_t b) {
  const Homogeneous h = of(s, a, b);
  const double u = 1 / s.spans_u()[a].length(), v = 1 / s.spans_v()[b].length();
  if (!s.is_rational()) {
    const Vector3 du = along_u(h.a), dv = along_v(h.a);
    return {u * bounds::largest_length(du), v * bounds::largest_length(dv), u * u * bounds::largest_length(along_u(du)),
            u * v * bounds::largest_length(along_v(du)), v * v * bounds::largest_length(along_v(dv))};
  }
  const Polynomial wu = along_u(h.w), wv = along_v(h.w);
  const Vector3 nu = first_numerator(h.a, h.w, along_u(h.a), wu), nv = first_numerator(h.a, h.w, along_v(h.a), wv);
  return {u * quotient(nu, h.w, 2), v * quotient(nv, h.w, 2),
          u * u * quotient(second_numerator(nu, h.w, along_u(nu), wu), h.w, 3),
          u * v * quotient(second_numerator(nu, h.w, along_v(nu), wv), h.w, 3),
          v * v * quotient(second_numerator(nv, h.w, along_v(nv), wv), h.w, 3)};
}

DirectionCone tangent_cone(const CurvePieces& c, std::size_t piece) {
  const Homogeneous h = of(c, piece);
  if (!c.is_rational()) return cone_of(along_u(h.a));
  if (!(h.w.lowest() > 0)) return {};
  return cone_of(first_numerator(h.a, h.w, along_u(h.a), along_u(h.w)));
}
DirectionCone tangent_cone_u(const SurfacePieces& s, std::size_t a, std::size_t b) {
  const Homogeneous h = of(s, a, b);
  if (!s.is_rational()) return cone_of(along_u(h.a));
  if (!(h.w.lowest() > 0)) return {};
  return cone_of(first_numerator(h.a, h.w, along_u(h.a), along_u(h.w)));
}
DirectionCone tangent_cone_v(const SurfacePieces& s, std::size_t a, std::size_t b) {
  const Homogeneous h = of(s, a, b);
  if (!s.is_rational()) return cone_of(along_v(h.a));
  if (!(h.w.lowest() > 0)) return {};
  return cone_of(first_numerator(h.a, h.w, along_v(h.a), along_v(h.w)));
}

DirectionCone normal_cone(const SurfacePieces& s, std::size_t a, std::size_t b) {
  const Homogeneous h = of(s, a, b);
  const Vector3 au = along_u(h.a), av = along_v(h.a);
  if (!s.is_rational()) return cone_of(cross(au, av));
  if (!(h.w.lowest() > 0)) return {};
  return cone_of(h.w * cross(au, av) - along_u(h.w) * cross(h.a, av) - along_v(h.w) * cross(au, h.a));
}

DirectionCone joined(const DirectionCone& a, const DirectionCone& b) {
  if (a.half_angle_rad >= pi || b.half_angle_rad >= pi) return {};
  const double between = std::atan2(norm(cross(a.axis, b.axis)), dot(a.axis, b.axis));
  if (between + b.half_angle_rad <= a.half_angle_rad) return a;
  if (between + a.half_angle_rad <= b.half_angle_rad) return b;
  // The axis in the plane of both, midway between the outer sides.
  const double half = 0.5 * (between + a.half_angle_rad + b.half_angle_rad);
  const Vector across = normalized(b.axis - dot(a.axis, b.axis) * a.axis);
  if (half >= pi || norm(across) == 0) return {};
  const double turn = half - a.half_angle_rad;
  return {normalized(std::cos(turn) * a.axis + std::sin(turn) * across), half + 16 * bounds::eps};
}

}  // namespace trimloop
