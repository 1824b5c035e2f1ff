#pragma once
// Cubic Beta-splines with one bias and one tension (seed 004; Barsky 1981). Their segments meet with
// Q(0) = Q(1), Q'(0) = b1 Q'(1), Q''(0) = b1^2 Q''(1) + b2 Q'(1), from which the basis below follows.
// (1, 0) is the uniform cubic B-spline. As NURBS they are exact:
//   tension 0:     the control points are the poles, over knots in geometric progression with ratio b1;
//   other tension: double knots in that progression (the first derivative is continuous, the second jumps).

#include <span>

#include "kernel/nurbs/surface.h"
#include "kernel/splines/subdivision_matrix.h"

namespace trimloop {

struct BetaShape {
  double bias = 1;     // b1 > 0
  double tension = 0;  // b2; the basis exists while 2 b1^3 + 4 b1^2 + 4 b1 + b2 + 2 > 0
};

// The basis of one segment in powers of t in [0, 1]: column r belongs to control point i + r.
template <class Scalar>
Matrix<Scalar> beta_basis(const Scalar& b1, const Scalar& b2) {
  const Scalar square = b1 * b1, cube = square * b1;
  const Scalar sum = Scalar(2) * cube + Scalar(4) * square + Scalar(4) * b1 + b2 + Scalar(2);
  Matrix<Scalar> m(4);
  m(0, 0) = Scalar(2) * cube;
  m(0, 1) = b2 + Scalar(4) * (square + b1);
  m(0, 2) = Scalar(2);
  m(1, 0) = Scalar(-6) * cube;
  m(1, 1) = Scalar(6) * (cube - b1);
  m(1, 2) = Scalar(6) * b1;
  m(2, 0) = Scalar(6) * cube;
  m(2, 1) = Scalar(-3) * (b2 + Scalar(2) * (cube + square));
  m(2, 2) = Scalar(3) * (b2 + Scalar(2) * square);
  m(3, 0) = Scalar(-2) * cube;
  m(3, 1) = Scalar(2) * (b2 + cube + square + b1);
  m(3, 2) = Scalar(-2) * (b2 + square + b1 + Scalar(1));
  m(3, 3) = Scalar(2);
  for (Scalar& x : m.at) x = x / sum;
  return m;
}

// Bernstein coefficients of one segment: row k gives pole k as a combination of the four control points.
template <class Scalar>
Matrix<Scalar> beta_to_bezier(const Scalar& b1, const Scalar& b2) {
  const Matrix<Scalar> m = beta_basis(b1, b2);
  Matrix<Scalar> bezier(4);
  for (std::size_t r = 0; r < 4; ++r) {
    bezier(0, r) = m(0, r);
    bezier(1, r) = m(0, r) + m(1, r) / Scalar(3);
    bezier(2, r) = m(0, r) + (Scalar(2) * m(1, r) + m(2, r)) / Scalar(3);
    bezier(3, r) = m(0, r) + m(1, r) + m(2, r) + m(3, r);
  }
  return bezier;
}

// n >= 4 control points give n - 3 segments. The parameter starts at 0, the first segment's interval is [0, 1].
// When b1^segments leaves [1e-9, 1e9] the intervals are all 1 and the joints triple knots: same shape, geometric
// continuity only.
Result<NurbsCurve> beta_spline(std::span<const Point> points, BetaShape shape);

// rows x columns control points, point (i, j) at points[i * columns + j]; rows along u.
Result<NurbsSurface> beta_spline(std::span<const Point> points, std::size_t rows, std::size_t columns, BetaShape u,
                                 BetaShape v);

}  // namespace trimloop
