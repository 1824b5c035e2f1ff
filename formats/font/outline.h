#pragma once
// Glyph outlines of a font file (TrueType, OpenType, Type 1; read by FreeType) in font units: whole numbers, parabolas
// or cubics as the font has them, y upwards.

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace trimloop::font {

struct Segment {
  enum class Kind : std::uint8_t { Move, Line, Quad, Cubic, Close };
  Kind kind = Kind::Move;
  std::array<std::array<double, 2>, 3> at{};  // control points, then the end
};

struct Line {
  std::vector<Segment> path;  // of all glyphs, closed subpaths
  double units_per_em = 1000;
  double width = 0;                // where the next glyph would begin
  std::vector<char32_t> missing;   // characters without a glyph; their place is left empty
};

// `text` is UTF-8, set on one line with the font's own advances and kerning. InvalidArgument when the bytes are no font
// that can be read; Unsupported for fonts without outlines.
Result<Line> outline(std::string_view font_bytes, std::string_view text);
bool sniff(std::string_view first_bytes);

}  // namespace trimloop::font
