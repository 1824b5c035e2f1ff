#pragma once
// Records of tessellated shapes (ISO 10303-42:2014 and later). Indices are those of the file, from 1.

#include <array>

#include "formats/step/records/reader.h"

namespace trimloop::step {

struct CoordinatesList {
  static constexpr Entity type = Entity::CoordinatesList;
  std::vector<std::array<double, 3>> points;
  static CoordinatesList read(Reader&);
};

// TRIANGULATED_FACE, TRIANGULATED_SURFACE_SET and their COMPLEX_ forms, told apart by the entity.
struct Triangulation {
  static constexpr Entity type = Entity::TessellatedItem;
  std::string name;
  Ref coordinates;
  std::int64_t pnmax = 0;
  std::vector<std::array<double, 3>> normals;  // none, one for all, or pnmax
  Ref link;                                    // of a face: what it stands for
  std::vector<int> pnindex;                    // local index -> index into the coordinates; empty: the same
  std::vector<std::vector<int>> triangles, strips, fans;
  static Triangulation read(Reader&);
};

// TESSELLATED_SOLID, TESSELLATED_SHELL, TESSELLATED_WIRE, TESSELLATED_GEOMETRIC_SET
struct TessellatedGroup {
  static constexpr Entity type = Entity::TessellatedItem;
  std::string name;
  std::vector<Ref> items;
  Ref link;
  static TessellatedGroup read(Reader&);
};

// TESSELLATED_CURVE_SET: strips; TESSELLATED_EDGE: one strip; TESSELLATED_POINT_SET: one strip that is no line
struct TessellatedLines {
  static constexpr Entity type = Entity::TessellatedItem;
  std::string name;
  Ref coordinates, link;
  std::vector<std::vector<int>> strips;
  static TessellatedLines read(Reader&);
};

}  // namespace trimloop::step
