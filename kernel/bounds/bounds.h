#pragma once
// Bounds that hold: boxes, cones of directions, derivatives, distance from a chord. All from control points of Bezier
// pieces (hulls of the shape, of its hodographs and of its normals, rational ones included), rounding accounted for;
// nothing is sampled. Weights must be positive on a piece for its bounds to be finite: infinite or "any direction"
// else. Sources: The NURBS Book, 2nd ed., sections 3.3, 4.3, 4.5; T. Sederberg and R. Meyers, "Loop detection in
// surface patch intersections", CAGD 5 (1988), for cones; T. Sederberg and X. Wang, "Rational hodographs", CAGD 4
// (1987).

#include "kernel/batch/pieces.h"

namespace trimloop {

// The hull of all pieces: encloses.
Box hull_box(const CurvePieces&);
Box hull_box(const SurfacePieces&);

// Encloses, and each side is within `share` of the size (the largest coordinate in magnitude, and the hull's diagonal)
// of a point of the shape. Best first by the hulls of halves; about 10 us a curve, 100 us a surface of some dozen
// pieces.
struct TightBox {
  Box box;
  double slack = 0;  // no side is farther out than this
};
TightBox tight_box(const CurvePieces&, double share = 1e-10);
TightBox tight_box(const SurfacePieces&, double share = 1e-10);

// All directions in question make at most this angle with the axis; pi when nothing is known.
struct DirectionCone {
  Vector axis{0, 0, 1};
  double half_angle_rad = pi;
};
DirectionCone tangent_cone(const CurvePieces&, std::size_t piece);                 // of C'
DirectionCone normal_cone(const SurfacePieces&, std::size_t a, std::size_t b);     // of Su x Sv
DirectionCone tangent_cone_u(const SurfacePieces&, std::size_t a, std::size_t b);  // of Su
DirectionCone tangent_cone_v(const SurfacePieces&, std::size_t a, std::size_t b);
DirectionCone joined(const DirectionCone&, const DirectionCone&);  // holds the directions of both

// Upper bounds of the lengths of derivatives on a piece.
struct CurveDerivativeBounds {
  double first = infinity, second = infinity;
};
struct SurfaceDerivativeBounds {
  double u = infinity, v = infinity, uu = infinity, uv = infinity, vv = infinity;
};
CurveDerivativeBounds derivative_bounds(const CurvePieces&, std::size_t piece);
SurfaceDerivativeBounds derivative_bounds(const SurfacePieces&, std::size_t a, std::size_t b);

// Distance of the piece's points from the segment between its ends, at most; and of a patch's points from those of the
// same parameters on the bilinear patch through its corners, at most.
double chord_height_bound(const CurvePieces&, std::size_t piece);
double bilinear_deviation_bound(const SurfacePieces&, std::size_t a, std::size_t b);

// A polyline whose segments the curve's parts between t[i] and t[i + 1] stay within `bound` of, bound <= tolerance: the
// width of the hull of each part, halved until it is narrow enough. Limit when `most` points do not suffice.
struct Flattening {
  std::vector<double> t;
  std::vector<Point> points;
  double bound = 0;
};
Result<Flattening> flatten(const NurbsCurve&, double tolerance_mm, std::size_t most = 1000000);

}  // namespace trimloop
