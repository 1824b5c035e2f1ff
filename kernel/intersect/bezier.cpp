#include "kernel/intersect/bezier.h"

#include <fmt/format.h>

#include "kernel/nurbs/homogeneous.h"

namespace trimloop::detail {
namespace {

constexpr double half_ulp = std::numeric_limits<double>::epsilon() / 2;

double largest_coordinate(const std::vector<Hpoint>& net) {
  double most = 0;
  for (const Hpoint& h : net) most = std::max({most, std::abs(h.x), std::abs(h.y), std::abs(h.z)});
  return most;
}

// Weights scaled by a power of two, which rounds nothing; the origin moved.
Result<void> settle(Bezier& b, Point origin) {
  double most = 0;
  for (const Hpoint& h : b.net) {
    if (!(h.w > 0))
      return fail(ErrorCode::Unsupported,
                  fmt::format("a weight of {} has no bounded hull; split or elevate the spline first", h.w), h.w, 0.0);
    most = std::max(most, h.w);
  }
  int exponent = 0;
  std::frexp(most, &exponent);
  const double scale = b.rational ? std::ldexp(1.0, -exponent) : 1;
  for (Hpoint& h : b.net) {
    h = scale * h;
    h.x -= h.w * origin.x;
    h.y -= h.w * origin.y;
    h.z -= h.w * origin.z;
  }
  // The move itself rounds at the size of the origin.
  const double steps = (8.0 * (b.degree_u + b.degree_v) + 32) * half_ulp;
  b.noise = steps * (largest_coordinate(b.net) + norm(to_vector(origin)));
  b.weight_noise = steps;
  return {};
}

// De Casteljau on rows of `width` points with `stride` between the points of one polygon, in place.
// keep_left: the part [0, t]; else [t, 1].
void cut(Hpoint* p, std::size_t degree, std::size_t stride, double t, bool keep_left) {
  const double s = 1 - t;
  if (keep_left) {
    for (std::size_t level = 1; level <= degree; ++level)
      for (std::size_t i = degree; i >= level; --i) p[i * stride] = s * p[(i - 1) * stride] + t * p[i * stride];
  } else {
    for (std::size_t level = 1; level <= degree; ++level)
      for (std::size_t i = 0; i + level <= degree; ++i) p[i * stride] = s * p[i * stride] + t * p[(i + 1) * stride];
  }
}

void restrict_polygon(Hpoint* p, std::size_t degree, std::size_t stride, Interval to) {
  if (to.lo == 0 && to.hi == 1) return;
  if (to.hi >= 1 - to.lo) {  // the cut nearer to its end first: the second one stays well inside
    if (to.hi != 1) cut(p, degree, stride, to.hi, true);
    if (to.lo != 0) cut(p, degree, stride, to.lo / to.hi, false);
  } else {
    if (to.lo != 0) cut(p, degree, stride, to.lo, false);
    if (to.hi != 1) cut(p, degree, stride, (to.hi - to.lo) / (1 - to.lo), true);
  }
}

// Bernstein polynomials of one degree with two derivatives.
struct Bernstein {
  std::array<double, 65> n, d1, d2;  // the first p + 1 of each
  Bernstein(int p, double t) {
    std::array<double, 65> lower;
    n[0] = 1;
    d1[0] = d2[0] = d2[1] = 0;
    for (int j = 1; j <= p; ++j) {
      if (j == p - 1) derive(n, j, lower);
      if (j == p) {
        derive(n, j, d1);
        if (p >= 2) derive(lower, j, d2);
      }
      double carried = 0;
      for (int i = 0; i < j; ++i) {
        const double old = n[static_cast<std::size_t>(i)];
        n[static_cast<std::size_t>(i)] = carried + (1 - t) * old;
        carried = t * old;
      }
      n[static_cast<std::size_t>(j)] = carried;
    }
  }

 private:
  // Of the `degree` polynomials of one degree less (or of their derivatives).
  static void derive(const std::array<double, 65>& b, int degree, std::array<double, 65>& d) {
    double left = 0;
    for (int i = 0; i < degree; ++i) {
      d[static_cast<std::size_t>(i)] = degree * (left - b[static_cast<std::size_t>(i)]);
      left = b[static_cast<std::size_t>(i)];
    }
    d[static_cast<std::size_t>(degree)] = degree * left;
  }
};

RangeVector spread(const Range (&r)[3]) { return {r[0], r[1], r[2]}; }

}  // namespace

Result<std::vector<Bezier>> bezier_pieces(const NurbsCurve& c, Point origin) {
  std::vector<Bezier> out;
  if (!(c.range().length() > 0)) return fail(ErrorCode::Degenerate, "a curve without span has no pieces", 0.0);
  for (const NurbsCurve& piece : trimloop::bezier_pieces(c)) {
    Bezier b{piece.degree(), 0, piece.is_rational(), piece.poles(), piece.range(), {0, 1}, 0, 0};
    if (const auto settled = settle(b, origin); !settled) return tl::unexpected<Error>(settled.error());
    out.push_back(std::move(b));
  }
  return out;
}

Result<std::vector<Bezier>> bezier_pieces(const NurbsSurface& s, Point origin) {
  std::vector<Bezier> out;
  if (!(s.range_u().length() > 0) || !(s.range_v().length() > 0))
    return fail(ErrorCode::Degenerate, "a surface without extent has no pieces", 0.0);
  const std::vector<double> us = trimloop::breaks_u(s), vs = trimloop::breaks_v(s);
  for (std::size_t i = 0; i + 1 < us.size(); ++i)
    for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
      const NurbsSurface piece = trimmed(s, {us[i], us[i + 1]}, {vs[j], vs[j + 1]});
      Bezier b{piece.degree_u(),
               piece.degree_v(),
               piece.is_rational(),
               piece.poles(),
               piece.range_u(),
               piece.range_v(),
               0,
               0};
      if (const auto settled = settle(b, origin); !settled) return tl::unexpected<Error>(settled.error());
      out.push_back(std::move(b));
    }
  return out;
}

void restrict_to(const Bezier& b, Interval u, Interval v, std::vector<Hpoint>& net) {
  net = b.net;
  const std::size_t columns = b.columns(), rows = b.rows();
  for (std::size_t j = 0; j < columns; ++j) restrict_polygon(&net[j], rows - 1, columns, u);
  if (columns > 1)
    for (std::size_t i = 0; i < rows; ++i) restrict_polygon(&net[i * columns], columns - 1, 1, v);
}

BezierJet jet(const Bezier& b, double u, double v) {
  const Bernstein bu(b.degree_u, u), bv(b.degree_v, v);
  Hpoint s{0, 0, 0, 0}, su = s, sv = s, suu = s, suv = s, svv = s;
  for (std::size_t i = 0; i < b.rows(); ++i) {
    Hpoint r{0, 0, 0, 0}, r1 = r, r2 = r;
    for (std::size_t j = 0; j < b.columns(); ++j) {
      const Hpoint& h = b.net[i * b.columns() + j];
      r = r + bv.n[j] * h;
      r1 = r1 + bv.d1[j] * h;
      r2 = r2 + bv.d2[j] * h;
    }
    s = s + bu.n[i] * r;
    su = su + bu.d1[i] * r;
    sv = sv + bu.n[i] * r1;
    suu = suu + bu.d2[i] * r;
    suv = suv + bu.d1[i] * r1;
    svv = svv + bu.n[i] * r2;
  }
  BezierJet out;
  out.point = project(s);
  const Vector p = to_vector(out.point);
  out.du = (xyz(su) - su.w * p) / s.w;
  out.dv = (xyz(sv) - sv.w * p) / s.w;
  out.duu = (xyz(suu) - 2 * su.w * out.du - suu.w * p) / s.w;
  out.duv = (xyz(suv) - su.w * out.dv - sv.w * out.du - suv.w * p) / s.w;
  out.dvv = (xyz(svv) - 2 * sv.w * out.dv - svv.w * p) / s.w;
  return out;
}

Point evaluate(const Bezier& b, double u, double v) {
  std::array<double, 65> nu, nv;
  const auto fill = [](std::array<double, 65>& n, int p, double t) {
    n[0] = 1;
    for (int j = 1; j <= p; ++j) {
      double carried = 0;
      for (int i = 0; i < j; ++i) {
        const double old = n[static_cast<std::size_t>(i)];
        n[static_cast<std::size_t>(i)] = carried + (1 - t) * old;
        carried = t * old;
      }
      n[static_cast<std::size_t>(j)] = carried;
    }
  };
  fill(nu, b.degree_u, u);
  fill(nv, b.degree_v, v);
  Hpoint sum{0, 0, 0, 0};
  for (std::size_t i = 0; i < b.rows(); ++i) {
    Hpoint row{0, 0, 0, 0};
    for (std::size_t j = 0; j < b.columns(); ++j) row = row + nv[j] * b.net[i * b.columns() + j];
    sum = sum + nu[i] * row;
  }
  return project(sum);
}

namespace {

// Hulls of finite differences of the net, moved so that `centre` is the origin: numerators and weights apart.
struct Differences {
  const Bezier& b;
  const std::vector<Hpoint>& net;
  Point centre;
  double smallest = infinity;  // weight

  Hpoint at(std::size_t i, std::size_t j) const {
    const Hpoint& h = net[i * b.columns() + j];
    return {h.x - h.w * centre.x, h.y - h.w * centre.y, h.z - h.w * centre.z, h.w};
  }
  // Difference of order (a, c) with the factors of the derivative; `weight` receives that of the weights.
  RangeVector hull(int a, int c, Range& weight) const {
    Range r[4] = {{infinity, -infinity}, {infinity, -infinity}, {infinity, -infinity}, {infinity, -infinity}};
    double factor = 1, terms = 1;
    for (int k = 0; k < a; ++k) factor *= b.degree_u - k, terms *= 2;
    for (int k = 0; k < c; ++k) factor *= b.degree_v - k, terms *= 2;
    if (factor <= 0) {
      weight = 0;
      return {};
    }
    for (std::size_t i = 0; i + a < b.rows(); ++i)
      for (std::size_t j = 0; j + c < b.columns(); ++j) {
        const Hpoint d = factor * in_v(i, j, a, c);
        const double value[4] = {d.x, d.y, d.z, d.w};
        for (int k = 0; k < 4; ++k) r[k] = trimloop::detail::hull(r[k], value[k]);
      }
    const double allowance = 2 * terms * factor * b.noise, of_weight = terms * factor * b.weight_noise;
    weight = b.rational ? outward({r[3].lo - of_weight, r[3].hi + of_weight}) : Range{a + c == 0 ? 1.0 : 0.0};
    const Range first3[3] = {r[0], r[1], r[2]};
    return widened(spread(first3), allowance);
  }
  Hpoint in_u(std::size_t i, std::size_t j, int a) const {
    if (a == 0) return at(i, j);
    if (a == 1) return at(i + 1, j) - at(i, j);
    return (at(i + 2, j) - at(i + 1, j)) - (at(i + 1, j) - at(i, j));
  }
  Hpoint in_v(std::size_t i, std::size_t j, int a, int c) const {
    if (c == 0) return in_u(i, j, a);
    if (c == 1) return in_u(i, j + 1, a) - in_u(i, j, a);
    return (in_u(i, j + 2, a) - in_u(i, j + 1, a)) - (in_u(i, j + 1, a) - in_u(i, j, a));
  }
};

}  // namespace

Enclosure enclose_points(const Bezier& b, const std::vector<Hpoint>& net) {
  Enclosure e;
  const Hpoint& middle = net[(b.rows() / 2) * b.columns() + b.columns() / 2];
  double smallest = infinity;
  for (const Hpoint& h : net) smallest = std::min(smallest, h.w);
  if (!(smallest > 2 * b.weight_noise)) return e;
  e.valid = true;
  e.centre = project(middle);
  const Differences d{b, net, e.centre};
  Range r[3] = {{infinity, -infinity}, {infinity, -infinity}, {infinity, -infinity}};
  for (std::size_t i = 0; i < b.rows(); ++i)
    for (std::size_t j = 0; j < b.columns(); ++j) {
      const Hpoint h = d.at(i, j);
      r[0] = hull(r[0], h.x / h.w), r[1] = hull(r[1], h.y / h.w), r[2] = hull(r[2], h.z / h.w);
    }
  e.offset = widened(spread(r), 2 * b.noise / smallest);
  return e;
}

void enclose_derivatives(const Bezier& b, const std::vector<Hpoint>& net, bool second, Enclosure& e) {
  if (!e.valid) return;
  const Differences d{b, net, e.centre};
  Range w, wu, wv, wuu, wuv, wvv;
  d.hull(0, 0, w);
  const RangeVector nu = d.hull(1, 0, wu), nv = d.hull(0, 1, wv);
  const RangeVector& p = e.offset;
  const auto over = [&](const RangeVector& n) { return b.rational ? n / w : n; };
  e.du = b.rational ? over(nu - wu * p) : nu;
  e.dv = b.rational ? over(nv - wv * p) : nv;
  if (!second) return;
  const RangeVector nuu = d.hull(2, 0, wuu), nuv = d.hull(1, 1, wuv), nvv = d.hull(0, 2, wvv);
  if (!b.rational) {
    e.duu = nuu, e.duv = nuv, e.dvv = nvv;
    return;
  }
  e.duu = over(nuu - Range(2) * wu * e.du - wuu * p);
  e.duv = over(nuv - wu * e.dv - wv * e.du - wuv * p);
  e.dvv = over(nvv - Range(2) * wv * e.dv - wvv * p);
}

Enclosure enclose(const Bezier& b, const std::vector<Hpoint>& net, bool second) {
  Enclosure e = enclose_points(b, net);
  enclose_derivatives(b, net, second, e);
  return e;
}

double blur(const Bezier& b) {
  double smallest = infinity;
  for (const Hpoint& h : b.net) smallest = std::min(smallest, h.w);
  return 4 * b.noise / smallest;
}

Range extent(const Bezier& b, const std::vector<Hpoint>& net, Vector direction) {
  Range r{infinity, -infinity};
  double smallest = infinity;
  for (const Hpoint& h : net) {
    r = hull(r, dot(direction, xyz(h)) / h.w);
    smallest = std::min(smallest, h.w);
  }
  if (!(smallest > 0)) return {-infinity, infinity};
  const double allowance = 4 * norm(direction) * b.noise / smallest;
  return {r.lo - allowance, r.hi + allowance};
}

Box hull(const Bezier& b, const std::vector<Hpoint>& net) {
  const Range x = extent(b, net, {1, 0, 0}), y = extent(b, net, {0, 1, 0}), z = extent(b, net, {0, 0, 1});
  return {{x.lo, y.lo, z.lo}, {x.hi, y.hi, z.hi}};
}

}  // namespace trimloop::detail
