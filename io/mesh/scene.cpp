#include "io/mesh/scene.h"

#include <fmt/format.h>

#include <cmath>
#include <deque>

#include "base/number.h"
#include "io/face_report.h"
#include "kernel/check/measure.h"
#include "kernel/mesh/parallel.h"

namespace trimloop::io {

bool is_visible(const Model& model, AttributesId id) { return model[id].visible; }

Result<double> parse_deflection(std::string_view text, double diagonal_mm) {
  double factor = 1;
  std::string_view number = text;
  if (!number.empty() && number.back() == '%') {
    number.remove_suffix(1);
    factor = diagonal_mm / 100;
  } else if (number.size() > 2 && number.substr(number.size() - 2) == "mm") {
    number.remove_suffix(2);
  }
  const NumberText<double> value = read_real(number);
  if (!value || !(value.value > 0)) {
    return fail(ErrorCode::InvalidArgument,
                fmt::format("deflection '{}' is not a positive length in mm or share of the diagonal (0.05, 0.1%)", text));
  }
  return value.value * factor;
}

Result<Box> visible_box(const Model& model, const Execution& execution) {
  const auto placed = occurrences(model, execution.limits.instances, execution.limits.nesting_depth);
  if (!placed) return tl::unexpected(placed.error());
  struct Item {
    std::size_t part;
    const Body* body;
    FaceId face;
  };
  std::vector<Item> items;
  for (std::size_t i = 0; i < model.parts.size(); ++i) {
    for (const Body& body : model.parts[i].bodies) {
      if (!is_visible(model, body.attributes)) continue;
      for (std::uint32_t f = 0; f < body.faces.size(); ++f)
        if (is_visible(model, body.faces[f].attributes)) items.push_back({i, &body, {f}});
    }
  }
  std::vector<Box> face_boxes(items.size());
  mesh::for_each_index(items.size(), execution.jobs, [&](std::size_t, std::size_t i) {
    if (!execution.stop.stop_requested()) face_boxes[i] = bounding_box(*items[i].body, items[i].face);
  });
  if (execution.stop.stop_requested()) return fail(ErrorCode::Cancelled, "stopped while measuring the model");
  std::vector<Box> part_boxes(model.parts.size());
  for (std::size_t i = 0; i < items.size(); ++i) part_boxes[items[i].part].add(face_boxes[i]);
  for (std::size_t i = 0; i < model.parts.size(); ++i) {
    for (const PolygonMesh& given : model.parts[i].meshes)
      if (!given.stands_for && is_visible(model, given.attributes)) part_boxes[i].add(bounding_box(given));
  }
  Box box;
  for (const Occurrence& o : *placed) {
    const Box& b = part_boxes[o.part];
    if (b.empty()) continue;
    for (int corner = 0; corner < 8; ++corner) {
      box.add(apply(o.transform, Point{corner & 1 ? b.hi.x : b.lo.x, corner & 2 ? b.hi.y : b.lo.y,
                                       corner & 4 ? b.hi.z : b.lo.z}));
    }
  }
  return box;
}

namespace {

// Hidden bodies and faces are not meshed: they are left out of a copy that keeps every index.
Body without_hidden(const Model& model, const Body& body) {
  Body copy = body;
  for (Face& face : copy.faces) {
    if (is_visible(model, face.attributes) || face.status == FaceStatus::Failed) continue;
    face.status = FaceStatus::Failed;
    face.reason = "hidden";
    face.loops.clear();
  }
  return copy;
}

bool has_hidden_face(const Model& model, const Body& body) {
  for (const Face& face : body.faces) {
    if (!is_visible(model, face.attributes)) return true;
  }
  return false;
}

// Triangles as the file has them. Where it gives no normal, a corner has that of its triangle.
mesh::BodyMesh as_given(const Model& model, const PolygonMesh& given) {
  mesh::BodyMesh out;
  out.points = given.points;
  for (std::uint32_t f = 0; f < given.faces.size(); ++f) {
    const MeshFace& face = given.faces[f];
    mesh::FaceMesh& to = out.faces.emplace_back();
    to.face = FaceId{f};
    if (!is_visible(model, face.attributes)) {
      to.reason = "hidden";
      continue;
    }
    for (std::size_t t = 0; t < face.triangles.size(); ++t) {
      const auto c = given.corners(face, t);
      const Vector flat = normalized(cross(c[1] - c[0], c[2] - c[0]));
      std::array<std::uint32_t, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        const MeshVertex& v = face.vertices[face.triangles[t][k]];
        corners[k] = static_cast<std::uint32_t>(to.vertices.size());
        to.vertices.push_back({v.point, {}, norm(v.normal) > 0 ? v.normal : flat});
      }
      to.triangles.push_back(corners);
    }
  }
  return out;
}

// The largest placement scale of each part, so that a body placed enlarged still meets the deflection.
std::vector<double> largest_scale(const Model& model, const std::vector<Occurrence>& placed) {
  std::vector<double> scale(model.parts.size(), 0);
  for (const Occurrence& o : placed) scale[o.part] = std::max(scale[o.part], scale_factor(o.transform));
  return scale;
}

struct Bounds {
  double deflection_mm, angle_rad;
  Bounds times(double factor) const {  // sagittas grow with the square of the angle
    return {deflection_mm * factor, std::min(angle_rad * std::sqrt(factor), pi / 2)};
  }
};

Result<std::vector<SceneBody>> meshed(const Model& model, const std::vector<double>& scales, const Bounds& bounds,
                                      const Execution& execution) {
  std::vector<SceneBody> out;
  std::vector<mesh::BodyTask> tasks;
  std::vector<std::size_t> place;       // in `out`, by task
  std::deque<Body> without_hidden_faces;
  for (std::uint32_t p = 0; p < model.parts.size(); ++p) {
    if (!(scales[p] > 0)) continue;
    for (std::uint32_t b = 0; b < model.parts[p].bodies.size(); ++b) {
      const Body& body = model.parts[p].bodies[b];
      if (!is_visible(model, body.attributes)) continue;
      mesh::BodyTask& task = tasks.emplace_back();
      task.body = has_hidden_face(model, body) ? &without_hidden_faces.emplace_back(without_hidden(model, body)) : &body;
      task.options.angle_rad = bounds.angle_rad;
      task.options.deflection_mm = bounds.deflection_mm / scales[p];
      place.push_back(out.size());
      out.push_back({p, b, false, {}});
    }
    for (std::uint32_t m = 0; m < model.parts[p].meshes.size(); ++m) {
      const PolygonMesh& given = model.parts[p].meshes[m];
      if (!given.stands_for && is_visible(model, given.attributes)) out.push_back({p, m, true, as_given(model, given)});
    }
  }
  auto meshes = mesh::tessellate(tasks, execution);
  if (!meshes) return tl::unexpected(meshes.error());
  for (std::size_t i = 0; i < tasks.size(); ++i) out[place[i]].mesh = std::move((*meshes)[i]);
  return out;
}

std::size_t triangles_of(const std::vector<SceneBody>& bodies) {
  std::size_t sum = 0;
  for (const SceneBody& b : bodies) sum += b.mesh.triangle_count();
  return sum;
}

// Bounds are widened until the budget holds, then narrowed again by halving the ratio between the last that did not fit
// and the last that did. `factor`: by how much the deflection was widened.
Result<std::vector<SceneBody>> within_budget(const Model& model, const std::vector<double>& scales, const Bounds& asked,
                                             const WriteOptions& options, double& factor) {
  constexpr int most_widenings = 40, narrowings = 4;
  const auto budget = *options.max_triangles;
  auto best = meshed(model, scales, asked, options.execution);
  double too_many = 1;
  std::size_t count = best ? triangles_of(*best) : 0;
  factor = 1;
  for (int i = 0; best && count > budget; ++i) {
    const std::size_t before = count;
    too_many = factor;
    factor *= std::max(2.0, 1.1 * static_cast<double>(count) / static_cast<double>(budget));
    best = meshed(model, scales, asked.times(factor), options.execution);
    count = best ? triangles_of(*best) : 0;
    if (i == most_widenings || (count == before && i > 4))
      return fail(ErrorCode::Limit, fmt::format("the coarsest mesh has {} triangles, not {}", count, budget),
                  static_cast<double>(count), static_cast<double>(budget));
  }
  for (int i = 0; best && factor > 1 && i < narrowings; ++i) {
    const double middle = std::sqrt(too_many * factor);
    auto finer = meshed(model, scales, asked.times(middle), options.execution);
    if (!finer) return finer;
    if (triangles_of(*finer) > budget) {
      too_many = middle;
    } else {
      factor = middle;
      best = std::move(finer);
    }
  }
  return best;
}

}  // namespace

Result<Scene> make_scene(const Model& model, const WriteOptions& options) {
  Scene scene;
  auto placed = occurrences(model, options.execution.limits.instances, options.execution.limits.nesting_depth);
  if (!placed) return tl::unexpected(placed.error());
  for (Occurrence& o : *placed) {
    bool visible = true;
    std::uint32_t part = 0;
    for (const std::uint32_t step : o.path) {
      const Instance& instance = model.parts[part].instances[step];
      visible = visible && is_visible(model, instance.attributes);
      part = instance.part;
    }
    if (visible) scene.occurrences.push_back(std::move(o));
  }

  double diagonal = 0;
  if (options.deflection.find('%') != std::string::npos) {
    const auto box = visible_box(model, options.execution);
    if (!box) return tl::unexpected(box.error());
    diagonal = box->diagonal() > 0 ? box->diagonal() : 1;
  }
  const auto deflection = parse_deflection(options.deflection, diagonal);
  if (!deflection) return tl::unexpected(deflection.error());
  scene.deflection_mm = *deflection;

  const std::vector<double> scales = largest_scale(model, scene.occurrences);
  const Bounds asked{scene.deflection_mm, options.angle_deg * pi / 180};
  auto bodies = options.max_triangles ? within_budget(model, scales, asked, options, scene.coarsened)
                                      : meshed(model, scales, asked, options.execution);
  if (!bodies) return tl::unexpected(bodies.error());
  scene.bodies = std::move(*bodies);
  return scene;
}

AttributesId attributes_of(const Model& model, const SceneBody& item) {
  const Part& part = model.parts[item.part];
  return item.is_given ? part.meshes[item.body].attributes : part.bodies[item.body].attributes;
}

AttributesId attributes_of(const Model& model, const SceneBody& item, const mesh::FaceMesh& face) {
  const Part& part = model.parts[item.part];
  return item.is_given ? part.meshes[item.body].faces[face.face.index].attributes
                       : part.bodies[item.body].faces[face.face.index].attributes;
}

void describe(const Model& model, const SourceInfo& source, const Scene& scene, WriteResult& result) {
  result.deflection_mm = scene.deflection_mm;
  result.coarsened = scene.coarsened;
  std::uint32_t id = 0;
  for (const SceneBody& item : scene.bodies) {
    result.vertices += item.mesh.points.size();
    result.open_edges += item.mesh.open_edges();
    if (item.is_given) {
      result.triangles += item.mesh.triangle_count();
      continue;  // rows are of exact faces
    }
    const Body& body = model.parts[item.part].bodies[item.body];
    for (std::size_t f = 0; f < body.faces.size(); ++f) {
      const Face& face = body.faces[f];
      const mesh::FaceMesh& triangles = item.mesh.faces[f];
      FaceReport row = face_report(source, body, FaceId{static_cast<std::uint32_t>(f)}, id++);
      if (row.reason.empty()) row.reason = triangles.reason;
      if (face.status != FaceStatus::Failed && triangles.triangles.empty() && triangles.reason != "hidden") {
        row.status = FaceStatus::Failed;
        if (row.reason.empty()) row.reason = "no triangles";
      }
      row.triangles = triangles.triangles.size();
      row.bound_mm = triangles.bound_mm;
      row.bound_kind = triangles.bound_kind;
      result.triangles += row.triangles;
      result.max_bound_mm = std::max(result.max_bound_mm, row.bound_mm);
      result.faces.push_back(std::move(row));
    }
  }
}

}  // namespace trimloop::io
