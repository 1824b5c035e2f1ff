#include "kernel/heal/draft.h"

namespace trimloop::heal {

void add_natural_boundary(Draft& draft) {
  const SurfaceDomain& d = draft.sheet.domain();
  const Interval u = draft.input.range_u.value_or(d.u), v = draft.input.range_v.value_or(d.v);
  if (!u.is_bounded() || !v.is_bounded() || !(u.lo < u.hi) || !(v.lo < v.hi)) {
    draft.failure = "the surface is unbounded and no loop bounds it";
    return;
  }
  Ring ring;
  const Uv corners[] = {{u.lo, v.lo}, {u.hi, v.lo}, {u.hi, v.hi}, {u.lo, v.hi}};
  for (int i = 0; i < 4; ++i) {
    Piece side = straight_piece(corners[i], corners[(i + 1) % 4]);
    ring.pieces.push_back(std::move(side));
  }
  draft.rings.push_back(std::move(ring));
}

}  // namespace trimloop::heal
