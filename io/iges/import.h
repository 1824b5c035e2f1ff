#pragma once
// IGES records -> Model. Resolves references, transforms and units once; decides which of two redundant curves to
// trust (docs/trim-policy.md) and says so.

#include "formats/iges/file.h"
#include "io/external.h"
#include "kernel/model/model.h"

namespace trimloop::io::iges_import {

struct External;

// `measure_healed`: a finding for each healed face, with its area before and after. Other files that this one names (416)
// are asked for from `resolve`, where there is one.
Model import(const iges::File& file, const Execution& execution, std::optional<LengthUnit> assume_unit, Report& report,
             bool measure_healed = false, const Resolver& resolve = {});
Model import(const iges::File& file, const Execution& execution, std::optional<LengthUnit> assume_unit, Report& report,
             bool measure_healed, const External& external);

}  // namespace trimloop::io::iges_import
