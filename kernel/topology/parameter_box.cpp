#include "kernel/topology/parameter_box.h"

namespace trimloop {

ParameterBox parameter_box(const Body& body, const Face& face) {
  ParameterBox box;
  for (const LoopId id : face.loops) {
    for (const Coedge& coedge : body[id].coedges) {
      const Interval r{std::min(coedge.pcurve_range.lo, coedge.pcurve_range.hi),
                       std::max(coedge.pcurve_range.lo, coedge.pcurve_range.hi)};
      const Box b = bounding_box(with_range(coedge.pcurve.curve, r));
      if (b.empty()) continue;
      box.u = {std::min(box.u.lo, b.lo.x), std::max(box.u.hi, b.hi.x)};
      box.v = {std::min(box.v.lo, b.lo.y), std::max(box.v.hi, b.hi.y)};
    }
  }
  return box;
}

}  // namespace trimloop
