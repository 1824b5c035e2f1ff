#pragma once

#include "kernel/topology/body.h"

namespace trimloop {

struct ParameterBox {
  Interval u{infinity, -infinity}, v{infinity, -infinity};
};
// Encloses the pcurves of a face: the boxes of their control polygons. Empty intervals for a face without loops.
ParameterBox parameter_box(const Body&, const Face&);

}  // namespace trimloop
