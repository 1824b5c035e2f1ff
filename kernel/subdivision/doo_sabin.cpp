// Doo and Sabin 1978, and the two schemes of the same topology: seed 000's midpoint rule and mid-edge.
#include <array>

#include "kernel/subdivision/rules.h"

namespace trimloop::subdivision::detail {

namespace {

// New point of each corner of each face, at the corner's own index.
std::vector<Point> corner_points(const ControlMesh& mesh, bool midpoint_rule) {
  std::vector<Point> points;
  points.reserve(mesh.corners.size());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto corner = mesh.face(f);
    const std::size_t n = corner.size();
    const Point centre = face_centre(mesh, f);
    for (std::size_t i = 0; i < n; ++i) {
      if (midpoint_rule) {
        points.push_back(midpoint(mesh.points[corner[i]], centre));
        continue;
      }
      // (n + 5) / 4n for the corner itself, (3 + 2 cos(2 pi k / n)) / 4n for the k-th; 9, 3, 1, 3 of 16 for four.
      Mean mean;
      for (std::size_t k = 0; k < n; ++k) {
        const double cosine = n == 4 ? (k == 2 ? -1.0 : 0.0) : std::cos(two_pi * static_cast<double>(k) / static_cast<double>(n));
        const double weight = k == 0 ? static_cast<double>(n) + 5 : 3 + 2 * cosine;
        mean.add(weight, mesh.points[corner[(i + k) % n]]);
      }
      points.push_back(mean.point());
    }
  }
  return points;
}

}  // namespace

ControlMesh doo_sabin(const ControlMesh& mesh, const Adjacency& adj, bool midpoint_rule) {
  ControlMesh out;
  out.points = corner_points(mesh, midpoint_rule);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {  // a face inside each face
    std::vector<std::uint32_t> corners;
    for (std::uint32_t h = mesh.face_start[f]; h < mesh.face_start[f + 1]; ++h) corners.push_back(h);
    out.add_face(corners);
  }
  for (const std::uint32_t h : adj.edge_half) {  // a strip across each inner edge
    const std::uint32_t t = adj.twin[h];
    if (t != Adjacency::none) out.add_face(std::array{adj.next[h], h, adj.next[t], t});
  }
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {  // a face for each inner vertex
    if (adj.out[v] == Adjacency::none || adj.border_in[v] != Adjacency::none) continue;
    out.add_face(outgoing(adj, v));
  }
  return out;
}

ControlMesh mid_edge(const ControlMesh& mesh, const Adjacency& adj) {
  ControlMesh out;
  for (std::uint32_t e = 0; e < adj.edge_half.size(); ++e) out.points.push_back(edge_middle(mesh, adj, e));
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    std::vector<std::uint32_t> corners;
    for (std::uint32_t h = mesh.face_start[f]; h < mesh.face_start[f + 1]; ++h) corners.push_back(adj.edge[h]);
    out.add_face(corners);
  }
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    if (adj.out[v] == Adjacency::none || adj.border_in[v] != Adjacency::none) continue;
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t h : outgoing(adj, v)) corners.push_back(adj.edge[h]);
    out.add_face(corners);
  }
  return out;
}

}  // namespace trimloop::subdivision::detail
