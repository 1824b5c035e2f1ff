#pragma once
// Bodies put into one, and one taken apart into solids (not part of the public face).

#include "kernel/topology/body.h"

namespace trimloop::boolean {

// All arrays one after another; attributes and sources of the first, and the sources of the others.
Body joined(const std::vector<Body>&);

// Each shell that bounds a volume from outside with the voids in it. Degenerate when a void lies in none.
Result<std::vector<Body>> solids_of(const Body& closed_shells, double tolerance_mm);

}  // namespace trimloop::boolean
