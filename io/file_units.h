#pragma once
// Millimetres -> the lengths of a file in another unit, digits kept.

#include "kernel/math/vec.h"

namespace trimloop::io {

// The shortest decimal d with fl(d x factor) equal to the stored value is chosen, so that an inch file keeps the digits
// it came with.
class FileUnits {
 public:
  explicit FileUnits(double mm_per_unit) : factor_(mm_per_unit) {}
  double length(double mm) const;
  Point point(Point p) const { return {length(p.x), length(p.y), length(p.z)}; }
  double factor() const { return factor_; }

 private:
  double factor_;
};

// 100 x part in its shortest form: 33.3 and not 33.300000000000004.
double percent_of(double part);

}  // namespace trimloop::io
