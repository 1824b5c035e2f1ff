#pragma once
// The loops of a face as closed polygons in its parameter plane, made of the samples that its edges share.

#include <span>

#include "kernel/mesh/edge_sampling.h"
#include "kernel/mesh/triangulation.h"

namespace trimloop::mesh {

// An edge with its samples and their places in BodyMesh::points.
struct SampledEdge {
  EdgeSamples samples;
  std::vector<std::uint32_t> points;
  std::vector<EdgeUse> uses;
};

// Along which parameter a pole runs: u for a side v = const that is one point.
enum class PoleSide : std::uint8_t { None, AlongU, AlongV };

struct FaceBoundary {
  std::vector<Uv> uv;
  std::vector<std::uint32_t> point;     // into BodyMesh::points
  std::vector<PoleSide> pole;
  std::vector<Segment> segments;        // into the arrays above
  struct Chord {
    EdgeId edge;                        // none: joins two coedges that do not quite meet in parameter space
    std::uint32_t index = 0;            // chord of the edge's samples
    const Coedge* coedge = nullptr;     // whose parameter curve it stands for
  };
  std::vector<Chord> chords;            // one per segment
  Interval u, v;                        // box
  double gap_mm = 0;                    // largest gap its coedges state
  double edge_deviation_mm = 0;
  bool finite = true;

  void clear();
};

// Replaces the content of `out`, keeping its memory.
void collect_boundary(const Body&, const Face&, std::span<const SampledEdge>, FaceBoundary& out);

}  // namespace trimloop::mesh
