#pragma once
// Small helpers on homogeneous points (not part of the public face).

#include "kernel/math/transform.h"
#include "kernel/nurbs/curve.h"

namespace trimloop::detail {

// sum += s * h; the weight of a polynomial is known to be 1 and is left alone.
template <bool Rational>
inline void add(Hpoint& sum, double s, const Hpoint& h) {
  sum.x += s * h.x;
  sum.y += s * h.y;
  sum.z += s * h.z;
  if constexpr (Rational) sum.w += s * h.w;
}

inline Vector xyz(const Hpoint& h) { return {h.x, h.y, h.z}; }

inline Hpoint apply(const Transform& m, const Hpoint& h) {
  const Vector v = trimloop::apply(m, xyz(h)) + h.w * m.t;
  return {v.x, v.y, v.z, h.w};
}

inline Box everything() { return {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}}; }

// Box of the projected poles, which encloses what they span; infinite when a weight is not positive.
inline Box hull_box(std::span<const Hpoint> poles) {
  Box box;
  for (const Hpoint& h : poles) {
    const Point p = project(h);
    if (!(h.w > 0) || !is_finite(p)) return everything();
    box.add(p);
  }
  return box;
}

inline Box point_box(Point p) { return is_finite(p) ? Box{p, p} : everything(); }

}  // namespace trimloop::detail
