#pragma once
// Loops of a face as STEP has them: a face that lies across the seam of a closed surface has a loop on either side of it in
// a Body, with pieces of the seam in both; in STEP it has one, and no seam.

#include <vector>

#include "kernel/topology/body.h"

namespace trimloop::io::step_export {

struct JoinedLoops {
  std::vector<std::vector<const Coedge*>> loops;  // of the body, in the face's order; a joined one stands where its first part stood
  bool crosses_seam = false;               // some were joined: consecutive coedges need not meet in the parameter plane
};
JoinedLoops joined_loops(const Body&, const Face&);

}  // namespace trimloop::io::step_export
