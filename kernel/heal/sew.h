#pragma once
// Faces that lie edge to edge become shells and solids.
//
// Border edges (used once) are joined by measured gap: both curves are compared over their whole length, never by end
// points alone. Where an edge ends in the middle of another, that one is split there first, so that edges that overlap
// in part are joined in part. Every joined edge keeps one curve; the other face's parameter curve is mapped onto it and
// Coedge::gap_mm says how far that face's border is off. The result does not depend on the order of the faces, apart
// from numbering.

#include <stop_token>

#include "kernel/topology/body.h"

namespace trimloop::heal {

struct SewOptions {
  double tolerance_mm = 1e-2;
  bool measure_gaps = true;   // of the edges that stay open
  std::stop_token stop = {};  // asked between edges and between faces
};

struct OpenEdge {
  EdgeId edge;
  FaceId face;
  Point at;            // its middle
  double gap_mm = -1;  // to the nearest border edge of the body, measured over this edge; < 0: none within reach, or not asked for
};

struct SewReport {
  std::size_t joined = 0;           // pairs of border edges that became one
  std::size_t splits = 0;           // cuts at ends of other edges
  std::size_t collapsed = 0;        // edges shorter than the tolerance: poles now
  std::size_t non_manifold = 0;     // places where more than two border edges met; two of them are joined
  std::size_t turned_faces = 0;     // their normals were against their neighbours' or pointed into the solid
  std::size_t closed_shells = 0, open_shells = 0;
  std::size_t voids = 0;            // closed shells that bound a hollow in a solid
  double max_gap_mm = 0;            // of the joined pairs, seen at samples of both edges
  std::vector<OpenEdge> open;       // what is left, in the result's handles
};

struct SewResult {
  // Each closed shell a solid of its own; then what is left, by the body it came from, and as one where it now hangs
  // together across bodies.
  std::vector<Body> bodies;
  std::vector<SewReport> reports;   // one for each body: its open edges; the counts stand in the first
  bool stopped = false;             // what was asked for is not done: there are no bodies
};

// Faces of all the bodies (sheets) are joined. Names, colours and sources stay with faces and edges; a split edge gives
// them to its parts; a body made of faces of one body keeps that one's. Closed shells are turned
// so that their volume is positive; in open ones the majority decides. A closed shell inside a solid is a void of it where
// the faces, as given, look the other way than those around them (both into the material, or both out of it), and a solid
// of its own where they look the same way; inside a void it is a solid again. Cost: near-linear in the number of border edges.
SewResult sew(std::vector<Body> bodies, const SewOptions& options);

}  // namespace trimloop::heal
