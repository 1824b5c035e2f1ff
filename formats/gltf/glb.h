#pragma once
// glTF 2.0 binary (GLB): nodes, meshes with indexed triangles, materials by colour.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

namespace trimloop::glb {

struct Primitive {
  std::vector<std::array<float, 3>> positions, normals;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::optional<std::array<double, 4>> colour;  // linear RGBA
  std::string name;                             // goes to `extras`
};
struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
};
struct Node {
  std::string name;
  std::optional<std::size_t> mesh;
  std::array<double, 16> matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};  // column major
  std::vector<std::size_t> children;
};
struct Document {
  std::string generator;
  std::vector<Mesh> meshes;
  std::vector<Node> nodes;
  std::vector<std::size_t> roots;
};
Result<std::string> write(const Document&);

}  // namespace trimloop::glb
