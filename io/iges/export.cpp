#include "io/iges/export.h"

#include <fmt/format.h>

#include "formats/iges/records/structure.h"
#include "io/iges/write_annotation.h"

namespace trimloop::io::iges_export {

namespace {

// IGES 5.3 2.2.4.3.14.
int unit_flag(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::Inch: return 1;
    case LengthUnit::Millimetre: return 2;
    case LengthUnit::Foot: return 4;
    case LengthUnit::Mile: return 5;
    case LengthUnit::Metre: return 6;
    case LengthUnit::Kilometre: return 7;
    case LengthUnit::Mil: return 8;
    case LengthUnit::Micron: return 9;
    case LengthUnit::Centimetre: return 10;
    case LengthUnit::MicroInch: return 11;
  }
  return 2;
}

std::string_view unit_word(LengthUnit unit) {
  static constexpr std::string_view words[] = {"", "IN", "MM", "", "FT", "MI", "M", "KM", "MIL", "UM", "CM", "UIN"};
  return words[unit_flag(unit)];
}

constexpr std::string_view null_stamp = "00010101.000000";

// "YYYYMMDD.HHNNSS", and of two digits of the year, pass; ISO 8601 ("2026-11-25T04:05:06", as STEP has it) becomes that, its
// zone left out. Anything else is no date.
std::string date_of(const std::string& given) {
  const auto fits = [&](std::string_view form) {  // 0: a digit
    if (given.size() < form.size()) return false;
    for (std::size_t i = 0; i < form.size(); ++i)
      if (form[i] == '0' ? given[i] < '0' || given[i] > '9' : given[i] != form[i]) return false;
    return true;
  };
  if ((given.size() == 15 && fits("00000000.000000")) || (given.size() == 13 && fits("000000.000000"))) return given;
  if (!fits("0000-00-00T00:00:00")) return std::string(null_stamp);
  std::string out;
  for (const std::size_t at : {0, 1, 2, 3, 5, 6, 8, 9}) out += given[at];
  out += '.';
  for (const std::size_t at : {11, 12, 14, 15, 17, 18}) out += given[at];
  return out;
}

iges::Global global_of(const Model& model, const WriteOptions& options, LengthUnit unit, double mm_per_unit, const LineWeights& weights) {
  iges::Global global;
  global.sender_product = model.name;
  global.file_name = model.name;
  global.native_system = "trimloop";
  global.preprocessor = "trimloop";
  global.receiver_product = model.name;
  global.unit_flag = unit_flag(unit);
  global.unit_name = unit_word(unit);
  global.model_scale = Units(mm_per_unit).length(millimetres_per(unit));
  global.resolution = Units(mm_per_unit).length(model.resolution_mm);
  global.date = date_of(options.timestamp);
  global.modified = global.date;
  global.version_flag = 11;
  global.weight_gradations = weights.steps;
  global.max_line_width = Units(millimetres_per(unit)).length(weights.widest_mm);
  global.author = global.organization = "unknown";
  return global;
}

bool has_pole(const Body& body) {
  return std::any_of(body.edges.begin(), body.edges.end(), [](const Edge& e) { return e.is_pole; });
}

// As a shell with shared edges, unless the options or a pole forbid it: then face by face, and said so.
bool goes_as_shells(EntityWriter& writer, const Body& body) {
  if (body.shells.empty()) return false;
  const bool pole = writer.options.iges_profile == IgesProfile::Conservative && has_pole(body);
  if (writer.options.iges_bodies == IgesBodies::Solids && !pole) return true;
  writer.losses.push_back(fmt::format("a {} is written as {} trimmed surfaces{}", body.kind == BodyKind::Solid ? "solid" : "shell",
                                      body.faces.size(), pole ? ", since it has poles" : ""));
  return false;
}

// Members of one part, in the order bodies, curves, points, annotation, instances.
std::vector<iges::Ref> write_part(EntityWriter& writer, const Part& part, const std::vector<iges::Ref>& definitions,
                                  bool to_nurbs, Role role, std::map<std::string, std::size_t>& kinds_lost) {
  std::vector<iges::Ref> members;
  for (const Body& body : part.bodies) {
    if (body.kind == BodyKind::Wire) {
      for (const Edge& edge : body.edges) {
        if (edge.is_pole || !edge.curve) continue;
        if (const iges::Ref ref = write_curve(writer, with_range(*edge.curve, edge.range), role, body.attributes)) {
          members.push_back(ref);
        }
      }
      continue;
    }
    std::vector<bool> in_shell(body.faces.size(), false);
    if (goes_as_shells(writer, body) && write_shells(writer, body, to_nurbs, role, members)) {
      for (const Shell& shell : body.shells) {
        for (const Shell::Use& use : shell.faces) in_shell[use.face.index] = true;
      }
    }
    for (std::size_t f = 0; f < body.faces.size(); ++f) {
      if (!in_shell[f]) write_face(writer, body, body.faces[f], to_nurbs, role, members);
    }
  }
  for (const FreeCurve& free : part.curves) {
    const bool as_nurbs = to_nurbs && is_bounded(free.curve);
    const auto nurbs = as_nurbs ? trimloop::to_nurbs(free.curve) : Result<ToNurbsCurve>(fail(ErrorCode::Unsupported, ""));
    if (nurbs) ++writer.statement.exact_curves;
    const iges::Ref ref = write_curve(writer, nurbs ? Curve{nurbs->curve} : free.curve, role, free.attributes);
    if (ref) members.push_back(ref);
  }
  for (const FreePoint& free : part.points) {
    iges::PointRecord record;
    record.point = writer.units.point(free.point);
    members.push_back(writer.add(record, role, 0, nullptr, free.attributes));
  }
  for (const Annotation& a : part.annotation) {
    const Role as = role == Role::Independent ? Role::Annotation : Role::AnnotationPart;
    for (const iges::Ref ref : write_annotation(writer, a, as, kinds_lost)) members.push_back(ref);
  }
  for (const Instance& instance : part.instances) {
    // Scale, then translate, then the matrix (IGES 5.3 4.70): everything but the scale goes into the matrix.
    iges::SubfigureInstance record;
    record.definition = definitions[instance.part];
    record.scale = scale_factor(instance.transform);
    if (!record.definition || !(record.scale > 0)) {
      const std::string& name = writer.model.parts[instance.part].name;
      writer.losses.push_back(!record.definition ? fmt::format("an occurrence of {}: the part has no shape", name)
                                                 : fmt::format("an occurrence of {}: its placement flattens it", name));
      continue;
    }
    Transform placement = instance.transform;
    for (auto& row : placement.r) {
      for (double& value : row) value /= record.scale;
    }
    members.push_back(writer.add(record, role, 0, is_identity(placement) ? nullptr : &placement, instance.attributes));
  }
  return members;
}

// Definitions before their users: parts in the order in which all their own instances are already written.
std::vector<std::uint32_t> leaves_first(const Model& model) {
  std::vector<std::uint32_t> order, pending(model.parts.size(), 0);
  std::vector<std::vector<std::uint32_t>> users(model.parts.size());
  for (std::uint32_t p = 0; p < model.parts.size(); ++p) {
    for (const Instance& i : model.parts[p].instances) {
      users[i.part].push_back(p);
      ++pending[p];
    }
  }
  for (std::uint32_t p = 0; p < model.parts.size(); ++p) {
    if (pending[p] == 0) order.push_back(p);
  }
  for (std::size_t next = 0; next < order.size(); ++next) {
    for (const std::uint32_t user : users[order[next]]) {
      if (--pending[user] == 0) order.push_back(user);
    }
  }
  return order;
}

}  // namespace

Result<Exported> write(const Model& model, const SourceInfo&, const WriteOptions& options) {
  Exported out;
  const LengthUnit unit = options.unit.value_or(model.source_unit);
  const double mm_per_unit = options.unit ? millimetres_per(unit) : model.source_scale;
  const LineWeights weights = line_weights(model);
  EntityWriter writer(model, global_of(model, options, unit, mm_per_unit, weights), mm_per_unit, weights, options, out.losses);
  std::map<std::string, std::size_t> kinds_lost;

  std::vector<iges::Ref> definitions(model.parts.size());
  std::vector<std::int64_t> depths(model.parts.size(), 0);  // 308 states how deep its instances nest
  for (const std::uint32_t p : leaves_first(model)) {
    const Part& part = model.parts[p];
    if (p == 0) {
      write_part(writer, part, definitions, options.to_nurbs, Role::Independent, kinds_lost);
      continue;
    }
    iges::SubfigureDefinition record;
    record.name = part.name.empty() ? fmt::format("part {}", p) : writer.text(part.name);
    record.members = write_part(writer, part, definitions, options.to_nurbs, Role::Child, kinds_lost);
    for (const Instance& i : part.instances) depths[p] = std::max(depths[p], depths[i.part] + 1);
    record.depth = depths[p];
    if (!record.members.empty()) definitions[p] = writer.add(record, Role::Definition);
  }
  write_drawings(writer, kinds_lost);
  write_layer_names(writer);
  for (const auto& [kind, n] : kinds_lost) out.losses.push_back(fmt::format("annotation as lines and text only: {} {}", n, kind));
  if (writer.entities() == 0) return fail(ErrorCode::NotFound, "there is nothing that an IGES file can hold");
  auto bytes = writer.finish();
  if (!bytes) return tl::unexpected(bytes.error());
  out.bytes = std::move(*bytes);
  out.nurbs = writer.statement;
  return out;
}

}  // namespace trimloop::io::iges_export
