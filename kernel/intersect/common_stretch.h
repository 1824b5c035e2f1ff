#pragma once
// Where two Bézier pieces coincide: found from contacts of ends, proven by Taylor models (not part of the public face).

#include "kernel/intersect/points.h"
#include "kernel/pcurve/taylor_model.h"

namespace trimloop::detail {

NurbsCurve to_nurbs_curve(const Bezier& curve);
NurbsSurface to_nurbs_surface(const Bezier& patch);

struct CommonStretch {
  Interval first, second;
  bool opposed = false;
  double bound = 0;
};
// At most one stretch: two rational pieces that coincide anywhere coincide until one of them ends.
std::optional<CommonStretch> common_stretch(const Bezier& a, const Bezier& b, double tolerance);

// Stretches of a curve that lie in a patch.
struct StretchInPatch {
  Interval on_curve;
  double bound = 0;
};
std::vector<StretchInPatch> stretches_in_patch(const Bezier& curve, const Bezier& patch, double tolerance);

// A step of the parameter after which curves that only touch are well apart, if they bend at the size of the piece.
double telling_step(const Bezier& curve, double s, double near);

// For common_points(): nothing in the cell but points of a stretch.
struct StretchContext {
  const Bezier &a, &b;
  double tolerance;
};
bool only_on_stretch(const void* context, const Cell&);

bool only_on_stretch_in_patch(const void* context, const Cell&);

// Polynomial in x over [-1, 1] through values at the Chebyshev nodes node(k), k = 0..5.
constexpr int witness_nodes = 6;
double witness_node(int k);
TaylorModel witness(const std::array<double, witness_nodes>& values);

}  // namespace trimloop::detail
