#include <fmt/format.h>

#include <chrono>
#include <map>

#include "base/bytes.h"
#include "io/face_report.h"
#include "io/description/export.h"
#include "io/iges/export.h"
#include "io/io.h"
#include "io/mesh/scene.h"
#include "io/nurbs_entities.h"
#include "io/step/export.h"
#include "io/step/pmi.h"
#include "io/step/raw_data.h"
#include "io/weights.h"

namespace trimloop::io {

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// What a mesh file cannot hold.
void list_mesh_losses(const Model& model, std::vector<std::string>& losses) {
  std::size_t curves = 0, points = 0, failed = 0;
  for (const Part& part : model.parts) {
    curves += part.curves.size();
    points += part.points.size();
    for (const Body& body : part.bodies) {
      for (const Face& face : body.faces) failed += face.status == FaceStatus::Failed;
    }
  }
  if (curves) losses.push_back(fmt::format("{} free curves: a mesh holds triangles only", curves));
  if (points) losses.push_back(fmt::format("{} free points: a mesh holds triangles only", points));
  if (failed) losses.push_back(fmt::format("{} faces that could not be made sound", failed));
}

Result<WriteResult> encode_mesh(const Model& model, const SourceInfo& source, const WriteOptions& options) {
  WriteResult result;
  const auto start = Clock::now();
  const auto scene = make_scene(model, options);
  if (!scene) return tl::unexpected(scene.error());
  result.timings.mesh_ms = milliseconds_since(start);
  describe(model, source, *scene, result);
  list_mesh_losses(model, result.losses);
  if (result.triangles == 0) {
    return fail(ErrorCode::NotFound, "there is no face to mesh: nothing would be in the output");
  }

  const auto write_start = Clock::now();
  const double unit_mm = millimetres_per(options.unit.value_or(LengthUnit::Millimetre));
  auto bytes = options.format == Format::Stl   ? to_stl(model, *scene, unit_mm)
               : options.format == Format::Obj ? to_obj(model, *scene, unit_mm)
               : options.format == Format::Ply ? to_ply(model, *scene, unit_mm)
                                               : to_glb(model, *scene);
  if (!bytes) return tl::unexpected(bytes.error());
  result.bytes = std::move(*bytes);
  result.timings.write_ms = milliseconds_since(write_start);
  return result;
}

// Annotation, drawings and views, which only IGES holds.
void list_drafting(const Model& model, std::vector<std::string>& losses) {
  std::map<std::string, std::size_t> annotations;
  for (const Part& part : model.parts) {
    for (const Annotation& a : part.annotation) ++annotations[a.kind];
  }
  for (const Drawing& drawing : model.drawings) {
    for (const Annotation& a : drawing.annotation) ++annotations[a.kind];
  }
  for (const auto& [kind, n] : annotations) losses.push_back(fmt::format("annotation: {} {}", n, kind));
  if (!model.drawings.empty()) losses.push_back(fmt::format("drawings: {}", model.drawings.size()));
  if (!model.views.empty()) losses.push_back(fmt::format("views of drawings: {}", model.views.size()));
}

// What the format does not hold, wherever it came from.
void list_exact_losses(const Model& model, const SourceInfo& source, Format format, StepSchema schema, std::vector<std::string>& losses) {
  if (format == Format::Iges) {
    std::size_t meshes = 0;
    for (const Part& part : model.parts) meshes += part.meshes.size();
    if (meshes) losses.push_back(fmt::format("polygon meshes: {}, IGES holds none", meshes));
  } else {
    list_drafting(model, losses);
  }
  // STEP keeps it as it stands (io/step/opaque.h): AP242 from a STEP file.
  if (format == Format::Step && schema == StepSchema::Ap242 && source.step) return;
  if (source.step) {
    for (const auto& [name, n] : count_properties(*source.step, {})) losses.push_back(fmt::format("properties of parts: {} '{}'", n, printable(name, 80)));
    std::map<std::string_view, std::size_t> raw;
    for (const step::Keyword& k : source.step->keywords())
      if (k.count > 0 && is_raw(k)) raw[k.name] += k.count;
    if (!raw.empty()) losses.push_back(list_raw_data(raw));
  }
  for (const auto& [kind, n] : source.pmi) losses.push_back(fmt::format("product manufacturing information: {} {}", n, kind));
}

// IGES and STEP: `write` gives bytes, losses and what became of the NURBS.
template <class Write>
Result<WriteResult> encode_exact(const Model& model, const SourceInfo& source, const WriteOptions& options, Write write) {
  const auto start = Clock::now();
  WriteResult result;
  const std::optional<Model> positive = with_positive_weights(model, result.losses);
  auto exported = write(positive ? *positive : model, source, options);
  if (!exported) return tl::unexpected(exported.error());
  result.bytes = std::move(exported->bytes);
  result.losses.insert(result.losses.end(), exported->losses.begin(), exported->losses.end());
  if (options.format == Format::Iges || options.format == Format::Step) list_exact_losses(model, source, options.format, options.step_schema, result.losses);
  result.nurbs = exported->nurbs;
  if (options.to_nurbs) result.nurbs.entities = nurbs_entities(model, source);
  std::uint32_t id = 0;
  for (const Part& part : model.parts) {
    for (const Body& body : part.bodies) {
      for (std::uint32_t f = 0; f < body.faces.size(); ++f)
        result.faces.push_back(face_report(source, body, FaceId{f}, id++));
    }
  }
  result.timings.write_ms = milliseconds_since(start);
  return result;
}

}  // namespace

Result<WriteResult> encode(const Model& model, const SourceInfo& source, const WriteOptions& options) {
  switch (options.format) {
    case Format::Iges: return encode_exact(model, source, options, iges_export::write);
    case Format::Step: return encode_exact(model, source, options, step_export::write);
    case Format::Json: return encode_exact(model, source, options, description::write_json);
    case Format::Svg: return encode_exact(model, source, options, description::write_svg);
    case Format::Stl:
    case Format::Obj:
    case Format::Ply:
    case Format::Glb: return encode_mesh(model, source, options);
    default: return fail(ErrorCode::Unsupported, fmt::format("this version does not write {}", to_string(options.format)));
  }
}

}  // namespace trimloop::io
