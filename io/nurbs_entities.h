#pragma once
// What becomes of each face and free curve when everything is to be a NURBS.

#include "io/io.h"

namespace trimloop::io {

// Asks the kernel for the same conversions as the writers do.
std::vector<NurbsEntity> nurbs_entities(const Model&, const SourceInfo&);

}  // namespace trimloop::io
