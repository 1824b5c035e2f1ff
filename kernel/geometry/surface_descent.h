#pragma once
// Newton's method for the nearest point of a surface, from a start and inside a rectangle.

#include "kernel/geometry/detail.h"

namespace trimloop::detail {

inline SurfaceFoot foot_at(const Surface& s, Point p, Uv uv) {
  const Point q = evaluate(s, uv);
  return {uv, q, distance(p, q)};
}
inline void keep_nearer(SurfaceFoot& best, const SurfaceFoot& other) {
  if (other.distance < best.distance) best = other;
}

// Bottom of the valley of the distance that `start` lies in. Never farther than the start, but for rounding. With
// `wrap` a surface that closes is entered again on its other side.
SurfaceFoot descend(const Surface&, Point, Uv start, const Rectangle&, int iterations, bool wrap);

// On a side where a derivative vanishes a descent sees only part of the plane: at a pole the one meridian it is on,
// beside a doubled row of poles no way inwards. A start there is moved to the best of some places around, if one is
// better.
Uv off_singular_side(const Surface&, Point, Uv start, const Rectangle&);

// Nearest point of a plane, cylinder, cone, sphere or torus; nothing for other types.
std::optional<SurfaceFoot> closest_elementary(const Surface&, Point, Interval u, Interval v);
// The same near a start: angles on its turn, a cone's nappe kept, an angle that is not defined taken over from it.
std::optional<SurfaceFoot> closest_elementary_near(const Surface&, Point, Uv start);

}  // namespace trimloop::detail
