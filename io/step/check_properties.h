#pragma once
// Validation properties (volume, surface area, centroid) as the sender states them, against what we measure.

#include "io/step/context.h"

namespace trimloop::io::step_import {

// `part_of` gives the part of the model that a PRODUCT_DEFINITION became. Parts with occurrences are not compared.
// Deviations are findings SP-V05 to SP-V07; measuring costs a quadrature over the part's faces.
void check_properties(Context& context, const Model& model, const std::unordered_map<std::size_t, std::uint32_t>& part_of);

}  // namespace trimloop::io::step_import
