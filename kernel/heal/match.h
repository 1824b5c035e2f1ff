#pragma once
// Do a pcurve and a 3D curve describe the same piece of boundary, and which parameters belong together?

#include "kernel/heal/draft.h"

namespace trimloop::heal {

struct Match {
  double gap_mm = infinity;  // largest distance seen between C(t) and S(P(map(t)))
  bool against = false;      // they fit only when one of them is turned around
  std::vector<Uv> map;       // as Coedge::map, for the 3D curve as it is; empty: affine
};

// Cheap when the parameters correspond affinely (9 or 17 points); otherwise the map is built from nearest points
// of the 3D curve and halved until it follows within `tolerance_mm`.
Match match(const Sheet&, const Piece&, double tolerance_mm);

}  // namespace trimloop::heal
