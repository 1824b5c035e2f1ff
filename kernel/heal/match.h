#pragma once
// Do a pcurve and a 3D curve describe the same piece of boundary, and which parameters belong together?

#include "kernel/heal/draft.h"

namespace trimloop::heal {

// Differences that no use of a face can see, as a share of the curve's length: not worth losing a copy for, however
// fine the file's resolution.
constexpr double invisible = 1e-5;

struct Match {
  double gap_mm = infinity;  // largest distance seen between C(t) and S(P(map(t)))
  double off_mm = infinity;  // largest distance seen from S(P) to the nearest point of C: what they contradict by
  double allowed_mm = 0;     // the tolerance, or what is invisible on a curve of this length
  bool against = false;      // they fit only when one of them is turned around
  std::vector<Uv> map;       // as Coedge::map, for the 3D curve as it is; empty: affine
};

// Cheap when the parameters correspond affinely (9 or 17 points); otherwise the map is built from nearest points
// of the 3D curve and halved until what is lost along the curve is below `tolerance_mm` or 5e-5 of its length.
Match match(const Sheet&, const Piece&, double tolerance_mm);

}  // namespace trimloop::heal
