#pragma once
// Chords of a face that cross or touch though the parameter curves behind them do not.

#include "kernel/mesh/chart.h"
#include "kernel/mesh/face_boundary.h"

namespace trimloop::mesh {

// A new sample of an edge.
struct EdgeCut {
  EdgeId edge;
  double t = 0;  // of the edge, inside one of its chords
};

// Samples that part chords which cross, found by halving both where they bow; none where the curves themselves cross,
// touch or run along each other, which no sample can mend. `triangulation` is that of the boundary's points, in `chart`
// (null: in the surface's parameters).
std::vector<EdgeCut> part_crossings(const Body&, const FaceBoundary&, std::span<const SampledEdge>, const Triangulation&,
                                    const Chart*);
// The middles of all chords that bow: for a boundary that encloses nothing.
std::vector<EdgeCut> halve_bowed(const Body&, const FaceBoundary&, std::span<const SampledEdge>, const Chart*);

}  // namespace trimloop::mesh
