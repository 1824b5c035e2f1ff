#include <algorithm>
#include <array>
#include <optional>

#include "kernel/subdivision/local_mesh.h"
#include "kernel/subdivision/patches.h"
#include "kernel/subdivision/rules.h"
#include "kernel/subdivision/schemes.h"

namespace trimloop::subdivision {

namespace {

using detail::LocalMesh;
using detail::Mean;
using detail::Ring;
using detail::Square;

constexpr std::uint32_t none = Adjacency::none;

// Regular: what a bicubic B-spline over uniform knots has, with border rows mirrored outwards.
bool regular(const Adjacency& adj, std::uint32_t v) {
  if (adj.border_in[v] == none) return adj.valence[v] == 4;
  return adj.valence[v] == 3 ? !adj.fixed[v] : adj.valence[v] == 2 && adj.fixed[v];
}

// The 4 x 4 control points of the face of `half`, whose corner half starts at is (1,1) and runs towards (2,1).
// Beyond a border: 2 P - Q, which gives the border's own rules.
std::vector<Point> net(const ControlMesh& mesh, const Adjacency& adj, std::uint32_t half) {
  std::array<std::array<std::optional<Point>, 4>, 4> g;
  const auto at = [&](std::uint32_t h) { return mesh.points[mesh.corners[h]]; };
  // Side k leaves corner k; in its own frame x runs along it and y into the face. Place (x, y) counted from the corner.
  static constexpr std::array<std::array<int, 2>, 4> corner{{{1, 1}, {2, 1}, {2, 2}, {1, 2}}};
  static constexpr std::array<std::array<int, 2>, 4> along{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  std::uint32_t h = half;
  for (std::size_t k = 0; k < 4; ++k, h = adj.next[h]) {
    const int cx = corner[k][0], cy = corner[k][1], dx = along[k][0], dy = along[k][1];
    const auto place = [&](int x, int y) -> std::optional<Point>& {
      return g[static_cast<std::size_t>(cx + x * dx - y * dy)][static_cast<std::size_t>(cy + x * dy + y * dx)];
    };
    place(0, 0) = at(h);
    const std::uint32_t t = adj.twin[h];
    if (t == none) continue;
    place(0, -1) = at(adj.next[adj.next[t]]);
    place(1, -1) = at(adj.before[t]);
    const std::uint32_t s = adj.twin[adj.next[t]];
    if (s != none) place(-1, -1) = at(adj.before[s]);
  }
  // Whole rows beyond a border first; a corner then follows the row that is real, or either of two mirrored ones.
  const auto found = g;
  const auto mirrored = [](const std::optional<Point>& near, const std::optional<Point>& far) { return *near + (*near - *far); };
  for (std::size_t i = 1; i < 3; ++i) {
    if (!g[i][0]) g[i][0] = mirrored(g[i][1], g[i][2]);
    if (!g[i][3]) g[i][3] = mirrored(g[i][2], g[i][1]);
    if (!g[0][i]) g[0][i] = mirrored(g[1][i], g[2][i]);
    if (!g[3][i]) g[3][i] = mirrored(g[2][i], g[1][i]);
  }
  for (const std::size_t i : {std::size_t{0}, std::size_t{3}}) {
    for (const std::size_t j : {std::size_t{0}, std::size_t{3}}) {
      const std::size_t near_i = i == 0 ? 1 : 2, near_j = j == 0 ? 1 : 2;
      if (g[i][j]) continue;
      g[i][j] = found[i][near_j] ? mirrored(g[i][near_j], g[i][3 - near_j]) : mirrored(g[near_i][j], g[3 - near_i][j]);
    }
  }
  std::vector<Point> out;
  for (const auto& column : g)
    for (const auto& p : column) out.push_back(*p);
  return out;
}

// Poles of the bicubic approximation of Loop and Schaefer 2008: exact where the face is regular, and along sides
// between regular corners. Interior poles (n P + 2 e1 + 2 e2 + f) / (n + 5); a side's pole is the mean of the two
// interior ones beside it; a corner is the limit point.
class Approximation {
 public:
  Approximation(const ControlMesh& mesh, const Adjacency& adj) : mesh_(mesh), adj_(adj) {}

  Point inner(std::uint32_t h) const {  // of the face of h, at the corner that h leaves
    const std::uint32_t v = mesh_.corners[h];
    const double n = adj_.border_in[v] == none ? static_cast<double>(adj_.valence[v]) : 4;
    Mean mean;
    mean.add(n, mesh_.points[v]);
    mean.add(2, mesh_.points[mesh_.corners[adj_.next[h]]]);
    mean.add(2, mesh_.points[mesh_.corners[adj_.before[h]]]);
    mean.add(1, mesh_.points[mesh_.corners[adj_.next[adj_.next[h]]]]);
    return mean.point();
  }

  // The pole beside the corner that h leaves, on the side of h or (`in`) of the side that enters there.
  Point side(std::uint32_t h, bool in) const {
    const std::uint32_t edge = in ? adj_.before[h] : h, t = adj_.twin[edge];
    if (t != none) return midpoint(inner(h), inner(in ? t : adj_.next[t]));
    const std::uint32_t far = in ? mesh_.corners[edge] : mesh_.corners[adj_.next[h]];
    Mean mean;
    mean.add(2, mesh_.points[mesh_.corners[h]]);
    mean.add(1, mesh_.points[far]);
    return mean.point();
  }

  Point corner(std::uint32_t h) const {
    const std::uint32_t v = mesh_.corners[h];
    if (adj_.fixed[v]) return mesh_.points[v];
    Mean mean;
    if (adj_.border_in[v] != none) {
      mean.add(4, mesh_.points[v]);
      mean.add(1, mesh_.points[mesh_.corners[adj_.border_in[v]]]);
      mean.add(1, mesh_.points[mesh_.corners[adj_.next[adj_.out[v]]]]);
      return mean.point();
    }
    for (const std::uint32_t around : outgoing(adj_, v)) mean.add(1, inner(around));
    return mean.point();
  }

  Square square(std::uint32_t half) const {
    Square s{3, std::vector<Point>(16)};
    std::uint32_t h = half;
    static constexpr std::array<std::array<int, 2>, 4> place{{{0, 0}, {3, 0}, {3, 3}, {0, 3}}};
    static constexpr std::array<std::array<int, 2>, 4> along{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    for (std::size_t k = 0; k < 4; ++k, h = adj_.next[h]) {
      const int x = place[k][0], y = place[k][1], dx = along[k][0], dy = along[k][1];
      const auto pole = [&](int i, int j) -> Point& { return s.poles[static_cast<std::size_t>(4 * i + j)]; };
      pole(x, y) = corner(h);
      pole(x + dx, y + dy) = side(h, false);
      pole(x - dy, y + dx) = side(h, true);
      pole(x + dx - dy, y + dy + dx) = inner(h);
    }
    return s;
  }

 private:
  const ControlMesh& mesh_;
  const Adjacency& adj_;
};

// A face whose first corner is irregular, and what is around it.
struct FaceCorner {
  static constexpr int degree = 3;
  LocalMesh local;

  Square approximation() const { return Approximation(local.mesh, local.adjacency).square(local.half); }

  std::vector<Point> hull() const {
    // Beyond a border the rules are B-splines of mirrored points, yet convex in the points themselves.
    return local.mesh.points;
  }

  Result<Ring> descend() {
    const ControlMesh fine = detail::catmull_clark(local.mesh, local.adjacency);
    const auto adj = adjacency(fine);
    if (!adj) return tl::unexpected(adj.error());
    // Face k of the finer mesh is the quarter at corner k: corner, side's middle, centre, middle of the side before.
    std::array<std::uint32_t, 4> quarter{};
    std::uint32_t h = local.half;
    for (std::uint32_t& q : quarter) q = fine.face_start[h], h = local.adjacency.next[h];
    Ring ring{net(fine, *adj, quarter[1] + 3), net(fine, *adj, quarter[2] + 2), net(fine, *adj, quarter[3] + 1)};
    auto next = detail::around_face(fine, *adj, quarter[0]);
    if (!next) return tl::unexpected(next.error());
    local = std::move(*next);
    return ring;
  }
};

// Sharp edges become borders: each sector between them gets a vertex of its own.
Result<ControlMesh> cut_at_creases(const ControlMesh& mesh) {
  if (mesh.creases.empty()) return mesh;
  const auto adj = adjacency(mesh);
  if (!adj) return tl::unexpected(adj.error());
  ControlMesh out = mesh;
  out.creases.clear();
  out.fixed.clear();
  out.rounded.clear();
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    if (adj->out[v] == none) continue;
    const auto around = outgoing(*adj, v);
    std::vector<std::size_t> cuts;
    const bool border = adj->border_in[v] != none;
    for (std::size_t i = border ? 1 : 0; i < around.size(); ++i)
      if (adj->edge_sharpness[adj->edge[around[i]]] > 0) cuts.push_back(i);
    const std::size_t sharp = cuts.size() + (border ? 2 : 0);
    if (sharp == 1)
      return fail(ErrorCode::Unsupported, "a crease ends inside the surface at point " + std::to_string(v));
    const bool fixed = adj->fixed[v] || sharp > 2;
    const std::size_t sectors = border ? cuts.size() + 1 : std::max<std::size_t>(cuts.size(), 1);
    std::vector<std::uint32_t> name{v};
    for (std::size_t s = 1; s < sectors; ++s) {
      name.push_back(static_cast<std::uint32_t>(out.points.size()));
      out.points.push_back(mesh.points[v]);
    }
    for (std::size_t i = 0; i < around.size(); ++i) {
      // The sector of side i: the number of cuts at or before it, around an inner vertex counted from the first one.
      const auto passed = static_cast<std::size_t>(std::upper_bound(cuts.begin(), cuts.end(), i) - cuts.begin());
      out.corners[around[i]] = name[passed % sectors];
    }
    for (const std::uint32_t n : name) {
      if (fixed) out.fixed.push_back(n);
      else if (sharp > 0) out.rounded.push_back(n);
    }
  }
  return out;
}

// Quadrilaterals only, creases either gone or borders, at most one irregular corner in a face.
Result<ControlMesh> prepared(const ControlMesh& mesh, std::size_t most_corners) {
  Result<ControlMesh> out = mesh;
  const auto fading = [](const ControlMesh& m) {
    return std::any_of(m.creases.begin(), m.creases.end(), [](const Crease& c) { return c.sharpness > 0 && std::isfinite(c.sharpness); });
  };
  while (out && fading(*out)) out = refined(*out, Scheme::CatmullClark, 0, most_corners);
  if (out) out = cut_at_creases(*out);
  for (int round = 0; out; ++round) {
    bool good = true;
    const auto adj = adjacency(*out);
    if (!adj) return tl::unexpected(adj.error());
    for (std::size_t f = 0; good && f < out->face_count(); ++f) {
      const auto corners = out->face(f);
      good = corners.size() == 4 &&
             std::count_if(corners.begin(), corners.end(), [&](std::uint32_t v) { return !regular(*adj, v); }) <= 1;
    }
    if (good) break;
    out = refined(*out, Scheme::CatmullClark, 0, most_corners);
  }
  return out;
}

}  // namespace

Result<LimitSurface> catmull_clark_limit(const ControlMesh& control, const LimitOptions& options) {
  const auto mesh = prepared(control, 4 * options.most_patches);
  if (!mesh) return tl::unexpected(mesh.error());
  if (mesh->face_count() > options.most_patches)
    return fail(ErrorCode::Limit, "the limit surface has more patches than allowed", static_cast<double>(mesh->face_count()),
                static_cast<double>(options.most_patches));
  const auto adj = adjacency(*mesh);
  if (!adj) return tl::unexpected(adj.error());
  LimitSurface out;
  detail::CornerPatches corners;
  for (std::uint32_t f = 0; f < mesh->face_count(); ++f) {
    std::uint32_t half = mesh->face_start[f];
    bool is_regular = true;
    for (std::uint32_t h = mesh->face_start[f]; h < mesh->face_start[f + 1]; ++h) {
      if (regular(*adj, mesh->corners[h])) continue;
      is_regular = false;
      half = h;
    }
    if (is_regular) {
      out.patches.push_back({detail::uniform_patch(3, net(*mesh, *adj, half)), f, 0});
      ++out.exact;
      continue;
    }
    auto local = detail::around_face(*mesh, *adj, half);
    if (!local) return tl::unexpected(local.error());
    auto levels = detail::levels(FaceCorner{std::move(*local)}, options);
    if (!levels) return tl::unexpected(levels.error());
    corners.corners.push_back(std::move(*levels));
    corners.from.push_back(f);
  }
  detail::add_corners(out, corners, 3);
  return out;
}

}  // namespace trimloop::subdivision
