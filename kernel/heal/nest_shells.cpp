// A closed shell inside another is a void of that solid, or a solid of its own. What the file gave decides: faces that look
// the other way than those of the shell around them bound a hollow, faces that look the same way a part inside a part.

#include <algorithm>

#include "kernel/check/measure.h"
#include "kernel/heal/sew_detail.h"
#include "kernel/mesh/tessellate.h"

namespace trimloop::heal {
namespace {

// How often the triangles go round p: 1 inside, 0 outside. By the solid angles that they take up (Van Oosterom, Strackee 1983).
double winding(const mesh::BodyMesh& m, Point p) {
  double sum = 0;
  for (const mesh::FaceMesh& face : m.faces)
    for (const auto& t : face.triangles) {
      const Vector a = m.points[face.vertices[t[0]].point] - p, b = m.points[face.vertices[t[1]].point] - p,
                   c = m.points[face.vertices[t[2]].point] - p;
      const double x = norm(a), y = norm(b), z = norm(c);
      sum += 2 * std::atan2(dot(a, cross(b, c)), x * y * z + dot(a, b) * z + dot(b, c) * x + dot(c, a) * y);
    }
  return sum / (4 * pi);
}

bool encloses(const Box& outer, const Box& inner) {
  const auto along = [](double ol, double oh, double il, double ih) { return ol <= il && ih <= oh; };
  return along(outer.lo.x, outer.hi.x, inner.lo.x, inner.hi.x) && along(outer.lo.y, outer.hi.y, inner.lo.y, inner.hi.y) &&
         along(outer.lo.z, outer.hi.z, inner.lo.z, inner.hi.z);
}

class Nester {
 public:
  Nester(const std::vector<Body>& solids) : solids_(solids), meshes_(solids.size()) {
    for (const Body& b : solids) {
      Box box;
      for (std::uint32_t f = 0; f < b.faces.size(); ++f) box.add(bounding_box(b, FaceId{f}));
      boxes_.push_back(box);
    }
  }

  bool is_inside(std::size_t inner, std::size_t outer) {
    if (boxes_[inner].empty() || !encloses(boxes_[outer], boxes_[inner])) return false;
    const mesh::BodyMesh* m = mesh_of(outer);
    if (!m) return false;
    int in = 0, out = 0;
    for (const Point p : points_of(inner)) {
      const double w = std::abs(winding(*m, p));
      constexpr double clear = 0.25;  // on the border it is a half
      if (w > 1 - clear) ++in;
      else if (w < clear) ++out;
    }
    return in > 0 && out == 0;
  }

 private:
  const mesh::BodyMesh* mesh_of(std::size_t i) {
    if (!meshes_[i]) {
      mesh::TessellationOptions options;
      options.deflection_mm = 0.01 * boxes_[i].diagonal();
      options.max_triangles_per_face = 10'000;
      auto made = mesh::tessellate(solids_[i], options);
      meshes_[i] = made ? std::make_unique<mesh::BodyMesh>(std::move(*made)) : std::make_unique<mesh::BodyMesh>();
    }
    return meshes_[i]->faces.empty() ? nullptr : meshes_[i].get();
  }

  std::vector<Point> points_of(std::size_t i) const {
    constexpr std::size_t asked = 8;
    const Body& b = solids_[i];
    std::vector<Point> points;
    const std::size_t step = std::max<std::size_t>(1, b.edges.size() / asked);
    for (std::size_t e = 0; e < b.edges.size(); e += step)
      points.push_back(b.edges[e].curve ? evaluate(*b.edges[e].curve, b.edges[e].range.mid()) : b[b.edges[e].start].point);
    return points;
  }

  const std::vector<Body>& solids_;
  std::vector<Box> boxes_;
  std::vector<std::unique_ptr<mesh::BodyMesh>> meshes_;
};

// The inner solid's shell goes to the outer one, its faces turned towards the hollow.
void take_as_void(Body& outer, Body&& inner) {
  const auto by = static_cast<std::uint32_t>(outer.faces.size());
  for (Face& f : inner.faces) f.reversed = !f.reversed;
  Shell shell = inner.shells.front();
  shell.is_void = true;
  for (Shell::Use& use : shell.faces) use.face.index += by;
  append(outer, std::move(inner));
  outer.add(std::move(shell));
}

}  // namespace

std::vector<std::size_t> nest_shells(std::vector<Body>& solids, const std::vector<bool>& inward) {
  const std::size_t n = solids.size();
  std::vector<std::size_t> gone;
  if (n < 2) return gone;
  Nester nester(solids);
  std::vector<std::vector<std::size_t>> around(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k)
      if (i != k && nester.is_inside(i, k)) around[i].push_back(k);
  std::vector<std::size_t> order(n);  // from outside
  for (std::size_t i = 0; i < n; ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return around[a].size() < around[b].size(); });
  std::vector<bool> is_void(n, false);
  std::vector<std::size_t> owner(n, n);
  for (const std::size_t i : order) {
    if (around[i].empty()) continue;
    const std::size_t next = *std::max_element(around[i].begin(), around[i].end(), [&](std::size_t a, std::size_t b) {
      return around[a].size() < around[b].size();
    });
    is_void[i] = !is_void[next] && inward[i] != inward[next];
    owner[i] = next;
  }
  for (std::size_t i = 0; i < n; ++i)
    if (is_void[i]) take_as_void(solids[owner[i]], std::move(solids[i])), gone.push_back(i);
  return gone;
}

}  // namespace trimloop::heal
