#pragma once
// All common points of a Bézier curve and a Bézier curve or patch, by subdivision (not part of the public face).
//
// A cell is a box of parameters. It is dropped when a direction separates the two hulls by more than the tolerance or
// when the Krawczyk operator maps it away from itself; it is settled when that operator is a contraction into the
// (slightly inflated) cell: then it holds exactly one common point. Of two curves in space the operator sees the two
// coordinates in which they cross, and the gap along the third is measured. Cells that can be neither are halved until
// both parts lie in a slab a few tolerances thick; neighbouring ones make one contact (a touch).
// R. E. Moore, R. B. Kearfott, M. J. Cloud, "Introduction to Interval Analysis" (2009), ch. 8.

#include <optional>

#include "kernel/intersect/bezier.h"

namespace trimloop::detail {

using Cell = std::array<Interval, 3>;  // curve; then u and v of the other (v: [0,0] of a curve)

struct PointContact {
  std::array<double, 3> at{};
  Point point;
  double gap = 0;
  bool crossing = true;  // one proven transversal root; else a touch: all contacts of `within` are within the tolerance
  Cell within;           // no other contact in here
};

struct PointContacts {
  std::vector<PointContact> contacts;
  std::vector<Cell> undecided;
};

// What is known already and need not be found again: return true for a cell to be left out.
using Known = bool (*)(const void* context, const Cell&);

// `cells`: budget, lowered by what was used. When it ends the cells left are undecided.
PointContacts common_points(const Bezier& curve, const Bezier& other, double tolerance, std::size_t& cells,
                            Known known = nullptr, const void* context = nullptr);

// Nearest pair of points in the cell, from a start in it: Gauss-Newton with parameters held at the sides.
struct NearestPair {
  std::array<double, 3> at{};
  Point a, b;
  double distance = infinity;
};
NearestPair nearest_pair(const Bezier& curve, const Bezier& other, const Cell&, std::array<double, 3> start);

}  // namespace trimloop::detail
