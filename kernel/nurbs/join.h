#pragma once
// Joining, extending, and the continuity of what is joined. The NURBS Book, 2nd ed., sections 1.2, 5.2; G. Farin,
// Curves and Surfaces for CAGD, on geometric continuity.

#include "kernel/nurbs/surface.h"

namespace trimloop {

// How the end of one curve meets the start of the next: the defect of each order, and the highest order whose defects,
// and those of all below, keep within the tolerances.
struct JointTolerances {
  double length = 1e-6;     // of position, mm
  double angle_rad = 1e-6;  // of tangents, and of the directions of derivatives
  double relative = 1e-6;   // of derivatives (to the larger) and of curvature (to the larger, or to 1 / mm)
};
struct Joint {
  double gap = 0;                // distance of the ends
  double tangent_angle_rad = 0;  // between the directions of motion; pi when they are opposed; 0 without direction
  double curvature_gap = 0;      // |k1 - k2| of the curvature vectors, 1 / mm
  double curvature = 0;          // the larger of the two
  std::vector<double> derivative_gaps;  // |C1^(k) - C2^(k)| for k = 1 .. , in the curves' parameters
  int parametric = -1;                  // C^k, -1: apart
  int geometric = -1;                   // G^0, G^1, G^2
  bool opposed = false;                 // tangents at an angle of pi: a cusp-like turn
  bool at_rest = false;  // a speed of zero at the joint: parametric continuity says nothing about the shape
};
Joint joint(const NurbsCurve& before, const NurbsCurve& after, const JointTolerances& = {}, int highest_order = 3);

// Every knot inside the range: its joint from left to right, and parameters inside spans where the speed falls to zero
// (cusps), found as roots of |C'|^2 below (tolerance x mean speed)^2.
struct Continuity {
  struct At {
    double t = 0;
    int multiplicity = 0;
    Joint joint;
  };
  std::vector<At> knots;
  std::vector<double> cusps;
  int parametric = 0, geometric = 0;  // the lowest over all knots; degree (and 2) when there are none
};
Continuity continuity(const NurbsCurve&, const JointTolerances& = {});

// Along a common side of two surfaces, sampled at `samples` parameters: gap, angle of normals and difference of normal
// curvature across the side. `a`'s side at u = hi against `b`'s side at u = lo, with equal v over their ranges.
struct SurfaceJoint {
  double gap = 0, normal_angle_rad = 0, curvature_gap = 0;
  int geometric = -1;
};
SurfaceJoint joint_along_u(const NurbsSurface& a, const NurbsSurface& b, const JointTolerances& = {}, int samples = 33);

struct Joined {
  NurbsCurve curve;
  int continuity = 0;    // C^k at the joint
  double deviation = 0;  // bound on what joining moved; the given curves lie over the parameters of `curve` in turn
};
// One curve over [a.lo, a.hi] and b's range shifted to begin there. Degrees are raised to the higher one; weights of b
// are scaled to agree. A gap up to the tolerance is closed half way; then knots of the joint are removed as far as the
// tolerance allows. Degenerate when the ends are farther apart.
Result<Joined> join(const NurbsCurve& a, const NurbsCurve& b, double tolerance);

enum class End : std::uint8_t { Start, Finish };
// The outermost polynomial carried on over `by` > 0 of the parameter: exact continuation, with all its derivatives.
// InvalidArgument when `by` is not positive and finite; the result is refused when it is not finite.
Result<NurbsCurve> extended(const NurbsCurve&, End, double by);
Result<NurbsSurface> extended_u(const NurbsSurface&, End, double by);
Result<NurbsSurface> extended_v(const NurbsSurface&, End, double by);

}  // namespace trimloop
