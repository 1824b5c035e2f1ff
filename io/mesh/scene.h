#pragma once
// A model's triangles, ready to be flattened into a mesh format: each body meshed once, placed as often as it occurs.

#include "io/io.h"

namespace trimloop::io {

struct SceneBody {
  std::uint32_t part = 0, body = 0;  // into Model::parts and Part::bodies; is_given: Part::meshes
  bool is_given = false;             // the file gave the triangles
  mesh::BodyMesh mesh;
};
AttributesId attributes_of(const Model&, const SceneBody&);
AttributesId attributes_of(const Model&, const SceneBody&, const mesh::FaceMesh&);

struct Scene {
  std::vector<SceneBody> bodies;
  std::vector<Occurrence> occurrences;  // visible ones only
  double deflection_mm = 0;  // asked for
  double coarsened = 1;      // times that, to keep to the budget of triangles
};

// "0.05", "0.05mm" or "0.1%" of `diagonal_mm`.
Result<double> parse_deflection(std::string_view text, double diagonal_mm);
// Box of what is seen: faces of all occurrences.
Result<Box> visible_box(const Model& model, const Execution&);

Result<Scene> make_scene(const Model& model, const WriteOptions& options);
bool is_visible(const Model& model, AttributesId id);
// Fills faces, counts and bounds of a conversion report, one row per face per part.
void describe(const Model& model, const SourceInfo& source, const Scene& scene, WriteResult& result);

Result<std::string> to_stl(const Model&, const Scene&, double unit_mm);
Result<std::string> to_obj(const Model&, const Scene&, double unit_mm);
Result<std::string> to_ply(const Model&, const Scene&, double unit_mm);
Result<std::string> to_glb(const Model&, const Scene&);

}  // namespace trimloop::io
