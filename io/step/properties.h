#pragma once
// Validation properties of a part: volume, area and centroid as we measure them (recommended practice "Geometric and
// Assembly Validation Properties"), so that a receiver can see whether it read the same shape.

#include "io/step/product_writer.h"
#include "kernel/check/part_mass.h"

namespace trimloop::io::step_export {

// For the shape `owner` (a PRODUCT_DEFINITION_SHAPE) of a part whose geometry is written at `scale`.
void write_properties(EntityWriter&, const PartMass& mass, double scale, InstanceId owner, const SharedContext&);

}  // namespace trimloop::io::step_export
