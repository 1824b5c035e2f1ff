#pragma once
// Arcs of the unit circle and of the unit hyperbola as rational quadratic pieces in standard form (the end weights 1):
// what every conic and every turned surface is made of.

#include "kernel/geometry/curve.h"

namespace trimloop::detail {

struct ArcPole {  // premultiplied: (w cos, w sin, w), or (w cosh, w sinh, w)
  double c, s, w;
};
struct Arcs {
  std::vector<double> at;             // piece boundaries, in the parameter of the arc and in that of the NURBS alike
  std::vector<ArcPole> poles;         // 2 pieces + 1
  std::vector<double> knots() const;  // of degree 2, double inside
  ParameterMap map(ParameterMap::Kind) const;
};

// Pieces of a quarter turn at most (weights >= sqrt(1/2)); a full turn closes exactly.
Arcs circular_arcs(Interval angle_rad);
// Pieces of at most 2, which keeps the middle weight below 1.55.
Arcs hyperbolic_arcs(Interval parameter);

}  // namespace trimloop::detail
