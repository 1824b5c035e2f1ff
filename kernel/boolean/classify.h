#pragma once
// Where a point lies with respect to a closed body (not part of the public face).

#include "kernel/boolean/operand.h"

namespace trimloop::boolean {

enum class Side : std::uint8_t { Inside, Outside };

// By counting the faces that a ray crosses; rays that come near an edge or touch a face are given up for others.
// Nothing when the point is on the body or no ray is clear.
std::optional<Side> side_of(const Operand&, Point);

}  // namespace trimloop::boolean
