// Kobbelt 2000: a point in every triangle, every inner edge flipped, old vertices smoothed. Borders change in every
// second round only, where each border edge is cut in three (§4 there).
#include <array>

#include "kernel/subdivision/rules.h"

namespace trimloop::subdivision::detail {

namespace {

constexpr std::uint32_t none = Adjacency::none;

Point smooth_vertex(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t v) {
  const auto around = outgoing(adj, v);
  const double n = static_cast<double>(around.size());
  const double alpha = around.size() == 6 ? 1.0 / 3 : (4 - 2 * std::cos(two_pi / n)) / 9;
  Mean mean;
  mean.add(1 - alpha, mesh.points[v]);
  for (const std::uint32_t h : around) mean.add(alpha / n, mesh.points[mesh.corners[adj.next[h]]]);
  return mean.point();
}

std::uint32_t before_on_border(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t v) {
  return mesh.corners[adj.border_in[v]];
}
std::uint32_t after_on_border(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t v) {
  return mesh.corners[adj.next[adj.out[v]]];
}

Point weighted(const ControlMesh& mesh, std::uint32_t a, double wa, std::uint32_t b, double wb, std::uint32_t c, double wc) {
  Mean mean;
  mean.add(wa, mesh.points[a]);
  mean.add(wb, mesh.points[b]);
  mean.add(wc, mesh.points[c]);
  return mean.point();
}

}  // namespace

ControlMesh sqrt3(const ControlMesh& mesh, const Adjacency& adj, int round) {
  const bool cut_borders = round % 2 == 1;
  ControlMesh out;
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    if (adj.out[v] == none) out.points.push_back(mesh.points[v]);
    else if (adj.border_in[v] == none) out.points.push_back(smooth_vertex(mesh, adj, v));
    else if (!cut_borders) out.points.push_back(mesh.points[v]);
    else out.points.push_back(weighted(mesh, before_on_border(mesh, adj, v), 4, v, 19, after_on_border(mesh, adj, v), 4));
  }
  const auto centre = static_cast<std::uint32_t>(out.points.size());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) out.points.push_back(face_centre(mesh, f));

  for (std::uint32_t h = 0; h < mesh.corners.size(); ++h) {
    const std::uint32_t a = mesh.corners[h], b = mesh.corners[adj.next[h]], t = adj.twin[h];
    if (t != none) {  // the triangle between a and the two centres; its twin makes the other half
      out.add_face(std::array{a, centre + adj.face[t], centre + adj.face[h]});
      continue;
    }
    if (!cut_borders) {
      out.add_face(std::array{a, b, centre + adj.face[h]});
      continue;
    }
    const auto near_a = static_cast<std::uint32_t>(out.points.size());
    out.points.push_back(weighted(mesh, before_on_border(mesh, adj, a), 1, a, 16, b, 10));
    out.points.push_back(weighted(mesh, after_on_border(mesh, adj, b), 1, b, 16, a, 10));
    out.add_face(std::array{a, near_a, centre + adj.face[h]});
    out.add_face(std::array{near_a, near_a + 1, centre + adj.face[h]});
    out.add_face(std::array{near_a + 1, b, centre + adj.face[h]});
  }
  return out;
}

}  // namespace trimloop::subdivision::detail
