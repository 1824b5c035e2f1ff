#pragma once
// Wavefront OBJ: flat arrays in, text out.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"

namespace trimloop::obj {

struct Group {
  std::string name;
  std::vector<std::array<std::uint32_t, 3>> positions;  // indices from 0
  std::vector<std::array<std::uint32_t, 3>> normals;    // parallel to positions
};
struct Document {
  std::string comment;
  std::vector<std::array<double, 3>> positions, normals;
  std::vector<Group> groups;
};
Result<std::string> write(const Document&);

}  // namespace trimloop::obj
