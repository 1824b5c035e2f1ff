#pragma once
// A NURBS for any smooth map into the plane or into space, to a tolerance, with the deviation that was measured.

#include <functional>
#include <vector>

#include "kernel/geometry/surface.h"

namespace trimloop {

struct Approximation {
  Curve2 curve;          // cubic, over the same parameter as the map; knots of multiplicity 3: continuous, pieces apart
  double deviation = 0;  // largest distance at the check points (four a piece, between the fitted ones)
};

// Cubic pieces that agree with `f` in value and slope at their ends, halved until four points in between agree within
// `tolerance` (in the plane's units). `breaks` are the ends of the range and where f has corners: ascending, two or
// more. NoConvergence when `max_pieces` do not suffice; the error holds the deviation reached.
Result<Approximation> approximate(const std::function<Uv(double)>& f, const std::vector<double>& breaks,
                                  double tolerance, std::size_t max_pieces = 4096);

struct SpaceApproximation {
  Curve curve;
  double deviation = 0;
};
// The same for a map into space.
Result<SpaceApproximation> approximate_in_space(const std::function<Point(double)>& f, const std::vector<double>& breaks,
                                                double tolerance_mm, std::size_t max_pieces = 4096);

struct RuledApproximation {
  NurbsSurface surface;  // degree 3 x 1 over [0,1] x [0,1], the parameters of the ruled surface
  double deviation = 0;  // of the rails, and so of every ruling
};
// Where no rational surface matches the rulings: both rails fitted over common knots.
Result<RuledApproximation> approximate(const Ruled&, double tolerance_mm);

}  // namespace trimloop
