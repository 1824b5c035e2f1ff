#include "kernel/model/model.h"

#include <algorithm>

#include <functional>

namespace trimloop {
namespace {

struct UnitRow {
  LengthUnit unit;
  std::string_view name;
  double millimetres;
};
constexpr UnitRow unit_table[] = {
    {LengthUnit::Millimetre, "mm", 1},         {LengthUnit::Inch, "inch", 25.4},
    {LengthUnit::Foot, "foot", 304.8},         {LengthUnit::Mile, "mile", 1609344},
    {LengthUnit::Metre, "m", 1000},            {LengthUnit::Kilometre, "km", 1e6},
    {LengthUnit::Mil, "mil", 0.0254},          {LengthUnit::Micron, "micron", 0.001},
    {LengthUnit::Centimetre, "cm", 10},        {LengthUnit::MicroInch, "microinch", 0.0000254},
};

const UnitRow& row(LengthUnit unit) {
  for (const UnitRow& r : unit_table)
    if (r.unit == unit) return r;
  return unit_table[0];
}

struct UnitAlias {
  std::string_view name;
  LengthUnit unit;
};
constexpr UnitAlias unit_aliases[] = {
    {"millimetre", LengthUnit::Millimetre}, {"millimeter", LengthUnit::Millimetre}, {"in", LengthUnit::Inch},
    {"inches", LengthUnit::Inch},           {"ft", LengthUnit::Foot},               {"feet", LengthUnit::Foot},
    {"mi", LengthUnit::Mile},               {"metre", LengthUnit::Metre},           {"meter", LengthUnit::Metre},
    {"kilometre", LengthUnit::Kilometre},   {"kilometer", LengthUnit::Kilometre},   {"um", LengthUnit::Micron},
    {"micrometre", LengthUnit::Micron},     {"micrometer", LengthUnit::Micron},     {"centimetre", LengthUnit::Centimetre},
    {"centimeter", LengthUnit::Centimetre}, {"uin", LengthUnit::MicroInch},
};

bool same_letters(std::string_view text, std::string_view lower) {
  if (text.size() != lower.size()) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i] >= 'A' && text[i] <= 'Z' ? static_cast<char>(text[i] - 'A' + 'a') : text[i];
    if (c != lower[i]) return false;
  }
  return true;
}

bool equal(const Attributes& a, const Attributes& b) {
  const bool same_colour = a.colour.has_value() == b.colour.has_value() &&
                           (!a.colour || (a.colour->r == b.colour->r && a.colour->g == b.colour->g &&
                                          a.colour->b == b.colour->b));
  return same_colour && a.name == b.name && a.layer == b.layer && a.visible == b.visible &&
         a.line_font == b.line_font && a.line_weight_mm == b.line_weight_mm;
}

std::size_t hash_of(const Attributes& a) {
  std::size_t h = std::hash<std::string>{}(a.name);
  const auto mix = [&](std::size_t value) { h = h * 1000003u + value; };
  mix(std::hash<int>{}(a.layer));
  mix(a.visible);
  mix(std::hash<int>{}(a.line_font));
  mix(std::hash<double>{}(a.line_weight_mm));
  if (a.colour) {
    mix(std::hash<double>{}(a.colour->r));
    mix(std::hash<double>{}(a.colour->g));
    mix(std::hash<double>{}(a.colour->b));
  }
  return h;
}

ModelCounts operator*(std::size_t times, ModelCounts c) {
  for (std::size_t* value : {&c.solids, &c.shells, &c.faces, &c.faces_healed, &c.faces_failed, &c.edges, &c.curves,
                             &c.points, &c.meshes, &c.mesh_faces, &c.mesh_triangles})
    *value *= times;
  return c;
}

void operator+=(ModelCounts& a, const ModelCounts& b) {
  a.solids += b.solids;
  a.shells += b.shells;
  a.faces += b.faces;
  a.faces_healed += b.faces_healed;
  a.faces_failed += b.faces_failed;
  a.edges += b.edges;
  a.curves += b.curves;
  a.points += b.points;
  a.meshes += b.meshes;
  a.mesh_faces += b.mesh_faces;
  a.mesh_triangles += b.mesh_triangles;
}

ModelCounts count_own(const Part& part) {
  ModelCounts n;
  n.curves = part.curves.size();
  n.points = part.points.size();
  n.meshes = part.meshes.size();
  for (const PolygonMesh& mesh : part.meshes) {
    n.mesh_faces += mesh.faces.size();
    n.mesh_triangles += mesh.triangle_count();
  }
  for (const Body& body : part.bodies) {
    n.solids += body.kind == BodyKind::Solid;
    n.shells += body.shells.size();
    n.faces += body.faces.size();
    for (const Face& f : body.faces) {
      n.faces_healed += f.status == FaceStatus::Healed;
      n.faces_failed += f.status == FaceStatus::Failed;
    }
    for (const Edge& e : body.edges) n.edges += !e.is_pole;
  }
  return n;
}

}  // namespace

double millimetres_per(LengthUnit unit) { return row(unit).millimetres; }
std::string_view to_string(LengthUnit unit) { return row(unit).name; }

std::optional<LengthUnit> unit_from_name(std::string_view name) {
  for (const UnitRow& r : unit_table)
    if (same_letters(name, r.name)) return r.unit;
  for (const UnitAlias& a : unit_aliases)
    if (same_letters(name, a.name)) return a.unit;
  return std::nullopt;
}

AttributesId Model::add(const Attributes& a) {
  const std::size_t hash = hash_of(a);
  const auto [first, last] = attribute_places.equal_range(hash);
  for (auto it = first; it != last; ++it)
    if (equal(attributes[it->second], a)) return AttributesId{it->second};
  const auto place = static_cast<std::uint32_t>(attributes.size());
  attributes.push_back(a);
  attribute_places.emplace(hash, place);
  return AttributesId{place};
}

int Model::layer_number(std::string_view layer) {
  const auto known = std::find(layer_names.begin(), layer_names.end(), layer);
  if (known == layer_names.end()) return layer_names.emplace_back(layer), static_cast<int>(layer_names.size());
  return static_cast<int>(known - layer_names.begin()) + 1;
}

const Attributes& Model::operator[](AttributesId id) const {
  static const Attributes defaults;
  return id ? attributes[id.index] : defaults;
}

Result<std::vector<Occurrence>> occurrences(const Model& model, std::size_t max_instances, std::size_t max_depth) {
  std::vector<Occurrence> found;
  if (model.parts.empty()) return found;
  std::vector<Occurrence> stack{{0, Transform{}, {}}};
  while (!stack.empty()) {
    Occurrence here = std::move(stack.back());
    stack.pop_back();
    if (here.path.size() > max_depth)
      return fail(ErrorCode::Limit, "the assembly is nested too deeply", double(here.path.size()), double(max_depth));
    const std::vector<Instance>& children = model.parts[here.part].instances;
    const std::size_t known = found.size() + 1 + stack.size() + children.size();
    if (known > max_instances)
      return fail(ErrorCode::Limit, "the assembly has too many occurrences", double(known), double(max_instances));
    for (std::size_t i = children.size(); i-- > 0;) {
      if (children[i].part >= model.parts.size())
        return fail(ErrorCode::InvalidArgument, "an instance names a part that does not exist", children[i].part);
      Occurrence child{children[i].part, here.transform * children[i].transform, here.path};
      child.path.push_back(static_cast<std::uint32_t>(i));
      stack.push_back(std::move(child));
    }
    found.push_back(std::move(here));
  }
  return found;
}

// Level by level: how often each part occurs at that depth. Costs depth x instances whatever the number of occurrences.
Result<ModelCounts> count(const Model& model, std::size_t max_instances, std::size_t max_depth) {
  ModelCounts total;
  if (model.parts.empty()) return total;
  std::vector<std::size_t> here(model.parts.size(), 0), times(model.parts.size(), 0);
  here[0] = 1;
  std::size_t seen = 0;
  for (std::size_t depth = 0;; ++depth) {
    std::vector<std::size_t> below(model.parts.size(), 0);
    bool any = false;
    for (std::size_t p = 0; p < here.size(); ++p) {
      if (here[p] == 0) continue;
      any = true;
      seen += here[p];
      times[p] += here[p];
      if (seen > max_instances)
        return fail(ErrorCode::Limit, "the assembly has too many occurrences", double(seen), double(max_instances));
      for (const Instance& child : model.parts[p].instances) {
        if (child.part >= model.parts.size())
          return fail(ErrorCode::InvalidArgument, "an instance names a part that does not exist", child.part);
        below[child.part] = std::min(below[child.part] + here[p], max_instances + 1);
      }
    }
    if (!any) break;
    if (depth > max_depth)
      return fail(ErrorCode::Limit, "the assembly is nested too deeply", double(depth), double(max_depth));
    here = std::move(below);
  }
  for (std::size_t p = 0; p < times.size(); ++p)
    if (times[p] > 0) total += times[p] * count_own(model.parts[p]);
  return total;
}

}  // namespace trimloop
