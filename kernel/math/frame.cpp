#include "kernel/math/vec.h"

namespace trimloop {

Frame make_frame(Point origin, Vector axis, Vector reference) {
  Frame f;
  f.origin = origin;
  f.z = normalized(axis);
  if (norm(f.z) == 0) f.z = {0, 0, 1};
  Vector x = reference - dot(reference, f.z) * f.z;
  if (!(norm(x) > 1e-12 * norm(reference)) || norm(reference) == 0) {
    // The coordinate direction least along the axis, made orthogonal.
    const Vector a{std::abs(f.z.x), std::abs(f.z.y), std::abs(f.z.z)};
    const Vector pick = a.x <= a.y && a.x <= a.z ? Vector{1, 0, 0} : a.y <= a.z ? Vector{0, 1, 0} : Vector{0, 0, 1};
    x = pick - dot(pick, f.z) * f.z;
  }
  f.x = normalized(x);
  f.y = cross(f.z, f.x);
  return f;
}

}  // namespace trimloop
