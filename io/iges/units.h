#pragma once
// What a file's numbers mean in millimetres (Global parameters 13, 14, 15).

#include <optional>

#include "base/report.h"
#include "formats/iges/file.h"
#include "kernel/model/model.h"

namespace trimloop::io::iges_import {

struct FileUnit {
  LengthUnit unit = LengthUnit::Inch;
  bool known = true;      // false: neither flag nor name can be understood
  double scale = 1;       // mm per unit of the file, model space scale included
};

// Flag 1-11 decides; flag 3 asks the name. A flag that means nothing is IG-G15 and read as `assume`, else millimetres.
FileUnit file_unit(const iges::Global& global, std::optional<LengthUnit> assume, Report& report);

}  // namespace trimloop::io::iges_import
