#pragma once
// Where lines and conics cross elementary surfaces, in closed form (not part of the public face).

#include "kernel/geometry/surface.h"

namespace trimloop::boolean {

// Parameters, ascending, within the curve's range widened by `slack` (a length). Nothing where there is no closed form here or where
// the curve comes too near to touching for it to be safe.
std::optional<std::vector<double>> curve_hits(const Curve&, const Surface&, double slack);

}  // namespace trimloop::boolean
