#pragma once
// The order in which points enter the triangulation: biased randomised rounds (Amenta, Choi, Rote, "Incremental
// constructions con BRIO", 2003), each along a Hilbert curve. Neighbours in the order are neighbours in the plane, so
// that location is a short walk; and each round samples the next, so that no input makes the flips quadratic.

#include <cstdint>
#include <span>
#include <vector>

#include "kernel/math/vec.h"

namespace trimloop::mesh {

// `order` becomes a permutation of the indices. The other two are scratch.
void insertion_order(std::span<const Uv> points, std::vector<std::uint32_t>& order, std::vector<std::uint64_t>& keys,
                     std::vector<std::uint64_t>& more_keys);

}  // namespace trimloop::mesh
