#pragma once
// The control mesh in a Wavefront OBJ file: positions, polygons, and what stands for creases in the field (a line
// element `l` is an edge kept sharp). Texture and normal indices are passed over.

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/limits.h"
#include "base/result.h"

namespace trimloop::obj {

struct Polygons {
  std::vector<std::array<double, 3>> positions;
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> face_start{0};
  std::vector<std::array<std::uint32_t, 2>> lines;
  std::size_t passed_over = 0;  // lines of other kinds
};

// InvalidArgument names the line: fewer than three numbers, an index of nothing. Negative indices count back.
Result<Polygons> read(std::string_view text, const Limits&);

}  // namespace trimloop::obj
