#pragma once
// Small helpers on homogeneous points (not part of the public face).

#include "kernel/math/transform.h"
#include "kernel/nurbs/curve.h"

namespace trimloop::detail {

// A sum of multiples of poles, in two registers of two numbers: half the instructions of plain scalars, the same bits.
struct Sum {
  typedef double Pair __attribute__((vector_size(16)));
  Pair xy{0, 0}, zw{0, 0};
  Sum() = default;
  explicit Sum(const Hpoint& h) : xy{h.x, h.y}, zw{h.z, h.w} {}
  void add(double s, const Sum& h) {
    xy += Pair{s, s} * h.xy;
    zw += Pair{s, s} * h.zw;
  }
  Hpoint point() const { return {xy[0], xy[1], zw[0], zw[1]}; }
};

inline Vector xyz(const Hpoint& h) { return {h.x, h.y, h.z}; }

// The point of a value: a polynomial's weight is one, whatever its sum came to.
inline Point to_point(const Hpoint& h, bool rational) { return rational ? project(h) : Point{h.x, h.y, h.z}; }

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
