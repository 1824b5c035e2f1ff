#include "formats/ply/ply.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>

namespace trimloop::ply {

static_assert(std::endian::native == std::endian::little, "PLY is written as binary_little_endian from memory");

Result<std::string> write(const Document& document) {
  if (document.positions.size() > 0x7fffffffu) {
    return fail(ErrorCode::Limit, "PLY vertex indices are signed 32-bit", static_cast<double>(document.positions.size()),
                2147483647.0);
  }
  const bool coloured = !document.colours.empty();
  std::string out = "ply\nformat binary_little_endian 1.0\n";
  if (!document.comment.empty()) out += fmt::format("comment {}\n", document.comment);
  out += fmt::format("element vertex {}\nproperty double x\nproperty double y\nproperty double z\n",
                     document.positions.size());
  out += fmt::format("element face {}\nproperty list uchar int vertex_indices\n", document.triangles.size());
  if (coloured) out += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  out += "end_header\n";

  const std::size_t head = out.size();
  const std::size_t face_size = 13 + (coloured ? 3 : 0);
  out.resize(head + 24 * document.positions.size() + face_size * document.triangles.size());
  char* at = out.data() + head;
  for (const auto& p : document.positions) {
    std::memcpy(at, p.data(), 24);
    at += 24;
  }
  for (std::size_t i = 0; i < document.triangles.size(); ++i) {
    *at = 3;
    std::memcpy(at + 1, document.triangles[i].data(), 12);
    if (coloured) std::memcpy(at + 13, document.colours[i].data(), 3);
    at += face_size;
  }
  return out;
}

}  // namespace trimloop::ply
