#pragma once
// Differential geometry of curves and surfaces at a parameter. M. do Carmo, Differential Geometry of Curves and
// Surfaces, sections 1.5, 3.2, 3.3.

#include "kernel/geometry/surface.h"

namespace trimloop {

struct FrenetFrame {
  Point point;
  Vector tangent, normal, binormal;  // unit; normal and binormal are zero where the curvature is
  double speed = 0;                  // |C'|
  double curvature = 0;              // 1 / mm
  double torsion = 0;                // 1 / mm; 0 where the curvature is
};
// Degenerate where the curve stands still (a cusp). At a joint: of the piece that begins there.
Result<FrenetFrame> frenet_frame(const Curve&, double t);
// Radius and centre of the osculating circle; Degenerate where the curvature is zero.
struct OsculatingCircle {
  Point centre;
  double radius = 0;
};
Result<OsculatingCircle> osculating_circle(const Curve&, double t);

struct SurfaceCurvature {
  Point point;
  Vector normal;                  // Su x Sv, unit
  double k1 = 0, k2 = 0;          // principal curvatures, k1 >= k2; positive where the surface bends towards the normal
  Vector direction1, direction2;  // unit, tangent, right-handed with the normal; any pair at an umbilic
  double gaussian = 0, mean = 0;  // k1 k2, (k1 + k2) / 2
  bool umbilic = false;           // |k1 - k2| at most 1e-9 of the larger
};
// Degenerate where Su and Sv span no plane (poles).
Result<SurfaceCurvature> curvature(const Surface&, Uv);
// Of the normal section in the tangent direction du Su + dv Sv (Euler, Meusnier): II / I.
Result<double> normal_curvature(const Surface&, Uv, Uv direction);

}  // namespace trimloop
