#pragma once
// The one place that touches the disk.

#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"

namespace trimloop::io {

// The whole file. Io with the system's reason; Limit above `max_bytes`.
Result<std::string> load(const std::filesystem::path& path, std::size_t max_bytes);

}  // namespace trimloop::io
