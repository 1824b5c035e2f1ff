#include "io/step/import.h"

#include <fmt/format.h>

#include "base/bytes.h"
#include "formats/step/rules.h"
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

// Documents that are STEP files themselves: what they hold is not read.
void report_other_files(Context& context) {
  const auto is_step = [](std::string name) {
    for (char& c : name) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    for (const std::string_view end : {".stp", ".step", ".p21", ".stpz", ".stpx"})
      if (name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0) return true;
    return false;
  };
  for (const Record& i : context.file.instances()) {
    if (!context.is(i, Entity::DocumentFile)) continue;
    step::Tape tape;
    step::Reader r(context.file, i, context.execution.limits, tape, context.report);
    if (!r.at(Entity::Document)) continue;
    const std::string name = r.text(0);
    if (is_step(name)) context.add(i, step::rules::other_file, fmt::format("a part is in the file {}, which is not opened", printable(name, 80)));
  }
}

}  // namespace

Model import(const step::File& file, const Execution& execution, std::optional<LengthUnit> assume_unit, Report& report) {
  Context context(file, execution, assume_unit, report);
  Model model;
  StructureReader structure(context, model);
  structure.read();
  report_other_files(context);
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
