#pragma once
// Arc length along a bounded curve as a function of the parameter, and back.

#include "kernel/geometry/curve.h"

namespace trimloop {

// Measures the curve once, into a table; then each question costs a few evaluations. Relative accuracy about 1e-10.
class ArcLength {
 public:
  explicit ArcLength(CurvePtr curve);
  double total() const { return lengths_.back(); }
  double fraction(double t) const;                 // of the total length, from the start; 0..1
  double parameter(double length_fraction) const;  // inverse; of a curve without length: affine

 private:
  CurvePtr curve_;
  std::vector<double> parameters_, lengths_;  // ascending, same size, at least two
};

}  // namespace trimloop
