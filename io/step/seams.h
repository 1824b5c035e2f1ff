#pragma once
// Where a file gives no seam edge on a closed elementary surface, healing cuts it along a line of its own choice. These
// choose the place by the same rule and prepare it, so that no edge is cut for one face only: neighbours go on sharing it.

#include "kernel/heal/make_face.h"

namespace trimloop::io::step_import {

// The surface with u = 0 at a vertex of the loops that go round it; others as they are.
SurfacePtr seam_at_vertex(const SurfacePtr& surface, const Body& body, const std::vector<heal::TrimLoop>& loops);

// Cuts every edge that a loop of such a face takes over the seam, for all faces at once. Also about the tube of a torus.
void split_at_seams(Body& body, std::vector<heal::FaceInput*>& faces);

}  // namespace trimloop::io::step_import
