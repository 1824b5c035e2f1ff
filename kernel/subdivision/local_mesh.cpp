#include "kernel/subdivision/local_mesh.h"

#include <algorithm>
#include <map>

namespace trimloop::subdivision::detail {

namespace {

constexpr std::uint32_t none = Adjacency::none;

// Two corners of neighbouring faces are one point when it is a centre, or the far end of an edge at a centre; else they
// are points of their own.
class Builder {
 public:
  Builder(const ControlMesh& mesh, const Adjacency& adj, std::vector<std::uint32_t> centres)
      : mesh_(mesh), adj_(adj), centres_(std::move(centres)) {}

  void add(std::uint32_t face) {
    std::vector<std::uint32_t> corners;
    for (std::uint32_t h = mesh_.face_start[face]; h < mesh_.face_start[face + 1]; ++h) corners.push_back(point_of(h));
    out_.mesh.add_face(corners);
  }

  Result<LocalMesh> finish(std::uint32_t half) {
    for (std::uint32_t i = 0; i < origin_.size(); ++i) {
      if (!is_centre(origin_[i])) continue;
      if (adj_.fixed[origin_[i]]) out_.mesh.fixed.push_back(i);
      else if (adj_.border_in[origin_[i]] != none) out_.mesh.rounded.push_back(i);
    }
    auto adjacent = adjacency(out_.mesh);
    if (!adjacent) return tl::unexpected(adjacent.error());
    out_.adjacency = std::move(*adjacent);
    out_.half = half;
    return std::move(out_);
  }

 private:
  bool is_centre(std::uint32_t v) const { return std::find(centres_.begin(), centres_.end(), v) != centres_.end(); }

  // Key of the point at corner h: (0, centre), (1, edge to a centre) or (2, corner).
  std::pair<int, std::uint32_t> key(std::uint32_t h) const {
    const std::uint32_t v = mesh_.corners[h];
    if (is_centre(v)) return {0, v};
    if (is_centre(mesh_.corners[adj_.next[h]])) return {1, adj_.edge[h]};
    if (is_centre(mesh_.corners[adj_.before[h]])) return {1, adj_.edge[adj_.before[h]]};
    return {2, h};
  }

  std::uint32_t point_of(std::uint32_t h) {
    const auto [at, added] = known_.emplace(key(h), static_cast<std::uint32_t>(origin_.size()));
    if (added) {
      origin_.push_back(mesh_.corners[h]);
      out_.mesh.points.push_back(mesh_.points[mesh_.corners[h]]);
    }
    return at->second;
  }

  const ControlMesh& mesh_;
  const Adjacency& adj_;
  std::vector<std::uint32_t> centres_;
  std::map<std::pair<int, std::uint32_t>, std::uint32_t> known_;
  std::vector<std::uint32_t> origin_;  // of each local point
  LocalMesh out_;
};

}  // namespace

Result<LocalMesh> around_face(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t half) {
  const std::uint32_t face = adj.face[half];
  const auto corners = mesh.face(face);
  std::vector<std::uint32_t> faces;
  for (const std::uint32_t v : corners)
    for (const std::uint32_t h : outgoing(adj, v)) faces.push_back(adj.face[h]);
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  Builder builder(mesh, adj, {corners.begin(), corners.end()});
  builder.add(face);  // first, so that its corners keep their places
  for (const std::uint32_t f : faces)
    if (f != face) builder.add(f);
  return builder.finish(half - mesh.face_start[face]);
}

Result<LocalMesh> around_vertex(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t half) {
  Builder builder(mesh, adj, {mesh.corners[half]});
  builder.add(adj.face[half]);
  for (const std::uint32_t h : outgoing(adj, mesh.corners[half]))
    if (adj.face[h] != adj.face[half]) builder.add(adj.face[h]);
  return builder.finish(half - mesh.face_start[adj.face[half]]);
}

}  // namespace trimloop::subdivision::detail
