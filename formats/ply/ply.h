#pragma once
// Binary little-endian PLY with vertex normals and face colours.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"

namespace trimloop::ply {

struct Document {
  std::string comment;
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::uint8_t, 3>> colours;  // per triangle, or empty
};
Result<std::string> write(const Document&);

}  // namespace trimloop::ply
