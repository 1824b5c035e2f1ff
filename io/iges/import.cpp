#include "io/iges/import.h"

#include "formats/iges/rules.h"
#include "io/iges/attributes.h"
#include "io/iges/structure.h"
#include "io/rules.h"

namespace trimloop::io::iges_import {
namespace {

bool empty(const Model& model) {
  for (const Part& part : model.parts)
    if (!part.bodies.empty() || !part.curves.empty() || !part.points.empty() || !part.annotation.empty()) return false;
  return model.drawings.empty();
}

bool anything_visible(const Model& model) {
  if (!model.drawings.empty()) return true;
  const auto seen = [&](AttributesId id) { return model[id].visible; };
  for (const Part& part : model.parts) {
    for (const FreeCurve& c : part.curves)
      if (seen(c.attributes)) return true;
    for (const FreePoint& p : part.points)
      if (seen(p.attributes)) return true;
    for (const Annotation& a : part.annotation)
      if (seen(a.attributes)) return true;
    for (const Body& body : part.bodies)
      for (const Face& f : body.faces)
        if (seen(f.attributes)) return true;
  }
  return false;
}

}  // namespace

Model import(const iges::File& file, const Execution& execution, std::optional<LengthUnit> assume_unit, Report& report,
             bool measure_healed, const Resolver& resolve) {
  External external;
  if (resolve) external.resolve = &resolve;
  return import(file, execution, assume_unit, report, measure_healed, external);
}

Model import(const iges::File& file, const Execution& execution, std::optional<LengthUnit> assume_unit,
             Report& report, bool measure_healed, const External& external) {
  Context context(file, execution, assume_unit, report);
  context.measure_healed = measure_healed;
  context.external = external;
  Model model;
  model.source_unit = context.unit.unit;
  model.source_scale = context.unit.scale;
  model.unit_known = context.unit.known;
  model.resolution_mm = context.resolution_mm;
  model.name = file.global().receiver_product.empty() ? file.global().sender_product : file.global().receiver_product;
  model.layer_names = layer_names(context);
  StructureReader(context, model).read();
  if (empty(model))
    report.add(rules::empty_model, "no entity of the file gives a shape");
  else if (!anything_visible(model))
    report.add(rules::nothing_visible, "every shape of the file is hidden");
  return model;
}

}  // namespace trimloop::io::iges_import
