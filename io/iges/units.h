#pragma once
// What a file's numbers mean in millimetres (Global parameters 13, 14, 15).

#include <optional>

#include "formats/iges/file.h"
#include "kernel/model/model.h"

namespace trimloop::io::iges_import {

struct FileUnit {
  LengthUnit unit = LengthUnit::Inch;
  bool known = true;      // false: neither flag nor name can be understood
  double scale = 1;       // mm per unit of the file, model space scale included
};

// Flag 1-11 decides; flag 3 asks the name. A unit that cannot be told (the Global section's IG-G15 or IG-G17 says so) is
// read as `assume`, else as millimetres.
FileUnit file_unit(const iges::Global& global, std::optional<LengthUnit> assume);

}  // namespace trimloop::io::iges_import
