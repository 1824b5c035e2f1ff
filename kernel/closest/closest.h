#pragma once
// Nearest points with a certificate: prepared once from a curve, a surface or a trimmed face, then asked as often as
// one likes, from any number of threads. (`closest_point` of kernel/geometry needs no preparation and gives no
// certificate.)
//
// NURBS, and what is exactly one, are searched best first over their Bezier pieces with bounds that hold
// (kernel/closest/search.h), so that nothing is missed: no sampling is involved. Sides and corners count like any other
// point. Planes, cylinders, cones, spheres and tori without trims go by closed form.
//
// A question that is not finite has the distance infinity.
//
// Cost of a query: some microseconds to some tens of them. Preparation: some microseconds a piece, and 40 (2 p + 1)
// (2 q + 1) bytes.

#include <memory>

#include "kernel/geometry/surface.h"
#include "kernel/topology/body.h"

namespace trimloop {

struct ClosestOptions {
  double tolerance_mm = 0;  // answers may be that much farther than the nearest point; 0: as near as rounding allows
};

struct ClosestPoint {  // t in .u for curves
  Uv uv;
  Point point;
  double distance = infinity;
  // No point is nearer than this, rounding included: distance - lower is how much the answer may be wrong at most.
  // About 1e-11 of the distance, more where the distance is almost the same along a curve or region (an axis, the
  // centre of a sphere) and where p is on the surface (all of it then).
  double lower = 0;
};

// All nearest points, and other valleys of the distance up to `within` beyond it; nearest first.
struct ClosestPoints {
  std::vector<ClosestPoint> points;
  bool complete = true;  // false: a continuum of them, or too many to tell apart; some of them are given
};

class ClosestOnCurve {
 public:
  explicit ClosestOnCurve(const NurbsCurve&);        // over range(), which must have a length
  static Result<ClosestOnCurve> make(const Curve&);  // Unsupported where to_nurbs is
  ClosestPoint nearest(Point, ClosestOptions = {}) const;
  ClosestPoints all(Point, double within_mm) const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

class ClosestOnSurface {
 public:
  explicit ClosestOnSurface(const NurbsSurface&);
  // Over a bounded rectangle, by default the domain. Unsupported where to_nurbs is, and for unbounded ones but
  // elementary surfaces.
  static Result<ClosestOnSurface> make(const Surface&, std::optional<Interval> u = {}, std::optional<Interval> v = {});
  ClosestPoint nearest(Point, ClosestOptions = {}) const;
  // Of elementary surfaces only the nearest one.
  ClosestPoints all(Point, double within_mm) const;

 private:
  ClosestOnSurface() = default;
  struct Data;
  std::shared_ptr<const Data> data_;
};

// A face: nearest among its boundary, which is where its edges' curves run (their pcurves on the surface where an edge
// has none), and the stationary points of its surface inside the loops.
class ClosestOnFace {
 public:
  static Result<ClosestOnFace> make(const Body&, FaceId);
  // uv is the pcurve's where the boundary is nearest.
  ClosestPoint nearest(Point, ClosestOptions = {}) const;

 private:
  ClosestOnFace() = default;
  struct Data;
  std::shared_ptr<const Data> data_;
};

}  // namespace trimloop
