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
// A closed curve's start and end are one point. Unbounded lines are cut to the other curve's box; two of them go by
// closed form; a ray against a ray or line is refused (InvalidArgument).
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

// ---- Surface with surface

struct IntersectionBranch {
  Curve curve;           // cubic spline in space; its parameter is about the length along it, from 0
  Curve2 first, second;  // its images, over the same parameter; along periodic directions they run on (unwrapped)
  double bound_mm = 0;   // at no parameter is the curve farther than this from either surface at its image (proven)
  bool closed = false;
  bool tangential = false;  // the surfaces touch along it
  int component = 0;        // branches that meet at their ends (seams, poles, branch points) share it
};
struct SurfaceSurfacePoint {
  Uv first, second;
  Point point;
  double gap_mm = 0;
  bool branching = false;  // branches meet here; else the surfaces touch in this point alone
};
// A part of a side of one surface that lies in the other.
struct SideInSurface {
  bool of_first = true;
  bool at_u = true;  // the side u = value (v runs), else v = value
  double value = 0;
  Interval range;       // of the parameter that runs
  double bound_mm = 0;  // of its distance from the other surface (proven)
};
// The surfaces coincide over an area. Its outline is made of the sides; gap_mm was measured inside, not proven.
struct SurfaceOverlap {
  std::vector<SideInSurface> outline;
  double gap_mm = 0;
};
struct SurfaceSurfaceDoubt {
  Interval u_first, v_first, u_second, v_second;
};
struct SurfaceSurfaceIntersection {
  std::vector<IntersectionBranch> branches;
  std::vector<SurfaceSurfacePoint> points;
  std::vector<SurfaceOverlap> overlaps;  // at most one
  std::vector<SurfaceSurfaceDoubt> undecided;
  int components = 0;  // connected sets among branches and points
  std::size_t cells = 0;
};
struct SurfaceIntersectOptions : IntersectOptions {
  double fit_mm = 0;  // how well branches are fitted; 0: 1e-8 of the size of both
};
// Over rectangles that default to the domains, unbounded directions cut to the other surface's box. Two unbounded
// planes go by closed form: a line without ends, at unit speed, its bound that of its start. Other pairs that are both
// unbounded are refused.
Result<SurfaceSurfaceIntersection> intersect(const Surface&, const Surface&, const SurfaceIntersectOptions& = {},
                                             std::optional<Interval> u_first = {}, std::optional<Interval> v_first = {},
                                             std::optional<Interval> u_second = {},
                                             std::optional<Interval> v_second = {});

}  // namespace trimloop
