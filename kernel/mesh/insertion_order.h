#pragma once
// The order in which points enter the triangulation: biased randomised rounds (Amenta, Choi, Rote, "Incremental
// constructions con BRIO", 2003), each along a Hilbert curve. Neighbours in the order are neighbours in the plane, so
// that location is a short walk; and each round samples the next, so that no input makes the flips quadratic.

#include <cstdint>
#include <span>
#include <vector>

#include "kernel/math/vec.h"
#include "kernel/mesh/stop_check.h"

namespace trimloop::mesh {

// `order` becomes a permutation of the indices. The other two are scratch. False when stopped.
bool insertion_order(std::span<const Uv> points, StopCheck&, std::vector<std::uint32_t>& order, std::vector<std::uint64_t>& keys,
                     std::vector<std::uint64_t>& more_keys);

}  // namespace trimloop::mesh
