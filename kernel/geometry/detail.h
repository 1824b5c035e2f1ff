#pragma once
// Helpers that the sources of this folder share.

#include "kernel/geometry/surface.h"

namespace trimloop::detail {

std::size_t segment_at(const CompositeCurve&, double t);  // the segment that begins at t; needs at least one segment
Vector third_derivative(const Curve&, double t);          // exact except for an offset of an offset

// The angle, turned by full turns into [lo, lo + 2 pi).
inline double first_at_or_after(double lo, double angle_rad) {
  const double t = angle_rad + two_pi * std::ceil((lo - angle_rad) / two_pi);
  return t < lo ? lo : t;
}
inline double distance(const Box& b, Point p) {
  const auto out = [](double x, double lo, double hi) { return std::max({lo - x, x - hi, 0.0}); };
  return norm(Vector{out(p.x, b.lo.x, b.hi.x), out(p.y, b.lo.y, b.hi.y), out(p.z, b.lo.z, b.hi.z)});
}

// Rotation, mirror and uniform scale, up to 1e-9: what the matrices of files are after they went through text.
inline bool is_similarity(const Transform& m) { return deviation_from_similarity(m) <= 1e-9; }
// Isocurve of a plane, cylinder, cone, sphere or torus, which is a line or a circle with the surface's own parameter:
// v -> S(fixed, v) when `at_u`, else u -> S(u, fixed).
Curve elementary_isocurve(const Surface&, bool at_u, double fixed, Interval along);

// Parameter rectangle without the questions of closedness and poles (those cost samples). `free_u` and `free_v`: the
// direction is an angle of a full turn, values outside are as good.
struct Rectangle {
  Interval u, v;
  bool free_u = false, free_v = false;
};
Rectangle rectangle(const Surface&);
bool is_full_turn(Interval angle_rad);
// The curve's parameter is an angle and its range a full turn: evaluation beyond the range is periodic.
bool is_periodic(const Curve&);

}  // namespace trimloop::detail
