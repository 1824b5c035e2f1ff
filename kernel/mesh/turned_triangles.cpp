#include "kernel/mesh/turned_triangles.h"

#include <unordered_map>

#include "kernel/mesh/distance.h"
#include "kernel/mesh/predicates.h"

namespace trimloop::mesh {
namespace {

constexpr double looks_away = 0.2;    // cosine to the surface normal below which a triangle is worth a flip
constexpr double gain = 0.05;         // of that cosine, least for a flip
constexpr double turned_allowance = 1.5;  // of the angle: a triangle that is turned over is the greater turn
constexpr int max_passes = 8;

class Flipper {
 public:
  Flipper(FaceMesh& mesh, std::span<const Point> points, const Surface& surface, bool reversed, const TessellationOptions& bounds,
          StopCheck& stop)
      : mesh_(mesh), points_(points), surface_(surface), reversed_(reversed), bounds_(bounds), stop_(stop) {}

  std::vector<std::uint32_t> run() {
    std::vector<std::uint32_t> bad = turned();
    if (bad.empty()) return {};
    for (std::uint32_t t = 0; t < mesh_.triangles.size() && !stop_.spend(); ++t) enter(t);
    for (int pass = 0; pass < max_passes && !bad.empty() && !stop_.stopped(); ++pass) {
      bool any = false;
      for (const std::uint32_t t : bad) any = flip_best_side(t) || any;
      if (!any) break;
      bad = turned();
    }
    std::sort(flipped_.begin(), flipped_.end());
    flipped_.erase(std::unique(flipped_.begin(), flipped_.end()), flipped_.end());
    return std::move(flipped_);
  }

 private:
  using Corners = std::array<std::uint32_t, 3>;

  static std::uint64_t key(std::uint32_t from, std::uint32_t to) { return std::uint64_t{from} << 32 | to; }

  void enter(std::uint32_t t) {
    const Corners& v = mesh_.triangles[t];
    for (std::size_t i = 0; i < 3; ++i) side_[key(v[i], v[(i + 1) % 3])] = t;
  }

  // Cosine between the triangle and the surface at its corners; -1 without area.
  double look(const Corners& v) const {
    const Vector a = points_[v[1]] - points_[v[0]], b = points_[v[2]] - points_[v[0]], n = cross(a, b);
    const double area = norm(n), size2 = std::max({dot(a, a), dot(b, b), dot(b - a, b - a)});
    if (!(area > 1e-10 * size2)) return -1;
    const Vector outward = normalized(mesh_.vertices[v[0]].normal + mesh_.vertices[v[1]].normal + mesh_.vertices[v[2]].normal);
    return dot(n, outward) / area;
  }

  std::vector<std::uint32_t> turned() {
    constexpr std::uint32_t triangles_per_unit = 16;
    std::vector<std::uint32_t> bad;
    for (std::uint32_t t = 0; t < mesh_.triangles.size() && !(t % triangles_per_unit == 0 && stop_.spend()); ++t)
      if (!(look(mesh_.triangles[t]) > looks_away)) bad.push_back(t);
    return bad;
  }

  bool positive(const Corners& v) const {
    const double sign = orient2d(mesh_.vertices[v[0]].uv, mesh_.vertices[v[1]].uv, mesh_.vertices[v[2]].uv);
    return reversed_ ? sign < 0 : sign > 0;
  }

  bool within_bounds(std::uint32_t a, std::uint32_t b, double angle_rad) const {
    const Uv p = mesh_.vertices[a].uv, q = mesh_.vertices[b].uv;
    const Point middle = evaluate(surface_, {0.5 * (p.u + q.u), 0.5 * (p.v + q.v)});
    return distance_to_segment(middle, points_[a], points_[b]) <= bounds_.deflection_mm &&
           angle_between(mesh_.vertices[a].normal, mesh_.vertices[b].normal) <= angle_rad * (1 + 1e-6);
  }

  bool flip_best_side(std::uint32_t t) {
    const Corners v = mesh_.triangles[t];
    const double now = look(v);
    if (now > looks_away) return false;  // mended by an earlier flip
    const double angle_rad = (now < 0 ? turned_allowance : 1) * bounds_.angle_rad;
    double best = 0;
    Corners best_a{}, best_b{};
    std::uint32_t best_other = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = v[i], b = v[(i + 1) % 3], c = v[(i + 2) % 3];
      const auto found = side_.find(key(b, a));
      if (found == side_.end()) continue;
      const Corners& w = mesh_.triangles[found->second];
      const std::uint32_t d = w[0] != a && w[0] != b ? w[0] : w[1] != a && w[1] != b ? w[1] : w[2];
      const Corners first{c, a, d}, second{d, b, c};
      const double better = std::min(look(first), look(second)) - std::min(now, look(w));
      if (better > std::max(best, gain) && !side_.count(key(c, d)) && !side_.count(key(d, c)) && positive(first) &&
          positive(second) && within_bounds(c, d, angle_rad))
        best = better, best_a = first, best_b = second, best_other = found->second;
    }
    if (best == 0) return false;
    side_.erase(key(best_a[1], best_b[1])), side_.erase(key(best_b[1], best_a[1]));
    mesh_.triangles[t] = best_a, mesh_.triangles[best_other] = best_b;
    enter(t), enter(best_other);
    flipped_.push_back(t), flipped_.push_back(best_other);
    return true;
  }

  FaceMesh& mesh_;
  std::span<const Point> points_;
  const Surface& surface_;
  bool reversed_;
  const TessellationOptions& bounds_;
  StopCheck& stop_;
  std::vector<std::uint32_t> flipped_;
  std::unordered_map<std::uint64_t, std::uint32_t> side_;  // directed side -> triangle; only looked up, never walked
};

}  // namespace

std::vector<std::uint32_t> turn_back(FaceMesh& mesh, std::span<const Point> points, const Surface& surface, bool reversed,
                                     const TessellationOptions& bounds, StopCheck& stop) {
  return Flipper(mesh, points, surface, reversed, bounds, stop).run();
}

}  // namespace trimloop::mesh
