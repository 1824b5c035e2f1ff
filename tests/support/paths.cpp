#include "tests/support/paths.h"

namespace trimloop::test {

const std::filesystem::path& source_dir() {
  static const std::filesystem::path path = TRIMLOOP_SOURCE_DIR;
  return path;
}

const std::filesystem::path& binary_dir() {
  static const std::filesystem::path path = TRIMLOOP_BINARY_DIR;
  return path;
}

}  // namespace trimloop::test
