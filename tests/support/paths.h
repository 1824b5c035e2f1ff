#pragma once
// Where this checkout and its build tree lie. Known to one source file only, so that every other object is the same in
// any checkout and a compiler cache can serve it.

#include <filesystem>

namespace trimloop::test {

const std::filesystem::path& source_dir();
const std::filesystem::path& binary_dir();

}  // namespace trimloop::test
