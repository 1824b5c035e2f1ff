#include <array>

#include "base/assert.h"
#include "kernel/subdivision/limit_surface.h"
#include "kernel/subdivision/loop_basis.h"
#include "kernel/subdivision/schemes.h"

namespace trimloop::subdivision {

namespace {

constexpr std::uint32_t none = Adjacency::none;

bool regular(const Adjacency& adj, std::uint32_t v) { return adj.border_in[v] == none && adj.valence[v] == 6; }

// The twelve control points around the face of half-edge h, in the order of loop_basis.h: its corners are 4, 7, 8.
std::array<std::uint32_t, 12> ring(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t h) {
  const auto to = [&](std::uint32_t half) { return mesh.corners[adj.next[half]]; };
  const auto turn = [&](std::uint32_t half) { return adj.twin[adj.before[half]]; };  // next one counter-clockwise
  std::array<std::uint32_t, 12> p{};
  const std::uint32_t h1 = adj.next[h], h2 = adj.next[h1];
  p[3] = mesh.corners[h], p[6] = mesh.corners[h1], p[7] = mesh.corners[h2];
  // Counter-clockwise around corner 4: 7, 8, then 5, 2, 1, 3.
  std::uint32_t at = turn(turn(h));
  p[4] = to(at), at = turn(at), p[1] = to(at), at = turn(at), p[0] = to(at), at = turn(at), p[2] = to(at);
  // Around corner 7: 8, 4, then 3, 6, 10, 11.
  at = turn(turn(turn(h1)));
  p[5] = to(at), at = turn(at), p[9] = to(at), at = turn(at), p[10] = to(at);
  // Around corner 8: 4, 7, then 11, 12, 9, 5.
  at = turn(turn(turn(h2)));
  p[11] = to(at), at = turn(at), p[8] = to(at);
  return p;
}

}  // namespace

Result<LoopPatches> loop_regular_patches(const ControlMesh& mesh) {
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    if (mesh.face(f).size() != 3) return fail(ErrorCode::InvalidArgument, "Loop's surfaces have triangles only");
  const auto adj = adjacency(mesh);
  if (!adj) return tl::unexpected(adj.error());
  const auto coefficients = detail::loop_bezier<double>();
  std::vector<bool> creased(mesh.points.size(), false);
  for (const Crease& c : mesh.creases) creased[c.a] = creased[c.b] = true;
  for (const std::uint32_t v : mesh.fixed) creased[v] = true;
  LoopPatches out;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    bool smooth = true;
    for (const std::uint32_t v : mesh.face(f)) smooth = smooth && regular(*adj, v) && !creased[v];
    if (!smooth) {
      out.irregular.push_back(f);
      continue;
    }
    const auto around = ring(mesh, *adj, mesh.face_start[f]);
    std::vector<Hpoint> poles(15, Hpoint{0, 0, 0, 0});
    for (std::size_t k = 0; k < 15; ++k) {
      for (std::size_t i = 0; i < 12; ++i) {
        const Point p = mesh.points[around[i]];
        poles[k] = poles[k] + coefficients[k][i] * Hpoint{p.x, p.y, p.z, 0};
      }
      poles[k].w = 1;
    }
    auto patch = TriangleBezier::from_homogeneous(4, std::move(poles));
    TRIMLOOP_ASSERT(patch.has_value(), "means of finite points make a patch");
    out.patches.push_back(std::move(*patch));
    out.faces.push_back(f);
  }
  return out;
}

}  // namespace trimloop::subdivision
