#pragma once
// The word for a shape in reports and pages.

#include <string_view>

#include "kernel/geometry/surface.h"

namespace trimloop::io {

inline std::string_view shape_word(const Curve& curve) {
  static constexpr std::string_view words[] = {"line",     "circle", "ellipse",      "parabola",       "hyperbola",
                                               "polyline", "NURBS",  "offset curve", "composite curve"};
  static_assert(std::size(words) == std::variant_size_v<decltype(Curve::shape)>);
  return words[curve.shape.index()];
}
inline std::string_view shape_word(const Surface& surface) {
  static constexpr std::string_view words[] = {"plane",      "cylinder",  "cone",  "sphere", "torus",
                                               "revolution", "extrusion", "ruled", "offset", "NURBS"};
  static_assert(std::size(words) == std::variant_size_v<decltype(Surface::shape)>);
  return words[surface.shape.index()];
}

}  // namespace trimloop::io
