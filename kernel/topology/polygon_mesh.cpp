#include "kernel/topology/polygon_mesh.h"

#include <algorithm>

namespace trimloop {
namespace {

template <class Use>
void for_each_triangle(const PolygonMesh& mesh, Use use) {
  for (const MeshFace& face : mesh.faces)
    for (std::size_t t = 0; t < face.triangles.size(); ++t) use(mesh.corners(face, t));
}

// Near the shape, so that the tetrahedra below its triangles cancel little.
Point inner_origin(const PolygonMesh& mesh) {
  const Box box = bounding_box(mesh);
  return box.empty() ? Point{} : midpoint(box.lo, box.hi);
}

// Six times the volume of the tetrahedron from the origin to the triangle.
double six_volumes(const std::array<Point, 3>& c, Point origin) {
  return dot(c[0] - origin, cross(c[1] - origin, c[2] - origin));
}

}  // namespace

std::size_t PolygonMesh::triangle_count() const {
  std::size_t count = 0;
  for (const MeshFace& face : faces) count += face.triangles.size();
  return count;
}

std::array<Point, 3> PolygonMesh::corners(const MeshFace& face, std::size_t triangle) const {
  const auto& t = face.triangles[triangle];
  return {points[face.vertices[t[0]].point], points[face.vertices[t[1]].point], points[face.vertices[t[2]].point]};
}

double area(const PolygonMesh& mesh) {
  double twice = 0;
  for_each_triangle(mesh, [&](const std::array<Point, 3>& c) { twice += norm(cross(c[1] - c[0], c[2] - c[0])); });
  return 0.5 * twice;
}

Box bounding_box(const PolygonMesh& mesh) {
  Box box;
  for_each_triangle(mesh, [&](const std::array<Point, 3>& c) {
    for (const Point p : c) box.add(p);
  });
  for (const MeshLine& line : mesh.lines)
    for (const std::uint32_t p : line.points) box.add(mesh.points[p]);
  return box;
}

std::size_t open_sides(const PolygonMesh& mesh) {
  struct Side {
    std::uint64_t ends;
    int direction;
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangle_count());
  for (const MeshFace& face : mesh.faces) {
    for (const auto& t : face.triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint64_t a = face.vertices[t[i]].point, b = face.vertices[t[(i + 1) % 3]].point;
        sides.push_back({std::min(a, b) << 32 | std::max(a, b), a < b ? 1 : -1});
      }
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.ends < b.ends; });
  std::size_t open = 0;
  for (std::size_t i = 0; i < sides.size();) {
    int sum = 0;
    std::size_t end = i;
    for (; end < sides.size() && sides[end].ends == sides[i].ends; ++end) sum += sides[end].direction;
    open += static_cast<std::size_t>(std::abs(sum));
    i = end;
  }
  return open;
}

Result<double> volume(const PolygonMesh& mesh) {
  if (const std::size_t open = open_sides(mesh))
    return fail(ErrorCode::Degenerate, "an open mesh has no volume", static_cast<double>(open), 0);
  const Point origin = inner_origin(mesh);
  double sum = 0;
  for_each_triangle(mesh, [&](const std::array<Point, 3>& c) { sum += six_volumes(c, origin); });
  return sum / 6;
}

Result<Point> centroid(const PolygonMesh& mesh) {
  const auto whole = volume(mesh);
  if (!whole) return tl::unexpected(whole.error());
  const Point origin = inner_origin(mesh);
  Vector moment;
  for_each_triangle(mesh, [&](const std::array<Point, 3>& c) {
    moment += six_volumes(c, origin) / 24 * ((c[0] - origin) + (c[1] - origin) + (c[2] - origin));
  });
  const Vector from_origin = moment / *whole;
  if (!(std::abs(*whole) > 0) || !is_finite(from_origin)) return fail(ErrorCode::Degenerate, "a mesh without volume has no centre");
  return origin + from_origin;
}

std::vector<std::string> broken_promises(const PolygonMesh& mesh) {
  std::vector<std::string> out;
  for (const MeshFace& face : mesh.faces) {
    for (const MeshVertex& v : face.vertices)
      if (v.point >= mesh.points.size()) out.push_back("a vertex names a point that does not exist");
    for (const auto& t : face.triangles) {
      if (*std::max_element(t.begin(), t.end()) >= face.vertices.size()) out.push_back("a triangle names a vertex that does not exist");
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) out.push_back("a triangle names one vertex twice");
    }
  }
  for (const MeshLine& line : mesh.lines)
    for (const std::uint32_t p : line.points)
      if (p >= mesh.points.size()) out.push_back("a line names a point that does not exist");
  return out;
}

}  // namespace trimloop
