#include "kernel/subdivision/control_mesh.h"

#include <fmt/format.h>

#include <algorithm>

namespace trimloop::subdivision {

namespace {

constexpr std::uint32_t none = Adjacency::none;

Result<void> check_faces(const ControlMesh& mesh) {
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    if (!is_finite(mesh.points[i])) return fail(ErrorCode::InvalidArgument, fmt::format("point {} is not finite", i));
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto corners = mesh.face(f);
    if (corners.size() < 3)
      return fail(ErrorCode::InvalidArgument, fmt::format("face {} has {} corners, a face has at least 3", f, corners.size()),
                  static_cast<double>(corners.size()), 3);
    for (const std::uint32_t v : corners)
      if (v >= mesh.points.size())
        return fail(ErrorCode::InvalidArgument, fmt::format("face {} names point {}, there are {}", f, v, mesh.points.size()), v,
                    static_cast<double>(mesh.points.size()));
    std::vector<std::uint32_t> sorted(corners.begin(), corners.end());
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end())
      return fail(ErrorCode::InvalidArgument, fmt::format("face {} names point {} twice", f, *twice));
  }
  return {};
}

struct Half {
  std::uint32_t a, b, half;  // a < b
  bool operator<(const Half& o) const { return a != o.a ? a < o.a : b != o.b ? b < o.b : half < o.half; }
};

// Twins and edges, in the order of the edges' first half-edges.
Result<void> pair_up(const ControlMesh& mesh, Adjacency& adj) {
  const auto n = static_cast<std::uint32_t>(mesh.corners.size());
  std::vector<Half> halves;
  for (std::uint32_t h = 0; h < n; ++h) {
    const std::uint32_t from = mesh.corners[h], to = mesh.corners[adj.next[h]];
    halves.push_back({std::min(from, to), std::max(from, to), h});
  }
  std::sort(halves.begin(), halves.end());
  adj.twin.assign(n, none);
  for (std::size_t i = 0; i < halves.size();) {
    std::size_t end = i + 1;
    while (end < halves.size() && halves[end].a == halves[i].a && halves[end].b == halves[i].b) ++end;
    if (end - i > 2)
      return fail(ErrorCode::InvalidArgument,
                  fmt::format("edge {}-{} has {} faces, at most 2 are meant", halves[i].a, halves[i].b, end - i),
                  static_cast<double>(end - i), 2);
    if (end - i == 2) {
      const std::uint32_t one = halves[i].half, two = halves[i + 1].half;
      if (mesh.corners[one] == mesh.corners[two])
        return fail(ErrorCode::InvalidArgument, fmt::format("faces {} and {} run along edge {}-{} the same way",
                                                            adj.face[one], adj.face[two], halves[i].a, halves[i].b));
      adj.twin[one] = two;
      adj.twin[two] = one;
    }
    i = end;
  }
  adj.edge.assign(n, none);
  for (std::uint32_t h = 0; h < n; ++h) {
    if (adj.edge[h] != none) continue;
    const auto e = static_cast<std::uint32_t>(adj.edge_half.size());
    adj.edge_half.push_back(h);
    adj.edge[h] = e;
    if (adj.twin[h] != none) adj.edge[adj.twin[h]] = e;
  }
  adj.edge_sharpness.assign(adj.edge_half.size(), 0);
  for (const Crease& c : mesh.creases) {
    const Half wanted{std::min(c.a, c.b), std::max(c.a, c.b), 0};
    const auto found = std::lower_bound(halves.begin(), halves.end(), wanted);
    if (found == halves.end() || found->a != wanted.a || found->b != wanted.b)
      return fail(ErrorCode::InvalidArgument, fmt::format("crease {}-{} is no edge of the mesh", c.a, c.b));
    if (!(c.sharpness >= 0)) return fail(ErrorCode::InvalidArgument, fmt::format("crease {}-{} has sharpness {}", c.a, c.b, c.sharpness), c.sharpness, 0);
    adj.edge_sharpness[adj.edge[found->half]] = c.sharpness;
  }
  return {};
}

Result<void> mark_fixed(const ControlMesh& mesh, Adjacency& adj) {
  adj.fixed.assign(mesh.points.size(), false);
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) adj.fixed[v] = adj.border_in[v] != none && adj.valence[v] == 2;
  for (const auto* list : {&mesh.rounded, &mesh.fixed}) {
    for (const std::uint32_t v : *list) {
      if (v >= mesh.points.size())
        return fail(ErrorCode::InvalidArgument,
                    fmt::format("corner {} does not exist, there are {} points", v, mesh.points.size()), v,
                    static_cast<double>(mesh.points.size()));
      adj.fixed[v] = list == &mesh.fixed;
    }
  }
  return {};
}

}  // namespace

Result<Adjacency> adjacency(const ControlMesh& mesh) {
  if (auto good = check_faces(mesh); !good) return tl::unexpected(good.error());
  Adjacency adj;
  const std::size_t n = mesh.corners.size();
  adj.face.resize(n);
  adj.next.resize(n);
  adj.before.resize(n);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const std::uint32_t from = mesh.face_start[f], to = mesh.face_start[f + 1];
    for (std::uint32_t h = from; h < to; ++h) {
      adj.face[h] = static_cast<std::uint32_t>(f);
      adj.next[h] = h + 1 < to ? h + 1 : from;
      adj.before[h] = h > from ? h - 1 : to - 1;
    }
  }
  if (auto good = pair_up(mesh, adj); !good) return tl::unexpected(good.error());

  adj.out.assign(mesh.points.size(), none);
  adj.border_in.assign(mesh.points.size(), none);
  adj.valence.assign(mesh.points.size(), 0);
  std::vector<std::uint32_t> faces_at(mesh.points.size(), 0);
  for (std::uint32_t h = 0; h < n; ++h) {
    const std::uint32_t v = mesh.corners[h];
    ++faces_at[v];
    if (adj.out[v] == none || adj.twin[h] == none) {
      if (adj.twin[h] == none && adj.out[v] != none && adj.twin[adj.out[v]] == none)
        return fail(ErrorCode::InvalidArgument, fmt::format("two borders meet in point {}", v));
      adj.out[v] = h;
    }
    if (adj.twin[h] == none) adj.border_in[mesh.corners[adj.next[h]]] = h;
  }
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    if (adj.out[v] == none) continue;
    const std::size_t around = outgoing(adj, v).size();
    if (around != faces_at[v])
      return fail(ErrorCode::InvalidArgument, fmt::format("the faces at point {} only touch there", v));
    adj.valence[v] = static_cast<std::uint32_t>(around) + (adj.border_in[v] != none ? 1 : 0);
  }
  if (auto good = mark_fixed(mesh, adj); !good) return tl::unexpected(good.error());
  return adj;
}

std::vector<std::uint32_t> outgoing(const Adjacency& adj, std::uint32_t vertex) {
  std::vector<std::uint32_t> halves;
  const std::uint32_t first = adj.out[vertex];
  for (std::uint32_t h = first; h != none;) {
    halves.push_back(h);
    h = adj.twin[adj.before[h]];  // the next edge counter-clockwise
    if (h == first) break;
  }
  return halves;
}

}  // namespace trimloop::subdivision
