#pragma once
// One self-contained HTML page of a meshed model: no request leaves it. The script (viewer/, bundled at build time) is
// given by the caller; the scene is JSON in the page:
//   size; bodies[{name, placements[16 numbers], positions, normals, triangles, edges (base64 of little-endian arrays),
//   faces[{id, source, name, surface, status, reason, colour, first_vertex, vertices, first_triangle, triangles, bound,
//   loops[[u, v, ...]]}]}], annotation[{kind, source, colour, strokes (base64, pairs of points), texts[{text, at, along, up}]}]

#include <string>

#include "io/mesh/scene.h"

namespace trimloop::io {

Result<std::string> to_page(const Model& model, const SourceInfo& source, const Scene& scene, std::string_view script);

}  // namespace trimloop::io
