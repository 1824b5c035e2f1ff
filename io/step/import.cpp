#include "io/step/import.h"

#include "io/rules.h"
#include "io/step/check_properties.h"
#include "io/step/structure.h"

namespace trimloop::io::step_import {
namespace {

bool empty(const Model& model) {
  for (const Part& part : model.parts)
    if (!part.bodies.empty() || !part.meshes.empty() || !part.curves.empty() || !part.points.empty()) return false;
  return true;
}

}  // namespace

Model import(const step::File& file, const Execution& execution, std::optional<LengthUnit> assume_unit, Report& report) {
  Context context(file, execution, assume_unit, report);
  Model model;
  StructureReader structure(context, model);
  structure.read();
  check_properties(context, model, structure.parts_of_definitions());
  const Units& units = context.first_units();
  model.source_unit = units.unit;
  model.source_scale = units.mm;
  model.unit_known = units.is_known;
  model.resolution_mm = units.uncertainty_mm;
  if (!model.parts.empty()) model.name = model.parts.front().name;
  if (empty(model)) report.add(rules::empty_model, "no entity of the file gives a shape");
  return model;
}

}  // namespace trimloop::io::step_import
