#include "io/iges/units.h"

#include <cmath>

namespace trimloop::io::iges_import {
namespace {

std::optional<LengthUnit> unit_of_flag(int flag) {
  switch (flag) {
    case 1: return LengthUnit::Inch;
    case 2: return LengthUnit::Millimetre;
    case 4: return LengthUnit::Foot;
    case 5: return LengthUnit::Mile;
    case 6: return LengthUnit::Metre;
    case 7: return LengthUnit::Kilometre;
    case 8: return LengthUnit::Mil;
    case 9: return LengthUnit::Micron;
    case 10: return LengthUnit::Centimetre;
    case 11: return LengthUnit::MicroInch;
    default: return std::nullopt;
  }
}

}  // namespace

FileUnit file_unit(const iges::Global& global, std::optional<LengthUnit> assume) {
  FileUnit out;
  std::optional<LengthUnit> unit =
      global.unit_flag == 3 ? unit_from_name(global.unit_name) : unit_of_flag(global.unit_flag);
  if (!global.unit_known) unit.reset();
  out.known = unit || assume;
  out.unit = unit ? *unit : assume.value_or(LengthUnit::Millimetre);
  // Model space lengths divided by the scale are real lengths; a scale that is no number is IG-G14 and read as 1.
  const double scale = global.model_scale;
  out.scale = millimetres_per(out.unit);
  if (std::isnormal(scale) && scale > 0 && std::isnormal(out.scale / scale)) out.scale /= scale;
  return out;
}

}  // namespace trimloop::io::iges_import
