#include "kernel/subdivision/rules.h"

#include <array>

namespace trimloop::subdivision::detail {

Point face_centre(const ControlMesh& mesh, std::size_t face) {
  Mean mean;
  for (const std::uint32_t v : mesh.face(face)) mean.add(1, mesh.points[v]);
  return mean.point();
}

Point edge_middle(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t edge) {
  const std::uint32_t h = adj.edge_half[edge];
  return midpoint(mesh.points[mesh.corners[h]], mesh.points[mesh.corners[adj.next[h]]]);
}

double sharpness(const Adjacency& adj, std::uint32_t edge) {
  return adj.twin[adj.edge_half[edge]] == Adjacency::none ? infinity : adj.edge_sharpness[edge];
}

namespace {

struct SharpEnd {
  Point far;
  double sharpness;
};

std::vector<SharpEnd> sharp_ends(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t vertex) {
  std::vector<SharpEnd> ends;
  for (const std::uint32_t h : outgoing(adj, vertex)) {
    const double s = sharpness(adj, adj.edge[h]);
    if (s > 0) ends.push_back({mesh.points[mesh.corners[adj.next[h]]], s});
  }
  if (adj.border_in[vertex] != Adjacency::none)
    ends.push_back({mesh.points[mesh.corners[adj.border_in[vertex]]], infinity});
  return ends;
}

}  // namespace

Point crease_vertex(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t vertex, Point smooth) {
  const std::vector<SharpEnd> ends = sharp_ends(mesh, adj, vertex);
  const Point p = mesh.points[vertex];
  if (adj.fixed[vertex]) return p;
  if (ends.size() < 2) return smooth;
  Point sharp = p;
  if (ends.size() == 2) {
    Mean mean;  // the cubic B-spline's (1, 6, 1) / 8
    mean.add(6, p);
    mean.add(1, ends[0].far);
    mean.add(1, ends[1].far);
    sharp = mean.point();
  }
  double least = infinity;
  for (const SharpEnd& e : ends) least = std::min(least, e.sharpness);
  return least >= 1 ? sharp : smooth + least * (sharp - smooth);
}

std::vector<Crease> halved_creases(const ControlMesh& mesh, const Adjacency& adj, const std::vector<std::uint32_t>& vertex_point,
                                   const std::vector<std::uint32_t>& edge_point) {
  std::vector<Crease> creases;
  for (std::uint32_t e = 0; e < adj.edge_half.size(); ++e) {
    const double left = adj.edge_sharpness[e] - 1;
    if (!(left > 0)) continue;
    const std::uint32_t h = adj.edge_half[e];
    creases.push_back({vertex_point[mesh.corners[h]], edge_point[e], left});
    creases.push_back({edge_point[e], vertex_point[mesh.corners[adj.next[h]]], left});
  }
  return creases;
}

ControlMesh split_triangles(const ControlMesh& mesh, const Adjacency& adj, std::vector<Point> vertex_points,
                            const std::vector<Point>& edge_points) {
  ControlMesh out;
  out.points = std::move(vertex_points);
  std::vector<std::uint32_t> vertex_point(mesh.points.size()), edge_point(edge_points.size());
  for (std::uint32_t v = 0; v < vertex_point.size(); ++v) vertex_point[v] = v;
  for (std::uint32_t e = 0; e < edge_point.size(); ++e) edge_point[e] = static_cast<std::uint32_t>(out.points.size()) + e;
  out.points.insert(out.points.end(), edge_points.begin(), edge_points.end());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const std::uint32_t h = mesh.face_start[f];
    const std::uint32_t e0 = edge_point[adj.edge[h]], e1 = edge_point[adj.edge[h + 1]], e2 = edge_point[adj.edge[h + 2]];
    const auto corner = mesh.face(f);
    out.add_face(std::array{corner[0], e0, e2});
    out.add_face(std::array{corner[1], e1, e0});
    out.add_face(std::array{corner[2], e2, e1});
    out.add_face(std::array{e0, e1, e2});
  }
  out.creases = halved_creases(mesh, adj, vertex_point, edge_point);
  out.fixed = mesh.fixed;
  out.rounded = mesh.rounded;
  return out;
}

}  // namespace trimloop::subdivision::detail
