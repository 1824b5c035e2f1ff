#pragma once
// STEP file -> Model: products, representations, bodies, in millimetres. Every step that changes or drops something is a
// finding under the rules of formats/step/rules.h and io/rules.h.

#include "formats/step/file.h"
#include "kernel/model/model.h"

namespace trimloop::io::step_import {

Model import(const step::File& file, const Execution& execution, std::optional<LengthUnit> assume_unit, Report& report);

}  // namespace trimloop::io::step_import
