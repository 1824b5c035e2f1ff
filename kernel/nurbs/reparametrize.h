#pragma once
// Reparametrizations that keep the point set: Moebius (same degree) and polynomial (degree times that of the function).
// The NURBS Book, 2nd ed., section 6.4; the affine one is reparametrized() of kernel/nurbs/curve.h.

#include "kernel/nurbs/surface.h"

namespace trimloop {

// C(t(s)) over the same domain [lo, hi], with x = (t - lo) / (hi - lo) and y likewise for s:
//   x = ratio y / (1 + (ratio - 1) y),   y = x / (x + ratio (1 - x)),   ratio > 0.
// Knots and range move by the second; pole i is multiplied by the product, over its degree knots, of 1 + (ratio - 1) y.
// InvalidArgument when the ratio is not positive and finite, or puts infinity on a knot outside the domain.
Result<NurbsCurve> moebius(const NurbsCurve&, double ratio);
double moebius_to(Interval domain, double ratio, double t);    // s of t
double moebius_from(Interval domain, double ratio, double s);  // t of s
Result<NurbsSurface> moebius(const NurbsSurface&, double ratio_u, double ratio_v);

// The same curve with end weights of one (C12): Moebius with the degree-th root of first weight / last weight, and all
// weights divided. Unsupported when an end weight is zero or the two differ in sign. Clamped first.
struct NormalizedEnds {
  NurbsCurve curve;
  double ratio = 1;  // what moebius_to and moebius_from take
};
Result<NormalizedEnds> with_end_weights_one(const NurbsCurve&);

// C(f(s)) for s over `parameters`, f the polynomial with the Bernstein ordinates `f` over it; f must ascend from one
// parameter of the domain to another. Degree(C) * degree(f), each span made of products of Bernstein polynomials; knots
// where f meets those of C. Limit above degree 64.
Result<NurbsCurve> composed(const NurbsCurve&, std::span<const double> f, Interval parameters);
// t = s^2: C(s^2) for s in [sqrt lo, sqrt hi] of the range, which must not be negative.
Result<NurbsCurve> composed_with_square(const NurbsCurve&);

}  // namespace trimloop
