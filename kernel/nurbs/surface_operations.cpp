#include "base/assert.h"
#include "kernel/nurbs/basis.h"
#include "kernel/nurbs/builder.h"
#include "kernel/nurbs/homogeneous.h"
#include "kernel/nurbs/net.h"

namespace trimloop {

using detail::Net;

namespace {

// Everything is done along u, on rows of poles; along v it is done between two swaps.
Net net(const NurbsSurface& s) { return {s.degree_u(), s.poles_v(), s.knots_u(), s.poles()}; }

NurbsSurface with_net(const NurbsSurface& s, Net n, Interval range_u) {
  return NurbsBuilder::surface(n.degree, s.degree_v(), s.is_rational(), std::move(n.knots), s.knots_v(),
                               std::move(n.poles), range_u, s.range_v());
}

NurbsSurface elevated_u(const NurbsSurface& s, int by) {
  TRIMLOOP_ASSERT(by >= 0 && by <= detail::max_degree - s.degree_u(), "the elevated degree is at most 64");
  if (by == 0) return s;
  Net n = net(s);
  for (int i = 0; i < by; ++i) n = detail::elevated(n);
  return with_net(s, std::move(n), s.range_u());
}

NurbsSurface trimmed_u(const NurbsSurface& s, Interval u) {
  u = {s.domain_u().clamp(u.lo), s.domain_u().clamp(u.hi)};
  TRIMLOOP_ASSERT(u.lo < u.hi, "the part that is kept has a length");
  return with_net(s, detail::part(net(s), u), u);
}

}  // namespace

NurbsSurface refine_u(const NurbsSurface& s, std::span<const double> new_knots) {
  const Net n = net(s);
  return with_net(s, detail::refined(n, detail::insertable(n, new_knots)), s.range_u());
}

NurbsSurface refine_v(const NurbsSurface& s, std::span<const double> new_knots) {
  return swapped(refine_u(swapped(s), new_knots));
}

NurbsSurface elevate(const NurbsSurface& s, int by_u, int by_v) {
  NurbsSurface result = elevated_u(s, by_u);
  return by_v == 0 ? result : swapped(elevated_u(swapped(result), by_v));
}

NurbsSurface swapped(const NurbsSurface& s) {
  const std::size_t rows = s.poles_u(), columns = s.poles_v();
  std::vector<Hpoint> poles(s.poles().size());
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j) poles[j * rows + i] = s.poles()[i * columns + j];
  return NurbsBuilder::surface(s.degree_v(), s.degree_u(), s.is_rational(), s.knots_v(), s.knots_u(), std::move(poles),
                               s.range_v(), s.range_u());
}

NurbsSurface reversed_u(const NurbsSurface& s) {
  const Interval d = s.domain_u(), u{detail::mirrored(d, s.range_u().hi), detail::mirrored(d, s.range_u().lo)};
  return with_net(s, detail::reversed(net(s)), u);
}

NurbsSurface trimmed(const NurbsSurface& s, Interval u, Interval v) {
  return swapped(trimmed_u(swapped(trimmed_u(s, u)), v));
}

NurbsCurve isocurve_u(const NurbsSurface& s, double u) {
  u = s.domain_u().clamp(u);
  const std::size_t p = static_cast<std::size_t>(s.degree_u()), columns = s.poles_v();
  const std::size_t k = detail::span_of(s.knots_u().data(), p, s.poles_u(), u);
  detail::Basis<0> basis;
  detail::fill(basis, s.degree_u(), s.knots_u().data() + k, u);
  std::vector<Hpoint> poles(columns);
  for (std::size_t j = 0; j < columns; ++j) {
    detail::Sum sum;
    for (std::size_t r = 0; r <= p; ++r) sum.add(basis.n[0][r], detail::Sum(s.pole(k - p + r, j)));
    poles[j] = sum.point();
  }
  return NurbsBuilder::curve(s.degree_v(), s.is_rational(), s.knots_v(), std::move(poles), s.range_v());
}

NurbsCurve isocurve_v(const NurbsSurface& s, double v) { return isocurve_u(swapped(s), v); }

NurbsSurface transformed(const NurbsSurface& s, const Transform& m) {
  std::vector<Hpoint> poles = s.poles();
  for (Hpoint& h : poles) h = detail::apply(m, h);
  return NurbsBuilder::surface(s.degree_u(), s.degree_v(), s.is_rational(), s.knots_u(), s.knots_v(), std::move(poles),
                               s.range_u(), s.range_v());
}

Box bounding_box(const NurbsSurface& s) {
  const Interval u = s.range_u(), v = s.range_v();
  const bool whole = u.lo == s.knots_u().front() && u.hi == s.knots_u().back() &&  //
                     v.lo == s.knots_v().front() && v.hi == s.knots_v().back();
  if (whole) return detail::hull_box(s.poles());
  if (!(u.lo < u.hi)) return bounding_box(isocurve_u(s, u.lo));
  if (!(v.lo < v.hi)) return bounding_box(isocurve_v(s, v.lo));
  return detail::hull_box(trimmed(s, u, v).poles());
}

}  // namespace trimloop
