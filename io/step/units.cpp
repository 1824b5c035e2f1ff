// Units by representation context: SI with prefixes, conversion-based ones down to SI, degrees. ISO 10303-41.

#include <fmt/format.h>

#include <cmath>

#include "base/bytes.h"
#include "formats/step/rules.h"
#include "io/step/context.h"

namespace trimloop::io::step_import {
namespace {

namespace sr = step::rules;

std::optional<double> prefix_value(std::string_view prefix) {
  constexpr std::pair<std::string_view, double> table[] = {
      {"", 1},        {"EXA", 1e18},   {"PETA", 1e15},  {"TERA", 1e12},  {"GIGA", 1e9},    {"MEGA", 1e6},
      {"KILO", 1e3},  {"HECTO", 1e2},  {"DECA", 1e1},   {"DECI", 1e-1},  {"CENTI", 1e-2},  {"MILLI", 1e-3},
      {"MICRO", 1e-6}, {"NANO", 1e-9}, {"PICO", 1e-12}, {"FEMTO", 1e-15}, {"ATTO", 1e-18}};
  for (const auto& [word, value] : table)
    if (word == prefix) return value;
  return std::nullopt;
}

// Millimetres of a metre with that prefix, exactly for the usual ones.
std::optional<double> si_millimetres(std::string_view prefix) {
  if (prefix == "MILLI") return 1.0;
  if (prefix == "CENTI") return 10.0;
  if (prefix == "DECI") return 100.0;
  if (prefix == "MICRO") return 1e-3;
  const auto value = prefix_value(prefix);
  if (!value) return std::nullopt;
  return *value * 1000;
}

LengthUnit nearest_unit(double mm) {
  for (const LengthUnit u : {LengthUnit::Millimetre, LengthUnit::Inch, LengthUnit::Foot, LengthUnit::Metre, LengthUnit::Centimetre,
                             LengthUnit::Kilometre, LengthUnit::Micron, LengthUnit::Mil, LengthUnit::MicroInch, LengthUnit::Mile})
    if (std::abs(millimetres_per(u) - mm) <= 1e-6 * mm) return u;
  return LengthUnit::Millimetre;
}

// The names of conversion-based units whose factor cannot be used.
std::optional<double> by_name(std::string name, bool angle) {
  for (char& c : name) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  if (angle) return name == "degree" || name == "degrees" || name == "deg" ? std::optional(pi / 180) : std::nullopt;
  if (const auto unit = unit_from_name(name)) return millimetres_per(*unit);
  return std::nullopt;
}

}  // namespace

std::optional<double> unit_value(Context& context, const Record& unit, bool angle) {
  Visit visit(context, unit);
  const auto r = visit ? context.read<step::UnitRecord>(unit) : std::nullopt;
  if (!r) return std::nullopt;
  if (r->is_si) {
    if (angle) return r->name == "RADIAN" ? prefix_value(r->prefix) : std::nullopt;
    return r->name == "METRE" ? si_millimetres(r->prefix) : std::nullopt;
  }
  if (!context.is(unit, Entity::ConversionBasedUnit)) return by_name(r->name, angle);
  const Record* factor = context.find(r->factor);
  const bool is_measure = factor && (context.is(*factor, Entity::MeasureWithUnit) || context.is(*factor, Entity::MeasureRepresentationItem));
  const auto measure = is_measure ? context.read<step::MeasureRecord>(*factor) : std::nullopt;
  const Record* base = measure ? context.find(measure->unit) : nullptr;
  const auto base_value = base && context.is(*base, Entity::NamedUnit) ? unit_value(context, *base, angle) : std::nullopt;
  const double value = measure && base_value ? measure->value.number * *base_value : 0;
  if (value > 0 && std::isfinite(value) && std::isnormal(value)) {
    // A degree written with fewer digits than it has is a degree.
    if (angle && std::abs(value - pi / 180) < 1e-6 * pi / 180) return pi / 180;
    return value;
  }
  const auto named = by_name(r->name, angle);
  context.add(unit, sr::units, named ? fmt::format("the factor of the unit '{}' cannot be used; its name is", printable(r->name, 40))
                                     : fmt::format("the unit '{}' leads to no known one", printable(r->name, 40)),
              measure ? measure->value.number : not_measured);
  return named;
}

Units read_units(Context& context, const Record& representation_context) {
  Units out;
  const auto r = context.read<step::ContextRecord>(representation_context);
  bool has_length = false, has_angle = false;
  if (r) {
    for (const Ref ref : r->units) {
      const Record* unit = context.find(ref);
      if (!unit) {
        context.add(representation_context, sr::reference_unresolved, fmt::format("the unit #{} is not in the file", ref.id));
        continue;
      }
      const bool length = context.is(*unit, Entity::LengthUnit), angle = context.is(*unit, Entity::PlaneAngleUnit);
      if ((length && !has_length) || (angle && !has_angle)) {
        const auto value = unit_value(context, *unit, angle);
        if (!value) continue;
        if (angle) out.rad = *value, has_angle = true;
        else out.mm = *value, has_length = true;
      }
    }
  }
  const bool has_units = context.is(representation_context, Entity::GlobalUnitAssignedContext);
  out.is_known = has_length;
  if (!has_length) {
    if (context.assume_unit) out.mm = millimetres_per(*context.assume_unit);
    if (has_units)
      context.add(representation_context, sr::units, Severity::Warning,
                  fmt::format("no usable length unit; {} is taken", context.assume_unit ? to_string(*context.assume_unit) : "mm"));
  }
  out.unit = nearest_unit(out.mm);
  if (!r) return out;
  for (const Ref ref : r->uncertainties) {
    const Record* claim = context.find(ref);
    const auto measure = claim && context.is(*claim, Entity::MeasureWithUnit) ? context.read<step::MeasureRecord>(*claim) : std::nullopt;
    if (!measure || measure->value.type == "PLANE_ANGLE_MEASURE" || measure->value.kind != step::Select::Kind::Number) continue;
    const Record* unit = context.find(measure->unit);
    if (unit && context.is(*unit, Entity::PlaneAngleUnit)) continue;
    const auto mm = unit && context.is(*unit, Entity::NamedUnit) ? unit_value(context, *unit, false) : std::nullopt;
    const double value = measure->value.number * mm.value_or(out.mm);
    if (!(value > 0) || !(value < 100)) {
      context.add(*claim, sr::uncertainty, "the stated uncertainty cannot be meant; a micrometre is taken", value, 100).unit = "mm";
      continue;
    }
    // A claim of the sender, not a licence: coarser ones are not believed (iges-step-facts 7.9.13).
    out.uncertainty_mm = std::clamp(value, 1e-6, 1e-2);
    break;
  }
  return out;
}

}  // namespace trimloop::io::step_import
