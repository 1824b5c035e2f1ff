#include "kernel/heal/draft.h"

namespace trimloop::heal {

void orient(Draft& draft) {
  for (Ring& ring : draft.rings) ring.area = area_of(ring);
  std::stable_sort(draft.rings.begin(), draft.rings.end(),
                   [](const Ring& a, const Ring& b) { return std::abs(a.area) > std::abs(b.area); });
  for (std::size_t i = 0; i < draft.rings.size(); ++i) {
    Ring& ring = draft.rings[i];
    int depth = 0;
    for (std::size_t k = 0; k < i; ++k) depth += is_inside(draft.rings[k], first_uv(ring.pieces[0]));
    const bool outer = depth % 2 == 0;
    if ((ring.area > 0) == outer) continue;
    turn_around(ring);
    draft.record(Step::LoopReoriented, ring.loop, -1, 0, 0, draft.sheet.point(first_uv(ring.pieces[0])), false);
  }
}

}  // namespace trimloop::heal
