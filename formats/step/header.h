#pragma once
// The header entities and the parameters of DATA sections, decoded.

#include "formats/step/file.h"

namespace trimloop::step {

struct HeaderEntity {
  std::size_t offset = 0, length = 0;  // without the ';'
};

Header read_header(std::string_view bytes, const std::vector<HeaderEntity>& entities, const Limits& limits, Report& report);

// ('name',('SCHEMA',...))
void read_data_parameters(std::string_view text, const Limits& limits, std::string& name, std::vector<std::string>& schemas);

}  // namespace trimloop::step
