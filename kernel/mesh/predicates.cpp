#include "kernel/mesh/predicates.h"

#include <array>
#include <utility>

#include "kernel/mesh/expansion.h"
#include "kernel/mesh/wide_integer.h"

// The stages below the inline filter, in the paper's letters:
//   B  the determinant of the rounded differences, exactly;
//   C  B plus the first-order effect of what the differences lost;
//   D  everything, exactly.
// All of them need products free of over- and underflow: 2^-190..2^190 is ample for degree four. Coordinates outside
// are brought there by a power of two, or, when they do not fit together, become whole numbers.

namespace trimloop::mesh {
namespace {

constexpr double eps = 0x1p-53;

// Degree 2: terms of the cross product of two differences. T is an Expansion or a WideInteger.
template <class T>
auto cross_of(const T& ax, const T& ay, const T& bx, const T& by) {
  return ax * by - ay * bx;
}
// Degree 4: the lifted determinant of three differences.
template <class T>
auto lifted(const T& ax, const T& ay, const T& bx, const T& by, const T& cx, const T& cy) {
  return (ax * ax + ay * ay) * cross_of(bx, by, cx, cy) + (bx * bx + by * by) * cross_of(cx, cy, ax, ay) +
         (cx * cx + cy * cy) * cross_of(ax, ay, bx, by);
}

double orient2d_adapt(Uv a, Uv b, Uv c) {
  const Two ax = two_diff(a.u, c.u), ay = two_diff(a.v, c.v);
  const Two bx = two_diff(b.u, c.u), by = two_diff(b.v, c.v);
  const double size = std::abs(ax.hi * by.hi) + std::abs(ay.hi * bx.hi);

  const auto rounded = cross_of(expand(ax.hi), expand(ay.hi), expand(bx.hi), expand(by.hi));
  if (ax.lo == 0 && ay.lo == 0 && bx.lo == 0 && by.lo == 0) return rounded.sign();
  double det = rounded.estimate();
  if (std::abs(det) >= (2 + 12 * eps) * eps * size) return det;

  const double bound = (9 + 64 * eps) * eps * eps * size + (3 + 8 * eps) * eps * std::abs(det);
  det += (ax.hi * by.lo + by.hi * ax.lo) - (ay.hi * bx.lo + bx.hi * ay.lo);
  if (std::abs(det) >= bound && bound > 0) return det;

  return cross_of(expand(ax), expand(ay), expand(bx), expand(by)).sign();
}

double incircle_adapt(Uv a, Uv b, Uv c, Uv d) {
  const Two ax = two_diff(a.u, d.u), ay = two_diff(a.v, d.v);
  const Two bx = two_diff(b.u, d.u), by = two_diff(b.v, d.v);
  const Two cx = two_diff(c.u, d.u), cy = two_diff(c.v, d.v);
  const auto size_of = [](Two px, Two py, Two qx, Two qy) { return std::abs(px.hi * qy.hi) + std::abs(qx.hi * py.hi); };
  const auto lift_of = [](Two px, Two py) { return px.hi * px.hi + py.hi * py.hi; };
  const double size = lift_of(ax, ay) * size_of(bx, by, cx, cy) + lift_of(bx, by) * size_of(cx, cy, ax, ay) +
                      lift_of(cx, cy) * size_of(ax, ay, bx, by);

  const auto rounded = lifted(expand(ax.hi), expand(ay.hi), expand(bx.hi), expand(by.hi), expand(cx.hi), expand(cy.hi));
  if (ax.lo == 0 && ay.lo == 0 && bx.lo == 0 && by.lo == 0 && cx.lo == 0 && cy.lo == 0) return rounded.sign();
  double det = rounded.estimate();
  if (std::abs(det) >= (4 + 48 * eps) * eps * size) return det;

  // d(lift(p) * (q x r)) to first order in the tails.
  const auto first_order = [&](Two px, Two py, Two qx, Two qy, Two rx, Two ry) {
    const double cross_change = (qx.hi * ry.lo + ry.hi * qx.lo) - (qy.hi * rx.lo + rx.hi * qy.lo);
    const double lift_change = 2 * (px.hi * px.lo + py.hi * py.lo);
    return lift_of(px, py) * cross_change + lift_change * (qx.hi * ry.hi - qy.hi * rx.hi);
  };
  const double bound = (44 + 576 * eps) * eps * eps * size + (3 + 8 * eps) * eps * std::abs(det);
  det +=
      first_order(ax, ay, bx, by, cx, cy) + first_order(bx, by, cx, cy, ax, ay) + first_order(cx, cy, ax, ay, bx, by);
  if (std::abs(det) >= bound && bound > 0) return det;

  return lifted(expand(ax), expand(ay), expand(bx), expand(by), expand(cx), expand(cy)).sign();
}

// The magnitudes that occur among some coordinates.
struct Span {
  double smallest = infinity, largest = 0;  // smallest: not zero
};
template <std::size_t N>
Span span_of(const std::array<Uv, N>& points) {
  Span s;
  for (Uv p : points) {
    for (double x : {std::abs(p.u), std::abs(p.v)}) {
      s.largest = std::max(s.largest, x);
      if (x > 0) s.smallest = std::min(s.smallest, x);
    }
  }
  return s;
}
bool is_safe(Span s) { return s.smallest > 0x1p-190 && s.largest < 0x1p190; }

template <std::size_t N>
void shift(std::array<Uv, N>& points, int exponent) {
  for (Uv& p : points) p = {std::ldexp(p.u, exponent), std::ldexp(p.v, exponent)};
}

template <std::size_t N>
std::array<WideInteger, 2 * N> whole(const std::array<Uv, N>& points) {
  std::array<WideInteger, 2 * N> out;
  for (std::size_t i = 0; i < N; ++i) {
    out[2 * i] = WideInteger::from(points[i].u, 1074);
    out[2 * i + 1] = WideInteger::from(points[i].v, 1074);
  }
  return out;
}

}  // namespace

namespace detail {

double orient2d_exact(Uv a, Uv b, Uv c) {
  std::array<Uv, 3> p{a, b, c};
  const Span span = span_of(p);
  if (is_safe(span)) return orient2d_adapt(a, b, c);
  if (span.largest == 0) return 0;
  const int up = -std::ilogb(span.largest);
  if (std::ldexp(span.smallest, up) > 0x1p-190) {
    shift(p, up);
    return orient2d(p[0], p[1], p[2]);
  }
  const auto w = whole(p);
  return cross_of(w[0] - w[4], w[1] - w[5], w[2] - w[4], w[3] - w[5]).sign();
}

double incircle_exact(Uv a, Uv b, Uv c, Uv d) {
  std::array<Uv, 4> p{a, b, c, d};
  const Span span = span_of(p);
  if (is_safe(span)) return incircle_adapt(a, b, c, d);
  if (span.largest == 0) return 0;
  const int up = -std::ilogb(span.largest);
  if (std::ldexp(span.smallest, up) > 0x1p-190) {
    shift(p, up);
    return incircle(p[0], p[1], p[2], p[3]);
  }
  const auto w = whole(p);
  return lifted(w[0] - w[6], w[1] - w[7], w[2] - w[6], w[3] - w[7], w[4] - w[6], w[5] - w[7]).sign();
}

}  // namespace detail

namespace {

// Twice the area of abc with a relative error of a few eps, whatever cancels.
double area2(Uv a, Uv b, Uv c) {
  const auto diff = [](double x, double y) { return expand(two_diff(x, y)); };
  return cross_of(diff(a.u, c.u), diff(a.v, c.v), diff(b.u, c.u), diff(b.v, c.v)).estimate();
}

bool before(Uv a, Uv b) { return a.u != b.u ? a.u < b.u : a.v < b.v; }

double clamp_between(double x, double p, double q, double r, double s) {
  const double lo = std::max(std::min(p, q), std::min(r, s));
  const double hi = std::min(std::max(p, q), std::max(r, s));
  return std::min(std::max(x, lo), hi);
}

}  // namespace

Uv crossing_point(Uv a, Uv b, Uv c, Uv d) {
  // 1. One order for all ways to say the same.
  if (before(b, a)) std::swap(a, b);
  if (before(d, c)) std::swap(c, d);
  if (before(c, a)) std::swap(a, c), std::swap(b, d);
  // 2. The share of ab that lies before cd. Scaled, so that no product leaves the range of doubles; what becomes
  // subnormal by that is too small to matter.
  std::array<Uv, 4> p{a, b, c, d};
  const double largest = span_of(p).largest;
  shift(p, largest > 0 ? -std::ilogb(largest) : 0);
  const double at_a = std::abs(area2(p[2], p[3], p[0])), at_b = std::abs(area2(p[2], p[3], p[1]));
  double t = at_a / (at_a + at_b);
  if (!(t >= 0 && t <= 1)) t = 0.5;
  // 3. From the nearer end, to lose least.
  const auto along = [t](double x, double y) {
    return t <= 0.5 ? x + (y * t - x * t) : y + (x * (1 - t) - y * (1 - t));
  };
  return {clamp_between(along(a.u, b.u), a.u, b.u, c.u, d.u), clamp_between(along(a.v, b.v), a.v, b.v, c.v, d.v)};
}

}  // namespace trimloop::mesh
