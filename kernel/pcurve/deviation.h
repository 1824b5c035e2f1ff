#pragma once
// How far a curve in space and its image in a surface's parameter plane are apart: a bound that holds over the whole
// range, and the largest distance seen. Taylor models over parts of the range, halved where the bound is loose
// (kernel/pcurve/taylor_model.h); no sampling in the bound.

#include "kernel/geometry/surface.h"

namespace trimloop {

struct Deviation {
  double bound_mm = infinity;  // sup over the range is not larger; infinite when none was found
  double measured_mm = 0;      // sup is not smaller: seen at a parameter
  double at = 0;               // the curve's parameter where it was seen
  bool proven() const { return bound_mm < infinity; }
};

struct DeviationOptions {
  double ratio = 1.05;       // stop when bound <= ratio * measured + floor_mm
  double floor_mm = 1e-9;    // differences below this are of no interest
  double enough_mm = 0;      // stop also when the bound is below this
  std::size_t parts = 4096;  // at most this many parts of the range,
  std::size_t parts_of_piece = 16;  // and this many for each of its smooth pieces
  // Of a surface that merely closes, whose pcurve runs on over the seam: the length of its range along u and v.
  double period_u = 0, period_v = 0;
};

// sup of |S(P(a t + b)) - C(t)| over `range` of the curve, the affine map taking its ends to the ends of `on_pcurve`.
// About 10 us for each part of a bicubic rational surface; mostly 4 to 100 parts.
Deviation deviation(const Curve2& pcurve, Interval on_pcurve, const Surface&, const Curve& curve, Interval range,
                    const DeviationOptions& = {});
// sup of |A(t) - B(a t + b)|.
Deviation deviation(const Curve& a, Interval range, const Curve& b, Interval on_b, const DeviationOptions& = {});

}  // namespace trimloop
