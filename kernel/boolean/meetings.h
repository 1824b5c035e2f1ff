#pragma once
// Where edges and faces of two operands meet: points (nodes) on the edges, and arcs inside the faces. Nothing is cut yet.

#include <array>
#include <optional>
#include <vector>

#include "kernel/boolean/network.h"

namespace trimloop::boolean {

struct Cut {  // of an edge at a node
  double t = 0;
  NodeIndex node = none;
};

// A curve along which two faces meet, with its images where they are known.
struct Branch {
  CurvePtr curve;
  Interval range;
  bool closed = false, extends = false;  // extends: can be evaluated beyond a closed range
  std::array<std::optional<Curve2>, 2> images;
  double bound_mm = 0;
};

// A part of a branch from node to node inside both faces.
struct Arc {
  std::uint32_t f, g;  // faces of the first and of the second operand
  Branch branch;
  Interval range;
  NodeIndex start, end;
};

struct Contained {  // an edge that runs, in part at least, in a face of the other operand
  std::uint32_t edge, face;
};

struct Meetings {
  std::vector<Point> nodes;
  // By operand: the node of each vertex, the cuts of each edge (unsorted, none at its ends), contained edges.
  std::array<std::vector<NodeIndex>, 2> vertex;
  std::array<std::vector<std::vector<Cut>>, 2> cuts;
  std::array<std::vector<Contained>, 2> contained;
  std::vector<Arc> arcs;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> coincident;  // faces on one surface
};

// Unsupported where something is not decided. Cost: each edge with each face of the other operand whose boxes meet, and each
// pair of such faces.
Result<Meetings> find_meetings(const std::array<const Operand*, 2>& operands);

}  // namespace trimloop::boolean
