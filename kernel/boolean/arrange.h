#pragma once
// A face cut along the curves of the network: the pieces that they leave of it (not part of the public face).

#include "kernel/boolean/network.h"

namespace trimloop::boolean {

// One side of a segment (or of a part of a pole) in a face, the piece on its left.
struct HalfEdge {
  Use use;                       // use.reversed: the half-edge runs against the segment
  NodeIndex from = none, to = none;  // nodes of the network; the same for poles
  std::uint32_t next = none, previous = none;
};

struct FacePieces {
  std::vector<HalfEdge> half_edges;
  struct Piece {
    std::vector<std::uint32_t> cycles;  // a half-edge of each; the outer one first
    std::vector<Uv> inner;              // points inside, the one farthest from the border first
  };
  std::vector<Piece> pieces;
};

// Degenerate when the curves' directions at a node cannot be told apart or the cycles bound nothing.
Result<FacePieces> arrange(const Network&, const FaceOf&, const FaceNet&);

Uv start_of(const HalfEdge&);
Uv end_of(const HalfEdge&);
// Polyline through a cycle's curves, and the area that they enclose (positive: counter-clockwise).
std::vector<Uv> polygon(const std::vector<HalfEdge>&, std::uint32_t cycle);
double area_of(const std::vector<Uv>& polygon);
bool contains(const std::vector<Uv>& polygon, Uv);
// Points inside the outer polygon and outside the holes, farthest from all of them first.
std::vector<Uv> points_inside(const std::vector<std::vector<Uv>>& polygons);

}  // namespace trimloop::boolean
