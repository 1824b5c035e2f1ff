// Units per context (ISO 10303-41), uncertainty, application and product contexts.

#include "io/step/product_writer.h"

namespace trimloop::io::step_export {

using step::Derived;
using step::Enumeration;
using step::Measure;
using step::partial;
using step::Unset;

namespace {

// The prefix of a metre, or nothing for units that are conversions.
std::optional<std::string_view> si_prefix(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::Millimetre: return "MILLI";
    case LengthUnit::Metre: return "";
    case LengthUnit::Kilometre: return "KILO";
    case LengthUnit::Micron: return "MICRO";
    case LengthUnit::Centimetre: return "CENTI";
    default: return std::nullopt;
  }
}

std::string_view conversion_name(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::Foot: return "FOOT";
    case LengthUnit::Mile: return "MILE";
    case LengthUnit::Mil: return "MIL";
    case LengthUnit::MicroInch: return "MICROINCH";
    default: return "INCH";
  }
}

InstanceId metre(EntityWriter& w, std::string_view prefix) {
  const step::Partial si = prefix.empty() ? partial("SI_UNIT", Unset{}, Enumeration{"METRE"})
                                          : partial("SI_UNIT", Enumeration{prefix}, Enumeration{"METRE"});
  return w.out.add_complex({partial("LENGTH_UNIT"), partial("NAMED_UNIT", Derived{}), si});
}

InstanceId write_length_unit(EntityWriter& w, LengthUnit unit) {
  if (const auto prefix = si_prefix(unit)) return metre(w, *prefix);
  const InstanceId millimetre = metre(w, "MILLI");
  const InstanceId factor = w.out.add("LENGTH_MEASURE_WITH_UNIT", Measure{"LENGTH_MEASURE", millimetres_per(unit)}, millimetre);
  const InstanceId exponents = w.out.add("DIMENSIONAL_EXPONENTS", 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
  return w.out.add_complex({partial("CONVERSION_BASED_UNIT", conversion_name(unit), factor), partial("LENGTH_UNIT"),
                            partial("NAMED_UNIT", exponents)});
}

}  // namespace

SharedContext write_context(EntityWriter& w, LengthUnit unit, bool is_ap242) {
  SharedContext c;
  c.is_ap242 = is_ap242;
  const InstanceId application = w.out.add(
      "APPLICATION_CONTEXT",
      is_ap242 ? "managed model based 3d engineering" : "core data for automotive mechanical design processes");
  w.out.add("APPLICATION_PROTOCOL_DEFINITION", "international standard",
            is_ap242 ? "ap242_managed_model_based_3d_engineering" : "automotive_design", is_ap242 ? 2014 : 2010, application);
  c.product_context = w.out.add("PRODUCT_CONTEXT", "", application, "mechanical");
  c.definition_context = w.out.add("PRODUCT_DEFINITION_CONTEXT", "part definition", application, "design");

  c.length_unit = write_length_unit(w, unit);
  const InstanceId radian = w.out.add_complex(
      {partial("NAMED_UNIT", Derived{}), partial("PLANE_ANGLE_UNIT"), partial("SI_UNIT", Unset{}, Enumeration{"RADIAN"})});
  const InstanceId steradian = w.out.add_complex({partial("NAMED_UNIT", Derived{}),
                                                  partial("SI_UNIT", Unset{}, Enumeration{"STERADIAN"}),
                                                  partial("SOLID_ANGLE_UNIT")});
  const InstanceId uncertainty =
      w.out.add("UNCERTAINTY_MEASURE_WITH_UNIT", Measure{"LENGTH_MEASURE", w.units.length(w.model.resolution_mm)},
                c.length_unit, "distance_accuracy_value", "confusion accuracy");
  c.geometric = w.out.add_complex({partial("GEOMETRIC_REPRESENTATION_CONTEXT", 3),
                                   partial("GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT", std::array{uncertainty}),
                                   partial("GLOBAL_UNIT_ASSIGNED_CONTEXT", std::array{c.length_unit, radian, steradian}),
                                   partial("REPRESENTATION_CONTEXT", "", "3D")});
  return c;
}

}  // namespace trimloop::io::step_export
