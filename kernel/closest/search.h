#pragma once
// Best-first search for nearest points over pieces and their halves (not part of the public face).
//
// A cell is a piece or a part of one, with the Bernstein coefficients of w^2 D over it (squared_distance.h). It is
// dropped when they prove that nothing in it is nearer than what is known, or when the distance is proven to have one
// valley in it, whose bottom Newton's method has found: with F = w^2 (D - T) convex over the cell, F lies above its
// tangent plane at the bottom. Otherwise it is halved. D. E. Johnson and E. Cohen, "A framework for efficient minimum
// distance computations", ICRA 1998, for the order of visits.

#include <functional>

#include "kernel/closest/squared_distance.h"

namespace trimloop::closest {

struct Shape {  // one of the two
  const SurfacePieces* surface = nullptr;
  const CurvePieces* curve = nullptr;
};

struct Foot {
  Uv uv;
  Point point;
  double squared = infinity;  // distance
  double gu = 0, gv = 0;      // derivatives of `squared`
  std::size_t piece = 0;
};

struct Question {
  Point p;
  double tolerance = 0;       // of the distance, absolute: what is not nearer by more is not looked for
  double within = 0;          // collect all valleys up to this much beyond the nearest
  double at_most = infinity;  // squared distance of an answer already known
  bool collect = false;
  // Candidates must be inside, and only stationary points are looked for; rectangles that `outside` knows to hold
  // nothing of interest are dropped. Empty: all are inside.
  std::function<bool(Uv)> inside;
  std::function<bool(Interval u, Interval v)> outside;
  std::size_t most_cells = 20000;  // that are halved
};

struct Answer {
  Foot best;               // squared is infinite when at_most was not undercut
  double lower = 0;        // squared distance that nothing undercuts, but for the rounding of evaluation
  std::vector<Foot> feet;  // collected, unordered, with repetitions
  bool complete = true;    // no cell was left over
};

Answer search(const SquaredDistance&, const Shape&, const Question&);

Foot foot_at(const Shape&, std::size_t piece, Point p, Uv);
// Bottom of the valley of `start`, held in a part of a piece.
Foot descend(const Shape&, std::size_t piece, Interval u, Interval v, Point p, Uv start);

}  // namespace trimloop::closest
