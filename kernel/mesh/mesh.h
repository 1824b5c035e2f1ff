#pragma once
// Triangles of a body: one shared vertex table, so that faces that share an edge share its points by index.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "kernel/model/model.h"

namespace trimloop::mesh {

struct FaceVertex {
  std::uint32_t point = 0;  // into BodyMesh::points
  Uv uv;
  Vector normal;            // outward, unit, exact of the surface
};

enum class BoundKind : std::uint8_t { Proven, Sampled };

struct FaceMesh {
  FaceId face;
  std::vector<FaceVertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // into `vertices`, counter-clockwise seen from outside
  double bound_mm = 0;         // distance between the face and its triangles is at most this
  BoundKind bound_kind = BoundKind::Sampled;
  bool deflection_met = true;
  std::string reason;          // why there are no triangles, or why the bound was not met; empty when all is well
};

struct EdgePolyline {
  EdgeId edge;
  std::vector<std::uint32_t> points;   // into BodyMesh::points, from edge start to end
  std::vector<double> parameters;      // of the edge
};

struct BodyMesh {
  std::vector<Point> points;
  std::vector<FaceMesh> faces;         // one per face of the body, in order; failed ones are empty with a reason
  std::vector<EdgePolyline> edges;
  std::size_t triangle_count() const;
  std::size_t open_edges() const;      // triangle sides used once, by index
};

struct SideUse {
  std::uint32_t a = 0, b = 0;          // into BodyMesh::points, a < b
  std::uint32_t uses = 0;              // by triangles: 2 inside and along closed edges, 1 on a border
};
std::vector<SideUse> sides(const BodyMesh&);  // ascending by (a, b)

}  // namespace trimloop::mesh
