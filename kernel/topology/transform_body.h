#pragma once

#include "kernel/topology/body.h"

namespace trimloop {

// The body moved by a rotation, mirror, uniform scale and shift (up to 1e-9): every shape keeps its type, pcurves follow
// their surfaces' parameters, and a mirror turns faces and loops so that outward stays outward. Unsupported for any
// other map.
Result<Body> transformed(const Body&, const Transform&);

}  // namespace trimloop
