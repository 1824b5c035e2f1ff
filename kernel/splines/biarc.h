#pragma once
// Chains of circular arcs with common tangents (seed 002 §1; Bolton 1975, "Biarc curves"; in space, each arc in a plane
// of its own): what a cutter or a shipyard's bending machine follows, and IGES 100/102 say exactly.

#include <span>

#include "kernel/geometry/curve.h"

namespace trimloop {

// Two arcs (or segments) from a with direction `ta` to b with direction `tb`; equal distances to the tangents' control
// points. InvalidArgument when the ends coincide or a direction is zero.
Result<std::vector<Curve>> biarc(Point a, Vector ta, Point b, Vector tb);

// Through the points, one biarc between two of them, directions by the circle through each three (the ends' from their
// own circle). A line where three points are in line.
Result<Curve> biarcs_through(std::span<const Point> points);

struct BiarcChain {
  Curve curve;           // composite of arcs and segments, tangent continuous
  std::size_t arcs = 0;
  double bound = 0;      // the curve and the chain are nowhere further apart (both ways)
};
// The curve within the tolerance: halved where a biarc is too far away. The bound holds: distances at parameters in
// between, plus what second derivatives allow between those (linear interpolation error). NoConvergence with the bound
// reached when `most_arcs` do not suffice; Degenerate where the curve stands still.
Result<BiarcChain> biarcs_along(const NurbsCurve&, double tolerance_mm, std::size_t most_arcs = 20'000);

}  // namespace trimloop
