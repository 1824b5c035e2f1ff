#pragma once
// Knot removal with the error it costs. The NURBS Book, 2nd ed., section 5.4 (A5.8) and 9.4.1 (A9.8, A9.9).

#include "kernel/nurbs/surface.h"

namespace trimloop {

struct KnotRemoval {
  NurbsCurve curve;
  int removed = 0;   // how many knots went
  double error = 0;  // bound on the distance to the given curve at equal parameters; 0 when none went
};
// The bound on what removing one occurrence of the inner knot t would cost; infinite when there is none, or where
// weights are not positive. Looks at the poles around it only. A9.8.
double removal_bound(const NurbsCurve&, double t);
// Up to `times` occurrences of the inner knot t, while the bound stays within the tolerance. Each bound is found by
// inserting the knot again and comparing poles; where weights are not positive nothing can be promised or removed.
KnotRemoval remove_knot(const NurbsCurve&, double t, int times, double tolerance);
// As many knots as the tolerance allows, those of the least cost first. Over the whole knot domain.
KnotRemoval remove_knots(const NurbsCurve&, double tolerance);

struct SurfaceKnotRemoval {
  NurbsSurface surface;
  int removed = 0;
  double error = 0;
};
SurfaceKnotRemoval remove_knot_u(const NurbsSurface&, double u, int times, double tolerance);
SurfaceKnotRemoval remove_knot_v(const NurbsSurface&, double v, int times, double tolerance);
SurfaceKnotRemoval remove_knots(const NurbsSurface&, double tolerance);  // in u, then in v with what is left

}  // namespace trimloop
