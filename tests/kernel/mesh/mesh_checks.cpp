#include "tests/kernel/mesh/mesh_checks.h"

#include <cstring>
#include <set>

#include "kernel/mesh/distance.h"

namespace trimloop::test {
namespace {

using mesh::distance_to_segment;
using mesh::FaceMesh;

struct Corners {
  Point a, b, c;
};

double distance_to(Point p, const Corners& t) {
  const Vector n = cross(t.b - t.a, t.c - t.a), d = p - t.a;
  const double nn = dot(n, n);
  if (nn > 0) {
    const double w = dot(cross(t.b - t.a, d), n) / nn, v = dot(cross(d, t.c - t.a), n) / nn;
    if (v >= 0 && w >= 0 && v + w <= 1) return std::abs(dot(d, n)) / std::sqrt(nn);
  }
  return std::min({distance_to_segment(p, t.a, t.b), distance_to_segment(p, t.b, t.c), distance_to_segment(p, t.c, t.a)});
}

class FaceCheck {
 public:
  FaceCheck(const Surface& surface, const mesh::BodyMesh& mesh, const FaceMesh& face) : surface_(surface), face_(face) {
    around_.resize(face.vertices.size());
    for (std::size_t t = 0; t < face.triangles.size(); ++t) {
      const auto& v = face.triangles[t];
      for (const std::uint32_t i : v) around_[i].push_back(t);
      corners_.push_back({mesh.points[face.vertices[v[0]].point], mesh.points[face.vertices[v[1]].point],
                          mesh.points[face.vertices[v[2]].point]});
    }
  }

  // Each sample against its own triangle, and where that is not near enough against two rings around it.
  double deviation(std::size_t t) const {
    constexpr int n = 10;
    const auto& v = face_.triangles[t];
    const std::vector<std::size_t> near = rings(t);
    double worst = 0;
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) {
        const double a = i / double{n}, b = j / double{n}, c = 1 - a - b;
        const Uv p = face_.vertices[v[0]].uv, q = face_.vertices[v[1]].uv, r = face_.vertices[v[2]].uv;
        const Point at = evaluate(surface_, {a * p.u + b * q.u + c * r.u, a * p.v + b * q.v + c * r.v});
        double d = distance_to(at, corners_[t]);
        if (d > worst)
          for (const std::size_t k : near) d = std::min(d, distance_to(at, corners_[k]));
        worst = std::max(worst, d);
      }
    }
    return worst;
  }

  const Corners& corners(std::size_t t) const { return corners_[t]; }

 private:
  std::vector<std::size_t> rings(std::size_t t) const {
    std::set<std::size_t> found{t};
    for (int ring = 0; ring < 2; ++ring) {
      const std::set<std::size_t> known = found;
      for (const std::size_t k : known)
        for (const std::uint32_t v : face_.triangles[k]) found.insert(around_[v].begin(), around_[v].end());
    }
    return {found.begin(), found.end()};
  }

  const Surface& surface_;
  const FaceMesh& face_;
  std::vector<std::vector<std::size_t>> around_;
  std::vector<Corners> corners_;
};

}  // namespace

MeshFacts measure(const Body& body, const mesh::BodyMesh& mesh) {
  MeshFacts facts;
  std::set<std::array<std::uint32_t, 3>> seen;
  for (const FaceMesh& face : mesh.faces) {
    if (face.triangles.empty()) continue;
    const FaceCheck check(*body[face.face].surface, mesh, face);
    for (std::size_t t = 0; t < face.triangles.size(); ++t) {
      const auto& v = face.triangles[t];
      const Corners& c = check.corners(t);
      const Vector n = cross(c.b - c.a, c.c - c.a);
      facts.area_mm2 += norm(n) / 2;
      facts.volume_mm3 += dot(to_vector(c.a), n) / 6;
      Vector normals;
      std::array<std::uint32_t, 3> points;
      for (std::size_t i = 0; i < 3; ++i) {
        const Vector here = face.vertices[v[i]].normal, next = face.vertices[v[(i + 1) % 3]].normal;
        normals += here;
        points[i] = face.vertices[v[i]].point;
        facts.turn_rad = std::max(facts.turn_rad, mesh::angle_between(here, next));
      }
      std::sort(points.begin(), points.end());
      facts.turned_over += !(dot(n, normals) > 0);
      facts.degenerate += points[0] == points[1] || points[1] == points[2] || !(norm(n) > 0);
      facts.duplicates += !seen.insert(points).second;
      facts.deviation_mm = std::max(facts.deviation_mm, check.deviation(t));
    }
  }
  std::set<std::uint32_t> points;
  const std::vector<mesh::SideUse> sides = mesh::sides(mesh);
  for (const mesh::SideUse& side : sides) points.insert(side.a), points.insert(side.b);
  facts.triangles = mesh.triangle_count();
  facts.euler = static_cast<long>(points.size()) - static_cast<long>(sides.size()) + static_cast<long>(facts.triangles);
  return facts;
}

bool same_bytes(const mesh::BodyMesh& a, const mesh::BodyMesh& b) {
  const auto same = [](const auto& x, const auto& y) {
    return x.size() == y.size() && (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0);
  };
  if (!same(a.points, b.points) || a.faces.size() != b.faces.size() || a.edges.size() != b.edges.size()) return false;
  for (std::size_t i = 0; i < a.faces.size(); ++i) {
    const FaceMesh &f = a.faces[i], &g = b.faces[i];
    if (f.vertices.size() != g.vertices.size() || !same(f.triangles, g.triangles) || f.bound_mm != g.bound_mm) return false;
    for (std::size_t k = 0; k < f.vertices.size(); ++k) {
      const mesh::FaceVertex &v = f.vertices[k], &w = g.vertices[k];
      if (v.point != w.point || std::memcmp(&v.uv, &w.uv, sizeof v.uv) != 0 ||
          std::memcmp(&v.normal, &w.normal, sizeof v.normal) != 0)
        return false;
    }
  }
  for (std::size_t i = 0; i < a.edges.size(); ++i)
    if (!same(a.edges[i].points, b.edges[i].points) || !same(a.edges[i].parameters, b.edges[i].parameters)) return false;
  return true;
}

}  // namespace trimloop::test
