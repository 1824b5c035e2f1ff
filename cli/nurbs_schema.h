#pragma once
// docs/nurbs-schema.json, built into the program.

#include <string_view>

namespace trimloop::cli {
std::string_view nurbs_schema();
}
