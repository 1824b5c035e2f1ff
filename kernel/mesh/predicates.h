#pragma once
// Exact signs of 2D determinants (Shewchuk 1997: filter, then expansions). Inputs finite, |x| within 1e-140..1e140.

#include "kernel/math/vec.h"

namespace trimloop::mesh {

// > 0: a, b, c counter-clockwise; 0: exactly collinear. The sign is exact.
double orient2d(Uv a, Uv b, Uv c);
// > 0: d inside the circle through a, b, c (counter-clockwise); 0: exactly cocircular. The sign is exact.
double incircle(Uv a, Uv b, Uv c, Uv d);

}  // namespace trimloop::mesh
