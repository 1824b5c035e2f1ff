#pragma once
// Edges of a body that its faces share, while the faces are being made. Where a face needs one of them cut (at the seam of
// its surface, where a loop crosses itself), it is cut once, for all: the faces made before go over the parts from then on,
// and the inputs of those to come go on naming the whole edge.

#include <optional>
#include <unordered_map>

#include "kernel/topology/body.h"

namespace trimloop::heal {

// The part of a coedge over a part of its edge's range.
Coedge part_of(const Coedge& whole, const Edge& edge, Interval range);

class SharedEdges {
 public:
  // The edge as it was before it was cut.
  Edge whole(const Body&, EdgeId) const;
  // Its parts, ascending along the curve: itself where nothing was cut.
  std::vector<EdgeId> parts(EdgeId) const;
  // The vertex at curve parameter t, where within `same` of it a part ends.
  std::optional<VertexId> vertex_at(const Body&, EdgeId, double t, double same) const;
  // Cuts the part that t lies in. Cost: the coedges of the loops that use it.
  void cut(Body&, EdgeId, double t, VertexId);
  // A face's loop goes over a part of an edge.
  void use(EdgeId part, LoopId loop) { loops_[part].push_back(loop); }
  // All uses of a body that was made otherwise.
  void use_all(const Body&);

 private:
  std::unordered_map<EdgeId, std::vector<EdgeId>> parts_;  // of edges that were cut
  std::unordered_map<EdgeId, std::vector<LoopId>> loops_;  // of parts
};

}  // namespace trimloop::heal
