#include "io/step/product_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "io/step/mesh_writer.h"
#include "io/step/properties.h"
#include "kernel/topology/transform_body.h"

namespace trimloop::io::step_export {

using step::Derived;
using step::partial;
using step::Unset;

namespace {

struct WrittenProduct {
  InstanceId definition;      // PRODUCT_DEFINITION
  InstanceId shape;           // PRODUCT_DEFINITION_SHAPE
  InstanceId representation;  // the SHAPE_REPRESENTATION that occurrences refer to
  InstanceId origin;          // its own axes
  std::vector<std::pair<InstanceId, Styled>> items;  // what an occurrence can give a style to
};

// Representation items by the kind of representation they belong to.
struct Geometry {
  std::vector<InstanceId> solids, surfaces, curves, meshes;
  std::vector<InstanceId> below_solids, below_surfaces;  // faces, edges and shells of these, where targets are kept
};

class ProductWriter {
 public:
  ProductWriter(EntityWriter& writer, const Structure& structure, const SharedContext& context, Targets& targets)
      : w_(writer), structure_(structure), context_(context), targets_(targets), masses_(writer.model), styles_(writer), products_(structure.definitions.size()) {}

  void run() {
    std::vector<InstanceId> all;
    for (const std::uint32_t d : structure_.leaves_first) {
      if (d == 0 && only_gathers()) continue;
      write(d);
      all.push_back(product_ids_[d]);
    }
    w_.out.add("PRODUCT_RELATED_PRODUCT_CATEGORY", "part", Unset{}, all);
    styles_.finish(context_.geometric);
  }

 private:
  bool only_gathers() const;
  void write(std::uint32_t d);
  Geometry write_geometry(const Part& part, double scale);
  WrittenBody write_body_of(const Body& body, Geometry& out, bool keep);
  void keep_targets(const Body& body, const WrittenBody& written);
  void write_meshes(const Part& part, double scale, const std::vector<WrittenBody>& bodies, Geometry& out);
  InstanceId own_placement(const Frame& frame);
  WrittenShape write_shape(const std::string& name, const Geometry& geometry, InstanceId origin,
                           const std::vector<InstanceId>& places);
  void keep_shape(const Part& part, const Geometry& geometry, const WrittenShape& shape);
  std::string unique_name(const Part& part, const Definition& definition);
  void write_occurrence(const Place& place, InstanceId target, const WrittenProduct& parent);

  EntityWriter& w_;
  const Structure& structure_;
  const SharedContext& context_;
  Targets& targets_;
  PartMasses masses_;
  StyleWriter styles_;
  std::vector<WrittenProduct> products_;
  std::map<std::uint32_t, InstanceId> product_ids_;
  std::set<std::string> names_;
  std::size_t occurrences_ = 0;
};

// A root without name and shape that holds several products as they stand is no product: they are roots themselves.
bool ProductWriter::only_gathers() const {
  const Part& root = w_.model.parts[0];
  if (root.instances.size() < 2 || !root.name.empty() || !root.bodies.empty() || !root.meshes.empty() || !root.curves.empty() ||
      !root.points.empty() || structure_.places[0].size() != root.instances.size())
    return false;
  std::set<std::uint32_t> seen;
  return std::all_of(root.instances.begin(), root.instances.end(), [&](const Instance& i) {
    const Attributes& own = w_.model[i.attributes];
    return seen.insert(i.part).second && is_identity(i.transform) && !own.colour && own.visible && own.layer == 0 &&
           (own.name.empty() || own.name == w_.model.parts[i.part].name);
  });
}

// A placement of its own: one that is shared would belong to several representations.
InstanceId ProductWriter::own_placement(const Frame& f) {
  const InstanceId origin = w_.point(f.origin), z = w_.direction(f.z), x = w_.direction(f.x);
  return w_.out.add("AXIS2_PLACEMENT_3D", "", origin, z, x);
}

std::string ProductWriter::unique_name(const Part& part, const Definition& d) {
  std::string name = part.name.empty() ? (d.part == 0 ? w_.model.name : fmt::format("part {}", d.part)) : part.name;
  if (d.scale == -1) name += " mirrored";
  else if (d.scale != 1) name += fmt::format(" x {}", d.scale);
  for (std::size_t n = 2; !names_.insert(name).second; ++n) {
    const std::string with_number = fmt::format("{} {}", name, n);
    if (names_.insert(with_number).second) return with_number;
  }
  return name;
}

void ProductWriter::keep_targets(const Body& body, const WrittenBody& written) {
  for (const WrittenFace& f : written.faces) targets_.add(body[f.face].source, f.id);
  for (const WrittenEdge& e : written.edges) targets_.add(body[e.edge].source, e.id);
  for (const WrittenShell& s : written.shells)
    if (s.shell) targets_.add(body[s.shell].source, s.id);
  const std::vector<InstanceId>& whole = written.solids.empty() ? written.surfaces : written.solids;
  if (!whole.empty()) targets_.add(body.source, whole.front());
}

WrittenBody ProductWriter::write_body_of(const Body& body, Geometry& out, bool keep) {
  WrittenBody written = write_body(w_, body);
  if (keep) {
    keep_targets(body, written);
    std::vector<InstanceId>& below = written.solids.empty() ? out.below_surfaces : out.below_solids;
    for (const WrittenFace& f : written.faces) below.push_back(f.id);
    for (const WrittenEdge& e : written.edges) below.push_back(e.id);
    for (const WrittenShell& s : written.shells) below.push_back(s.id);
  }
  for (const WrittenFace& f : written.faces) styles_.add(f.id, body[f.face].attributes, Styled::Surface);
  for (const InstanceId id : written.solids) styles_.add(id, body.attributes, Styled::Surface);
  for (const InstanceId id : written.surfaces) styles_.add(id, body.attributes, Styled::Surface);
  for (const InstanceId id : written.curves) styles_.add(id, body.attributes, Styled::Curve);
  const auto append = [](std::vector<InstanceId>& to, const std::vector<InstanceId>& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  append(out.solids, written.solids);
  append(out.surfaces, written.surfaces);
  append(out.curves, written.curves);
  return written;
}

void ProductWriter::write_meshes(const Part& part, double scale, const std::vector<WrittenBody>& bodies, Geometry& out) {
  for (const PolygonMesh& mesh : part.meshes) {
    if (!context_.is_ap242) {
      w_.lose(mesh.source, "a polygon mesh: AP214 has none");
      continue;
    }
    const WrittenBody* body = mesh.stands_for ? &bodies[mesh.stands_for.index] : nullptr;
    const WrittenMesh written = write_mesh(w_, mesh, scale, body);
    out.meshes.push_back(written.id);
    styles_.add(written.id, mesh.attributes, Styled::Surface);
    for (const WrittenMeshFace& f : written.faces) {
      if (f.attributes != mesh.attributes) styles_.add(f.id, f.attributes, Styled::Surface);
    }
  }
}

Geometry ProductWriter::write_geometry(const Part& part, double scale) {
  Geometry out;
  const bool moved = scale != 1;
  const Transform t = Transform::scale(scale);
  std::vector<WrittenBody> bodies;
  for (const Body& body : part.bodies) {
    if (!moved) {
      bodies.push_back(write_body_of(body, out, true));
    } else if (const auto scaled = transformed(body, t)) {
      bodies.push_back(write_body_of(*scaled, out, false));
    } else {
      bodies.emplace_back();
      w_.lose(body.source, fmt::format("a body at scale {}: {}", scale, scaled.error().text));
    }
  }
  write_meshes(part, scale, bodies, out);
  for (const FreeCurve& free : part.curves) {
    auto curve = moved ? transformed(free.curve, t) : Result<Curve>(free.curve);
    const auto id = curve ? write_bounded_curve(w_, *curve) : Result<InstanceId>(tl::unexpected(curve.error()));
    if (!id) {
      w_.lose(free.source, fmt::format("a free curve: {}", id.error().text));
      continue;
    }
    out.curves.push_back(*id);
    if (!moved) targets_.add(free.source, *id);
    styles_.add(*id, free.attributes, Styled::Curve);
  }
  for (const FreePoint& free : part.points) {
    const Point p = w_.units.point(moved ? apply(t, free.point) : free.point);
    const std::string name = free.attributes ? w_.model[free.attributes].name : std::string();
    out.curves.push_back(w_.out.add("CARTESIAN_POINT", name, std::array{p.x, p.y, p.z}));
    if (!moved) targets_.add(free.source, out.curves.back());
    styles_.add(out.curves.back(), free.attributes, Styled::Point);
  }
  return out;
}

// One representation for each kind of geometry. Where there is but one and no occurrence, it is the product's own; else
// they stand beside a plain one that holds the placements.
WrittenShape ProductWriter::write_shape(const std::string& name, const Geometry& g, InstanceId origin,
                                        const std::vector<InstanceId>& places) {
  struct Kind {
    std::string_view keyword;
    std::vector<InstanceId> items;
    InstanceId WrittenShape::* written;
  };
  WrittenShape out;
  std::vector<Kind> kinds;
  if (!g.solids.empty()) kinds.push_back({"ADVANCED_BREP_SHAPE_REPRESENTATION", g.solids, &WrittenShape::solids});
  if (!g.surfaces.empty()) kinds.push_back({"MANIFOLD_SURFACE_SHAPE_REPRESENTATION", g.surfaces, &WrittenShape::surfaces});
  if (!g.meshes.empty()) kinds.push_back({"TESSELLATED_SHAPE_REPRESENTATION", g.meshes, &WrittenShape::meshes});
  if (!g.curves.empty()) {
    out.curve_set = w_.out.add("GEOMETRIC_CURVE_SET", "", g.curves);
    kinds.push_back({"GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION", {out.curve_set}, &WrittenShape::curves});
  }
  if (kinds.size() == 1 && places.empty()) {
    kinds[0].items.push_back(origin);
    out.main = w_.out.add(kinds[0].keyword, name, kinds[0].items, context_.geometric);
    out.*kinds[0].written = out.main;
    return out;
  }
  std::vector<InstanceId> items{origin};
  items.insert(items.end(), places.begin(), places.end());
  out.main = w_.out.add("SHAPE_REPRESENTATION", name, items, context_.geometric);
  for (Kind& kind : kinds) {
    kind.items.push_back(own_placement(Frame{}));
    const InstanceId id = w_.out.add(kind.keyword, name, kind.items, context_.geometric);
    w_.out.add("SHAPE_REPRESENTATION_RELATIONSHIP", "", "", out.main, id);
    out.*kind.written = id;
  }
  return out;
}

void ProductWriter::keep_shape(const Part& part, const Geometry& g, const WrittenShape& shape) {
  const auto hold = [&](const std::vector<InstanceId>& items, InstanceId representation) {
    for (const InstanceId id : items) targets_.held_by.emplace(id.number, representation);
  };
  hold(g.solids, shape.solids);
  hold(g.below_solids, shape.solids);
  hold(g.surfaces, shape.surfaces);
  hold(g.below_surfaces, shape.surfaces);
  hold(g.curves, shape.curves);
  for (const SourceRef& ref : part.source)
    if (ref.role == 6) targets_.representations.try_emplace(ref.id, shape);
}

void ProductWriter::write(std::uint32_t d) {
  const Definition& definition = structure_.definitions[d];
  const Part& part = w_.model.parts[definition.part];
  const std::string name = unique_name(part, definition);
  // Products differ in their ids; names are the model's, twice where it has them twice.
  const std::string shown = definition.scale == 1 && !part.name.empty() ? part.name : name;
  const InstanceId product = w_.out.add("PRODUCT", name, shown, "", std::array{context_.product_context});
  const InstanceId formation = w_.out.add("PRODUCT_DEFINITION_FORMATION", "", "", product);
  product_ids_[d] = product;
  WrittenProduct& p = products_[d];
  p.definition = w_.out.add("PRODUCT_DEFINITION", "design", "", formation, context_.definition_context);
  p.shape = w_.out.add("PRODUCT_DEFINITION_SHAPE", "", "", p.definition);

  const Geometry geometry = write_geometry(part, definition.scale);
  p.origin = own_placement(Frame{});
  std::vector<InstanceId> targets;
  for (const Place& place : structure_.places[d]) targets.push_back(own_placement(place.frame));
  const WrittenShape shape = write_shape(name, geometry, p.origin, targets);
  p.representation = shape.main;
  for (const auto* of_kind : {&geometry.solids, &geometry.surfaces, &geometry.meshes})
    for (const InstanceId id : *of_kind) p.items.emplace_back(id, Styled::Surface);
  if (shape.curve_set) p.items.emplace_back(shape.curve_set, Styled::Curve);
  if (definition.scale == 1) {
    keep_shape(part, geometry, shape);
    for (const SourceRef& ref : part.source)
      if (ref.role == 0) targets_.products.try_emplace(ref.id, Targets::Product{p.definition, p.shape});
  }
  w_.out.add("SHAPE_DEFINITION_REPRESENTATION", p.shape, p.representation);
  write_properties(w_, masses_.of(definition.part), definition.scale, p.shape, context_);
  for (std::size_t i = 0; i < targets.size(); ++i) write_occurrence(structure_.places[d][i], targets[i], p);
}

void ProductWriter::write_occurrence(const Place& place, InstanceId target, const WrittenProduct& parent) {
  const WrittenProduct& child = products_[place.definition];
  const std::string id = fmt::format("{}", ++occurrences_);
  const std::string name = place.instance->attributes ? w_.model[place.instance->attributes].name : std::string();
  const Attributes& own = w_.model[place.instance->attributes];
  // A style lies on items of the part itself; an assembly has none.
  const bool bare = child.items.empty() || !structure_.places[place.definition].empty();
  if (own.colour && bare) w_.lose(place.instance->source, "the colour of an occurrence: an assembly has nothing to give it to");
  if (!own.visible && bare) w_.lose(place.instance->source, "a hidden occurrence: it is written visible, an assembly has nothing to hide");
  if (own.layer != 0 && bare) w_.lose(place.instance->source, "the layer of an occurrence: an assembly has nothing to put on it");
  const InstanceId usage = w_.out.add("NEXT_ASSEMBLY_USAGE_OCCURRENCE", id, name, "", parent.definition, child.definition,
                                      Unset{});
  const InstanceId shape = w_.out.add("PRODUCT_DEFINITION_SHAPE", "placement", "", usage);
  for (const SourceRef& ref : place.instance->source)
    if (ref.role == 0) targets_.products.try_emplace(ref.id, Targets::Product{usage, shape});
  const InstanceId moved = w_.out.add("ITEM_DEFINED_TRANSFORMATION", "", "", child.origin, target);
  const InstanceId relation = w_.out.add_complex(
      {partial("REPRESENTATION_RELATIONSHIP", "", "", child.representation, parent.representation),
       partial("REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION", moved), partial("SHAPE_REPRESENTATION_RELATIONSHIP")});
  w_.out.add("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION", relation, shape);
  if (bare || (!own.colour && own.visible && own.layer == 0)) return;
  for (const auto& [item, kind] : child.items) styles_.add_at(relation, item, place.instance->attributes, kind);
}

}  // namespace

void write_products(EntityWriter& writer, const Structure& structure, const SharedContext& context, Targets& targets) {
  ProductWriter(writer, structure, context, targets).run();
}

}  // namespace trimloop::io::step_export
