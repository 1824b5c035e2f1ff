#include "kernel/nurbs/curve.h"

#include "base/assert.h"
#include "kernel/math/transform.h"
#include "kernel/nurbs/basis.h"
#include "kernel/nurbs/homogeneous.h"
#include "kernel/nurbs/knots.h"

namespace trimloop {

Result<NurbsCurve> NurbsCurve::from_homogeneous(int degree, std::vector<double> knots, std::vector<Hpoint> poles,
                                                std::optional<Interval> range) {
  if (auto ok = detail::check_knots("", degree, knots, poles.size()); !ok) return tl::unexpected(ok.error());
  if (auto ok = detail::check_poles(poles); !ok) return tl::unexpected(ok.error());
  NurbsCurve c;
  c.degree_ = degree;
  c.rational_ = detail::divide_out_equal_weights(poles);
  c.knots_ = std::move(knots);
  c.poles_ = std::move(poles);
  const auto active = detail::check_range("", c.domain(), range);
  if (!active) return tl::unexpected(active.error());
  c.range_ = *active;
  return c;
}

Result<NurbsCurve> NurbsCurve::from_cartesian(int degree, std::vector<double> knots, std::span<const Point> points,
                                              std::span<const double> weights, std::optional<Interval> range) {
  auto poles = detail::premultiply(points, weights);
  if (!poles) return tl::unexpected(poles.error());
  return from_homogeneous(degree, std::move(knots), std::move(*poles), range);
}

NurbsCurve NurbsCurve::with_range(Interval range) const {
  TRIMLOOP_ASSERT(range.lo <= range.hi, "a range ascends");
  NurbsCurve c = *this;
  c.range_ = {domain().clamp(range.lo), domain().clamp(range.hi)};
  return c;
}

namespace {

// Derivatives 0..Order of the homogeneous curve.
template <int Order>
void homogeneous(const NurbsCurve& c, double t, Hpoint (&a)[Order + 1]) {
  const std::size_t p = static_cast<std::size_t>(c.degree());
  t = c.domain().clamp(t);
  const std::size_t k = detail::span_of(c.knots().data(), p, c.poles().size(), t);
  detail::Basis<Order> basis;
  detail::fill(basis, c.degree(), c.knots().data() + k, t);
  const Hpoint* pole = c.poles().data() + (k - p);
  for (int m = 0; m <= Order; ++m) {
    detail::Sum sum;
    for (std::size_t r = 0; r <= p; ++r) sum.add(basis.n[m][r], detail::Sum(pole[r]));
    a[m] = sum.point();
  }
}

}  // namespace

Point evaluate(const NurbsCurve& c, double t) {
  Hpoint a[1];
  homogeneous<0>(c, t, a);
  return detail::to_point(a[0], c.is_rational());
}

CurveJet jet(const NurbsCurve& c, double t) {
  Hpoint a[3];
  homogeneous<2>(c, t, a);
  CurveJet j{detail::to_point(a[0], c.is_rational()), detail::xyz(a[1]), detail::xyz(a[2])};
  if (!c.is_rational()) return j;
  const double s = 1 / a[0].w;  // eq. 4.8
  const Vector value = to_vector(j.point);
  j.d1 = s * (j.d1 - a[1].w * value);
  j.d2 = s * (j.d2 - 2 * a[1].w * j.d1 - a[2].w * value);
  return j;
}

std::vector<Vector> derivatives(const NurbsCurve& c, double t, int order) {
  TRIMLOOP_ASSERT(order >= 0, "the order of a derivative is not negative");
  const std::size_t p = static_cast<std::size_t>(c.degree()), count = static_cast<std::size_t>(order) + 1;
  t = c.domain().clamp(t);
  const std::size_t k = detail::span_of(c.knots().data(), p, c.poles().size(), t);

  // 1. Homogeneous derivatives; zero above the degree.
  std::vector<Hpoint> a(count, Hpoint{0, 0, 0, 0});
  for (std::size_t m = 0; m < count && m <= p; ++m) {
    double n[detail::max_degree + 1];
    detail::fill_derivative(c.degree(), static_cast<int>(m), c.knots().data() + k, t, n);
    detail::Sum sum;
    for (std::size_t r = 0; r <= p; ++r) sum.add(n[r], detail::Sum(c.poles()[k - p + r]));
    a[m] = sum.point();
  }

  // 2. A4.2: C(m) = (A(m) - sum_{i=1..m} binomial(m, i) w(i) C(m - i)) / w.
  std::vector<Vector> result(count);
  std::vector<double> binomial(count, 0.0);
  binomial[0] = 1;
  for (std::size_t m = 0; m < count; ++m) {
    Vector v = detail::xyz(a[m]);
    for (std::size_t i = std::min(m, p); i >= 1 && c.is_rational(); --i) v = v - binomial[i] * a[i].w * result[m - i];
    result[m] = m == 0 ? to_vector(detail::to_point(a[0], c.is_rational())) : c.is_rational() ? v / a[0].w : v;
    for (std::size_t i = m + 1; i >= 1; --i)
      if (i < count) binomial[i] += binomial[i - 1];  // Pascal's next row
  }
  return result;
}

std::vector<double> breaks(const NurbsCurve& c) { return detail::breaks(c.knots(), c.range()); }

}  // namespace trimloop
