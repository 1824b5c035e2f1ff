#include "kernel/check/measure.h"

#include "base/limits.h"
#include "kernel/check/extent.h"

namespace trimloop {
namespace {

// What does not depend on the placement of a part, up to powers of its scale.
struct PartSums {
  bool done = false;
  double area = 0, area_error = 0, length = 0, mesh_area = 0, mesh_volume = 0;
  double volume = 0, sheet_volume = 0;  // of solids; of closed shells that are called sheets
  bool has_volume = false, has_sheet_volume = false, has_mesh_volume = false;
  Box box;  // in the part's own coordinates
};

PartSums sums_of(const Part& part) {
  PartSums sums;
  sums.done = true;
  for (const Body& body : part.bodies) {
    for (std::uint32_t i = 0; i < body.faces.size(); ++i) {
      const Measured m = area(body, FaceId{i});
      sums.area += m.value;
      sums.area_error += m.error;
      detail::add_face(sums.box, body, body.faces[i], nullptr);
    }
    for (std::uint32_t i = 0; i < body.shells.size(); ++i)
      if (const auto v = volume(body, ShellId{i})) {
        const bool solid = body.kind == BodyKind::Solid;
        (solid ? sums.volume : sums.sheet_volume) += v->value;
        (solid ? sums.has_volume : sums.has_sheet_volume) = true;
      }
  }
  for (const PolygonMesh& mesh : part.meshes) {
    if (mesh.stands_for) continue;
    sums.box.add(bounding_box(mesh));
    sums.mesh_area += area(mesh);
    if (const auto v = volume(mesh)) {
      sums.mesh_volume += *v;
      sums.has_mesh_volume = true;
    }
  }
  for (const FreeCurve& c : part.curves)
    if (is_bounded(c.curve)) {
      sums.length += length(c.curve);
      detail::add_curve(sums.box, c.curve, range(c.curve), nullptr);
    }
  for (const FreePoint& p : part.points) sums.box.add(p.point);
  return sums;
}

bool keeps_axes(const Transform& t) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (i != j && t.r[i][j] != 0) return false;
  return true;
}

void add_part(Box& box, const Part& part, const Transform& at) {
  for (const Body& body : part.bodies)
    for (const Face& face : body.faces) detail::add_face(box, body, face, &at);
  for (const FreeCurve& c : part.curves)
    if (is_bounded(c.curve)) detail::add_curve(box, c.curve, range(c.curve), &at);
  for (const PolygonMesh& mesh : part.meshes)
    if (!mesh.stands_for)
      for (const Point p : mesh.points) box.add(apply(at, p));
  for (const FreePoint& p : part.points) box.add(apply(at, p.point));
}

void add_corners(Box& box, const Box& own, const Transform& at) {
  if (own.empty()) return;
  for (int k = 0; k < 8; ++k)
    box.add(apply(at, Point{k & 1 ? own.hi.x : own.lo.x, k & 2 ? own.hi.y : own.lo.y, k & 4 ? own.hi.z : own.lo.z}));
}

}  // namespace

Result<Measured> volume(const Body& body, ShellId id, double relative_error) {
  const Shell& shell = body[id];
  if (!shell.closed) return fail(ErrorCode::Degenerate, "an open shell has no volume");
  Box box;
  for (const Shell::Use& use : shell.faces)
    for (const LoopId loop : body[use.face].loops)
      for (const Coedge& c : body[loop].coedges) box.add(body[body[c.edge].start].point);
  const Point origin = box.empty() ? Point{} : midpoint(box.lo, box.hi);
  Measured sum;
  for (const Shell::Use& use : shell.faces) {
    const Measured m = volume_contribution(body, use.face, origin, relative_error);
    sum.value += use.reversed ? -m.value : m.value;
    sum.error += m.error;
  }
  return sum;
}

Result<Point> centroid(const Body& body, ShellId id, double relative_error) {
  const auto whole = volume(body, id, relative_error);
  if (!whole) return tl::unexpected(whole.error());
  Box box;
  for (const Shell::Use& use : body[id].faces) detail::add_face(box, body, body[use.face], nullptr);
  const double moment_scale = std::abs(whole->value) * box.diagonal();
  if (!(moment_scale > 0)) return fail(ErrorCode::Degenerate, "a shell without volume has no centre");
  Vector sum;
  for (const Shell::Use& use : body[id].faces) {
    const Vector m = moment_contribution(body, use.face, box.lo, relative_error, relative_error * moment_scale);
    sum += use.reversed ? -m : m;
  }
  return box.lo + sum / whole->value;
}

Result<ModelMeasures> measure(const Model& model, const Limits& limits) {
  const auto all = occurrences(model, limits.instances, limits.nesting_depth);
  if (!all) return tl::unexpected<Error>(all.error());
  ModelMeasures out;
  std::vector<PartSums> sums(model.parts.size());
  // A turned part is measured again for its box, up to so many faces; beyond, the corners of its own box enclose it.
  constexpr std::size_t most_turned_faces = 100'000;
  std::size_t turned_faces = 0;
  double total_volume = 0, sheet_volume = 0, mesh_volume = 0;
  bool has_volume = false, has_sheet_volume = false, has_mesh_volume = false;
  for (const Occurrence& o : *all) {
    const Part& part = model.parts[o.part];
    PartSums& own = sums[o.part];
    if (!own.done) own = sums_of(part);
    const double scale = scale_factor(o.transform);
    out.area_mm2 += own.area * scale * scale;
    out.area_error += own.area_error * scale * scale;
    out.curve_length_mm += own.length * scale;
    total_volume += own.volume * scale * scale * scale;
    has_volume = has_volume || own.has_volume;
    sheet_volume += own.sheet_volume * scale * scale * scale;
    has_sheet_volume = has_sheet_volume || own.has_sheet_volume;
    out.mesh_area_mm2 += own.mesh_area * scale * scale;
    mesh_volume += own.mesh_volume * scale * scale * scale;
    has_mesh_volume = has_mesh_volume || own.has_mesh_volume;
    for (const Body& body : part.bodies) turned_faces += keeps_axes(o.transform) ? 0 : body.faces.size();
    if (keeps_axes(o.transform) || turned_faces > most_turned_faces) {
      add_corners(out.box, own.box, o.transform);
    } else {
      add_part(out.box, part, o.transform);
    }
  }
  if (has_volume) out.volume_mm3 = total_volume;
  else if (has_sheet_volume) out.volume_mm3 = sheet_volume;
  if (has_mesh_volume) out.mesh_volume_mm3 = mesh_volume;
  return out;
}

}  // namespace trimloop
