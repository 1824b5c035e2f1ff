#include "formats/gltf/glb.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

namespace trimloop::glb {

static_assert(std::endian::native == std::endian::little, "GLB buffers are written as they lie in memory");

namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20) {
      out += fmt::format("\\u{:04x}", byte);
    } else if (byte >= 0x80) {
      // Names come as bytes of no stated encoding; Latin-1 keeps each of them visible and the JSON valid UTF-8.
      out += static_cast<char>(0xc0 | (byte >> 6));
      out += static_cast<char>(0x80 | (byte & 0x3f));
    } else {
      out += c;
    }
  }
  out += '"';
  return out;
}

template <class T>
std::size_t append(std::string& buffer, const std::vector<T>& values) {
  const std::size_t offset = buffer.size();
  buffer.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  return offset;
}

// Collects the JSON arrays of a document while the binary buffer grows.
struct Builder {
  std::string buffer, views, accessors, meshes, materials;
  std::size_t view_count = 0, accessor_count = 0;
  std::vector<std::array<double, 4>> colours;

  std::size_t view(std::size_t offset, std::size_t length, int target) {
    views += fmt::format("{}{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{},\"target\":{}}}", view_count ? "," : "",
                         offset, length, target);
    return view_count++;
  }
  std::size_t accessor(std::size_t view_index, int component, std::size_t count, const char* type,
                       const std::string& bounds) {
    accessors += fmt::format("{}{{\"bufferView\":{},\"componentType\":{},\"count\":{},\"type\":\"{}\"{}}}",
                             accessor_count ? "," : "", view_index, component, count, type, bounds);
    return accessor_count++;
  }
  std::size_t material(const std::array<double, 4>& colour) {
    const auto found = std::find(colours.begin(), colours.end(), colour);
    if (found != colours.end()) return static_cast<std::size_t>(found - colours.begin());
    materials += fmt::format(
        "{}{{\"pbrMetallicRoughness\":{{\"baseColorFactor\":[{},{},{},{}],\"metallicFactor\":0.1,"
        "\"roughnessFactor\":0.6}},\"doubleSided\":true}}",
        colours.empty() ? "" : ",", colour[0], colour[1], colour[2], colour[3]);
    colours.push_back(colour);
    return colours.size() - 1;
  }

  std::string primitive(const Primitive& p) {
    std::array<float, 3> lo, hi;
    lo.fill(std::numeric_limits<float>::max());
    hi.fill(std::numeric_limits<float>::lowest());
    for (const auto& q : p.positions) {
      for (std::size_t k = 0; k < 3; ++k) lo[k] = std::min(lo[k], q[k]), hi[k] = std::max(hi[k], q[k]);
    }
    constexpr int array_buffer = 34962, element_array_buffer = 34963, type_float = 5126, type_uint = 5125;
    const std::size_t n = p.positions.size();
    const std::string bounds =
        fmt::format(",\"min\":[{},{},{}],\"max\":[{},{},{}]", lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]);
    const auto position = accessor(view(append(buffer, p.positions), 12 * n, array_buffer), type_float, n, "VEC3", bounds);
    const auto normal = accessor(view(append(buffer, p.normals), 12 * n, array_buffer), type_float, n, "VEC3", "");
    const auto index = accessor(view(append(buffer, p.triangles), 12 * p.triangles.size(), element_array_buffer),
                                type_uint, 3 * p.triangles.size(), "SCALAR", "");
    std::string out = fmt::format("{{\"attributes\":{{\"POSITION\":{},\"NORMAL\":{}}},\"indices\":{}", position, normal, index);
    if (p.colour) out += fmt::format(",\"material\":{}", material(*p.colour));
    if (!p.name.empty()) out += fmt::format(",\"extras\":{{\"name\":{}}}", quoted(p.name));
    out += '}';
    return out;
  }
};

std::string nodes_json(const Document& document) {
  std::string out;
  for (const Node& node : document.nodes) {
    out += fmt::format("{}{{\"name\":{},\"matrix\":[{}]", out.empty() ? "" : ",", quoted(node.name),
                       fmt::join(node.matrix, ","));
    if (node.mesh) out += fmt::format(",\"mesh\":{}", *node.mesh);
    if (!node.children.empty()) out += fmt::format(",\"children\":[{}]", fmt::join(node.children, ","));
    out += "}";
  }
  return out;
}

void append_chunk(std::string& out, std::uint32_t type, std::string body, char padding) {
  while (body.size() % 4) body += padding;
  const auto size = static_cast<std::uint32_t>(body.size());
  out.append(reinterpret_cast<const char*>(&size), 4);
  out.append(reinterpret_cast<const char*>(&type), 4);
  out += body;
}

}  // namespace

Result<std::string> write(const Document& document) {
  Builder builder;
  for (const Mesh& mesh : document.meshes) {
    std::string primitives;
    for (const Primitive& p : mesh.primitives) {
      if (p.triangles.empty()) continue;
      if (p.normals.size() != p.positions.size()) {
        return fail(ErrorCode::InvalidArgument, "a glTF primitive has one normal per position");
      }
      primitives += fmt::format("{}{}", primitives.empty() ? "" : ",", builder.primitive(p));
    }
    if (primitives.empty()) return fail(ErrorCode::InvalidArgument, "a glTF mesh needs at least one triangle");
    builder.meshes += fmt::format("{}{{\"name\":{},\"primitives\":[{}]}}", builder.meshes.empty() ? "" : ",",
                                  quoted(mesh.name), primitives);
  }

  std::string json = fmt::format("{{\"asset\":{{\"version\":\"2.0\",\"generator\":{}}}", quoted(document.generator));
  json += fmt::format(",\"scene\":0,\"scenes\":[{{{}}}]",
                      document.roots.empty() ? "" : fmt::format("\"nodes\":[{}]", fmt::join(document.roots, ",")));
  if (!document.nodes.empty()) json += fmt::format(",\"nodes\":[{}]", nodes_json(document));
  if (!builder.meshes.empty()) {
    json += fmt::format(",\"meshes\":[{}],\"accessors\":[{}],\"bufferViews\":[{}],\"buffers\":[{{\"byteLength\":{}}}]",
                        builder.meshes, builder.accessors, builder.views, builder.buffer.size());
  }
  if (!builder.materials.empty()) json += fmt::format(",\"materials\":[{}]", builder.materials);
  json += "}";

  std::string out("glTF\2\0\0\0\0\0\0\0", 12);
  append_chunk(out, 0x4E4F534A, std::move(json), ' ');
  if (!builder.buffer.empty()) append_chunk(out, 0x004E4942, std::move(builder.buffer), '\0');
  if (out.size() > 0xffffffffu) {
    return fail(ErrorCode::Limit, "GLB counts bytes in 32 bits", static_cast<double>(out.size()), 4294967295.0);
  }
  const auto total = static_cast<std::uint32_t>(out.size());
  std::memcpy(out.data() + 8, &total, 4);
  return out;
}

}  // namespace trimloop::glb
