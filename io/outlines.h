#pragma once
// Outlines of drawings and fonts <-> curves. One curve a subpath: cubic runs are one NURBS of degree 3 with triple knots,
// parabolas degree 2 with double knots, lines polylines, arcs circles and ellipses; a mixed subpath is a composite of
// these. Control points keep their bits under a transform that only mirrors.

#include <vector>

#include "formats/svg/path.h"
#include "kernel/geometry/curve.h"

namespace trimloop::io {

// `to_mm` maps the path's plane into space.
Result<std::vector<Curve>> curves_of(const std::vector<svg::Segment>& path, const Transform& to_mm);

// The Bézier pieces of a curve as path segments in the plane z = 0: exact for lines, parabolas, cubics and polynomial
// NURBS up to degree 3, and for circles and ellipses (arcs); other pieces are cubics within `tolerance_mm`.
struct PathOfCurve {
  std::vector<svg::Segment> path;
  double deviation_mm = 0;  // 0: exact
};
Result<PathOfCurve> path_of(const Curve&, double tolerance_mm);

}  // namespace trimloop::io
