#pragma once
// Cubic splines through points by local tangents: Catmull-Rom over uniform parameters, Overhauser over chord lengths.
// Every one is a NURBS curve of degree 3 with poles by formula; moving a point moves at most four segments.
// Source: seed 000 §2.2; Catmull and Rom 1974; Overhauser 1968.

#include <span>

#include "kernel/nurbs/curve.h"

namespace trimloop {

enum class SplineEnds : std::uint8_t {
  Dropped,      // first and last point only steer the tangents: the curve runs from the second to the last but one
  QuadraticG1,  // a parabola as first and last segment, its middle pole at v/sqrt(2): a heuristic, tangent continuous
  QuadraticC1,  // the same with v/2: equal derivatives at the joint
  Closed        // from the last point back to the first
};

enum class TangentRule : std::uint8_t {
  CatmullRom,  // v = (P[i+1] - P[i-1]) / 2 over the parameters 0, 1, 2, ...
  Overhauser   // mean of the chords' unit vectors, weighted with the length of the other chord, over chord lengths
};

// At least 4 points for Dropped, 3 otherwise; neighbours must differ under Overhauser (their chord is a direction).
// C1 joints are double knots, other joints triple ones. The parameter is that of the rule, from 0.
Result<NurbsCurve> spline_through(std::span<const Point> points, TangentRule, SplineEnds);

// The Overhauser curve over uniform parameters: same shape, tangent continuous only (triple knots). Seed 000 §2.2.2.
Result<NurbsCurve> overhauser_uniform(std::span<const Point> points, SplineEnds);

}  // namespace trimloop
