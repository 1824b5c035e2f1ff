#pragma once
// One model inside another.

#include "kernel/model/model.h"

namespace trimloop {

// Takes over the parts of `other`, with the attributes, layers, views and drawings that they use. Returns the index of its
// root part; nothing places it yet. Lengths are millimetres in both. Linear in the size of `other`.
std::uint32_t append(Model& into, Model other);

}  // namespace trimloop
