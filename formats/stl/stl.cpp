#include "formats/stl/stl.h"

#include <bit>
#include <cstring>

namespace trimloop::stl {

static_assert(std::endian::native == std::endian::little, "STL is written as it lies in memory");

Result<std::string> write(std::span<const Triangle> triangles, std::string_view header) {
  if (triangles.size() > 0xffffffffu) {
    return fail(ErrorCode::Limit, "STL counts triangles in 32 bits", static_cast<double>(triangles.size()), 4294967295.0);
  }
  constexpr std::size_t header_size = 80, triangle_size = 50;
  std::string out(header_size + 4 + triangle_size * triangles.size(), '\0');
  std::memcpy(out.data(), header.data(), std::min(header.size(), header_size));
  const auto count = static_cast<std::uint32_t>(triangles.size());
  std::memcpy(out.data() + header_size, &count, 4);
  char* at = out.data() + header_size + 4;
  for (const Triangle& t : triangles) {
    std::memcpy(at, t.normal.data(), 12);
    std::memcpy(at + 12, t.corners.data(), 36);
    at += triangle_size;  // the attribute word stays zero
  }
  return out;
}

}  // namespace trimloop::stl
