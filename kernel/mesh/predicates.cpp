#include "kernel/mesh/predicates.h"

#include <array>
#include <utility>

#include "kernel/mesh/expansion.h"
#include "kernel/mesh/scaled_integers.h"
#include "kernel/mesh/wide_integer.h"

// Behind the inline filter the same formula is evaluated again, each time by an arithmetic that can do more:
//   64-bit integers, exact, when the differences of the coordinates are whole multiples of one power of two, as they
//   mostly are where neighbours lie close together compared with their distance from the origin;
//   pairs of doubles, about 104 bits, which decides nearly all that is not an exact tie;
//   expansions, which are exact as long as products neither over- nor underflow: coordinates of 2^-190..2^190 are ample
//   for degree four, others are brought there by a power of two;
//   whole numbers of any length, when the coordinates of one call do not fit into that range together.

namespace trimloop::mesh {
namespace {

// Degree 2: the cross product of two differences.
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

// The same with every term counted positive: what rounding errors are measured by.
struct Magnitude {
  double value;
  explicit Magnitude(Two x) : value(std::abs(x.hi)) {}
  explicit Magnitude(double x) : value(x) {}
  friend Magnitude operator*(Magnitude a, Magnitude b) { return Magnitude(a.value * b.value); }
  friend Magnitude operator+(Magnitude a, Magnitude b) { return Magnitude(a.value + b.value); }
  friend Magnitude operator-(Magnitude a, Magnitude b) { return Magnitude(a.value + b.value); }
};
// An operation on pairs errs by less than 2^-102 of the magnitude of its operands (Joldes, Muller, Popescu, "Tight and
// rigorous error bounds for basic building blocks of double-word arithmetic", 2017); the formulas are seven deep.
constexpr double pair_error = 0x1p-96;

double orient2d_adapt(Uv a, Uv b, Uv c) {
  const Two ax = two_diff(a.u, c.u), ay = two_diff(a.v, c.v);
  const Two bx = two_diff(b.u, c.u), by = two_diff(b.v, c.v);
  if (ax.lo == 0 && ay.lo == 0 && bx.lo == 0 && by.lo == 0) {
    if (const ScaledIntegers<4> w({ax.hi, ay.hi, bx.hi, by.hi}); w.exact) return cross_sign(w[0], w[1], w[2], w[3]);
    return cross_of(expand(ax.hi), expand(ay.hi), expand(bx.hi), expand(by.hi)).sign();
  }
  const double det = cross_of(ax, ay, bx, by).hi;
  const double size = cross_of(Magnitude(ax), Magnitude(ay), Magnitude(bx), Magnitude(by)).value;
  if (std::abs(det) > pair_error * size) return det;
  return cross_of(expand(ax), expand(ay), expand(bx), expand(by)).sign();
}

// Whether four numbers are two and two equal.
bool are_paired(double a, double b, double c, double d) {
  return (a == b && c == d) || (a == c && b == d) || (a == d && b == c);
}

double incircle_adapt(Uv a, Uv b, Uv c, Uv d) {
  // The corners of an upright rectangle, the commonest tie by far: any grid is full of it.
  if (are_paired(a.u, b.u, c.u, d.u) && are_paired(a.v, b.v, c.v, d.v)) return 0;
  const Two ax = two_diff(a.u, d.u), ay = two_diff(a.v, d.v);
  const Two bx = two_diff(b.u, d.u), by = two_diff(b.v, d.v);
  const Two cx = two_diff(c.u, d.u), cy = two_diff(c.v, d.v);
  const bool no_tails = ax.lo == 0 && ay.lo == 0 && bx.lo == 0 && by.lo == 0 && cx.lo == 0 && cy.lo == 0;
  if (no_tails) {
    const ScaledIntegers<6> w({ax.hi, ay.hi, bx.hi, by.hi, cx.hi, cy.hi});
    if (w.exact) return lifted_sign(w[0], w[1], w[2], w[3], w[4], w[5]);
  }
  const double det = lifted(ax, ay, bx, by, cx, cy).hi;
  const double size =
      lifted(Magnitude(ax), Magnitude(ay), Magnitude(bx), Magnitude(by), Magnitude(cx), Magnitude(cy)).value;
  if (std::abs(det) > pair_error * size) return det;
  if (no_tails) {
    return lifted(expand(ax.hi), expand(ay.hi), expand(bx.hi), expand(by.hi), expand(cx.hi), expand(cy.hi)).sign();
  }
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
  const auto length = [](Uv p, Uv q) { return std::max(q.u / 2 - p.u / 2, std::abs(q.v / 2 - p.v / 2)); };
  const double ab = length(a, b), cd = length(c, d);
  if (cd < ab || (cd == ab && before(c, a))) std::swap(a, c), std::swap(b, d);
  // 2. The share of the shorter segment that lies before the other one. Scaled, so that no product leaves the range of
  // doubles; what becomes subnormal by that is too small to matter.
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
