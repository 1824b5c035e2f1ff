#include "formats/iges/records/structure.h"

#include "formats/iges/records/trimming.h"

#include "formats/iges/rules.h"
#include "io/iges/annotation.h"
#include "io/iges/attributes.h"
#include "io/iges/curves.h"
#include "io/iges/placement.h"
#include "io/iges/solids.h"
#include "io/iges/structure.h"
#include "io/iges/surfaces.h"
#include "io/iges/trimming.h"
#include "io/rules.h"

namespace trimloop::io::iges_import {
namespace {

namespace igr = iges::rules;

bool is_definition(const DirectoryEntry& e) { return e.type == 308 || e.type == 320; }
bool is_group(const DirectoryEntry& e) {
  return e.type == 402 && (e.form == 1 || e.form == 7 || e.form == 14 || e.form == 15);
}
bool is_face(const DirectoryEntry& e) { return e.type == 144 || e.type == 143 || (e.type == 108 && e.form == 1); }
bool is_points(const DirectoryEntry& e) {
  return e.type == 116 || e.type == 132 || e.type == 134 || (e.type == 106 && e.form >= 1 && e.form <= 3);
}

}  // namespace

StructureReader::StructureReader(Context& context, Model& model)
    : context_(context), model_(model), ownership_(ownership(context)),
      trees_(context, [this](const DirectoryEntry& entry) { return solid_body(entry); }) {}

void StructureReader::read() {
  model_.parts.emplace_back();
  definitions_.push_back(nullptr);
  for (const DirectoryEntry& entry : context_.file.directory())
    if (is_definition(entry)) part_of(entry);
  fill(0, roots());
  for (std::uint32_t part = 1; part < model_.parts.size(); ++part) fill_part(part);
  read_drawings(context_, model_);
  add_left_over();
  limit_instances(context_, model_, definitions_);
  report_unused(context_);
}

// Everything that no entity owns. Definitions are never drawn themselves; members of groups stand for themselves.
StructureReader::Entries StructureReader::roots() const {
  Entries out;
  for (const DirectoryEntry& entry : context_.file.directory())
    if (entry.type != 0 && entry.usable && !ownership_.owned[context_.index(entry)]) out.push_back(&entry);
  return out;
}

void StructureReader::fill(std::uint32_t part, const Entries& entries) {
  // A group inside a definition brings its members along; a group at the top has them beside it already.
  Entries todo(entries.rbegin(), entries.rend());
  std::vector<bool> opened(part == 0 ? 0 : context_.file.directory().size());
  while (!todo.empty()) {
    const DirectoryEntry& entry = *todo.back();
    todo.pop_back();
    if (context_.execution.stop.stop_requested()) {
      context_.add(entry, rules::cancelled, "the import was interrupted before this entity");
      return;
    }
    if (!is_group(entry) || part == 0) {
      add(part, entry);
      continue;
    }
    const auto* group = context_.record<iges::Associativity>(entry);
    if (!group || opened[context_.index(entry)]) continue;
    opened[context_.index(entry)] = true;
    for (auto ref = group->members.rbegin(); ref != group->members.rend(); ++ref)
      if (const DirectoryEntry* member = *ref ? context_.file.find(*ref) : nullptr) todo.push_back(member);
  }
}

void StructureReader::add(std::uint32_t part, const DirectoryEntry& entry) {
  const int dependence = entry.status.subordinate;
  const bool shape = is_curve(entry) || is_surface(entry) || is_face(entry) || is_points(entry);
  if (part == 0 && shape && (dependence == 1 || dependence == 3) && !is_hole(entry) && !ownership_.group[context_.index(entry)])
    context_.add(entry, igr::orphan_dependent, "the entity is marked as part of another, but none uses it");
  if (is_primitive(entry) || entry.type == 186 || entry.type == 514 || entry.type == 510) return add_solid(part, entry);
  if (is_hole(entry)) return;
  if (is_face(entry)) return add_face(part, entry);
  if (entry.type == 108) {  // form 0 on its own: a plane without end is no face
    context_.state(entry).consumed = true;
    context_.add(entry, rules::ignored, "an unbounded plane: it is listed here and counts as no face");
    return;
  }
  if (is_surface(entry)) return add_face(part, entry);
  if (is_curve(entry) || entry.type == 142 || entry.type == 141) return add_curve(part, entry);
  if (is_points(entry)) return add_points(part, entry);
  if (is_annotation(entry)) return add_annotation(part, entry);
  if (entry.type == 125) return add_flash(part, entry);
  if (is_copy(entry)) return add_copy(part, entry);
  if (is_external(entry)) return add_external(part, entry);
}

bool StructureReader::is_hole(const DirectoryEntry& entry) const {
  if (entry.type != 108) return false;
  if (entry.form == -1) return true;
  for (const auto& [plane, holes] : ownership_.holes)
    if (std::find(holes.begin(), holes.end(), &entry) != holes.end()) return true;
  return false;
}

Attributes StructureReader::attributes(const DirectoryEntry& entry) {
  Attributes own = own_attributes(context_, entry);
  const DirectoryEntry* group = ownership_.group[context_.index(entry)];
  if (group && own.name.empty() && context_.record<iges::Associativity>(*group))
    own.name = own_attributes(context_, *group).name;
  return own;
}

Body& StructureReader::sheet(std::uint32_t part, const DirectoryEntry& entry) {
  const DirectoryEntry* group = ownership_.group[context_.index(entry)];
  auto& bodies = model_.parts[part].bodies;
  const auto [at, fresh] = sheets_.try_emplace({part, group ? group->de : 0}, bodies.size());
  if (!fresh) return bodies[at->second];
  Body& body = bodies.emplace_back();
  body.kind = BodyKind::Sheet;
  if (group && context_.record<iges::Associativity>(*group)) {
    body.attributes = model_.add(own_attributes(context_, *group));
    body.source.push_back(source_of(*group));
  }
  return body;
}

// A solid (186), shell (514) or face (510) and what it consists of; nothing after a finding.
std::optional<Body> StructureReader::brep_body(const DirectoryEntry& entry) {
  Body body;
  body.kind = BodyKind::Sheet;
  body.source.push_back(source_of(entry));
  Attributes whole;
  BrepReader reader(context_, body, [&](const DirectoryEntry& face) {
    Attributes own = own_attributes(context_, face);
    return model_.add(&face == &entry ? own : under(whole, entry, own));
  });
  // Own attributes need the record's trailing pointers: decode it first.
  if (entry.type == 186) context_.record<iges::ManifoldSolid>(entry);
  if (entry.type == 514) context_.record<iges::ShellRecord>(entry);
  if (entry.type == 510) context_.record<iges::FaceRecord>(entry);
  whole = attributes(entry);
  if (entry.type == 186) reader.solid(entry);
  if (entry.type == 514) reader.shell(entry);
  if (entry.type == 510) reader.face(entry);
  if (body.faces.empty()) return std::nullopt;  // the reader has said why
  body.attributes = model_.add(whole);
  return body;
}

void StructureReader::add_face(std::uint32_t part, const DirectoryEntry& entry) {
  const auto holes = ownership_.holes.find(context_.index(entry));
  auto input = face_input(context_, entry, holes == ownership_.holes.end() ? Entries{} : holes->second);
  Attributes own = attributes(entry);
  if (input && !own.colour && input->source.size() > 1)  // a sender may colour the surface instead of the face
    if (const DirectoryEntry* base = context_.file.find(Ref{static_cast<std::int32_t>(input->source[1].id)}))
      own.colour = own_attributes(context_, *base).colour;
  const AttributesId id = model_.add(own);
  iges_import::add_face(context_, sheet(part, entry), entry, std::move(input), id);
}

void StructureReader::add_curve(std::uint32_t part, const DirectoryEntry& entry) {
  context_.state(entry).consumed = true;
  if (entry.type == 142 || entry.type == 141) {
    context_.add(entry, rules::unsupported, "a trimming curve that trims nothing is not shown");
    return;
  }
  if (entry.status.use == 5) {
    context_.add(entry, igr::orphan_dependent, "a parameter-space curve that no surface uses is not shown");
    return;
  }
  const CurvePtr curve = model_curve(context_, entry);
  if (!curve) {
    context_.add(entry, rules::unsupported, Severity::Error,
                 "the curve failed: " + (context_.last_text().empty() ? "its record cannot be used" : context_.last_text()));
    return;
  }
  model_.parts[part].curves.push_back({*curve, model_.add(attributes(entry)), {source_of(entry)}});
}

void StructureReader::add_points(std::uint32_t part, const DirectoryEntry& entry) {
  context_.state(entry).consumed = true;
  const std::vector<Point> points = model_points(context_, entry);
  if (points.empty()) return;
  const AttributesId id = model_.add(attributes(entry));
  for (const Point p : points) model_.parts[part].points.push_back({p, id, {source_of(entry)}});
}

void StructureReader::add_annotation(std::uint32_t part, const DirectoryEntry& entry) {
  Annotation annotation = read_annotation(context_, entry);
  if (annotation.strokes.empty() && annotation.texts.empty()) return;
  annotation.attributes = model_.add(attributes(entry));
  model_.parts[part].annotation.push_back(std::move(annotation));
}

// 125: a closed outline about its point. Form 0 copies another entity there, 1 is a circle, 2 a rectangle, 3 a ring, 4 a
// strip with round ends.
void StructureReader::add_flash(std::uint32_t part, const DirectoryEntry& entry) {
  Visit visit(context_, entry);
  const iges::TableRecord* r = visit ? context_.table(entry) : nullptr;
  if (!r) return;
  context_.state(entry).consumed = true;
  const double mm = context_.unit.scale, a = r->real("D1") * mm, b = r->real("D2") * mm, turn = r->real("ROT");
  const Transform at = model_placement(context_, entry) *
                       Transform::translation({r->real("X") * mm, r->real("Y") * mm, 0}) *
                       Transform::rotation({}, {0, 0, 1}, turn);
  if (entry.form == 0) {
    const DirectoryEntry* shape = r->ref("DE") ? context_.file.find(r->ref("DE")) : nullptr;
    if (shape && shape != &entry) place(part, entry, *shape, at);
    return;
  }
  const auto add_outline = [&](Curve curve) {
    if (auto placed = transformed(curve, at))
      model_.parts[part].curves.push_back({std::move(*placed), model_.add(attributes(entry)), {source_of(entry)}});
  };
  const auto circle = [](Point centre, double radius, Interval range) {
    return std::make_shared<const Curve>(Curve{Circle{Frame{centre}, radius, range}});
  };
  if (!(a > 0) || (entry.form > 1 && !(b > 0))) {
    context_.add(entry, igr::e150::size, Severity::Warning, "the flash has no size; it is left out", std::min(a, b), 0.0);
  } else if (entry.form == 2) {
    add_outline({Polyline{{{-a / 2, -b / 2, 0}, {a / 2, -b / 2, 0}, {a / 2, b / 2, 0}, {-a / 2, b / 2, 0}, {-a / 2, -b / 2, 0}}}});
  } else if (entry.form == 4) {
    const double r0 = std::min(a, b) / 2, c = std::max(0.0, a / 2 - r0);
    const auto side = [](Point p, Point q) { return std::make_shared<const Curve>(Curve{Line{p, q, {0, 1}}}); };
    add_outline({make_composite({{side({-c, -r0, 0}, {c, -r0, 0})},
                                 {circle({c, 0, 0}, r0, {-pi / 2, pi / 2})},
                                 {side({c, r0, 0}, {-c, r0, 0})},
                                 {circle({-c, 0, 0}, r0, {pi / 2, 1.5 * pi})}})});
  } else {
    add_outline(*circle({}, a / 2, {0, two_pi}));
    if (entry.form == 3) add_outline(*circle({}, b / 2, {0, two_pi}));
  }
}

std::optional<Body> StructureReader::solid_body(const DirectoryEntry& entry) {
  if (!is_primitive(entry)) return brep_body(entry);
  auto body = primitive_body(context_, entry);
  if (!body) return std::nullopt;
  body->attributes = model_.add(attributes(entry));
  for (Face& face : body->faces) face.attributes = body->attributes;
  return body;
}

void StructureReader::add_solid(std::uint32_t part, const DirectoryEntry& entry) {
  if (auto body = solid_body(entry)) model_.parts[part].bodies.push_back(std::move(*body));
}

// Faces, shells and solids whose owner could not be used still appear, at the top. Curves and surfaces that are parts of
// each other in a circle are read once, so that the circle is named.
void StructureReader::add_left_over() {
  const auto& directory = context_.file.directory();
  const auto each = [&](auto wanted) {
    for (const DirectoryEntry& entry : directory) {
      const Context::State& state = context_.state(entry);
      if (entry.usable && !state.consumed && !state.visited && wanted(entry) && !is_hole(entry)) add(0, entry);
    }
  };
  each([](const DirectoryEntry& e) { return e.type == 186; });
  each([](const DirectoryEntry& e) { return e.type == 514; });
  each([](const DirectoryEntry& e) { return e.type == 510 || is_face(e); });
  for (const DirectoryEntry& entry : directory) {
    if (!entry.usable || context_.state(entry).visited) continue;
    if (entry.type == 102 || entry.type == 130) model_curve(context_, entry);
    if (entry.type == 140) model_surface(context_, entry);
  }
}

}  // namespace trimloop::io::iges_import
