#pragma once
// Arcs of one pair of patches put one after another, and cut to the patches (not part of the public face).

#include "kernel/intersect/surface_cells.h"

namespace trimloop::detail {

struct Chain {
  std::vector<Parameters> nodes;  // points of the intersection, in order
  std::vector<std::size_t> arcs;  // arcs[i] carries the stretch from nodes[i] to nodes[i + 1]
  bool tangential = false;
  bool closed = false;  // the last node is the first
};
// What of the arcs lies on both patches. Each arc is the only one of its box, so a point in the box of another arc is
// on that arc too: nothing is connected by nearness.
std::vector<Chain> chains(const Bezier& a, const Bezier& b, const SurfaceCells&);

}  // namespace trimloop::detail
