#pragma once
// IGES records -> Model. Resolves references, transforms and units once; decides which of two redundant curves to
// trust (docs/trim-policy.md) and says so.

#include "formats/iges/file.h"
#include "kernel/model/model.h"

namespace trimloop::io::iges_import {

Model import(const iges::File& file, const Execution& execution, std::optional<LengthUnit> assume_unit, Report& report);

}  // namespace trimloop::io::iges_import
