#include "kernel/nurbs/error_bound.h"

#include "kernel/nurbs/basis.h"
#include "kernel/nurbs/homogeneous.h"

namespace trimloop {
namespace {

constexpr double u = 0x1p-53;

// Largest coordinate and largest weight among the poles a point depends on.
struct Size {
  double point = 0, weight = 0;
  void add(const Hpoint& h) {
    point = std::max({point, std::abs(h.x), std::abs(h.y), std::abs(h.z)});
    weight = std::max(weight, std::abs(h.w));
  }
};

// `degrees`: the sum of the degrees, `directions`: 1 or 2.
double quotient_error(const Size& size, Point at, double w, bool rational, int degrees, int directions) {
  // The factor covers terms of second order; the last term what underflow may cost.
  const double share = (9 * degrees + directions) * u * (1 + 1e-10);
  const double least = (degrees + directions) * std::numeric_limits<double>::denorm_min() * 4;
  const double error = share * size.point + least;
  if (!rational) return error;
  const double error_w = share * size.weight + least;
  if (!(std::abs(w) > error_w) || !is_finite(at)) return infinity;
  const double largest = std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}) * (1 + 4 * u);
  return ((error + largest * error_w) / (std::abs(w) - error_w) + 2 * u * largest + least) * (1 + 8 * u);
}

}  // namespace

BoundedPoint evaluate_bounded(const NurbsCurve& c, double t) {
  const std::size_t p = static_cast<std::size_t>(c.degree());
  t = c.domain().clamp(t);
  const std::size_t k = detail::span_of(c.knots().data(), p, c.poles().size(), t);
  detail::Basis<0> basis;
  detail::fill(basis, c.degree(), c.knots().data() + k, t);
  detail::Sum sum;
  Size size;
  for (std::size_t r = 0; r <= p; ++r) {
    const Hpoint& pole = c.poles()[k - p + r];
    sum.add(basis.n[0][r], detail::Sum(pole));
    size.add(pole);
  }
  const Point point = detail::to_point(sum.point(), c.is_rational());
  return {point, quotient_error(size, point, sum.point().w, c.is_rational(), c.degree(), 1)};
}

BoundedPoint evaluate_bounded(const NurbsSurface& s, Uv uv) {
  const std::size_t p = static_cast<std::size_t>(s.degree_u()), q = static_cast<std::size_t>(s.degree_v());
  uv = {s.domain_u().clamp(uv.u), s.domain_v().clamp(uv.v)};
  const std::size_t ku = detail::span_of(s.knots_u().data(), p, s.poles_u(), uv.u);
  const std::size_t kv = detail::span_of(s.knots_v().data(), q, s.poles_v(), uv.v);
  detail::Basis<0> nu, nv;
  detail::fill(nu, s.degree_u(), s.knots_u().data() + ku, uv.u);
  detail::fill(nv, s.degree_v(), s.knots_v().data() + kv, uv.v);
  detail::Sum sum;
  Size size;
  for (std::size_t r = 0; r <= p; ++r) {
    detail::Sum row;
    for (std::size_t c = 0; c <= q; ++c) {
      const Hpoint& pole = s.pole(ku - p + r, kv - q + c);
      row.add(nv.n[0][c], detail::Sum(pole));
      size.add(pole);
    }
    sum.add(nu.n[0][r], row);
  }
  const Point point = detail::to_point(sum.point(), s.is_rational());
  return {point, quotient_error(size, point, sum.point().w, s.is_rational(), s.degree_u() + s.degree_v(), 2)};
}

}  // namespace trimloop
