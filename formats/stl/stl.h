#pragma once
// Binary STL: an 80-byte header, a count, and 50 bytes a triangle.

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "base/result.h"

namespace trimloop::stl {

struct Triangle {
  std::array<float, 3> normal;
  std::array<std::array<float, 3>, 3> corners;
};
// `header` is cut to 80 bytes and must not begin with "solid". Limit beyond 2^32 - 1 triangles.
Result<std::string> write(std::span<const Triangle> triangles, std::string_view header);

}  // namespace trimloop::stl
