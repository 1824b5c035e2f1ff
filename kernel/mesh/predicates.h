#pragma once
// Exact signs of 2D determinants for all finite doubles, from the smallest subnormal to the largest: a rounding-error
// filter first (inline), then pairs of doubles, then the expansions of Shewchuk, "Adaptive Precision Floating-Point
// Arithmetic and Fast Robust Geometric Predicates" (1997), then, for magnitudes too far apart for these, whole numbers.
// Only the sign of a returned value is promised. Build without fast-math and without x87 arithmetic.

#include "kernel/math/vec.h"

namespace trimloop::mesh {

namespace detail {
double orient2d_exact(Uv a, Uv b, Uv c);
double incircle_exact(Uv a, Uv b, Uv c, Uv d);
}  // namespace detail

// > 0: a, b, c counter-clockwise; 0: exactly collinear.
inline double orient2d(Uv a, Uv b, Uv c) {
  const double left = (a.u - c.u) * (b.v - c.v);
  const double right = (a.v - c.v) * (b.u - c.u);
  const double det = left - right;
  // (3 + 16 eps) eps of the paper's table; the second term covers underflow, and an overflow makes the bound infinite.
  const double bound = 3.3306690738754716e-16 * (std::abs(left) + std::abs(right)) + 0x1p-1000;
  return det > bound || -det > bound ? det : detail::orient2d_exact(a, b, c);
}

// > 0: d inside the circle through a, b, c (counter-clockwise); 0: exactly cocircular.
inline double incircle(Uv a, Uv b, Uv c, Uv d) {
  const double adx = a.u - d.u, ady = a.v - d.v;
  const double bdx = b.u - d.u, bdy = b.v - d.v;
  const double cdx = c.u - d.u, cdy = c.v - d.v;
  const double bc = bdx * cdy, cb = cdx * bdy;
  const double ca = cdx * ady, ac = adx * cdy;
  const double ab = adx * bdy, ba = bdx * ady;
  const double alift = adx * adx + ady * ady;
  const double blift = bdx * bdx + bdy * bdy;
  const double clift = cdx * cdx + cdy * cdy;
  const double det = alift * (bc - cb) + blift * (ca - ac) + clift * (ab - ba);
  const double permanent = alift * (std::abs(bc) + std::abs(cb)) + blift * (std::abs(ca) + std::abs(ac)) +
                           clift * (std::abs(ab) + std::abs(ba));
  // (10 + 96 eps) eps; underflow adds at most 2^-1070 (1 + the lifts), hence the second term and the last condition.
  const double bound = 1.1102230246251577e-15 * permanent + 0x1p-860;
  const bool certain = (det > bound || -det > bound) && alift + blift + clift < 0x1p200;
  return certain ? det : detail::incircle_exact(a, b, c, d);
}

// Where segments ab and cd cross, rounded; inside the boxes of both. They must cross (exactly) in one inner point.
// Swapping ends or segments gives the same point. Error: a few units in the last place of the
// largest coordinate of the shorter segment.
Uv crossing_point(Uv a, Uv b, Uv c, Uv d);

}  // namespace trimloop::mesh
