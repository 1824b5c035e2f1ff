#include "kernel/mesh/mesh.h"

#include <algorithm>

namespace trimloop::mesh {

std::size_t BodyMesh::triangle_count() const {
  std::size_t count = 0;
  for (const FaceMesh& face : faces) count += face.triangles.size();
  return count;
}

std::vector<SideUse> sides(const BodyMesh& mesh) {
  std::vector<std::uint64_t> keys;
  keys.reserve(3 * mesh.triangle_count());
  for (const FaceMesh& face : mesh.faces) {
    for (const auto& triangle : face.triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint64_t a = face.vertices[triangle[i]].point, b = face.vertices[triangle[(i + 1) % 3]].point;
        keys.push_back(std::min(a, b) << 32 | std::max(a, b));
      }
    }
  }
  std::sort(keys.begin(), keys.end());
  std::vector<SideUse> result;
  for (std::size_t i = 0; i < keys.size();) {
    std::size_t end = i;
    while (end < keys.size() && keys[end] == keys[i]) ++end;
    result.push_back({static_cast<std::uint32_t>(keys[i] >> 32), static_cast<std::uint32_t>(keys[i]),
                      static_cast<std::uint32_t>(end - i)});
    i = end;
  }
  return result;
}

std::size_t BodyMesh::open_edges() const {
  std::size_t open = 0;
  for (const SideUse& side : sides(*this)) open += side.uses == 1;
  return open;
}

}  // namespace trimloop::mesh
