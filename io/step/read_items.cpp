// Items of representations -> bodies, free curves, free points.

#include <fmt/format.h>

#include "formats/step/records/tessellated.h"
#include "formats/step/records/topology.h"
#include "formats/step/rules.h"
#include "io/rules.h"
#include "io/step/construction.h"
#include "io/step/structure.h"
#include "io/step/tessellation.h"

namespace trimloop::io::step_import {

namespace sr = step::rules;

void StructureReader::add(std::uint32_t part, const Record& item, Geometry& geometry) {
  const auto is = [&](Entity e) { return context_.is(item, e); };
  if (is(Entity::MappedItem)) return add_mapped(part, item, geometry);
  if (is(Entity::ManifoldSolidBrep) || is(Entity::ShellBasedSurfaceModel) || is(Entity::FaceBasedSurfaceModel) ||
      is(Entity::ConnectedFaceSet) || is(Entity::FaceSurface))
    return add_body(part, item, geometry);
  if (is(Entity::GeometricSet)) return add_set(part, item, geometry);
  if (is(Entity::ShellBasedWireframeModel) || is(Entity::EdgeBasedWireframeModel) || is(Entity::ConnectedEdgeSet))
    return add_wires(part, item, geometry);
  if (is(Entity::Placement) || is(Entity::Direction) || is(Entity::VectorEntity)) return;
  if (is(Entity::Curve) || is(Entity::Surface) || is(Entity::Point)) {
    Body sheet;
    sheet.source.push_back(source_of(item));
    add_element(part, item, geometry, {}, sheet);
    if (!sheet.faces.empty()) model_.parts[part].bodies.push_back(std::move(sheet));
    return;
  }
  if (is(Entity::TessellatedItem)) return add_tessellated(part, item, geometry);
  if (is_construction(context_, item)) return add_construction(part, item, geometry);
  const bool unread = is(Entity::SolidModel) || is(Entity::HalfSpaceSolid);
  if (unread) {
    context_.add(item, rules::unsupported, fmt::format("shapes of kind {} are not supported; it is left out", context_.file.keyword(item).name));
    context_.consume(item);
  }
}

void StructureReader::add_body(std::uint32_t part, const Record& item, Geometry& geometry) {
  Body body;
  body.kind = BodyKind::Sheet;
  body.source.push_back(source_of(item));
  Attributes whole = styles_.of(item), around;
  BrepReader reader(context_, geometry, body, [&](const Record& face, const std::string& name) {
    Attributes own = styles_.of(face);
    own.name = name == "NONE" ? std::string() : name;
    return model_.add(under(around, own));
  });
  const auto shell = [&](const Record& s) {
    around = under(whole, styles_.of(s));
    reader.shell(s, false, false);
  };
  if (context_.is(item, Entity::ManifoldSolidBrep)) {
    const auto r = context_.read<step::SolidRecord>(item);
    if (!r) return;
    whole.name = r->name;
    const Record* outer = context_.find(r->outer);
    around = outer ? under(whole, styles_.of(*outer)) : whole;
    reader.solid(item);
  } else if (context_.is(item, Entity::ConnectedFaceSet)) {
    shell(item);
  } else if (context_.is(item, Entity::FaceSurface)) {
    around = whole;
    reader.face(item);
  } else {
    context_.consume(item);
    const auto r = context_.read<step::Members>(item);
    if (!r) return;
    whole.name = r->name;
    for (const Ref ref : r->items)
      if (const Record* s = context_.resolve(item, ref, Entity::ConnectedFaceSet)) shell(*s);
  }
  if (body.faces.empty()) return;  // the reader has said why
  if (whole.name == "NONE") whole.name.clear();
  body.attributes = model_.add(whole);
  model_.parts[part].bodies.push_back(std::move(body));
}

void StructureReader::add_construction(std::uint32_t part, const Record& item, Geometry& geometry) {
  Attributes whole = styles_.of(item);
  step::Tape tape;
  step::Reader r(context_.file, item, context_.execution.limits, tape, context_.report);
  if (r.at(Entity::RepresentationItem, true)) whole.name = r.text(0);
  const AttributesId id = model_.add(whole);
  for (Body& body : ConstructionReader(context_, geometry).bodies(item)) {
    body.attributes = id;
    for (Face& face : body.faces) face.attributes = id;
    model_.parts[part].bodies.push_back(std::move(body));
  }
}

void StructureReader::add_tessellated(std::uint32_t part, const Record& item, Geometry& geometry) {
  const auto is = [&](Entity e) { return context_.is(item, e); };
  if (is(Entity::TessellatedGeometricSet)) {
    Visit visit(context_, item);
    const auto r = visit ? context_.read<step::TessellatedGroup>(item) : std::nullopt;
    if (!r) return;
    context_.consume(item);
    for (const Ref ref : r->items)
      if (const Record* member = context_.resolve(item, ref, Entity::TessellatedItem)) add_tessellated(part, *member, geometry);
    return;
  }
  MeshReader reader(context_, geometry, styles_, model_);
  if (is(Entity::TessellatedCurveSet) || is(Entity::TessellatedPointSet)) return reader.lines(model_.parts[part], item);
  if (is(Entity::CoordinatesList)) return;  // named by the items that use it
  if (auto mesh = reader.mesh(item)) model_.parts[part].meshes.push_back(std::move(*mesh));
}

void StructureReader::add_set(std::uint32_t part, const Record& item, Geometry& geometry) {
  Visit visit(context_, item);
  const auto r = visit ? context_.read<step::Members>(item) : std::nullopt;
  if (!r) return;
  context_.consume(item);
  Attributes whole = styles_.of(item);
  whole.name = r->name == "NONE" ? std::string() : r->name;
  Body sheet;
  sheet.source.push_back(source_of(item));
  sheet.attributes = model_.add(whole);
  for (const Ref ref : r->items)
    if (const Record* element = context_.resolve(item, ref, Entity::RepresentationItem)) add_element(part, *element, geometry, whole, sheet);
  if (!sheet.faces.empty()) model_.parts[part].bodies.push_back(std::move(sheet));
}

void StructureReader::add_element(std::uint32_t part, const Record& element, Geometry& geometry, const Attributes& owner, Body& sheet) {
  Attributes own = styles_.of(element);
  const AttributesId id = model_.add(under(owner, own));
  if (context_.is(element, Entity::Surface)) {
    const SurfacePtr basis = [&] {
      const auto placed = geometry.surface(element);
      return placed ? placed->surface : nullptr;
    }();
    const bool bounded = context_.is(element, Entity::BoundedSurface) || (basis && domain(*basis).is_bounded());
    if (basis && !bounded) {
      context_.add(element, rules::ignored, "an unbounded surface: it is listed here and counts as no face");
      return;
    }
    BrepReader reader(context_, geometry, sheet, [&](const Record&, const std::string&) { return id; });
    reader.surface_face(element);
  } else if (context_.is(element, Entity::Curve)) {
    context_.forget_text();
    const CurvePtr curve = geometry.curve(element);
    if (!curve) {
      context_.add(element, rules::unsupported, Severity::Error,
                   "the curve failed: " + (context_.last_text().empty() ? "its record cannot be used" : context_.last_text()));
      return;
    }
    model_.parts[part].curves.push_back({*curve, id, {source_of(element)}});
  } else if (context_.is(element, Entity::Point)) {
    if (const auto p = geometry.point(element)) model_.parts[part].points.push_back({*p, id, {source_of(element)}});
  } else if (context_.is(element, Entity::GeometricSet)) {
    add_set(part, element, geometry);
  } else if (context_.is(element, Entity::MappedItem)) {
    add_mapped(part, element, geometry);
  }
}

// Edges of wireframes as free curves: each edge once.
void StructureReader::add_wires(std::uint32_t part, const Record& item, Geometry& geometry) {
  Body wires;
  BrepReader reader(context_, geometry, wires, [&](const Record&, const std::string&) { return AttributesId{}; });
  const Attributes whole = styles_.of(item);
  std::vector<const Record*> todo{&item};
  std::vector<bool> seen(context_.file.instances().size());
  while (!todo.empty()) {
    const Record& i = *todo.back();
    todo.pop_back();
    if (seen[context_.index(i)]) continue;
    seen[context_.index(i)] = true;
    context_.consume(i);
    if (context_.is(i, Entity::EdgeCurve)) {
      const EdgeId id = reader.edge(i);
      if (id)
        model_.parts[part].curves.push_back({*wires[id].curve, model_.add(under(whole, styles_.of(i))), {source_of(i)}});
      else
        context_.add(i, rules::unsupported, Severity::Error, "the edge failed: " + context_.last_text());
      continue;
    }
    const auto references = context_.references(i);
    for (auto ref = references.rbegin(); ref != references.rend(); ++ref) {
      const Record* next = context_.find(*ref);
      if (next && context_.is(*next, Entity::TopologicalRepresentationItem) && !context_.is(*next, Entity::Vertex)) todo.push_back(next);
    }
  }
}

}  // namespace trimloop::io::step_import
