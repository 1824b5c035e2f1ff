#include "io/step/mesh_writer.h"

#include <algorithm>

namespace trimloop::io::step_export {

namespace {

InstanceId write_coordinates(EntityWriter& w, const PolygonMesh& mesh, double scale) {
  std::vector<std::array<double, 3>> points;
  points.reserve(mesh.points.size());
  for (const Point& p : mesh.points) {
    const Point q = w.units.point(to_point(scale * to_vector(p)));
    points.push_back({q.x, q.y, q.z});
  }
  return w.out.add("COORDINATES_LIST", "", points.size(), points);
}

// Triangles name positions in the face's own list of points; normals stand beside that list, all or none.
InstanceId write_face(EntityWriter& w, const MeshFace& face, InstanceId coordinates, bool mirrored, InstanceId link) {
  std::vector<std::size_t> points;
  std::vector<std::array<double, 3>> normals;
  for (const MeshVertex& v : face.vertices) {
    points.push_back(v.point + std::size_t{1});
    const Vector n = mirrored ? -v.normal : v.normal;
    if (dot(n, n) > 0) normals.push_back({n.x, n.y, n.z});
  }
  if (normals.size() != points.size()) normals.clear();
  std::vector<std::array<std::size_t, 3>> triangles;
  triangles.reserve(face.triangles.size());
  for (const auto& t : face.triangles) {
    triangles.push_back({t[0] + std::size_t{1}, t[mirrored ? 2 : 1] + std::size_t{1}, t[mirrored ? 1 : 2] + std::size_t{1}});
  }
  const std::string name = face.attributes ? w.model[face.attributes].name : std::string();
  return w.out.add("TRIANGULATED_FACE", name, coordinates, points.size(), normals, link, points, triangles);
}

}  // namespace

WrittenMesh write_mesh(EntityWriter& w, const PolygonMesh& mesh, double scale, const WrittenBody* body) {
  WrittenMesh out;
  const InstanceId coordinates = write_coordinates(w, mesh, scale);
  std::vector<InstanceId> items;
  for (const MeshFace& f : mesh.faces) {
    InstanceId link;
    if (body && f.stands_for) {
      const auto at = std::find_if(body->faces.begin(), body->faces.end(), [&](const WrittenFace& g) { return g.face == f.stands_for; });
      if (at != body->faces.end()) link = at->id;
    }
    items.push_back(write_face(w, f, coordinates, scale < 0, link));
    out.faces.push_back({items.back(), f.attributes});
  }
  for (const MeshLine& line : mesh.lines) {
    std::vector<std::size_t> strip;
    for (const std::uint32_t p : line.points) strip.push_back(p + std::size_t{1});
    items.push_back(w.out.add("TESSELLATED_EDGE", "", coordinates, InstanceId{}, strip));
  }
  const std::string name = mesh.attributes ? w.model[mesh.attributes].name : std::string();
  InstanceId solid, shell;
  if (body && body->solids.size() == 1) solid = body->solids.front();
  if (body && body->shells.size() == 1) shell = body->shells.front().id;
  if (mesh.kind == BodyKind::Solid) out.id = w.out.add("TESSELLATED_SOLID", name, items, solid);
  else if (mesh.kind == BodyKind::Sheet) out.id = w.out.add("TESSELLATED_SHELL", name, items, shell);
  else out.id = w.out.add("TESSELLATED_WIRE", name, items, InstanceId{});
  return out;
}

}  // namespace trimloop::io::step_export
