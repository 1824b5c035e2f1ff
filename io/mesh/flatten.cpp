// Scene -> the flat arrays of each mesh format.

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "formats/gltf/glb.h"
#include "formats/obj/obj.h"
#include "formats/ply/ply.h"
#include "formats/stl/stl.h"
#include "io/mesh/scene.h"

namespace trimloop::io {

namespace {

constexpr Colour default_colour{0.72, 0.75, 0.8};

std::array<double, 3> to_array(Point p) { return {p.x, p.y, p.z}; }
std::array<float, 3> to_floats(Vector p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

// The colour that shows on a face: its own, else its body's, else the default.
Colour colour_of(const Model& model, const SceneBody& item, const mesh::FaceMesh& face) {
  if (const auto& own = model[attributes_of(model, item, face)].colour) return *own;
  if (const auto& all = model[attributes_of(model, item)].colour) return *all;
  return default_colour;
}

std::string name_of(const Model& model, const SceneBody& item) {
  const std::string& own = model[attributes_of(model, item)].name;
  if (!own.empty()) return own;
  const std::string& part = model.parts[item.part].name;
  return fmt::format("{} {}", part.empty() ? item.is_given ? "mesh" : "body" : part, item.body + 1);
}

// Calls use(item, occurrence, mirrored) for every placed body, in occurrence order.
void for_each_placed(const Scene& scene,
                     const std::function<void(const SceneBody&, const Occurrence&, bool mirrored)>& use) {
  for (const Occurrence& occurrence : scene.occurrences) {
    const bool mirrored = determinant(occurrence.transform) < 0;
    for (const SceneBody& item : scene.bodies) {
      if (item.part == occurrence.part) use(item, occurrence, mirrored);
    }
  }
}

// A mirrored placement turns triangles inside out; swapping two corners turns them back.
std::array<std::uint32_t, 3> wound(std::array<std::uint32_t, 3> t, bool mirrored) {
  if (mirrored) std::swap(t[1], t[2]);
  return t;
}

}  // namespace

Result<std::string> to_stl(const Model&, const Scene& scene, double unit_mm) {
  std::vector<stl::Triangle> triangles;
  for_each_placed(scene, [&](const SceneBody& item, const Occurrence& occurrence, bool mirrored) {
    std::vector<std::array<float, 3>> points;
    points.reserve(item.mesh.points.size());
    for (const Point& p : item.mesh.points) points.push_back(to_floats(to_vector(apply(occurrence.transform, p)) / unit_mm));
    for (const mesh::FaceMesh& face : item.mesh.faces) {
      for (const auto& local : face.triangles) {
        const auto t = wound(local, mirrored);
        stl::Triangle out;
        for (std::size_t k = 0; k < 3; ++k) out.corners[k] = points[face.vertices[t[k]].point];
        if (out.corners[0] == out.corners[1] || out.corners[1] == out.corners[2] || out.corners[2] == out.corners[0]) {
          continue;  // two corners round to one float point: nothing is left of the triangle
        }
        const auto corner = [&](std::size_t k) {
          return Point{out.corners[k][0], out.corners[k][1], out.corners[k][2]};
        };
        out.normal = to_floats(normalized(cross(corner(1) - corner(0), corner(2) - corner(0))));
        triangles.push_back(out);
      }
    }
  });
  return stl::write(triangles, fmt::format("trimloop STL, 1 unit = {} mm", unit_mm));
}

Result<std::string> to_obj(const Model& model, const Scene& scene, double unit_mm) {
  obj::Document document;
  document.comment = fmt::format("trimloop OBJ, 1 unit = {} mm", unit_mm);
  for_each_placed(scene, [&](const SceneBody& item, const Occurrence& occurrence, bool mirrored) {
    obj::Group group;
    group.name = name_of(model, item);
    const auto first_point = static_cast<std::uint32_t>(document.positions.size());
    for (const Point& p : item.mesh.points) {
      document.positions.push_back(to_array(to_point(to_vector(apply(occurrence.transform, p)) / unit_mm)));
    }
    for (const mesh::FaceMesh& face : item.mesh.faces) {
      const auto first_normal = static_cast<std::uint32_t>(document.normals.size());
      for (const mesh::FaceVertex& v : face.vertices) {
        document.normals.push_back(to_array(to_point(normalized(apply(occurrence.transform, v.normal)))));
      }
      for (const auto& local : face.triangles) {
        const auto t = wound(local, mirrored);
        std::array<std::uint32_t, 3> p, n;
        for (std::size_t k = 0; k < 3; ++k) {
          p[k] = first_point + face.vertices[t[k]].point;
          n[k] = first_normal + t[k];
        }
        group.positions.push_back(p);
        group.normals.push_back(n);
      }
    }
    document.groups.push_back(std::move(group));
  });
  return obj::write(document);
}

Result<std::string> to_ply(const Model& model, const Scene& scene, double unit_mm) {
  ply::Document document;
  document.comment = fmt::format("trimloop PLY, 1 unit = {} mm", unit_mm);
  const auto byte = [](double c) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(c, 0.0, 1.0))); };
  for_each_placed(scene, [&](const SceneBody& item, const Occurrence& occurrence, bool mirrored) {
    const auto first = static_cast<std::uint32_t>(document.positions.size());
    for (const Point& p : item.mesh.points) {
      document.positions.push_back(to_array(to_point(to_vector(apply(occurrence.transform, p)) / unit_mm)));
    }
    for (const mesh::FaceMesh& face : item.mesh.faces) {
      const Colour c = colour_of(model, item, face);
      for (const auto& local : face.triangles) {
        auto t = wound(local, mirrored);
        for (auto& k : t) k = first + face.vertices[k].point;
        document.triangles.push_back(t);
        document.colours.push_back({byte(c.r), byte(c.g), byte(c.b)});
      }
    }
  });
  return ply::write(document);
}

namespace {

// One primitive per colour of a body; positions relative to `centre`, in mm.
std::vector<glb::Primitive> primitives_of(const Model& model, const SceneBody& item, Point centre) {
  std::vector<std::pair<std::array<double, 4>, glb::Primitive>> by_colour;
  const auto linear = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
  for (const mesh::FaceMesh& face : item.mesh.faces) {
    if (face.triangles.empty()) continue;
    const Colour c = colour_of(model, item, face);
    const std::array<double, 4> key{linear(c.r), linear(c.g), linear(c.b), 1};
    auto found = std::find_if(by_colour.begin(), by_colour.end(), [&](const auto& p) { return p.first == key; });
    if (found == by_colour.end()) {
      by_colour.push_back({key, {}});
      found = by_colour.end() - 1;
      found->second.colour = key;
    }
    glb::Primitive& primitive = found->second;
    const auto first = static_cast<std::uint32_t>(primitive.positions.size());
    for (const mesh::FaceVertex& v : face.vertices) {
      primitive.positions.push_back(to_floats(item.mesh.points[v.point] - centre));
      Vector n = normalized(v.normal);
      if (norm(n) == 0) n = {0, 0, 1};
      primitive.normals.push_back(to_floats(n));
    }
    for (auto t : face.triangles) {
      for (auto& k : t) k += first;
      primitive.triangles.push_back(t);
    }
  }
  std::vector<glb::Primitive> out;
  for (auto& p : by_colour) out.push_back(std::move(p.second));
  return out;
}

std::array<double, 16> column_major(const Transform& t) {
  return {t.r[0][0], t.r[1][0], t.r[2][0], 0, t.r[0][1], t.r[1][1], t.r[2][1], 0,
          t.r[0][2], t.r[1][2], t.r[2][2], 0, t.t.x,     t.t.y,     t.t.z,     1};
}

}  // namespace

// glTF is in metres with Y up: the root node turns and scales, coordinates stay as they are. Each body's vertices are
// relative to the centre of its box, so that a part far from the origin keeps its detail in single precision.
Result<std::string> to_glb(const Model& model, const Scene& scene) {
  glb::Document document;
  document.generator = "trimloop";
  std::vector<std::optional<std::size_t>> mesh_of(scene.bodies.size());
  std::vector<Point> centres(scene.bodies.size());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SceneBody& item = scene.bodies[i];
    Box box;
    for (const Point& p : item.mesh.points) box.add(p);
    if (!box.empty()) centres[i] = midpoint(box.lo, box.hi);
    std::vector<glb::Primitive> primitives = primitives_of(model, item, centres[i]);
    if (primitives.empty()) continue;
    mesh_of[i] = document.meshes.size();
    document.meshes.push_back({name_of(model, item), std::move(primitives)});
  }

  glb::Node root;
  root.name = model.name.empty() ? "model" : model.name;
  root.matrix = {1e-3, 0, 0, 0, 0, 0, -1e-3, 0, 0, 1e-3, 0, 0, 0, 0, 0, 1};
  for (const Occurrence& occurrence : scene.occurrences) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      if (scene.bodies[i].part != occurrence.part || !mesh_of[i]) continue;
      glb::Node node;
      node.name = name_of(model, scene.bodies[i]);
      node.mesh = mesh_of[i];
      node.matrix = column_major(occurrence.transform * Transform::translation(to_vector(centres[i])));
      root.children.push_back(document.nodes.size() + 1);
      document.nodes.push_back(std::move(node));
    }
  }
  document.nodes.insert(document.nodes.begin(), std::move(root));
  document.roots = {0};
  return glb::write(document);
}

}  // namespace trimloop::io
