#pragma once
// Points together with a bound on their rounding error that holds.
//
// With u = 2^-53, every column of the basis recursion is off by at most 8 u in the sum of absolute values (three
// roundings of the share, which go to one function and come from the other, and those of products and sums), so that
// degree p gives 8 p u; the sum over p + 1 poles adds (p + 1) u; the quotient follows by the triangle inequality.
// N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., chapter 3, for the calculus.

#include "kernel/nurbs/surface.h"

namespace trimloop {

struct BoundedPoint {
  Point point;       // the bits of evaluate()
  double error = 0;  // of each coordinate, at most; infinite where the weight may be zero
};
BoundedPoint evaluate_bounded(const NurbsCurve&, double t);
BoundedPoint evaluate_bounded(const NurbsSurface&, Uv);

}  // namespace trimloop
