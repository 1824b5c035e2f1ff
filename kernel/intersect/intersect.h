#pragma once
// Intersections: curve/curve, curve/surface, surface/surface. Every common point within the tolerance is in one of the
// components returned or in an undecided box; nothing else is returned.
//
// How sure: parts of the parameter space are left out only when hulls of Bernstein coefficients, or the Krawczyk
// operator, prove with outward allowances for rounding that nothing is there. A `Crossing` is proven to be the only one
// in its neighbourhood. A `Touch` is a place where the shapes come within the tolerance and no crossing can be told
// apart: a tangency, or several crossings closer together than the tolerance can separate. An overlap is a stretch of
// coincidence with a bound on the distance that holds over all of it.
//
// Splines with a weight that is not positive are refused (Unsupported): split or elevate them first. Offsets are
// refused too: approximate them first. Iterative; when the budget ends, what is left comes back as undecided.

#include "kernel/geometry/surface.h"

namespace trimloop {

struct IntersectOptions {
  double tolerance_mm = 0;        // what is not farther apart meets; 0: 1e-12 of the largest coordinate
  std::size_t cells = 2'000'000;  // budget of examined boxes, about 2 us (curves) to 15 us (surfaces) each
};

enum class ContactKind : std::uint8_t { Crossing, Touch };

// ---- Curve with curve, in space or in the plane

struct CurveCurvePoint {
  double t_first = 0, t_second = 0;
  Point point;
  double gap_mm = 0;  // between the two curves there
  ContactKind kind = ContactKind::Crossing;
  bool end_first = false, end_second = false;  // at an end of that curve
};
struct CurveCurveOverlap {
  Interval first, second;  // parameters; `second` ascends too
  bool opposed = false;    // the curves run against each other
  double bound_mm = 0;     // no point of the stretch is farther from the other curve
};
struct CurveCurveDoubt {
  Interval first, second;
};
struct CurveCurveIntersection {
  std::vector<CurveCurvePoint> points;      // ascending t_first
  std::vector<CurveCurveOverlap> overlaps;  // their ends are not among the points
  std::vector<CurveCurveDoubt> undecided;   // empty: the lists above are complete
  std::size_t cells = 0;                    // examined
};
// A closed curve's start and end are one point. Unbounded lines are cut to the other curve's box; two of them are
// refused.
Result<CurveCurveIntersection> intersect(const Curve&, const Curve&, const IntersectOptions& = {});
Result<CurveCurveIntersection> intersect(const NurbsCurve&, const NurbsCurve&, const IntersectOptions& = {});
Result<CurveCurveIntersection> intersect(const Curve2&, const Curve2&, const IntersectOptions& = {});

// ---- Curve with surface

struct CurveSurfacePoint {
  double t = 0;
  Uv uv;
  Point point;
  double gap_mm = 0;
  ContactKind kind = ContactKind::Crossing;  // at a pole of the surface always Touch
  bool end = false;                          // at an end of the curve
};
struct CurveSurfaceOverlap {
  Interval on_curve;    // this stretch lies in the surface
  double bound_mm = 0;  // no point of it is farther from the surface
};
struct CurveSurfaceDoubt {
  Interval on_curve, u, v;
};
struct CurveSurfaceIntersection {
  std::vector<CurveSurfacePoint> points;  // ascending t; one for each point of the curve, at seams and poles too
  std::vector<CurveSurfaceOverlap> overlaps;
  std::vector<CurveSurfaceDoubt> undecided;
  std::size_t cells = 0;
};
Result<CurveSurfaceIntersection> intersect(const NurbsCurve&, const NurbsSurface&, const IntersectOptions& = {});
// Over the rectangle, which defaults to the domain; its unbounded directions, and an unbounded line, are cut to the
// other shape's box.
Result<CurveSurfaceIntersection> intersect(const Curve&, const Surface&, const IntersectOptions& = {},
                                           std::optional<Interval> u = {}, std::optional<Interval> v = {});

}  // namespace trimloop
