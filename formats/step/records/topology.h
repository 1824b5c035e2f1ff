#pragma once
// Records of vertices, edges, loops, faces, shells and what is made of them (ISO 10303-42 5 and 6).

#include "formats/step/records/reader.h"

namespace trimloop::step {

struct VertexPoint {
  static constexpr Entity type = Entity::VertexPoint;
  Ref point;
  static VertexPoint read(Reader&);
};
struct EdgeCurve {
  static constexpr Entity type = Entity::EdgeCurve;
  Ref start, end, curve;
  bool same_sense = true;
  static EdgeCurve read(Reader&);
};
struct Oriented {  // ORIENTED_EDGE, ORIENTED_FACE, ORIENTED_CLOSED_SHELL, ORIENTED_OPEN_SHELL
  static constexpr Entity type = Entity::OrientedEdge;
  Ref element;
  bool orientation = true;
  static Oriented read(Reader&);
};
struct LoopRecord {  // EDGE_LOOP: oriented edges; VERTEX_LOOP: one vertex; POLY_LOOP: points
  static constexpr Entity type = Entity::Path;
  std::vector<Ref> items;
  static LoopRecord read(Reader&);
};
struct FaceBound {
  static constexpr Entity type = Entity::FaceBound;
  Ref loop;
  bool orientation = true, is_outer = false;
  static FaceBound read(Reader&);
};
struct FaceRecord {  // FACE_SURFACE, ADVANCED_FACE; FACE: no surface
  static constexpr Entity type = Entity::Face;
  std::string name;
  std::vector<Ref> bounds;
  Ref surface;
  bool same_sense = true;
  static FaceRecord read(Reader&);
};
struct Members {  // the one list of a CLOSED_SHELL, OPEN_SHELL, SHELL_BASED_SURFACE_MODEL, GEOMETRIC_SET, ...
  std::string name;
  std::vector<Ref> items;
  static Members read(Reader&);
};
struct SolidRecord {  // MANIFOLD_SOLID_BREP, FACETED_BREP, BREP_WITH_VOIDS
  static constexpr Entity type = Entity::ManifoldSolidBrep;
  std::string name;
  Ref outer;
  std::vector<Ref> voids;
  static SolidRecord read(Reader&);
};

}  // namespace trimloop::step
