// Loop 1987; creases and borders as Hoppe et al. 1994.
#include "kernel/subdivision/limit.h"
#include "kernel/subdivision/rules.h"

namespace trimloop::subdivision {

double loop_beta(std::size_t valence) {
  if (valence == 6) return 1.0 / 16;
  if (valence == 3) return 3.0 / 16;
  const double n = static_cast<double>(valence), c = 3.0 / 8 + std::cos(two_pi / n) / 4;
  return (5.0 / 8 - c * c) / n;
}

namespace detail {

namespace {

Point edge_point(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t edge) {
  const Point middle = edge_middle(mesh, adj, edge);
  const double s = sharpness(adj, edge);
  if (s >= 1) return middle;
  const std::uint32_t h = adj.edge_half[edge], t = adj.twin[h];
  Mean mean;
  mean.add(3, mesh.points[mesh.corners[h]]);
  mean.add(3, mesh.points[mesh.corners[t]]);
  mean.add(1, mesh.points[mesh.corners[adj.before[h]]]);
  mean.add(1, mesh.points[mesh.corners[adj.before[t]]]);
  return s > 0 ? mean.point() + s * (middle - mean.point()) : mean.point();
}

Point smooth_vertex(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t v) {
  const auto around = outgoing(adj, v);
  const double beta = loop_beta(around.size());
  Mean mean;
  mean.add(1 - static_cast<double>(around.size()) * beta, mesh.points[v]);
  for (const std::uint32_t h : around) mean.add(beta, mesh.points[mesh.corners[adj.next[h]]]);
  return mean.point();
}

}  // namespace

ControlMesh loop(const ControlMesh& mesh, const Adjacency& adj) {
  std::vector<Point> vertices, edges;
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    const bool used = adj.out[v] != Adjacency::none, inner = used && adj.border_in[v] == Adjacency::none;
    const Point smooth = inner ? smooth_vertex(mesh, adj, v) : mesh.points[v];
    vertices.push_back(used ? crease_vertex(mesh, adj, v, smooth) : mesh.points[v]);
  }
  for (std::uint32_t e = 0; e < adj.edge_half.size(); ++e) edges.push_back(edge_point(mesh, adj, e));
  return split_triangles(mesh, adj, std::move(vertices), edges);
}

}  // namespace detail
}  // namespace trimloop::subdivision
