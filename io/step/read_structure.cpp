// Products, representations and how they are put together.

#include "io/step/structure.h"
#include "io/step/tessellation.h"

#include <fmt/format.h>

#include <set>

#include "formats/step/records/geometry.h"
#include "formats/step/rules.h"
#include "io/rules.h"

namespace trimloop::io::step_import {

namespace sr = step::rules;

namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);

Transform inverse(const Transform& t) {
  const auto& m = t.r;
  const double det = determinant(t);
  Transform out;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      out.r[i][j] = (m[a][c] * m[b][d] - m[a][d] * m[b][c]) / det;
    }
  out.t = -apply(out, t.t);
  return out;
}

bool usable(const Transform& t) {
  const double det = determinant(t);
  return std::abs(det) > 0 && std::isfinite(det) && is_finite(t.t);
}

}  // namespace

StructureReader::StructureReader(Context& context, Model& model) : context_(context), model_(model), styles_(context, model) {}

void StructureReader::read() {
  collect();
  read_usages();
  make_parts();
  add_left_over();
  link_meshes(model_);
  limit_instances(context_, model_);
}

std::unordered_map<std::size_t, std::uint32_t> StructureReader::parts_of_definitions() const {
  std::unordered_map<std::size_t, std::uint32_t> out;
  for (const auto& [definition, shape] : by_definition_)
    if (const auto at = parts_.find(joined(shape)); at != parts_.end()) out.emplace(definition, at->second);
  return out;
}

std::size_t StructureReader::joined(std::size_t s) const {
  while (parent_[s] != s) s = parent_[s];
  return s;
}

void StructureReader::join(std::size_t a, std::size_t b) {
  a = joined(a);
  b = joined(b);
  if (a == b) return;
  if (b < a) std::swap(a, b);
  parent_[b] = a;
  Shape& to = shapes_[a];
  Shape& from = shapes_[b];
  to.representations.insert(to.representations.end(), from.representations.begin(), from.representations.end());
  from.representations.clear();
  if (!to.definition) to.definition = from.definition;
}

std::size_t StructureReader::shape_of(const Record& representation) {
  const auto [at, fresh] = by_representation_.try_emplace(context_.index(representation), shapes_.size());
  if (fresh) {
    parent_.push_back(shapes_.size());
    shapes_.push_back({{&representation}, nullptr, false, 0});
    const auto r = context_.read<step::RepresentationRecord>(representation);
    items_[context_.index(representation)] = r ? r->items : std::vector<Ref>{};
    contexts_[context_.index(representation)] = r ? context_.find(r->context) : nullptr;
  }
  return joined(at->second);
}

std::size_t StructureReader::shape_of_definition(const Record& definition) {
  const auto [at, fresh] = by_definition_.try_emplace(context_.index(definition), shapes_.size());
  if (fresh) {
    parent_.push_back(shapes_.size());
    shapes_.push_back({{}, &definition, false, 0});
  }
  return joined(at->second);
}

Geometry& StructureReader::geometry_for(const Record& representation) {
  shape_of(representation);
  const Record* context = contexts_[context_.index(representation)];
  const std::size_t key = context ? context_.index(*context) : none;
  auto& geometry = geometries_[key];
  if (!geometry) geometry = std::make_unique<Geometry>(context_, context_.units_of(context));
  return *geometry;
}

void StructureReader::collect() {
  for (const Record& i : context_.file.instances()) {
    if (context_.is(i, Entity::ShapeRepresentation)) {
      if (!context_.is(i, Entity::DraughtingModel)) shape_of(i);  // a saved view shows shapes, it has none
    } else if (context_.is(i, Entity::PropertyDefinitionRepresentation)) {
      const auto r = context_.read<step::Pair>(i);
      const Record* property = r ? context_.find(r->first) : nullptr;
      // Some senders leave it at the supertype; what it is of tells the same.
      const bool of_shape = context_.is(i, Entity::ShapeDefinitionRepresentation) || (property && context_.is(*property, Entity::ProductDefinitionShape));
      if (!of_shape) continue;
      const Record* representation = r ? context_.find(r->second) : nullptr;
      if (r && (!property || !representation)) context_.add(i, sr::reference_unresolved, "a shape definition leads nowhere");
      if (!property || !representation || !context_.is(*representation, Entity::Representation)) continue;
      const Record* definition = property;
      if (context_.is(*property, Entity::PropertyDefinition)) {
        const auto p = context_.read<step::PropertyRecord>(*property);
        definition = p ? context_.find(p->definition) : nullptr;
      }
      if (definition && context_.is(*definition, Entity::ProductDefinition)) {
        const std::size_t shape = shape_of(*representation);
        if (shapes_[shape].definition && shapes_[shape].definition != definition) {
          // One shape of two products: the second one gets it as a part of its own.
          const std::size_t other = shape_of_definition(*definition);
          uses_.push_back({&i, other, shape, {}, {}});
        } else {
          join(shape, shape_of_definition(*definition));
        }
      }
    } else if (context_.is(i, Entity::RepresentationRelationship) && !context_.is(i, Entity::RepresentationRelationshipWithTransformation) &&
               !context_.is(i, Entity::ConstructiveGeometryRepresentationRelationship)) {
      const auto r = context_.read<step::Relationship>(i);
      const Record* a = r ? context_.find(r->first) : nullptr;
      const Record* b = r ? context_.find(r->second) : nullptr;
      const auto is_shape = [&](const Record* candidate) {
        return candidate && context_.is(*candidate, Entity::ShapeRepresentation) && !context_.is(*candidate, Entity::DraughtingModel);
      };
      if (is_shape(a) && is_shape(b)) join(shape_of(*a), shape_of(*b));
    }
  }
  // A file without shapes still has its products.
  if (shapes_.empty())
    for (const Record& i : context_.file.instances())
      if (context_.is(i, Entity::ProductDefinition)) shape_of_definition(i);
  // What a shape maps is its child. Drawings and cameras map shapes too; they do not count.
  for (std::size_t s = 0; s < shapes_.size(); ++s) {
    const auto representations = shapes_[s].representations;
    for (const Record* rep : representations) {
      for (const Ref ref : items_[context_.index(*rep)]) {
        const Record* item = context_.find(ref);
        const auto mapped = item && context_.is(*item, Entity::MappedItem) ? context_.read<step::Pair>(*item) : std::nullopt;
        const Record* map = mapped ? context_.find(mapped->first) : nullptr;
        const auto m = map && context_.is(*map, Entity::RepresentationMap) ? context_.read<step::Pair>(*map) : std::nullopt;
        const Record* below = m ? context_.find(m->second) : nullptr;
        if (!below || !context_.is(*below, Entity::Representation)) continue;
        const std::size_t child = shape_of(*below);
        if (child != joined(s)) shapes_[child].is_child = true;
      }
    }
  }
}

bool StructureReader::lists(std::size_t shape, Ref item) {
  for (const Record* rep : shapes_[shape].representations) {
    const auto& items = items_[context_.index(*rep)];
    if (std::find(items.begin(), items.end(), item) != items.end()) return true;
  }
  return false;
}

// Parent and child come from the product structure; each placement belongs to the representation that lists it. Nothing
// hangs on which of the two a sender wrote first.
std::optional<Transform> StructureReader::placement(const Record& relationship, std::size_t parent, std::size_t child) {
  const auto r = context_.read<step::Relationship>(relationship);
  const Record* rep1 = r ? context_.find(r->first) : nullptr;
  const Record* rep2 = r ? context_.find(r->second) : nullptr;
  const Record* by = r ? context_.find(r->transformation) : nullptr;
  if (!rep1 || !rep2 || !by || !context_.is(*rep1, Entity::Representation) || !context_.is(*rep2, Entity::Representation)) return std::nullopt;
  const bool first_is_parent = shape_of(*rep1) == parent && shape_of(*rep2) != parent;
  if (context_.is(*by, Entity::CartesianTransformationOperator)) {
    const auto t = geometry_for(first_is_parent ? *rep1 : *rep2).transform(*by);
    return t;
  }
  if (!context_.is(*by, Entity::ItemDefinedTransformation)) return std::nullopt;
  const auto items = context_.read<step::Pair>(*by);
  if (!items) return std::nullopt;
  Ref in_child = items->first, in_parent = items->second;
  const bool straight = lists(child, in_child) && lists(parent, in_parent);
  const bool swapped = lists(parent, in_child) && lists(child, in_parent);
  bool turn = first_is_parent && !straight;
  if (swapped && !straight) turn = true;
  if (!straight && !swapped) {
    // One list may tell enough.
    if (lists(child, in_child) || lists(parent, in_parent)) turn = false;
    else if (lists(parent, in_child) || lists(child, in_parent)) turn = true;
  }
  if (turn) std::swap(in_child, in_parent);
  if (turn || first_is_parent)
    context_.add(relationship, sr::placement_swapped, "the relationship names the parent first; product structure and owner of the placements decide");
  const Record* a = context_.resolve(*by, in_child, Entity::RepresentationItem);
  const Record* b = context_.resolve(*by, in_parent, Entity::RepresentationItem);
  if (!a || !b) return std::nullopt;
  // Each placement is in the units of its own representation.
  const Record& child_rep = first_is_parent ? *rep2 : *rep1;
  const Record& parent_rep = first_is_parent ? *rep1 : *rep2;
  const auto from = geometry_for(child_rep).transform(*a);
  const auto to = geometry_for(parent_rep).transform(*b);
  if (!from || !to || !usable(*from)) return std::nullopt;
  return *to * inverse(*from);
}

void StructureReader::add_usage(const Record& usage, const Record* relationship) {
  const auto u = context_.read<step::Usage>(usage);
  const Record* parent = u ? context_.resolve(usage, u->parent, Entity::ProductDefinition) : nullptr;
  const Record* child = u ? context_.resolve(usage, u->child, Entity::ProductDefinition) : nullptr;
  if (!parent || !child) return;
  Use use;
  use.source = &usage;
  use.parent = shape_of_definition(*parent);
  use.child = shape_of_definition(*child);
  use.name = u->name.empty() ? u->id : u->name;
  use.relation = relationship;
  std::optional<Transform> placed = relationship ? placement(*relationship, use.parent, use.child) : std::nullopt;
  if (Geometry* geometry = nullptr; !relationship) {
    // Product structure beside mapped items: these say where, one for each occurrence, in the same order.
    if (const Record* item = mapping_of(use.parent, use.child, geometry)) {
      const Record* mapped = nullptr;
      placed = mapping(*item, *geometry, mapped);
      placing_.insert(context_.index(*item));
      use.relation = item;
      context_.consume(*item);
    }
  }
  if (const auto& t = placed; t && usable(*t)) {
    use.transform = *t;
    constexpr double visible_skew = 1e-6;
    if (const double skew = deviation_from_similarity(*t); skew > visible_skew)
      context_.add(usage, sr::transform_quality, "the placement stretches or skews the part", skew, visible_skew);
  } else {
    context_.add(usage, sr::occurrence_transform, "the occurrence has no placement that can be used; it is put at the origin");
  }
  shapes_[joined(use.child)].is_child = true;
  uses_.push_back(std::move(use));
}

// The first item of the parent that maps the child and places no occurrence yet.
const Record* StructureReader::mapping_of(std::size_t parent, std::size_t child, Geometry*& geometry) {
  const auto representations = shapes_[joined(parent)].representations;
  for (const Record* rep : representations) {
    for (const Ref ref : items_[context_.index(*rep)]) {
      const Record* item = context_.find(ref);
      if (!item || !context_.is(*item, Entity::MappedItem) || placing_.count(context_.index(*item))) continue;
      const auto r = context_.read<step::Pair>(*item);
      const Record* map = r ? context_.find(r->first) : nullptr;
      const auto m = map && context_.is(*map, Entity::RepresentationMap) ? context_.read<step::Pair>(*map) : std::nullopt;
      const Record* mapped = m ? context_.find(m->second) : nullptr;
      if (!mapped || !context_.is(*mapped, Entity::Representation) || shape_of(*mapped) != joined(child)) continue;
      geometry = &geometry_for(*rep);
      return item;
    }
  }
  return nullptr;
}

void StructureReader::read_usages() {
  // 1. Which relationship places which occurrence.
  std::unordered_map<std::size_t, const Record*> placed_by;
  std::set<std::size_t> tied;
  for (const Record& i : context_.file.instances()) {
    if (!context_.is(i, Entity::ContextDependentShapeRepresentation)) continue;
    const auto r = context_.read<step::Pair>(i);
    const Record* relationship = r ? context_.find(r->first) : nullptr;
    const Record* property = r ? context_.find(r->second) : nullptr;
    if (!relationship || !context_.is(*relationship, Entity::RepresentationRelationship)) continue;
    tied.insert(context_.index(*relationship));
    const auto p = property && context_.is(*property, Entity::PropertyDefinition) ? context_.read<step::PropertyRecord>(*property) : std::nullopt;
    const Record* usage = p ? context_.find(p->definition) : nullptr;
    if (usage && context_.is(*usage, Entity::ProductDefinitionRelationship)) placed_by.emplace(context_.index(*usage), relationship);
  }
  // 2. Occurrences by product structure, in the file's order.
  for (const Record& i : context_.file.instances()) {
    if (!context_.is(i, Entity::NextAssemblyUsageOccurrence)) continue;
    const auto at = placed_by.find(context_.index(i));
    add_usage(i, at == placed_by.end() ? nullptr : at->second);
  }
  // 3. Placements of one representation in another without a product structure.
  for (const Record& i : context_.file.instances()) {
    if (!context_.is(i, Entity::RepresentationRelationshipWithTransformation) || tied.count(context_.index(i))) continue;
    const auto r = context_.read<step::Relationship>(i);
    const Record* child = r ? context_.find(r->first) : nullptr;
    const Record* parent = r ? context_.find(r->second) : nullptr;
    if (!child || !parent || !context_.is(*child, Entity::ShapeRepresentation) || !context_.is(*parent, Entity::ShapeRepresentation)) continue;
    const std::size_t c = shape_of(*child), p = shape_of(*parent);
    if (c == p) continue;
    const auto t = placement(i, p, c);
    if (!t || !usable(*t)) {
      context_.add(i, sr::occurrence_transform, "the relationship has no placement that can be used; it is left out");
      continue;
    }
    shapes_[c].is_child = true;
    uses_.push_back({&i, p, c, *t, {}});
  }
}

std::string StructureReader::product_name(const Record& definition) {
  const auto d = context_.read<step::DefinitionRecord>(definition);
  const Record* formation = d ? context_.find(d->of) : nullptr;
  const auto f = formation && context_.is(*formation, Entity::ProductDefinitionFormation) ? context_.read<step::DefinitionRecord>(*formation) : std::nullopt;
  const Record* product = f ? context_.find(f->of) : nullptr;
  const auto p = product && context_.is(*product, Entity::Product) ? context_.read<step::ProductRecord>(*product) : std::nullopt;
  if (!p) return {};
  return p->name.empty() ? p->id : p->name;
}

void StructureReader::make_parts() {
  model_.parts.emplace_back();
  const auto has_items = [&](const Shape& s) {
    return std::any_of(s.representations.begin(), s.representations.end(), [&](const Record* r) { return !items_[context_.index(*r)].empty(); });
  };
  std::vector<std::size_t> roots, loose;
  for (std::size_t s = 0; s < shapes_.size(); ++s) {
    if (joined(s) != s) continue;
    if (shapes_[s].is_child) continue;
    if (shapes_[s].definition) roots.push_back(s);
    else if (has_items(shapes_[s])) loose.push_back(s);
  }
  const auto new_part = [&](std::size_t s) {
    model_.parts.emplace_back();
    parts_[s] = static_cast<std::uint32_t>(model_.parts.size() - 1);
  };
  if (roots.size() == 1) parts_[roots[0]] = 0;
  for (std::size_t s = 0; s < shapes_.size(); ++s) {
    if (joined(s) != s || parts_.count(s)) continue;
    if (std::find(loose.begin(), loose.end(), s) != loose.end()) parts_[s] = 0;
    else new_part(s);
  }
  // Names before contents: a part's instances may be of parts further down.
  for (std::size_t s = 0; s < shapes_.size(); ++s) {
    if (joined(s) != s || !shapes_[s].definition) continue;
    Part& part = model_.parts[parts_[s]];
    part.name = product_name(*shapes_[s].definition);
    part.source.push_back(source_of(*shapes_[s].definition));
  }
  // What lists a shape, for whoever writes it again. Loose representations beside products are of their aspects.
  for (std::size_t s = 0; s < shapes_.size(); ++s) {
    if (joined(s) != s) continue;
    const bool is_loose = std::find(loose.begin(), loose.end(), s) != loose.end();
    if (is_loose && !roots.empty()) continue;
    for (const Record* r : shapes_[s].representations) model_.parts[parts_[s]].source.push_back(source_of(*r, 6));
  }
  if (roots.size() > 1) {
    for (const std::size_t s : roots) {
      Instance top;
      top.part = parts_[s];
      Attributes named;
      named.name = model_.parts[parts_[s]].name;
      top.attributes = model_.add(named);
      top.source.push_back(source_of(*shapes_[s].definition));
      model_.parts[0].instances.push_back(std::move(top));
    }
  }
  for (const Use& use : uses_) {
    Instance instance;
    instance.part = parts_[joined(use.child)];
    instance.transform = use.transform;
    Attributes own = styles_.of(*use.source);
    if (use.relation) own = under(styles_.of(*use.relation), own);
    own.name = use.name;
    instance.attributes = model_.add(own);
    instance.source.push_back(source_of(*use.source));
    model_.parts[parts_[joined(use.parent)]].instances.push_back(std::move(instance));
  }
  // Products first: a representation of a part of a shape (a shape aspect) repeats what the product's lists.
  for (const bool is_loose : {false, true}) {
    for (std::size_t s = 0; s < shapes_.size(); ++s) {
      if (joined(s) != s || is_loose != (std::find(loose.begin(), loose.end(), s) != loose.end())) continue;
      const auto representations = shapes_[s].representations;  // filling may find more shapes
      for (const Record* rep : representations) fill(parts_[s], *rep, is_loose);
    }
  }
}

void StructureReader::fill(std::uint32_t part, const Record& representation, bool only_new) {
  Geometry& geometry = geometry_for(representation);
  context_.consume(representation);
  const std::vector<Ref> items = items_[context_.index(representation)];
  for (const Ref ref : items) {
    if (context_.execution.stop.stop_requested()) return;
    const Record* item = context_.find(ref);
    if (!item) {
      context_.add(representation, sr::reference_unresolved, fmt::format("the item #{} is not in the file", ref.id));
      continue;
    }
    if (only_new && context_.is_consumed(*item)) continue;
    if (!listed_.insert({part, context_.index(*item)}).second) continue;  // joined representations may both list it
    add(part, *item, geometry);
  }
}

// Where a mapped item puts the representation `mapped` (null after findings).
std::optional<Transform> StructureReader::mapping(const Record& item, Geometry& geometry, const Record*& mapped) {
  const auto r = context_.read<step::Pair>(item);
  const Record* map = r ? context_.resolve(item, r->first, Entity::RepresentationMap) : nullptr;
  const Record* target = r ? context_.find(r->second) : nullptr;
  const auto m = map ? context_.read<step::Pair>(*map) : std::nullopt;
  const Record* origin = m ? context_.find(m->first) : nullptr;
  mapped = m ? context_.resolve(*map, m->second, Entity::Representation) : nullptr;
  if (!mapped) return std::nullopt;
  const auto to = target ? geometry.transform(*target) : std::nullopt;
  const auto from = origin ? geometry_for(*mapped).transform(*origin) : std::nullopt;
  if (!to || !from || !usable(*to) || !usable(*from)) return std::nullopt;
  return *to * inverse(*from);
}

void StructureReader::add_mapped(std::uint32_t part, const Record& item, Geometry& geometry) {
  if (placing_.count(context_.index(item))) return;  // the product structure has it
  const Record* mapped = nullptr;
  const auto where = mapping(item, geometry, mapped);
  if (!mapped) return;
  context_.consume(item);
  Instance instance;
  if (where) {
    instance.transform = *where;
    constexpr double visible_skew = 1e-6;
    if (const double skew = deviation_from_similarity(instance.transform); skew > visible_skew)
      context_.add(item, sr::transform_quality, "the mapping stretches or skews the part", skew, visible_skew);
  } else {
    context_.add(item, sr::occurrence_transform, "the mapping has no placement that can be used; it is put at the origin");
  }
  const std::size_t shape = shape_of(*mapped);
  const auto known = parts_.find(shape);
  if (known == parts_.end()) {
    // A representation of a kind that holds no shape by itself, met here for the first time.
    model_.parts.emplace_back();
    parts_[shape] = static_cast<std::uint32_t>(model_.parts.size() - 1);
    fill(parts_[shape], *mapped, false);
  }
  instance.part = parts_[shape];
  instance.attributes = model_.add(styles_.of(item));
  instance.source.push_back(source_of(item));
  model_.parts[part].instances.push_back(std::move(instance));
}

// Solids and shells that no representation lists still appear, at the top.
void StructureReader::add_left_over() {
  std::unique_ptr<Geometry> geometry;
  const auto each = [&](auto wanted) {
    for (const Record& i : context_.file.instances()) {
      if (context_.is_consumed(i) || !wanted(i)) continue;
      if (!geometry) geometry = std::make_unique<Geometry>(context_, context_.first_units());
      context_.add(i, sr::shape_link, "no representation lists this shape; it is put at the top");
      add(0, i, *geometry);
    }
  };
  each([&](const Record& i) { return context_.is(i, Entity::ManifoldSolidBrep); });
  each([&](const Record& i) { return context_.is(i, Entity::ShellBasedSurfaceModel) || context_.is(i, Entity::FaceBasedSurfaceModel); });
  each([&](const Record& i) { return context_.is(i, Entity::ConnectedFaceSet); });
  each([&](const Record& i) { return context_.is(i, Entity::FaceSurface); });
  each([&](const Record& i) { return context_.is(i, Entity::TessellatedSolid) || context_.is(i, Entity::TessellatedShell); });
}

}  // namespace trimloop::io::step_import
