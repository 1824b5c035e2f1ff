#pragma once
// Helpers that the sources of this folder share.

#include "kernel/geometry/surface.h"

namespace trimloop::detail {

std::size_t segment_at(const CompositeCurve&, double t);  // the segment that begins at t; needs at least one segment
Vector third_derivative(const Curve&, double t);          // exact except for an offset of an offset

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
