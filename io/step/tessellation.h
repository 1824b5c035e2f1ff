#pragma once
// Tessellated items (AP242) -> polygon meshes, free polylines and points. ISO 10303-42:2014 and later.

#include "io/step/geometry.h"
#include "io/step/read_styles.h"

namespace trimloop::io::step_import {

// Triangles of one item. Points with the same coordinates are one point, also when they come from several lists, so that
// faces that meet share their points by index. What cannot be used is left out and said (SP-G32).
class MeshReader {
 public:
  MeshReader(Context& context, Geometry& geometry, const Styles& styles, Model& model)
      : context_(context), geometry_(geometry), styles_(styles), model_(model) {}

  // TESSELLATED_SOLID, TESSELLATED_SHELL, TESSELLATED_WIRE, a face or a surface set alone. Nothing after findings.
  std::optional<PolygonMesh> mesh(const Record& item);
  // TESSELLATED_CURVE_SET and TESSELLATED_POINT_SET into `part`.
  void lines(Part& part, const Record& item);

 private:
  struct Coordinates {
    std::vector<Point> points;
    std::vector<std::uint32_t> in_mesh;  // index into the mesh once used
  };
  struct SamePlace {
    std::size_t operator()(const Point& p) const;
    bool operator()(const Point& a, const Point& b) const { return a.x == b.x && a.y == b.y && a.z == b.z; }
  };

  Coordinates* coordinates(const Record& owner, Ref ref);
  std::uint32_t point(Coordinates& from, std::size_t index);
  void add_item(const Record& item, const Attributes& owner);
  void add_face(const Record& item, const Attributes& owner);
  void add_line(const Record& item, const Attributes& owner);
  Attributes attributes(const Record& item, const std::string& name, const Attributes& owner) const;
  std::optional<Transform> moved_by(const Record& item);

  Context& context_;
  Geometry& geometry_;
  const Styles& styles_;
  Model& model_;
  PolygonMesh mesh_;
  std::unordered_map<std::size_t, Coordinates> lists_;
  std::unordered_map<Point, std::uint32_t, SamePlace, SamePlace> places_;
};

// Role of a source that a mesh or its face stands for, beside its own.
inline constexpr std::uint8_t stands_for_role = 5;
// Sets PolygonMesh::stands_for and MeshFace::stands_for from the sources of that role: by the faces of the body, or by
// the body or shell that the mesh names. What they name outside their own part is not found.
void link_meshes(Model& model);

}  // namespace trimloop::io::step_import
