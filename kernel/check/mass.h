#pragma once
// Centroid and second moments of solids, sheets and curves, with the estimated error of the quadrature. Density one.

#include <array>

#include "kernel/check/measure.h"

namespace trimloop {

// Second moments about a point: integral of x x, y y, z z, x y, y z, z x.
struct SecondMoments {
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;
};
struct MassProperties {
  double measure = 0;  // mm^3, mm^2 or mm
  Point centroid;
  SecondMoments moments;                           // about the centroid, mm^2 times the measure's unit
  std::array<std::array<double, 3>, 3> inertia{};  // tensor: trace(moments) 1 - moments
  std::array<double, 3> principal{};               // its eigenvalues, ascending
  std::array<Vector, 3> axes{};                    // unit, right-handed, of those
  double error = 0;                                // estimated, absolute, of the measure
  double moment_error = 0;                         // of each second moment, before it was moved to the centroid
};
// Of the volume inside a closed shell. Degenerate when it is open or holds no volume.
Result<MassProperties> mass_properties(const Body&, ShellId, double relative_error = 1e-10);
// Of the area of a face. Degenerate when it has none (failed faces).
Result<MassProperties> mass_properties(const Body&, FaceId, double relative_error = 1e-10);
// Of the length of a bounded curve. Degenerate when it has none.
Result<MassProperties> mass_properties(const Curve&, double relative_error = 1e-10);

}  // namespace trimloop
