#pragma once
// Transformation matrices (124) of entities.

#include "io/iges/context.h"

namespace trimloop::io::iges_import {

// The matrix an entity points at, followed by those that matrix points at (IGES 5.3 4.21): the entity's own first.
// Translations are multiplied by `length_scale`. Identity without one. A loop or an over-long chain (IG-R05) ends it.
Transform placement(Context& context, const DirectoryEntry& entry, double length_scale);
inline Transform model_placement(Context& context, const DirectoryEntry& entry) {
  return placement(context, entry, context.unit.scale);
}
// What a matrix entity (124) itself says, and the chain behind it.
Transform matrix_placement(Context& context, const DirectoryEntry& matrix);

}  // namespace trimloop::io::iges_import
