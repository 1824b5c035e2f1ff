#pragma once
// Angles and distances the mesher measures by.

#include "kernel/math/vec.h"

namespace trimloop::mesh {

inline double angle_between(Vector a, Vector b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

inline double distance_to_segment(Point p, Point a, Point b) {
  const Vector d = b - a;
  const double length2 = dot(d, d);
  const double s = length2 > 0 ? std::clamp(dot(p - a, d) / length2, 0.0, 1.0) : 0.0;
  return distance(p, a + s * d);
}

}  // namespace trimloop::mesh
