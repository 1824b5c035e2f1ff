#pragma once
// A Bézier curve or patch with positive weights over the unit interval or square, and what is known of it over a part:
// hulls and enclosures of value and derivatives from Bernstein coefficients (not part of the public face).
//
// A curve is a patch of degree 0 in v. Rounding is covered by `noise`, an absolute allowance on homogeneous
// coordinates, and `weight_noise` on weights: restricting a net of degrees p, q twice in each direction costs less than
// (8 (p + q) + 32) 2^-53 times its largest coefficient (de Casteljau: one rounding of product and sum a level).

#include <array>
#include <vector>

#include "base/result.h"
#include "kernel/intersect/range.h"
#include "kernel/nurbs/surface.h"

namespace trimloop::detail {

struct Bezier {
  int degree_u = 1, degree_v = 0;
  bool rational = false;
  std::vector<Hpoint> net;    // pole (i, j) at i * (degree_v + 1) + j; largest weight in [0.5, 1] if rational
  Interval u{0, 1}, v{0, 1};  // what the unit interval means in the spline it was cut from
  double noise = 0, weight_noise = 0;

  int dimensions() const { return degree_v > 0 ? 2 : 1; }
  std::size_t rows() const { return static_cast<std::size_t>(degree_u) + 1; }
  std::size_t columns() const { return static_cast<std::size_t>(degree_v) + 1; }
};

// The pieces over the active range, moved by -origin. A weight that is not positive is refused, with its value.
Result<std::vector<Bezier>> bezier_pieces(const NurbsCurve&, Point origin);
Result<std::vector<Bezier>> bezier_pieces(const NurbsSurface&, Point origin);

// The part over u x v (of the unit square; both may stick out of it) as a net of its own.
void restrict_to(const Bezier&, Interval u, Interval v, std::vector<Hpoint>& net);

struct BezierJet {
  Point point;
  Vector du, dv, duu, duv, dvv;  // by the unit parameters
};
BezierJet jet(const Bezier&, double u, double v);  // also outside the unit square
Point evaluate(const Bezier&, double u, double v);

// What holds for every point of a part. The derivatives are by parameters that run over [0, 1] across the part.
struct Enclosure {
  bool valid = false;  // false: a weight of the part is not positive (outside of the unit square only)
  Point centre;        // about its middle
  RangeVector offset;  // of its points from `centre`
  RangeVector du, dv, duu, duv, dvv;
};
Enclosure enclose(const Bezier&, const std::vector<Hpoint>& net, bool second);
// The same in two steps: most parts are told apart by their points.
Enclosure enclose_points(const Bezier&, const std::vector<Hpoint>& net);
void enclose_derivatives(const Bezier&, const std::vector<Hpoint>& net, bool second, Enclosure&);
inline RangeVector points(const Enclosure& e) { return RangeVector{e.centre.x, e.centre.y, e.centre.z} + e.offset; }

// How far a computed point of the patch may be off, at most.
double blur(const Bezier&);

// Extent of the part's points along a direction, noise included.
Range extent(const Bezier&, const std::vector<Hpoint>& net, Vector direction);
Box hull(const Bezier&, const std::vector<Hpoint>& net);

}  // namespace trimloop::detail
