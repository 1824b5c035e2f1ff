#pragma once
// IGES records -> Model. Resolves references, transforms and units once; decides which of two redundant curves to
// trust (docs/trim-policy.md) and says so.

#include "formats/iges/file.h"
#include "kernel/model/model.h"

namespace trimloop::io::iges_import {

// `measure_healed`: a finding for each healed face, with its area before and after.
Model import(const iges::File& file, const Execution& execution, std::optional<LengthUnit> assume_unit, Report& report,
             bool measure_healed = false);

}  // namespace trimloop::io::iges_import
