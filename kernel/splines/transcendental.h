#pragma once
// Curves that no NURBS can be (seed 000 §0), as cubic splines with a proven bound. A cubic that has position and
// derivative of C at both ends of a step h is off by at most h^4 / 384 max |C''''| (P. J. Davis, Interpolation and
// Approximation, on the remainder of Hermite interpolation; its kernel has one sign, so the bound holds for the vector's
// length). Steps follow the local size of C''''.

#include <functional>

#include "kernel/math/vec.h"
#include "kernel/nurbs/curve.h"

namespace trimloop {

struct BoundedCurve {
  NurbsCurve curve;  // over the curve's own parameter, C1, double knots
  double bound = 0;  // at no parameter is it farther from the true curve; rounding included
};

// A curve by its point and derivative at t, and a bound on |C''''| over an interval.
struct SmoothCurve {
  std::function<Point(double t)> point;
  std::function<Vector(double t)> derivative;
  std::function<double(Interval)> fourth;
};
// Limit when more than `most_pieces` would be needed or a value is not finite.
Result<BoundedCurve> hermite_within(const SmoothCurve&, Interval range, double tolerance, std::size_t most_pieces = 1'000'000);

// Families in the plane z = 0 of a frame; t as given. All of them by closed forms of C'''' with
// e(t) = (cos t, sin t), i turning it by a quarter.
SmoothCurve helix(const Frame&, double radius, double pitch);                       // radius e(t), z = pitch t / 2 pi
SmoothCurve sine_wave(const Frame&, double amplitude, double wavelength);           // (t, a sin(2 pi t / l))
SmoothCurve catenary(const Frame&, double parameter);                               // (t, a cosh(t / a))
SmoothCurve trochoid(const Frame&, double radius, double arm);                      // (r t - d sin t, r - d cos t); d = r: cycloid
SmoothCurve archimedean_spiral(const Frame&, double start, double growth);          // (start + growth t / 2 pi) e(t)
SmoothCurve logarithmic_spiral(const Frame&, double start, double factor_per_turn); // start factor^(t / 2 pi) e(t)
SmoothCurve involute(const Frame&, double radius);                                  // radius (e(t) - t i e(t))

}  // namespace trimloop
