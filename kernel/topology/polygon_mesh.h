#pragma once
// PolygonMesh: a shape that its file gives as triangles, not an approximation that we make (kernel/mesh does that).
//
// Plain arrays with one point table for the whole shape, so that faces that share an edge share its points by index.
// A face is a group of triangles with a name and a colour of its own; it may stand for a face of a Body of the same
// part, whose triangles it then is. A mesh that stands for a body repeats it: it is counted and written, but neither
// measured nor shown beside the body.

#include <array>

#include "base/result.h"
#include "kernel/math/transform.h"
#include "kernel/topology/body.h"

namespace trimloop {

struct MeshVertex {
  std::uint32_t point = 0;  // into PolygonMesh::points
  Vector normal;            // unit, outward; zero where none is given
};

struct MeshFace {
  std::vector<MeshVertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // into `vertices`, counter-clockwise seen from outside
  FaceId stands_for;                                     // of the body that the mesh stands for
  AttributesId attributes;
  SourceRefs source;
};

struct MeshLine {  // a polyline beside the triangles: the polygon of an edge
  std::vector<std::uint32_t> points;  // into PolygonMesh::points
  AttributesId attributes;
  SourceRefs source;
};

using BodyIndex = Handle<struct BodyTag>;  // into Part::bodies

struct PolygonMesh {
  BodyKind kind = BodyKind::Sheet;  // what the file calls it: Solid promises a closed mesh (open_sides() says whether it is)
  std::vector<Point> points;
  std::vector<MeshFace> faces;
  std::vector<MeshLine> lines;
  BodyIndex stands_for;
  AttributesId attributes;
  SourceRefs source;

  std::size_t triangle_count() const;
  std::array<Point, 3> corners(const MeshFace& face, std::size_t triangle) const;
};

double area(const PolygonMesh&);
Box bounding_box(const PolygonMesh&);
// Sides of triangles without one that runs the other way between the same points; 0: closed and oriented.
std::size_t open_sides(const PolygonMesh&);
// Volume inside and its centre. Degenerate when the mesh is not closed; the centre also when it holds no volume.
Result<double> volume(const PolygonMesh&);
Result<Point> centroid(const PolygonMesh&);
// Indices out of range, triangles that name one point twice; as sentences, empty when all is well.
std::vector<std::string> broken_promises(const PolygonMesh&);

}  // namespace trimloop
