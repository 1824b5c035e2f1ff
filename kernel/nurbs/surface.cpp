#include "kernel/nurbs/surface.h"

#include <fmt/format.h>

#include "base/assert.h"
#include "kernel/nurbs/basis.h"
#include "kernel/nurbs/homogeneous.h"
#include "kernel/nurbs/knots.h"

namespace trimloop {

Result<NurbsSurface> NurbsSurface::from_homogeneous(int degree_u, int degree_v, std::vector<double> knots_u,
                                                    std::vector<double> knots_v, std::vector<Hpoint> poles,
                                                    std::optional<Interval> range_u, std::optional<Interval> range_v) {
  // The pole counts follow from the knots, so that the check below is about their product.
  const auto along = [](int degree, const std::vector<double>& knots) {
    const std::size_t order = degree < 0 ? 0 : static_cast<std::size_t>(degree) + 1;
    return knots.size() > order ? knots.size() - order : 0;
  };
  const std::size_t count_u = along(degree_u, knots_u), count_v = along(degree_v, knots_v);
  if (auto ok = detail::check_knots("u: ", degree_u, knots_u, count_u); !ok) return tl::unexpected(ok.error());
  if (auto ok = detail::check_knots("v: ", degree_v, knots_v, count_v); !ok) return tl::unexpected(ok.error());
  if (poles.size() % count_v != 0 || poles.size() / count_v != count_u)
    return fail(ErrorCode::InvalidArgument,
                fmt::format("the knots ask for {} x {} poles, there are {}", count_u, count_v, poles.size()),
                static_cast<double>(poles.size()), static_cast<double>(count_u) * static_cast<double>(count_v));
  if (auto ok = detail::check_poles(poles); !ok) return tl::unexpected(ok.error());
  NurbsSurface s;
  s.degree_u_ = degree_u;
  s.degree_v_ = degree_v;
  s.rational_ = detail::divide_out_equal_weights(poles);
  s.knots_u_ = std::move(knots_u);
  s.knots_v_ = std::move(knots_v);
  s.poles_ = std::move(poles);
  const auto active_u = detail::check_range("u: ", s.domain_u(), range_u);
  if (!active_u) return tl::unexpected(active_u.error());
  const auto active_v = detail::check_range("v: ", s.domain_v(), range_v);
  if (!active_v) return tl::unexpected(active_v.error());
  s.range_u_ = *active_u;
  s.range_v_ = *active_v;
  return s;
}

Result<NurbsSurface> NurbsSurface::from_cartesian(int degree_u, int degree_v, std::vector<double> knots_u,
                                                  std::vector<double> knots_v, std::span<const Point> points,
                                                  std::span<const double> weights, std::optional<Interval> range_u,
                                                  std::optional<Interval> range_v) {
  auto poles = detail::premultiply(points, weights);
  if (!poles) return tl::unexpected(poles.error());
  return from_homogeneous(degree_u, degree_v, std::move(knots_u), std::move(knots_v), std::move(*poles), range_u,
                          range_v);
}

NurbsSurface NurbsSurface::with_range(Interval u, Interval v) const {
  TRIMLOOP_ASSERT(u.lo <= u.hi && v.lo <= v.hi, "a range ascends");
  NurbsSurface s = *this;
  s.range_u_ = {domain_u().clamp(u.lo), domain_u().clamp(u.hi)};
  s.range_v_ = {domain_v().clamp(v.lo), domain_v().clamp(v.hi)};
  return s;
}

namespace {

// Partial derivatives a[i][j] = d^(i+j) / du^i dv^j of the homogeneous surface for i + j <= Order.
template <int Order>
void homogeneous(const NurbsSurface& s, Uv at, Hpoint (&a)[Order + 1][Order + 1]) {
  using detail::Sum;
  const std::size_t p = static_cast<std::size_t>(s.degree_u()), q = static_cast<std::size_t>(s.degree_v());
  const std::size_t poles_u = s.poles_u(), poles_v = s.poles_v();
  const double u = s.domain_u().clamp(at.u), v = s.domain_v().clamp(at.v);
  const std::size_t ku = detail::span_of(s.knots_u().data(), p, poles_u, u);
  const std::size_t kv = detail::span_of(s.knots_v().data(), q, poles_v, v);
  detail::Basis<Order> nu, nv;
  detail::fill(nu, s.degree_u(), s.knots_u().data() + ku, u);
  detail::fill(nv, s.degree_v(), s.knots_v().data() + kv, v);
  const Hpoint* row = s.poles().data() + (ku - p) * poles_v + (kv - q);
  Sum sum[Order + 1][Order + 1];
  // The loops over orders are unrolled by request (-O2 would not), so that the sums stay in registers.
  for (std::size_t r = 0; r <= p; ++r, row += poles_v) {
    Sum along_v[Order + 1];
    for (std::size_t c = 0; c <= q; ++c)
#pragma GCC unroll 3
      for (int j = 0; j <= Order; ++j) along_v[j].add(nv.n[j][c], Sum(row[c]));
#pragma GCC unroll 3
    for (int i = 0; i <= Order; ++i)
#pragma GCC unroll 3
      for (int j = 0; i + j <= Order; ++j) sum[i][j].add(nu.n[i][r], along_v[j]);
  }
#pragma GCC unroll 3
  for (int i = 0; i <= Order; ++i)
#pragma GCC unroll 3
    for (int j = 0; i + j <= Order; ++j) a[i][j] = sum[i][j].point();
}

}  // namespace

Point evaluate(const NurbsSurface& s, Uv uv) {
  Hpoint a[1][1];
  homogeneous<0>(s, uv, a);
  return detail::to_point(a[0][0], s.is_rational());
}

void jet1(const NurbsSurface& s, Uv uv, Point& point, Vector& du, Vector& dv) {
  Hpoint a[2][2];
  homogeneous<1>(s, uv, a);
  point = detail::to_point(a[0][0], s.is_rational());
  du = detail::xyz(a[1][0]);
  dv = detail::xyz(a[0][1]);
  if (!s.is_rational()) return;
  const double f = 1 / a[0][0].w;  // eq. 4.11
  du = f * (du - a[1][0].w * to_vector(point));
  dv = f * (dv - a[0][1].w * to_vector(point));
}

SurfaceJet jet(const NurbsSurface& s, Uv uv) {
  using detail::xyz;
  Hpoint a[3][3];
  homogeneous<2>(s, uv, a);
  SurfaceJet j{
      detail::to_point(a[0][0], s.is_rational()), xyz(a[1][0]), xyz(a[0][1]), xyz(a[2][0]), xyz(a[1][1]), xyz(a[0][2])};
  if (!s.is_rational()) return j;
  const double f = 1 / a[0][0].w, wu = a[1][0].w, wv = a[0][1].w;  // A4.4, eq. 4.20
  const Vector value = to_vector(j.point);
  j.du = f * (j.du - wu * value);
  j.dv = f * (j.dv - wv * value);
  j.duu = f * (j.duu - 2 * wu * j.du - a[2][0].w * value);
  j.duv = f * (j.duv - wu * j.dv - wv * j.du - a[1][1].w * value);
  j.dvv = f * (j.dvv - 2 * wv * j.dv - a[0][2].w * value);
  return j;
}

std::vector<double> breaks_u(const NurbsSurface& s) { return detail::breaks(s.knots_u(), s.range_u()); }
std::vector<double> breaks_v(const NurbsSurface& s) { return detail::breaks(s.knots_v(), s.range_v()); }

}  // namespace trimloop
