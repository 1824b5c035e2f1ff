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

// A length with an estimate of its own error (the difference of two rules on the same pieces, summed), halved until
// that is below `absolute_error` or the pieces end. InvalidArgument for unbounded curves.
struct MeasuredLength {
  double value = 0, error = 0;
};
Result<MeasuredLength> measured_length(const Curve&, double absolute_error);

// count + 1 parameters, both ends included, that cut the curve into `count` parts of equal length: a trajectory of
// constant speed. Degenerate when the curve has no length.
Result<std::vector<double>> equal_length_parameters(const CurvePtr&, int count);
// The parameter at a length from the start, clamped to the curve.
double parameter_at_length(const ArcLength&, double length);

// A spline extended beyond one end by a length along the continuation of its polynomial (kernel/nurbs/join.h), to 1e-9
// of that length. Degenerate when it ends at rest or its continuation does not become that long.
Result<NurbsCurve> extended_by_length(const NurbsCurve&, bool at_start, double length);

}  // namespace trimloop
