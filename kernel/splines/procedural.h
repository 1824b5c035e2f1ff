#pragma once
// Curves by procedure, at a level, with the distance to their limit (seed 000 §0).

#include <span>
#include <vector>

#include "base/result.h"
#include "kernel/math/vec.h"

namespace trimloop {

struct LevelPolygon {
  std::vector<Point> points;  // closed polygons do not repeat the first point
  double bound = 0;           // the limit curve and this polygon are nowhere further apart than this (both ways)
};

// Corner cutting: each round replaces a side by its part between `ratio` and 1 - ratio, 0 < ratio < 1/2. An open
// polygon keeps its two ends. At 1/4 the limit is the uniform quadratic B-spline (Chaikin 1974, Riesenfeld 1975); the
// seed's picture has 1/3. At most `most_points` points (ErrorCode::Limit).
Result<LevelPolygon> cut_corners(std::span<const Point> polygon, bool closed, double ratio, int rounds,
                                 std::size_t most_points = 10'000'000);

// Koch's curve: each round raises an equilateral triangle over the middle third of every side, to the left of the
// plane's z axis. `polygon` lies in a plane z = const.
Result<LevelPolygon> koch(std::span<const Point> polygon, bool closed, int rounds, std::size_t most_points = 10'000'000);

}  // namespace trimloop
