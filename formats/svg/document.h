#pragma once
// The outlines of an SVG drawing: paths, lines, polylines, polygons, rectangles, circles and ellipses, each with the
// matrix of its groups. Text, images, styles and references are counted, not drawn.

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/limits.h"
#include "formats/svg/path.h"

namespace trimloop::svg {

using Matrix = std::array<double, 6>;  // x' = a x + c y + e, y' = b x + d y + f
inline constexpr Matrix identity{1, 0, 0, 1, 0, 0};

struct Outline {
  std::string id;
  std::string element;      // "path", "circle", ...
  std::vector<Segment> path;
  Matrix matrix = identity;
  std::size_t offset = 0;   // of the element in the file, bytes
};

struct Fault {
  std::string text;
  std::string element;
  std::size_t offset = 0;
};

struct Document {
  std::vector<Outline> outlines;
  double user_unit_mm = 1;               // 1 unless the drawing states a physical size and a view box
  std::map<std::string, std::size_t> left_out;  // elements that hold no outline: name -> count
  std::vector<Fault> faults;             // elements that could not be read; the others are there
};

// InvalidArgument when the text is no XML or its root no <svg>; `measured` is the byte offset.
Result<Document> parse(std::string_view text, const Limits&);
// Is this the beginning of an SVG document?
bool sniff(std::string_view first_bytes);

}  // namespace trimloop::svg
