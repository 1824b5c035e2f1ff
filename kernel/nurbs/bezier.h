#pragma once
// Bezier and power form of one polynomial piece on [0, 1], any degree, homogeneous. The NURBS Book, 2nd ed., chapter 1
// and section 6.6. A net of (n + 1) x (m + 1) points has point (i, j) at [i * (m + 1) + j], i along u.

#include <span>
#include <vector>

#include "kernel/nurbs/surface.h"

namespace trimloop {

Hpoint horner(std::span<const Hpoint> coefficients, double t);                 // A1.1; ascending powers
Hpoint horner(std::span<const Hpoint> coefficients, std::size_t columns, Uv);  // A1.6
double bernstein(int degree, int i, double t);                                 // A1.2
std::vector<double> all_bernstein(int degree, double t);                       // A1.3
Hpoint bezier_point(std::span<const Hpoint> poles, double t);                  // A1.4
Hpoint de_casteljau(std::span<const Hpoint> poles, double t);                  // A1.5
Hpoint de_casteljau(std::span<const Hpoint> poles, std::size_t columns, Uv);   // A1.7

// Point and derivative of a rational Bezier curve over [0, 1] from the last two points a, b of de Casteljau's scheme:
// C' = n (w_a w_b / w^2) (B - A). Holds with weights of any sign, and with ideal points through their homogeneous form.
struct BezierTangent {
  Point point;
  Vector derivative;
};
BezierTangent bezier_tangent(std::span<const Hpoint> poles, double t);

// Sections 6.6: coefficient j is binomial(n, j) times the j-th forward difference of the poles. The power form at one
// end of a piece loses digits with the degree (at degree 25 about 1e-8 of the size of the poles): keep it below 10.
std::vector<Hpoint> bezier_to_power(std::span<const Hpoint> poles);
std::vector<Hpoint> power_to_bezier(std::span<const Hpoint> coefficients);  // exact sums of like binomials
std::vector<Hpoint> bezier_to_power(std::span<const Hpoint> poles, std::size_t columns);
std::vector<Hpoint> power_to_bezier(std::span<const Hpoint> coefficients, std::size_t columns);

// A spline as powers of (t - breaks[i]) on each of its pieces, and back. Pieces that do not meet are joined at their
// mean, half of the largest gap (homogeneous, per coordinate) being moved.
struct PowerForm {
  std::vector<double> breaks;
  std::vector<std::vector<Hpoint>> pieces;  // ascending powers, degree + 1 of them
};
PowerForm to_power(const NurbsCurve&);
struct FromPower {
  NurbsCurve curve;
  double largest_gap = 0;
};
Result<FromPower> from_power(const PowerForm&);

}  // namespace trimloop
