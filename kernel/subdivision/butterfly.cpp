// Butterfly: Dyn, Gregory and Levin 1990 (tension 1/16), with the rules of Zorin, Schröder and Sweldens 1996 at
// irregular vertices and the four-point rule (Dyn, Levin and Gregory 1987) along borders. Old points stay.
#include "kernel/subdivision/rules.h"

namespace trimloop::subdivision::detail {

namespace {

constexpr std::uint32_t none = Adjacency::none;

// Inner vertex: the weight of the k-th neighbour, counted from the edge in question; 3/4 for the vertex itself.
double irregular_weight(std::size_t valence, std::size_t k) {
  if (valence == 3) return k == 0 ? 5.0 / 12 : -1.0 / 12;
  if (valence == 4) return k == 0 ? 3.0 / 8 : k == 2 ? -1.0 / 8 : 0;
  const double n = static_cast<double>(valence), a = two_pi * static_cast<double>(k) / n;
  return (0.25 + std::cos(a) + 0.5 * std::cos(2 * a)) / n;
}

Point from_irregular(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t half) {
  const std::uint32_t v = mesh.corners[half];
  const auto around = outgoing(adj, v);
  std::size_t first = 0;
  while (around[first] != half) ++first;
  Mean mean;
  mean.add(0.75, mesh.points[v]);
  for (std::size_t k = 0; k < around.size(); ++k) {
    const std::uint32_t h = around[(first + k) % around.size()];
    mean.add(irregular_weight(around.size(), k), mesh.points[mesh.corners[adj.next[h]]]);
  }
  return mean.point();
}

// The point across the side `half` from the triangle that it belongs to; beyond a border, the mirror image of that
// triangle's own far corner in the side's middle.
Point wing(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t half) {
  const std::uint32_t t = adj.twin[half];
  if (t != none) return mesh.points[mesh.corners[adj.before[t]]];
  const Point a = mesh.points[mesh.corners[half]], b = mesh.points[mesh.corners[adj.next[half]]];
  return a + (b - mesh.points[mesh.corners[adj.before[half]]]);
}

Point eight_points(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t h) {
  const std::uint32_t t = adj.twin[h];
  Mean mean;
  mean.add(8, mesh.points[mesh.corners[h]]);
  mean.add(8, mesh.points[mesh.corners[t]]);
  mean.add(2, mesh.points[mesh.corners[adj.before[h]]]);
  mean.add(2, mesh.points[mesh.corners[adj.before[t]]]);
  for (const std::uint32_t side : {adj.next[h], adj.before[h], adj.next[t], adj.before[t]}) mean.add(-1, wing(mesh, adj, side));
  return mean.point();
}

Point border_point(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t h) {
  const std::uint32_t a = mesh.corners[h], b = mesh.corners[adj.next[h]];
  const Point before = mesh.points[mesh.corners[adj.border_in[a]]];
  const Point after = mesh.points[mesh.corners[adj.next[adj.out[b]]]];
  Mean mean;
  mean.add(9, mesh.points[a]);
  mean.add(9, mesh.points[b]);
  mean.add(-1, before);
  mean.add(-1, after);
  return mean.point();
}

Point edge_point(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t edge) {
  const std::uint32_t h = adj.edge_half[edge], t = adj.twin[h];
  if (t == none) return border_point(mesh, adj, h);
  const auto irregular = [&adj](std::uint32_t v) { return adj.border_in[v] == none && adj.valence[v] != 6; };
  const bool one = irregular(mesh.corners[h]), two = irregular(mesh.corners[t]);
  if (one && two) return midpoint(from_irregular(mesh, adj, h), from_irregular(mesh, adj, t));
  if (one) return from_irregular(mesh, adj, h);
  if (two) return from_irregular(mesh, adj, t);
  return eight_points(mesh, adj, h);
}

}  // namespace

ControlMesh butterfly(const ControlMesh& mesh, const Adjacency& adj) {
  std::vector<Point> edges;
  for (std::uint32_t e = 0; e < adj.edge_half.size(); ++e) edges.push_back(edge_point(mesh, adj, e));
  return split_triangles(mesh, adj, mesh.points, edges);
}

}  // namespace trimloop::subdivision::detail
