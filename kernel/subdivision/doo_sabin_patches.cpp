#include <algorithm>

#include "kernel/subdivision/local_mesh.h"
#include "kernel/subdivision/patches.h"
#include "kernel/subdivision/rules.h"
#include "kernel/subdivision/schemes.h"

namespace trimloop::subdivision {

namespace {

using detail::LocalMesh;
using detail::Ring;
using detail::Square;

constexpr std::uint32_t none = Adjacency::none;

std::size_t sides(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t half) { return mesh.face(adj.face[half]).size(); }

// The 3 x 3 control points around the vertex that `half` leaves; u runs along it.
std::vector<Point> net(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t half) {
  const auto to = [&](std::uint32_t h) { return mesh.points[mesh.corners[adj.next[h]]]; };
  std::vector<Point> g(9);
  g[4] = mesh.points[mesh.corners[half]];
  static constexpr std::array<std::size_t, 4> edge{7, 5, 1, 3}, corner{8, 2, 0, 6};
  std::uint32_t h = half;
  for (std::size_t k = 0; k < 4; ++k, h = adj.twin[adj.before[h]]) {
    g[edge[k]] = to(h);
    g[corner[k]] = to(adj.next[h]);
  }
  return g;
}

// A vertex with four faces, of which the one at (0,0), the third counter-clockwise from `half`, is no quadrilateral.
struct VertexCorner {
  static constexpr int degree = 2;
  LocalMesh local;

  std::array<std::uint32_t, 4> around() const {
    std::array<std::uint32_t, 4> h{local.half};
    for (std::size_t k = 1; k < 4; ++k) h[k] = local.adjacency.twin[local.adjacency.before[h[k - 1]]];
    return h;
  }

  // Corners at the faces' centres, sides through the edges' middles, as the B-spline has them.
  Square approximation() const {
    const ControlMesh& mesh = local.mesh;
    const Point centre = mesh.points[mesh.corners[local.half]];
    Square s{2, std::vector<Point>(9)};
    s.poles[4] = centre;
    static constexpr std::array<std::size_t, 4> edge{7, 5, 1, 3}, corner{8, 2, 0, 6};
    const auto h = around();
    for (std::size_t k = 0; k < 4; ++k) {
      s.poles[edge[k]] = midpoint(centre, mesh.points[mesh.corners[local.adjacency.next[h[k]]]]);
      s.poles[corner[k]] = detail::face_centre(mesh, local.adjacency.face[h[k]]);
    }
    return s;
  }

  std::vector<Point> hull() const { return local.mesh.points; }

  Result<Ring> descend() {
    // New point h stands for corner h; the faces around the old vertex make the face of the four new ones.
    const auto old = around();
    const ControlMesh fine = detail::doo_sabin(local.mesh, local.adjacency, false);
    const auto adj = adjacency(fine);
    if (!adj) return tl::unexpected(adj.error());
    const auto side = [&](std::uint32_t from, std::uint32_t to) {
      for (const std::uint32_t h : outgoing(*adj, from))
        if (fine.corners[adj->next[h]] == to) return h;
      return none;
    };
    const auto opposite = [&](std::uint32_t h) {
      for (int k = 0; k < 2; ++k) h = adj->twin[adj->before[h]];
      return h;
    };
    // In (u, v): old[0] is at (1,1), old[1] at (0,1), old[2] at (0,0), old[3] at (1,0).
    Ring ring{net(fine, *adj, opposite(side(old[3], old[2]))), net(fine, *adj, opposite(side(old[0], old[1]))),
              net(fine, *adj, side(old[1], old[0]))};
    auto next = detail::around_vertex(fine, *adj, side(old[2], old[3]));
    if (!next) return tl::unexpected(next.error());
    local = std::move(*next);
    return ring;
  }
};

// Every inner vertex has four faces, at most one of them no quadrilateral.
Result<ControlMesh> prepared(const ControlMesh& mesh, std::size_t most_corners) {
  Result<ControlMesh> out = mesh;
  while (out) {
    const auto adj = adjacency(*out);
    if (!adj) return tl::unexpected(adj.error());
    bool good = true;
    for (std::uint32_t v = 0; good && v < out->points.size(); ++v) {
      if (adj->out[v] == none || adj->border_in[v] != none) continue;
      const auto around = outgoing(*adj, v);
      good = around.size() == 4 &&
             std::count_if(around.begin(), around.end(), [&](std::uint32_t h) { return sides(*out, *adj, h) != 4; }) <= 1;
    }
    if (good) break;
    out = refined(*out, Scheme::DooSabin, 0, most_corners);
  }
  return out;
}

}  // namespace

Result<LimitSurface> doo_sabin_limit(const ControlMesh& control, const LimitOptions& options) {
  const auto mesh = prepared(control, 4 * options.most_patches);
  if (!mesh) return tl::unexpected(mesh.error());
  const auto adj = adjacency(*mesh);
  if (!adj) return tl::unexpected(adj.error());
  if (mesh->points.size() > options.most_patches)
    return fail(ErrorCode::Limit, "the limit surface has more patches than allowed", static_cast<double>(mesh->points.size()),
                static_cast<double>(options.most_patches));
  LimitSurface out;
  detail::CornerPatches corners;
  for (std::uint32_t v = 0; v < mesh->points.size(); ++v) {
    if (adj->out[v] == none || adj->border_in[v] != none) continue;
    const auto around = outgoing(*adj, v);
    std::size_t odd = 4;
    for (std::size_t k = 0; k < 4; ++k)
      if (sides(*mesh, *adj, around[k]) != 4) odd = k;
    if (odd == 4) {
      out.patches.push_back({detail::uniform_patch(2, net(*mesh, *adj, around[0])), v, 0});
      ++out.exact;
      continue;
    }
    auto local = detail::around_vertex(*mesh, *adj, around[(odd + 2) % 4]);
    if (!local) return tl::unexpected(local.error());
    auto levels = detail::levels(VertexCorner{std::move(*local)}, options);
    if (!levels) return tl::unexpected(levels.error());
    corners.corners.push_back(std::move(*levels));
    corners.from.push_back(v);
  }
  detail::add_corners(out, corners, 2);
  return out;
}

}  // namespace trimloop::subdivision
