#pragma once
// Which edges of a body are written, and who uses them: a seam that came as two edges is one, steps of no size are none.

#include "io/step/entity_writer.h"

namespace trimloop::io::step_export {

struct EdgeUse {
  const Face* face;
  const Coedge* coedge;
  bool flipped = false;  // the coedge's own edge runs against the one it is written with
};

struct EdgePlan {
  struct Twin {  // the edge that is written for an edge
    EdgeId edge;
    bool reversed = false;
  };
  std::vector<std::vector<EdgeUse>> uses;  // of each edge
  std::vector<Twin> twins;                 // of each edge
  std::vector<bool> left_out;              // of each edge
  std::vector<VertexId> same_vertex;       // joined ones lead to the one that is written

  VertexId vertex(VertexId id) const {
    while (same_vertex[id.index] != id) id = same_vertex[id.index];
    return id;
  }
};
// Seams whose two edges are not the same are named in the writer's losses.
EdgePlan plan_edges(EntityWriter&, const Body&);

// The pcurve of a use over `range`, the parameters of the written model curve `curve`, so that both run together within
// `tolerance_mm`, as receivers take them to. Nothing when there is none and the model curve says enough.
std::optional<NurbsCurve> pcurve_along(const Body&, const EdgeUse&, const Curve& curve, Interval range, double tolerance_mm);

}  // namespace trimloop::io::step_export
