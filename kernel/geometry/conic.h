#pragma once
// Arc of the conic a x^2 + b xy + c y^2 + d x + e y + f = 0 in a plane z = const, found from its coefficients alone.

#include "base/result.h"
#include "kernel/geometry/curve.h"

namespace trimloop {

struct ConicCoefficients {
  double a = 0, b = 0, c = 0, d = 0, e = 0, f = 0;
};
enum class ConicKind : std::uint8_t { Ellipse, Hyperbola, Parabola };

struct ConicArc {
  Curve curve;
  ConicKind kind = ConicKind::Ellipse;
  bool canonical = true;  // centred on the origin (parabola: vertex there), axes along x and y
  double end_error = 0;   // distance of the given ends from the curve's own
};

// Ellipses run counter-clockwise about +z from `start` to `end` (equal ends: the whole ellipse); the others along their
// branch. Ends off the curve are projected. Degenerate when the equation is no conic or the ends are on two branches.
Result<ConicArc> conic_arc(const ConicCoefficients& coefficients, Point start, Point end);

}  // namespace trimloop
