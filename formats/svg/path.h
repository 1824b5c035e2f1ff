#pragma once
// SVG path data (SVG 1.1 §8.3) as absolute segments, and back. Absolute coordinates keep their bits both ways.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace trimloop::svg {

struct Segment {
  enum class Kind : std::uint8_t {
    Move,   // to at[0]
    Line,   // to at[0]
    Quad,   // by at[0] to at[1]
    Cubic,  // by at[0], at[1] to at[2]
    Arc,    // to at[0], with rx, ry, rotation in degrees and the two flags
    Close
  };
  Kind kind = Kind::Move;
  bool large = false, sweep = false;
  std::array<std::array<double, 2>, 3> at{};
  double rx = 0, ry = 0, rotation_deg = 0;
};

// Linear in the text. The error's `measured` is the offset of what was not understood.
Result<std::vector<Segment>> parse_path(std::string_view data);
std::string path_text(const std::vector<Segment>&);  // shortest numbers that read back equal
void append_path_text(std::string& out, const std::vector<Segment>&);

}  // namespace trimloop::svg
