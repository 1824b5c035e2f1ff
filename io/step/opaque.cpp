#include "io/step/opaque.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "base/assert.h"
#include "formats/step/copy.h"
#include "io/step/context.h"
#include "io/step/pmi.h"
#include "io/step/raw_data.h"

namespace trimloop::io::step_export {

void Targets::add(const SourceRefs& source, InstanceId written) {
  for (const SourceRef& ref : source) {
    if (ref.role != 0) continue;
    if (written) items.try_emplace(ref.id, written);
    return;
  }
}

namespace {

using step::Entity;
using step::Instance;
using step::Ref;
using step::Tape;

bool has(std::string_view keyword, std::string_view word) { return keyword.find(word) != std::string_view::npos; }

class OpaqueWriter {
 public:
  OpaqueWriter(EntityWriter& writer, const step::File& source, const Targets& targets, const Limits& limits)
      : w_(writer), file_(source), targets_(targets), limits_(limits), members_(source.instances().size()),
        of_shapes_(source.instances().size()) {}

  void run() {
    find_owners();
    mark_shapes();
    collect();
    drop_what_lost_its_ground();
    keep_reached();
    write();
    name_losses();
  }

 private:
  // What becomes of a reference to an instance.
  enum class Way : std::uint8_t { Mapped, Copied, Lost, Omitted };  // Omitted: the model carries it itself

  std::size_t index(const Instance& i) const { return file_.index(i); }
  bool is(const Instance& i, Entity e) const { return file_.is(i, e); }
  const std::string& keyword(const Instance& i) const { return file_.keyword(i).name; }
  void read(const Instance& i) { tape_.read(file_.value(i), limits_); }
  std::vector<Ref> references(const Instance& i);
  std::vector<Ref> attribute(const Instance& i, Entity e, int at);
  std::string text(const Instance& i, Entity e, int at);

  void find_owners();
  void mark_shapes();
  InstanceId written(const Instance& i) const;
  InstanceId representation(const Instance& i) const;
  bool same_units(const Instance& context);
  Way way(const Instance& i);
  void include(const Instance& i);
  std::vector<Ref> subjects(const Instance& i);
  bool is_of_product(const Instance& i, const std::vector<Ref>& subjects);
  void collect();
  Ref renamed(const Instance& user, const Instance& i, InstanceId holder);
  bool writable(const Instance& i);
  InstanceId holder_of_items(const Instance& usage);
  void drop_what_lost_its_ground();
  void keep_reached();
  void write();
  void name_losses();

  EntityWriter& w_;
  const step::File& file_;
  const Targets& targets_;
  const Limits& limits_;
  Tape tape_;
  std::vector<bool> members_;    // copied
  std::vector<bool> of_shapes_;  // below the items of a part's representations
  std::unordered_map<std::uint64_t, InstanceId> owners_;            // property definitions that are written PRODUCT_DEFINITION_SHAPEs
  std::unordered_map<std::uint64_t, bool> contexts_;                // of the source: may the written one stand for it
  std::unordered_multimap<std::size_t, std::size_t> links_;         // an instance -> what says something about it
  std::vector<std::size_t> seeds_;
  std::vector<std::uint64_t> numbers_;                              // of copied instances, in the new file
  std::map<std::string, std::size_t> lost_;                         // kinds of what did not come along
  std::size_t lost_references_ = 0;
};

std::vector<Ref> OpaqueWriter::references(const Instance& i) {
  read(i);
  std::vector<Ref> out;
  for (std::uint32_t t = 0; t < tape_.size(); ++t)
    if (tape_[t].kind == step::Token::Kind::Reference) out.push_back({tape_[t].id});
  return out;
}

// References within attribute `at` of entity `e` in the record.
std::vector<Ref> OpaqueWriter::attribute(const Instance& i, Entity e, int at) {
  Report quiet;
  step::Reader r(file_, i, limits_, tape_, quiet);
  if (!r.at(e, true) || at >= r.count()) return {};
  const step::Select s = r.select(at);
  if (s.ref) return {s.ref};
  return r.refs(at);
}

std::string OpaqueWriter::text(const Instance& i, Entity e, int at) {
  Report quiet;
  step::Reader r(file_, i, limits_, tape_, quiet);
  return r.at(e, true) && at < r.count() ? r.text(at) : std::string();
}

void OpaqueWriter::find_owners() {
  for (const Instance& i : file_.instances()) {
    if (!is(i, Entity::ProductDefinitionShape)) continue;
    for (const Ref ref : attribute(i, Entity::PropertyDefinition, 2))
      if (const auto at = targets_.products.find(ref.id); at != targets_.products.end()) owners_.emplace(i.id, at->second.shape);
  }
}

void OpaqueWriter::mark_shapes() {
  std::vector<const Instance*> todo;
  const auto push = [&](const std::vector<Ref>& refs) {
    for (const Ref ref : refs) {
      const Instance* i = file_.find(ref);
      if (!i || of_shapes_[index(*i)] || is(*i, Entity::Representation) || is(*i, Entity::RepresentationMap)) continue;
      of_shapes_[index(*i)] = true;
      todo.push_back(i);
    }
  };
  for (const Instance& i : file_.instances())
    if (targets_.representations.count(i.id)) push(attribute(i, Entity::Representation, 1));
  while (!todo.empty()) {
    const Instance& i = *todo.back();
    todo.pop_back();
    push(references(i));
  }
}

InstanceId OpaqueWriter::representation(const Instance& i) const {
  const auto at = targets_.representations.find(i.id);
  if (at == targets_.representations.end()) return {};
  const WrittenShape& s = at->second;
  const auto or_main = [&](InstanceId id) { return id ? id : s.main; };
  const std::string& k = keyword(i);
  if (has(k, "BREP")) return or_main(s.solids);
  if (has(k, "TESSELLATED")) return or_main(s.meshes);
  if (has(k, "WIREFRAME")) return or_main(s.curves);
  if (has(k, "SURFACE")) return or_main(s.surfaces);
  return s.main;
}

// What stands for an instance of the source already.
InstanceId OpaqueWriter::written(const Instance& i) const {
  if (const auto at = targets_.items.find(i.id); at != targets_.items.end()) return at->second;
  if (const auto at = owners_.find(i.id); at != owners_.end()) return at->second;
  if (const auto at = targets_.products.find(i.id); at != targets_.products.end()) return at->second.definition;
  if (is(i, Entity::RepresentationContext)) {
    const auto at = contexts_.find(i.id);
    return at != contexts_.end() && at->second ? targets_.context : InstanceId{};
  }
  return representation(i);
}

OpaqueWriter::Way OpaqueWriter::way(const Instance& i) {
  if (is(i, Entity::RepresentationContext)) contexts_.try_emplace(i.id, same_units(i));
  if (written(i)) return Way::Mapped;
  if (is(i, Entity::StyledItem) && !is(i, Entity::AnnotationOccurrence)) {
    const auto item = attribute(i, Entity::StyledItem, 1);
    const Instance* styled = item.empty() ? nullptr : file_.find(item.front());
    const bool own = styled && !is(*styled, Entity::StyledItem) && !of_shapes_[index(*styled)] && way(*styled) == Way::Copied;
    return own ? Way::Copied : Way::Omitted;
  }
  if (of_shapes_[index(i)] && (is(i, Entity::TopologicalRepresentationItem) || is(i, Entity::SolidModel) ||
                               is(i, Entity::ShellBasedSurfaceModel) || is(i, Entity::FaceBasedSurfaceModel)))
    return Way::Lost;
  if (is(i, Entity::ProductDefinition) || is(i, Entity::ProductDefinitionRelationship) || is(i, Entity::ProductDefinitionShape) ||
      is(i, Entity::ProductDefinitionFormation) || is(i, Entity::Product) || is(i, Entity::ContextDependentShapeRepresentation))
    return Way::Lost;
  return Way::Copied;
}

// Only lengths in the unit that is written, and angles in radians, may share the context that is written.
bool OpaqueWriter::same_units(const Instance& context) {
  if (!is(context, Entity::GeometricRepresentationContext) || has(keyword(context), "PARAMETRIC")) return false;
  const Execution execution;
  Report quiet;
  step_import::Context reader(file_, execution, std::nullopt, quiet);
  const step_import::Units units = step_import::read_units(reader, context);
  constexpr double rounding = 1e-14;  // 25.4 and 0.0254 x 1000 are one inch
  return units.is_known && std::abs(units.mm - w_.units.factor()) <= rounding * units.mm && units.rad == 1;
}

// The instance, what it refers to, what says something about one of these, and so on.
void OpaqueWriter::include(const Instance& from) {
  if (members_[index(from)]) return;
  std::vector<const Instance*> reached{&from};
  const auto reach = [&](const Instance& i) {
    if (members_[index(i)]) return;
    members_[index(i)] = true;
    reached.push_back(&i);
  };
  members_[index(from)] = true;
  while (!reached.empty()) {
    const Instance& i = *reached.back();
    reached.pop_back();
    for (const Ref ref : references(i))
      if (const Instance* next = file_.find(ref); next && !members_[index(*next)] && way(*next) == Way::Copied) reach(*next);
    const auto [first, last] = links_.equal_range(index(i));
    for (auto link = first; link != last; ++link) reach(file_.instances()[link->second]);
  }
}

// What an instance that may link says something about.
std::vector<Ref> OpaqueWriter::subjects(const Instance& i) {
  if (is(i, Entity::ProductDefinitionShape)) return {};
  if (is(i, Entity::PropertyDefinition)) return attribute(i, Entity::PropertyDefinition, 2);
  if (is(i, Entity::PropertyDefinitionRepresentation)) return attribute(i, Entity::PropertyDefinitionRepresentation, 0);
  if (is(i, Entity::StyledItem) && !is(i, Entity::AnnotationOccurrence)) return attribute(i, Entity::StyledItem, 1);
  return references(i);
}

// A property of a product that was written; those of validation are written anew.
bool OpaqueWriter::is_of_product(const Instance& i, const std::vector<Ref>& subjects) {
  if (!is(i, Entity::PropertyDefinition)) return false;
  const bool of_product = std::any_of(subjects.begin(), subjects.end(), [&](Ref ref) {
    return targets_.products.count(ref.id) > 0 || owners_.count(ref.id) > 0;
  });
  if (!of_product) return false;
  const std::string name = text(i, Entity::PropertyDefinition, 0);
  return name != "geometric validation property" && name != "assembly validation property";
}

bool may_link(const step::File& file, const Instance& i) {
  if (file.is(i, Entity::PropertyDefinition) || file.is(i, Entity::PropertyDefinitionRepresentation) ||
      file.is(i, Entity::StyledItem) || file.is(i, Entity::Invisibility) || file.is(i, Entity::PresentationLayerAssignment) ||
      file.is(i, Entity::RepresentationRelationship) || file.is(i, Entity::MechanicalDesignGeometricPresentationRepresentation))
    return true;
  const std::string_view k = file.keyword(i).name;
  return k == "ID_ATTRIBUTE" || k == "NAME_ATTRIBUTE" || k == "DESCRIPTION_ATTRIBUTE" || k == "GENERAL_PROPERTY_ASSOCIATION" ||
         k == "CHARACTERIZED_ITEM_WITHIN_REPRESENTATION" || k == "MECHANICAL_DESIGN_AND_DRAUGHTING_RELATIONSHIP" ||
         k == "MEASURE_QUALIFICATION" || has(k, "ZONE_DEFINITION");
}

// Linear in references: each instance is reached once, from what it speaks of or from what refers to it.
void OpaqueWriter::collect() {
  std::vector<std::size_t> starts, may;
  for (const Instance& i : file_.instances()) {
    if (is_pmi(keyword(i)) || is(i, Entity::ConstructiveGeometryRepresentation) || keyword(i) == "MATERIAL_DESIGNATION") {
      if (!written(i)) starts.push_back(index(i));
    } else if (may_link(file_, i) && !written(i)) {
      may.push_back(index(i));
      const std::vector<Ref> about = subjects(i);
      if (is_of_product(i, about)) starts.push_back(index(i));
      for (const Ref ref : about)
        if (const Instance* subject = file_.find(ref)) links_.emplace(index(*subject), index(i));
    }
  }
  for (const std::size_t s : starts) include(file_.instances()[s]);
  seeds_ = std::move(starts);
  std::copy_if(may.begin(), may.end(), std::back_inserter(seeds_), [&](std::size_t i) { return members_[i]; });
}

// Usages name a representation together with items of it: that is the one which holds these now.
InstanceId OpaqueWriter::holder_of_items(const Instance& usage) {
  const std::string& k = keyword(usage);
  if (!has(k, "GEOMETRIC_ITEM_SPECIFIC_USAGE") && !has(k, "ITEM_IDENTIFIED_REPRESENTATION_USAGE")) return {};
  for (const Ref ref : references(usage)) {
    const auto item = targets_.items.find(ref.id);
    if (item == targets_.items.end()) continue;
    if (const auto at = targets_.held_by.find(item->second.number); at != targets_.held_by.end()) return at->second;
  }
  return {};
}

Ref OpaqueWriter::renamed(const Instance& user, const Instance& i, InstanceId holder) {
  if (holder && targets_.representations.count(i.id)) return {holder.number};
  if (const InstanceId known = written(i)) {
    // Layers and visibility of shapes are the model's own and have been written.
    const bool again = is(i, Entity::RepresentationItem) && (is(user, Entity::PresentationLayerAssignment) || is(user, Entity::Invisibility));
    return again ? Ref{} : Ref{known.number};
  }
  if (!members_[index(i)]) return {};
  return {numbers_.empty() ? 1 : numbers_[index(i)]};
}

bool OpaqueWriter::writable(const Instance& i) {
  if (!tape_.read(file_.value(i), limits_)) return false;
  return step::copy(tape_, [&](Ref ref) {
           const Instance* target = file_.find(ref);
           return target ? renamed(i, *target, {}) : Ref{};
         }).has_value();
}

// An instance that cannot do without what is not written goes too, and then what cannot do without it.
void OpaqueWriter::drop_what_lost_its_ground() {
  const auto& instances = file_.instances();
  std::unordered_map<std::size_t, std::vector<std::size_t>> users;
  std::vector<std::size_t> todo;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    if (!members_[i]) continue;
    todo.push_back(i);
    for (const Ref ref : references(instances[i])) {
      const Instance* target = file_.find(ref);
      if (!target) continue;
      if (members_[index(*target)]) users[index(*target)].push_back(i);
      else if (!written(*target) && way(*target) == Way::Lost) ++lost_references_;
    }
  }
  while (!todo.empty()) {
    const std::size_t i = todo.back();
    todo.pop_back();
    if (!members_[i] || writable(instances[i])) continue;
    members_[i] = false;
    const std::string_view kind = pmi_kind(keyword(instances[i]));
    if (!kind.empty()) ++lost_[std::string(kind)];
    if (const auto at = users.find(i); at != users.end()) todo.insert(todo.end(), at->second.begin(), at->second.end());
  }
}

// Values of what was dropped hang in the air: only what a remaining seed needs is written.
void OpaqueWriter::keep_reached() {
  const auto& instances = file_.instances();
  std::vector<bool> reached(members_.size());
  std::vector<std::size_t> todo;
  for (const std::size_t s : seeds_) {
    if (!members_[s]) continue;
    reached[s] = true;
    todo.push_back(s);
  }
  while (!todo.empty()) {
    const std::size_t i = todo.back();
    todo.pop_back();
    for (const Ref ref : references(instances[i])) {
      const Instance* target = file_.find(ref);
      if (!target || !members_[index(*target)] || reached[index(*target)]) continue;
      reached[index(*target)] = true;
      todo.push_back(index(*target));
    }
  }
  members_ = std::move(reached);
}

void OpaqueWriter::write() {
  const auto& instances = file_.instances();
  std::vector<std::uint64_t> numbers(members_.size());
  std::uint64_t last = w_.out.instances();
  for (std::size_t i = 0; i < members_.size(); ++i)
    if (members_[i]) numbers[i] = ++last;
  numbers_ = std::move(numbers);
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (!members_[i]) continue;
    const InstanceId holder = holder_of_items(instances[i]);
    read(instances[i]);
    const auto value = step::copy(tape_, [&](Ref ref) {
      const Instance* target = file_.find(ref);
      return target ? renamed(instances[i], *target, holder) : Ref{};
    });
    TRIMLOOP_ASSERT(value.has_value(), "what cannot be written was dropped before");
    w_.out.add_copy(*value);
  }
}

void OpaqueWriter::name_losses() {
  for (const auto& [kind, n] : lost_)
    w_.losses.push_back(fmt::format("product manufacturing information: {} {}: they speak of what was not written", n, kind));
  if (lost_references_ > 0)
    w_.losses.push_back(fmt::format("product manufacturing information: {} references to shapes or products that were not written", lost_references_));
  std::map<std::string_view, std::size_t> raw;
  for (const Instance& i : file_.instances())
    if (!members_[index(i)] && is_raw(file_.keyword(i))) ++raw[keyword(i)];
  if (!raw.empty()) w_.losses.push_back(list_raw_data(raw));
}

}  // namespace

void write_opaque(EntityWriter& writer, const step::File& source, const Targets& targets, const Limits& limits) {
  OpaqueWriter(writer, source, targets, limits).run();
}

}  // namespace trimloop::io::step_export
