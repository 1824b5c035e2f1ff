#pragma once
// Degree reduction with the error it costs (The NURBS Book, 2nd ed., section 5.6, A5.11, in one step for the whole
// spline). The poles of the reduced spline, elevated again, are the least-squares best to those of the given one, with
// the clamped ends (and `end_order` derivatives there) kept. For one piece that is the best approximation in the L2
// norm: D. Lutterkort, J. Peters and U. Reif, "Polynomial degree reduction in the L2-norm equals best Euclidean
// approximation of Bezier coefficients", CAGD 16 (1999).

#include "kernel/nurbs/surface.h"

namespace trimloop {

struct Reduction {
  NurbsCurve curve;
  double error = 0;  // bound on the distance at equal parameters, rounding included (kernel/nurbs/deviation.h)
};
// Clamped, degree - by >= 1. Inner knots of multiplicity m come back with max(1, m - 1) each time, so that elevation
// and reduction undo each other. InvalidArgument when the degree does not allow it.
Result<Reduction> reduce(const NurbsCurve&, int by = 1, int end_order = 0);
// The lowest degree within the tolerance; the curve itself when that is its own.
Reduction reduce_within(const NurbsCurve&, double tolerance);

struct SurfaceReduction {
  NurbsSurface surface;
  double error = 0;
};
Result<SurfaceReduction> reduce(const NurbsSurface&, int by_u, int by_v);

}  // namespace trimloop
