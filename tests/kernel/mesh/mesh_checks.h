#pragma once
// What must hold for the triangles of a body, measured without the mesher's own figures.

#include "kernel/mesh/tessellate.h"

namespace trimloop::test {

struct MeshFacts {
  double deviation_mm = 0;     // of the surface from the triangles, 66 samples per triangle
  double turn_rad = 0;         // largest turn of the normal along a side
  double area_mm2 = 0, volume_mm3 = 0;
  long euler = 0;              // points - sides + triangles, by index
  std::size_t triangles = 0;
  std::size_t turned_over = 0; // triangles against their normals
  std::size_t degenerate = 0;  // two equal points or no area
  std::size_t duplicates = 0;  // triangles of the same three points
};
MeshFacts measure(const Body&, const mesh::BodyMesh&);
bool same_bytes(const mesh::BodyMesh&, const mesh::BodyMesh&);

}  // namespace trimloop::test
