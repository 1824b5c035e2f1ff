#include "kernel/nurbs/hodograph.h"

#include <fmt/format.h>

#include "base/assert.h"
#include "kernel/nurbs/basis.h"
#include "kernel/nurbs/binomial.h"
#include "kernel/nurbs/homogeneous.h"
#include "kernel/nurbs/net.h"

namespace trimloop {
namespace {

using detail::Net;

std::size_t index(int i) { return static_cast<std::size_t>(i); }

// Eq. 3.8 on rows of `width` points: p (P_i+1 - P_i) / (u_i+p+1 - u_i+1), over the inner knots.
Net difference(const Net& s) {
  Net d{s.degree - 1, s.width, {s.knots.begin() + 1, s.knots.end() - 1}, {}};
  const std::size_t p = s.p(), rows = s.rows();
  d.poles.reserve((rows - 1) * s.width);
  for (std::size_t i = 0; i + 1 < rows; ++i) {
    const double width = s.knots[i + p + 1] - s.knots[i + 1];
    for (std::size_t c = 0; c < s.width; ++c) {
      const Hpoint &a = s.poles[i * s.width + c], &b = s.poles[(i + 1) * s.width + c];
      // Such a pole has no weight in any span of the domain.
      d.poles.push_back(width > 0 ? static_cast<double>(p) / width * (b - a) : Hpoint{0, 0, 0, 0});
    }
  }
  return d;
}

Net transposed(const Net& s, int degree, std::vector<double> knots) {
  const std::size_t rows = s.poles.size() / s.width;
  Net out{degree, rows, std::move(knots), std::vector<Hpoint>(s.poles.size())};
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < s.width; ++j) out.poles[j * rows + i] = s.poles[i * s.width + j];
  return out;
}

// ---- The derivative as a spline

// The knots of full multiplicity inside the range, with its ends.
std::vector<double> jumps(const std::vector<double>& knots, int degree, Interval range) {
  std::vector<double> at{range.lo};
  for (auto k = std::upper_bound(knots.begin(), knots.end(), range.lo); k != knots.end() && *k < range.hi;) {
    const auto next = std::upper_bound(k, knots.end(), *k);
    if (next - k >= degree) at.push_back(*k);
    k = next;
  }
  at.push_back(range.hi);
  return at;
}

// One patch over a rectangle of Bezier poles, row-major, (p + 1) x (q + 1).
struct Patch {
  std::size_t p, q;
  std::vector<Hpoint> poles;
};
struct Row {  // a polynomial in v, as a value of one in u
  std::vector<Hpoint> at;
};
Row operator+(Row a, const Row& b) {
  for (std::size_t i = 0; i < a.at.size(); ++i) a.at[i] = a.at[i] + b.at[i];
  return a;
}
Row operator*(double s, Row a) {
  for (Hpoint& h : a.at) h = s * h;
  return a;
}

// Homogeneous numerator and square of the weight of d/du of a rational patch over an interval of length h:
// w A_u - w_u A has degree (2 p - 1, 2 q), and is raised once in u.
Patch rational_derivative(const Patch& a, double h) {
  std::vector<Row> rows, slopes;
  for (std::size_t i = 0; i <= a.p; ++i)
    rows.push_back({{a.poles.begin() + static_cast<std::ptrdiff_t>(i * (a.q + 1)),
                     a.poles.begin() + static_cast<std::ptrdiff_t>((i + 1) * (a.q + 1))}});
  for (std::size_t i = 0; i < a.p; ++i) slopes.push_back(static_cast<double>(a.p) / h * (rows[i + 1] + -1.0 * rows[i]));
  const auto cross = [](const Hpoint& da, const Hpoint& b) {
    return Hpoint{da.x * b.w - da.w * b.x, da.y * b.w - da.w * b.y, da.z * b.w - da.w * b.z, 0};
  };
  const auto square = [](const Hpoint& f, const Hpoint& g) { return Hpoint{0, 0, 0, f.w * g.w}; };
  const auto in_v = [](const auto& times) {
    return [times](const Row& f, const Row& g) { return Row{detail::bezier_product(f.at, g.at, times)}; };
  };
  const std::vector<Row> top = detail::bezier_product(slopes, rows, in_v(cross));
  const std::vector<Row> bottom = detail::bezier_product(rows, rows, in_v(square));
  Patch out{2 * a.p, 2 * a.q, {}};
  for (std::size_t i = 0; i <= out.p; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(out.p);  // elevation, eq. 5.36
    Row row = bottom[i];
    if (i > 0) row = row + share * top[i - 1];
    if (i < out.p) row = row + (1 - share) * top[i];
    out.poles.insert(out.poles.end(), row.at.begin(), row.at.end());
  }
  return out;
}

std::vector<double> full_knots(const std::vector<double>& at, std::size_t degree) {
  std::vector<double> knots{at.front()};
  for (const double t : at) knots.insert(knots.end(), degree, t);
  knots.push_back(at.back());
  return knots;
}

// Of one smooth part; v is left alone.
Result<NurbsSurface> smooth_rational(const NurbsSurface& s) {
  const std::vector<double> at_u = breaks_u(s), at_v = breaks_v(s);
  const std::size_t p = index(s.degree_u()), q = index(s.degree_v());
  const std::vector<double> fine_u = full_knots(at_u, p), fine_v = full_knots(at_v, q);
  const NurbsSurface b = refine_v(refine_u(trimmed(s, s.range_u(), s.range_v()), fine_u), fine_v);
  const std::size_t columns = 2 * q * (at_v.size() - 1) + 1, rows = 2 * p * (at_u.size() - 1) + 1;
  std::vector<Hpoint> poles(rows * columns);
  for (std::size_t i = 0; i + 1 < at_u.size(); ++i)
    for (std::size_t j = 0; j + 1 < at_v.size(); ++j) {
      Patch patch{p, q, {}};
      for (std::size_t k = 0; k <= p; ++k)
        for (std::size_t l = 0; l <= q; ++l) patch.poles.push_back(b.pole(i * p + k, j * q + l));
      const Patch d = rational_derivative(patch, at_u[i + 1] - at_u[i]);
      for (std::size_t k = 0; k <= d.p; ++k)
        for (std::size_t l = 0; l <= d.q; ++l)
          poles[(i * d.p + k) * columns + j * d.q + l] = d.poles[k * (d.q + 1) + l];
    }
  return NurbsSurface::from_homogeneous(2 * s.degree_u(), 2 * s.degree_v(), full_knots(at_u, 2 * p),
                                        full_knots(at_v, 2 * q), std::move(poles));
}

// Over a smooth part of a polynomial. The difference is taken before anything is cut, which would cost digits on short
// spans. Splines begin at degree 1, so that of a line is raised.
Net smooth_polynomial(const Net& whole, Interval part) {
  Net d = whole.degree > 1 ? detail::part(difference(whole), part)
                           : difference(detail::elevated(detail::part(whole, part)));
  for (Hpoint& h : d.poles) h.w = 1;
  return d;
}

// ---- Values through derivative poles

struct Place {
  std::size_t span;
  double t;
};
Place place(const std::vector<double>& knots, int degree, std::size_t poles, double t) {
  t = Interval{knots[index(degree)], knots[poles]}.clamp(t);
  return {detail::span_of(knots.data(), index(degree), poles, t), t};
}
// The span that ends at t, when a knot of the domain lies there and one begins before it.
Place place(const std::vector<double>& knots, int degree, std::size_t poles, double t, Side side) {
  Place at = place(knots, degree, poles, t);
  if (side == Side::Left && knots[at.span] == at.t && at.t > knots[index(degree)])
    while (at.span > index(degree) && !(knots[at.span] < at.t)) --at.span;
  return at;
}

// A4.2 over derivatives of the homogeneous curve.
std::vector<Vector> quotient(const std::vector<Hpoint>& a, bool rational) {
  std::vector<Vector> out(a.size());
  for (std::size_t m = 0; m < a.size(); ++m) {
    Vector v = detail::xyz(a[m]);
    for (std::size_t i = 1; i <= m && rational; ++i) v = v - detail::binomial(m, i) * a[i].w * out[m - i];
    out[m] = rational ? v / a[0].w : v;
  }
  return out;
}

// A4.4 over a triangle of derivatives at [k * n + l], k + l < n.
std::vector<Vector> quotient2(const std::vector<Hpoint>& a, std::size_t n, bool rational) {
  std::vector<Vector> out(a.size());
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t l = 0; k + l < n; ++l) {
      Vector v = detail::xyz(a[k * n + l]);
      for (std::size_t i = 0; i <= k && rational; ++i)
        for (std::size_t j = i == 0 ? 1 : 0; j <= l; ++j)
          v = v - detail::binomial(k, i) * detail::binomial(l, j) * a[i * n + j].w * out[(k - i) * n + (l - j)];
      out[k * n + l] = rational ? v / a[0].w : v;
    }
  return out;
}

std::vector<Vector> derivatives_at(const NurbsCurve& c, Place at, int order) {
  std::vector<Hpoint> a(index(order) + 1, Hpoint{0, 0, 0, 0});
  for (int m = 0; m <= std::min(order, c.degree()); ++m) {
    double n[detail::max_degree + 1];
    detail::fill_derivative(c.degree(), m, c.knots().data() + at.span, at.t, n);
    detail::Sum sum;
    for (std::size_t r = 0; r <= index(c.degree()); ++r)
      sum.add(n[r], detail::Sum(c.poles()[at.span - index(c.degree()) + r]));
    a[index(m)] = sum.point();
  }
  return quotient(a, c.is_rational());
}

std::vector<Vector> derivatives_at(const NurbsSurface& s, Place u, Place v, int order) {
  const std::size_t n = index(order) + 1, p = index(s.degree_u()), q = index(s.degree_v());
  std::vector<Hpoint> a(n * n, Hpoint{0, 0, 0, 0});
  for (std::size_t k = 0; k < n && k <= p; ++k)
    for (std::size_t l = 0; k + l < n && l <= q; ++l) {
      double nu[detail::max_degree + 1], nv[detail::max_degree + 1];
      detail::fill_derivative(s.degree_u(), static_cast<int>(k), s.knots_u().data() + u.span, u.t, nu);
      detail::fill_derivative(s.degree_v(), static_cast<int>(l), s.knots_v().data() + v.span, v.t, nv);
      detail::Sum sum;
      for (std::size_t r = 0; r <= p; ++r) {
        detail::Sum row;
        for (std::size_t c = 0; c <= q; ++c) row.add(nv[c], detail::Sum(s.pole(u.span - p + r, v.span - q + c)));
        sum.add(nu[r], row);
      }
      a[k * n + l] = sum.point();
    }
  return quotient2(a, n, s.is_rational());
}

// The value of the k-th derivative at the span, from its poles: functions of degree p - k.
Hpoint value_of(const std::vector<Hpoint>& poles, std::size_t degree, std::size_t order, const double* at,
                std::size_t span, double t) {
  double n[detail::max_degree + 1];
  detail::fill_derivative(static_cast<int>(degree - order), 0, at, t, n);
  Hpoint sum{0, 0, 0, 0};
  for (std::size_t r = 0; r <= degree - order; ++r) sum = sum + n[r] * poles[span - degree + r];
  return sum;
}

}  // namespace

Result<std::vector<NurbsCurve>> hodograph(const NurbsCurve& c) {
  if (c.is_rational() && 2 * c.degree() > detail::max_degree)
    return fail(ErrorCode::Limit, fmt::format("the hodograph would have degree {}", 2 * c.degree()), 2 * c.degree(),
                detail::max_degree);
  std::vector<NurbsCurve> out;
  const std::vector<double> at = jumps(c.knots(), c.degree(), c.range());
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    if (!(at[i] < at[i + 1])) continue;
    if (!c.is_rational()) {
      Net d = smooth_polynomial({c.degree(), 1, c.knots(), c.poles()}, {at[i], at[i + 1]});
      auto curve = NurbsCurve::from_homogeneous(d.degree, std::move(d.knots), std::move(d.poles));
      if (!curve) return tl::unexpected<Error>(curve.error());
      out.push_back(std::move(*curve));
      continue;
    }
    const NurbsCurve part = trimmed(c, {at[i], at[i + 1]});
    const std::vector<double> ends = breaks(part);
    std::vector<Hpoint> poles;
    const std::vector<NurbsCurve> pieces = bezier_pieces(part);
    for (const NurbsCurve& piece : pieces) {
      const Patch d = rational_derivative({index(c.degree()), 0, piece.poles()}, piece.range().length());
      poles.insert(poles.end(), d.poles.begin() + (poles.empty() ? 0 : 1), d.poles.end());
    }
    auto curve =
        NurbsCurve::from_homogeneous(2 * c.degree(), full_knots(ends, 2 * index(c.degree())), std::move(poles));
    if (!curve) return tl::unexpected<Error>(curve.error());
    out.push_back(std::move(*curve));
  }
  return out;
}

Result<std::vector<NurbsSurface>> hodograph_u(const NurbsSurface& s) {
  const int highest = 2 * std::max(s.degree_u(), s.degree_v());
  if (s.is_rational() && highest > detail::max_degree)
    return fail(ErrorCode::Limit, fmt::format("the hodograph would have degree {}", highest), highest,
                detail::max_degree);
  std::vector<NurbsSurface> out;
  const std::vector<double> at = jumps(s.knots_u(), s.degree_u(), s.range_u());
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    if (!(at[i] < at[i + 1])) continue;
    const Interval over{at[i], at[i + 1]};
    Net d;
    if (!s.is_rational()) d = smooth_polynomial({s.degree_u(), s.poles_v(), s.knots_u(), s.poles()}, over);
    auto surface = s.is_rational() ? smooth_rational(trimmed(s, over, s.range_v()))
                                   : NurbsSurface::from_homogeneous(d.degree, s.degree_v(), d.knots, s.knots_v(),
                                                                    d.poles, {}, s.range_v());
    if (!surface) return tl::unexpected<Error>(surface.error());
    out.push_back(std::move(*surface));
  }
  return out;
}

Result<std::vector<NurbsSurface>> hodograph_v(const NurbsSurface& s) {
  auto parts = hodograph_u(swapped(s));
  if (parts)
    for (NurbsSurface& part : *parts) part = swapped(part);
  return parts;
}

std::vector<std::vector<Hpoint>> derivative_poles(const NurbsCurve& c, int order) {
  TRIMLOOP_ASSERT(order >= 0, "the order of a derivative is not negative");
  Net n{c.degree(), 1, c.knots(), c.poles()};
  std::vector<std::vector<Hpoint>> out{n.poles};
  for (int k = 1; k <= order; ++k) {
    if (k <= c.degree()) n = difference(n);
    out.push_back(k <= c.degree() ? n.poles : std::vector<Hpoint>());
  }
  return out;
}

std::vector<std::vector<Hpoint>> derivative_poles(const NurbsSurface& s, int order) {
  TRIMLOOP_ASSERT(order >= 0, "the order of a derivative is not negative");
  const std::size_t n = index(order) + 1;
  std::vector<std::vector<Hpoint>> out(n * n);
  Net along_u{s.degree_u(), s.poles_v(), s.knots_u(), s.poles()};
  for (int k = 0; k <= std::min(order, s.degree_u()); ++k) {
    if (k > 0) along_u = difference(along_u);
    Net along_v = transposed(along_u, s.degree_v(), s.knots_v());
    for (int l = 0; k + l <= order && l <= s.degree_v(); ++l) {
      if (l > 0) along_v = difference(along_v);
      out[index(k) * n + index(l)] = transposed(along_v, 1, {}).poles;
    }
  }
  return out;
}

std::vector<Vector> derivatives_by_poles(const NurbsCurve& c, double t, int order) {
  const std::vector<std::vector<Hpoint>> poles = derivative_poles(c, order);
  const Place at = place(c.knots(), c.degree(), c.poles().size(), t);
  std::vector<Hpoint> a(poles.size(), Hpoint{0, 0, 0, 0});
  for (std::size_t k = 0; k < a.size() && k <= index(c.degree()); ++k)
    a[k] = value_of(poles[k], index(c.degree()), k, c.knots().data() + at.span, at.span, at.t);
  return quotient(a, c.is_rational());
}

std::vector<Vector> derivatives(const NurbsSurface& s, Uv uv, int order) {
  return derivatives(s, uv, order, Side::Right, Side::Right);
}

std::vector<Vector> derivatives_by_poles(const NurbsSurface& s, Uv uv, int order) {
  const std::vector<std::vector<Hpoint>> nets = derivative_poles(s, order);
  const Place u = place(s.knots_u(), s.degree_u(), s.poles_u(), uv.u);
  const Place v = place(s.knots_v(), s.degree_v(), s.poles_v(), uv.v);
  const std::size_t n = index(order) + 1, p = index(s.degree_u()), q = index(s.degree_v());
  std::vector<Hpoint> a(n * n, Hpoint{0, 0, 0, 0});
  for (std::size_t k = 0; k < n && k <= p; ++k)
    for (std::size_t l = 0; k + l < n && l <= q; ++l) {
      const std::vector<Hpoint>& net = nets[k * n + l];
      const std::size_t columns = s.poles_v() - l;
      std::vector<Hpoint> column(s.poles_u() - k);
      for (std::size_t i = u.span - p; i <= u.span - k; ++i) {
        const auto row = net.begin() + static_cast<std::ptrdiff_t>(i * columns);
        column[i] =
            value_of({row, row + static_cast<std::ptrdiff_t>(columns)}, q, l, s.knots_v().data() + v.span, v.span, v.t);
      }
      a[k * n + l] = value_of(column, p, k, s.knots_u().data() + u.span, u.span, u.t);
    }
  return quotient2(a, n, s.is_rational());
}

std::vector<Vector> derivatives(const NurbsCurve& c, double t, int order, Side side) {
  TRIMLOOP_ASSERT(order >= 0, "the order of a derivative is not negative");
  return derivatives_at(c, place(c.knots(), c.degree(), c.poles().size(), t, side), order);
}

std::vector<Vector> derivatives(const NurbsSurface& s, Uv uv, int order, Side u, Side v) {
  TRIMLOOP_ASSERT(order >= 0, "the order of a derivative is not negative");
  return derivatives_at(s, place(s.knots_u(), s.degree_u(), s.poles_u(), uv.u, u),
                        place(s.knots_v(), s.degree_v(), s.poles_v(), uv.v, v), order);
}

}  // namespace trimloop
