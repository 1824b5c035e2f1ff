#pragma once
// The common points of two Bézier patches as arcs, by subdivision of the four parameters (not part of the public face).
//
// A cell is dropped when the hulls are apart or when the Krawczyk operator in three of the parameters maps it away. It
// is settled as an arc when, over the whole range of the fourth parameter k, the operator contracts a box about the
// cell into itself: for each value of parameter k there is exactly one common point in the box. Closed loops cannot
// hide in such a cell, however small. Where normals are parallel two more systems are tried: that of isolated parallel
// normals (four equations), which proves a touch, the absence of contact, or a saddle; and that of a ridge along which
// the gap is extremal in one direction, which carries tangential arcs.

#include "kernel/intersect/bezier.h"

namespace trimloop::detail {

using Parameters = std::array<double, 4>;  // u, v of the first patch, u, v of the second; unit squares
using Cell4 = std::array<Interval, 4>;

// Unknowns and equations of an arc: three of x (a - b = 0), or the ridge system in the frame e1, e2.
struct ArcSystem {
  bool ridge = false;
  Vector e1, e2;
};

struct SurfaceArc {
  Cell4 box;       // the only common points (of the ridge) in it are this arc
  int k = 0;       // the parameter it is a graph over
  Interval range;  // of parameter k, all of it
  Parameters middle{};
  ArcSystem system;
};

struct SurfaceTouch {
  Parameters at{};
  Point point;
  double gap = 0;
  bool branching = false;  // a saddle or a pole: arcs end here
  bool pole = false;       // a collapsed side of a patch on the other patch
  Cell4 within;
};

struct SurfaceCells {
  std::vector<SurfaceArc> arcs;
  std::vector<SurfaceTouch> touches;
  std::vector<Cell4> undecided;
};

SurfaceCells common_arcs(const Bezier& a, const Bezier& b, double tolerance, std::size_t& cells);

// The point of the arc's system at parameter k = x[k], by Newton from x; false when it does not converge.
bool solve_on_arc(const Bezier& a, const Bezier& b, const ArcSystem&, int k, Parameters& x);
// Direction of the arc in the four parameters, for a step of one millimetre in space; and in space.
bool arc_direction(const Bezier& a, const Bezier& b, const ArcSystem&, const Parameters& x, Parameters& step,
                   Vector& tangent);

}  // namespace trimloop::detail
