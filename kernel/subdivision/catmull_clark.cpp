// Catmull and Clark 1978; seed 000 §6.2 with R the mean of the edges' own middles.
#include <array>

#include "kernel/subdivision/rules.h"

namespace trimloop::subdivision::detail {

namespace {

Point edge_point(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t edge, const std::vector<Point>& centres) {
  const std::uint32_t h = adj.edge_half[edge];
  const Point middle = edge_middle(mesh, adj, edge);
  const double s = sharpness(adj, edge);
  if (s >= 1) return middle;
  Mean mean;
  mean.add(1, mesh.points[mesh.corners[h]]);
  mean.add(1, mesh.points[mesh.corners[adj.next[h]]]);
  mean.add(1, centres[adj.face[h]]);
  mean.add(1, centres[adj.face[adj.twin[h]]]);
  return s > 0 ? mean.point() + s * (middle - mean.point()) : mean.point();
}

// (F + 2R + (n - 3) P) / n.
Point smooth_vertex(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t vertex, const std::vector<Point>& centres) {
  Mean faces, middles;
  for (const std::uint32_t h : outgoing(adj, vertex)) {
    faces.add(1, centres[adj.face[h]]);
    middles.add(1, edge_middle(mesh, adj, adj.edge[h]));
  }
  const double n = faces.weight;
  Mean mean;
  mean.add(1, faces.point());
  mean.add(2, middles.point());
  mean.add(n - 3, mesh.points[vertex]);
  return mean.point();
}

}  // namespace

ControlMesh catmull_clark(const ControlMesh& mesh, const Adjacency& adj) {
  ControlMesh out;
  const std::size_t faces = mesh.face_count(), vertices = mesh.points.size();
  std::vector<Point> centres(faces);
  for (std::size_t f = 0; f < faces; ++f) centres[f] = face_centre(mesh, f);
  std::vector<std::uint32_t> vertex_at(vertices), edge_at(adj.edge_half.size());
  for (std::uint32_t v = 0; v < vertices; ++v) {
    vertex_at[v] = v;
    const bool inner = adj.out[v] != Adjacency::none && adj.border_in[v] == Adjacency::none;
    const Point smooth = inner ? smooth_vertex(mesh, adj, v, centres) : mesh.points[v];
    out.points.push_back(adj.out[v] == Adjacency::none ? mesh.points[v] : crease_vertex(mesh, adj, v, smooth));
  }
  for (std::uint32_t e = 0; e < edge_at.size(); ++e) {
    edge_at[e] = static_cast<std::uint32_t>(out.points.size());
    out.points.push_back(edge_point(mesh, adj, e, centres));
  }
  const auto first_centre = static_cast<std::uint32_t>(out.points.size());
  out.points.insert(out.points.end(), centres.begin(), centres.end());
  for (std::uint32_t h = 0; h < mesh.corners.size(); ++h)
    out.add_face(std::array{mesh.corners[h], edge_at[adj.edge[h]], first_centre + adj.face[h], edge_at[adj.edge[adj.before[h]]]});
  out.creases = halved_creases(mesh, adj, vertex_at, edge_at);
  out.fixed = mesh.fixed;
  out.rounded = mesh.rounded;
  return out;
}

}  // namespace trimloop::subdivision::detail
