// Copies: subfigures (308/408, 320/420), arrays (412, 414), Boolean trees (180, 182), assemblies (184) and instances (430) of
// solids. A definition becomes a part, a copy an instance of it.

#include "formats/iges/records/structure.h"
#include "formats/iges/rules.h"
#include "io/iges/placement.h"
#include "io/iges/solids.h"
#include "io/iges/structure.h"
#include "io/rules.h"

namespace trimloop::io::iges_import {
namespace {

namespace igr = iges::rules;

bool is_subfigure(const DirectoryEntry& e) { return e.type == 308; }
bool is_subfigure_or_reference(const DirectoryEntry& e) { return is_subfigure(e) || is_external(e); }
bool is_network_subfigure(const DirectoryEntry& e) { return e.type == 320; }
bool is_solid(const DirectoryEntry& e) {
  return is_operand(e) || e.type == 184;
}
bool is_tree(const DirectoryEntry& e) { return e.type == 180; }
bool is_matrix(const DirectoryEntry& e) { return e.type == 124; }
bool is_base(const DirectoryEntry& e) { return e.type != 0 && e.type != 320; }

Vector lengths(const Context& context, const iges::Xyz& v) {
  return {v.x * context.unit.scale, v.y * context.unit.scale, v.z * context.unit.scale};
}

// Which of `count` positions are carried out: all, the listed ones (DDF 0) or all others (DDF 1).
std::vector<bool> positions(const iges::TableRecord& record, std::size_t count) {
  const std::size_t listed = record.count("LC");
  const bool leave_out = record.integer("DDF") == 1;
  std::vector<bool> out(count, listed == 0 || leave_out);
  const std::size_t first = record.values.size() - listed;  // the list ends the record
  for (std::size_t i = 0; i < listed; ++i)
    if (const auto* number = std::get_if<std::int64_t>(&record.values[first + i]);
        number && *number >= 1 && static_cast<std::uint64_t>(*number) <= count)
      out[static_cast<std::size_t>(*number - 1)] = !leave_out;
  return out;
}

}  // namespace

bool is_copy(const DirectoryEntry& e) {
  switch (e.type) {
    case 180: case 182: case 184: case 408: case 412: case 414: case 420: case 430: return true;
    default: return false;
  }
}

std::uint32_t StructureReader::part_of(const DirectoryEntry& definition) {
  const auto [at, fresh] = parts_.try_emplace(definition.de, static_cast<std::uint32_t>(model_.parts.size()));
  if (!fresh) return at->second;
  const std::uint32_t part = at->second;
  model_.parts.emplace_back();
  definitions_.push_back(&definition);
  context_.state(definition).consumed = true;
  model_.parts[part].source.push_back(source_of(definition));
  if (is_subfigure(definition)) {
    if (const auto* record = context_.record<iges::SubfigureDefinition>(definition)) model_.parts[part].name = record->name;
  } else if (is_network_subfigure(definition)) {
    if (const auto* record = context_.table(definition)) model_.parts[part].name = record->string("NAME");
  } else {
    model_.parts[part].name = attributes(definition).name;
  }
  return part;
}

// What a definition holds goes into its part.
void StructureReader::fill_part(std::uint32_t part) {
  if (!definitions_[part]) return;  // came whole from another file
  const DirectoryEntry& definition = *definitions_[part];
  Entries members;
  const auto add_member = [&](Ref ref) {
    if (const DirectoryEntry* member = ref ? context_.file.find(ref) : nullptr) members.push_back(member);
  };
  if (is_subfigure(definition)) {
    Visit visit(context_, definition);
    if (const auto* record = context_.record<iges::SubfigureDefinition>(definition))
      for (const Ref ref : record->members) add_member(ref);
    return fill(part, members);
  }
  if (is_network_subfigure(definition)) {
    Visit visit(context_, definition);
    if (const iges::TableRecord* record = context_.table(definition))
      for (std::size_t i = 1, n = record->count("N"); i <= n; ++i) add_member(record->ref("DE", {i}));
    return fill(part, members);
  }
  if (definition.type == 180 || definition.type == 182) return fill_tree(part, definition);
  if (definition.type == 184) return fill_assembly(part, definition);
  fill(part, {&definition});
}

// The solids of a tree or component, or, where an operator is not decided, its operands as bodies and the reason.
void StructureReader::fill_tree(std::uint32_t part, const DirectoryEntry& entry) {
  const auto& solids = trees_.solids(entry);
  if (solids) {
    const AttributesId id = model_.add(attributes(entry));
    for (Body body : *solids) {
      body.attributes = id;
      body.source.insert(body.source.begin(), source_of(entry));
      model_.parts[part].bodies.push_back(std::move(body));
    }
    if (solids->empty()) context_.add(entry, rules::ignored, "nothing is left of the solids of this Boolean tree");
    return;
  }
  context_.add(entry, rules::unsupported, "the Boolean tree is not carried out: " + solids.error().text + "; its operands are there as bodies of their own",
               solids.error().measured, solids.error().limit);
  Visit visit(context_, entry);
  if (entry.type == 180) return fill_with_operands(part, entry);
  const iges::TableRecord* record = context_.table(entry);
  const DirectoryEntry* tree = record ? context_.resolve(record->ref("BTREE"), is_tree, "a Boolean tree (180)") : nullptr;
  if (!tree) return;
  Visit within(context_, *tree);
  fill_with_operands(part, *tree);
}

// Every operand once.
void StructureReader::fill_with_operands(std::uint32_t part, const DirectoryEntry& tree) {
  const iges::TableRecord* record = context_.table(tree);
  if (!record) return;
  Entries operands;
  std::vector<std::int32_t> seen;
  for (const iges::TableRecord::Value& value : record->values)
    if (const Ref* term = std::get_if<Ref>(&value); term && term->de < 0) seen.push_back(-term->de);
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  const Transform own = model_placement(context_, tree);
  for (const std::int32_t de : seen) {
    const DirectoryEntry* operand = context_.resolve(Ref{de}, is_solid, "a solid");
    if (!operand) continue;
    if (is_identity(own)) operands.push_back(operand);
    else place(part, tree, *operand, own);
  }
  fill(part, operands);
}

void StructureReader::fill_assembly(std::uint32_t part, const DirectoryEntry& entry) {
  Visit visit(context_, entry);
  const iges::TableRecord* record = context_.table(entry);
  if (!record) return;
  const Transform own = model_placement(context_, entry);
  for (std::size_t i = 1, n = record->count("N"); i <= n; ++i) {
    const DirectoryEntry* item = context_.resolve(record->ref("PTR", {i}), is_solid, "a solid");
    const DirectoryEntry* matrix = context_.resolve(record->ref("PTRM", {i}), is_matrix, "a matrix (124)");
    if (item) place(part, entry, *item, own * (matrix ? matrix_placement(context_, *matrix) : Transform{}));
  }
}

// One copy of what `definition` stands for, or a finding.
void StructureReader::place(std::uint32_t part, const DirectoryEntry& entry, const DirectoryEntry& definition,
                            const Transform& transform) {
  place(part, entry, part_of(definition), transform);
}

void StructureReader::place(std::uint32_t part, const DirectoryEntry& entry, std::uint32_t definition, const Transform& transform) {
  Instance instance;
  instance.part = definition;
  instance.transform = transform;
  const double det = determinant(instance.transform);
  if (!(std::abs(det) > 0) || !std::isfinite(det) || !is_finite(instance.transform.t)) {
    context_.add(entry, igr::e408::scale, "the copy has no size or no place; it is left out", det);
    return;
  }
  constexpr double visible_skew = 1e-6;
  if (const double skew = deviation_from_similarity(instance.transform); skew > visible_skew)
    context_.add(entry, igr::e124::orthonormal, "the matrix of this copy stretches or skews it", skew, visible_skew);
  instance.attributes = model_.add(attributes(entry));
  instance.source.push_back(source_of(entry));
  model_.parts[part].instances.push_back(std::move(instance));
}

void StructureReader::add_copy(std::uint32_t part, const DirectoryEntry& entry) {
  Visit visit(context_, entry);
  if (!visit) return;
  if (entry.type == 408) return add_instance(part, entry);
  const iges::TableRecord* record = context_.table(entry);
  if (!record) return;
  context_.state(entry).consumed = true;
  const Transform own = model_placement(context_, entry);
  switch (entry.type) {
    case 180: case 182: case 184: return place(part, entry, entry, {});  // its part stands under its matrix
    case 412: case 414: return add_array(part, entry, *record);
    case 430: {
      const DirectoryEntry* solid = context_.resolve(record->ref("DE"), is_solid, "a solid");
      if (solid) place(part, entry, *solid, own);
      return;
    }
    default: {  // 420: an omitted factor is that of x
      const DirectoryEntry* definition =
          context_.resolve(record->ref("DE"), is_network_subfigure, "a network subfigure definition (320)");
      if (!definition) return;
      const double x = record->real("XS"), y = record->real("YS"), z = record->real("ZS");
      Transform scale;
      scale.r = {{{x, 0, 0}, {0, y == 0 ? x : y, 0}, {0, 0, z == 0 ? x : z}}};
      const Vector shift = lengths(context_, record->xyz("X", "Y", "Z"));
      return place(part, entry, *definition, own * Transform::translation(shift) * scale);
    }
  }
}

// 408: scaled, then shifted, then under its own 124 (IGES 5.3 4.138).
void StructureReader::add_instance(std::uint32_t part, const DirectoryEntry& entry) {
  const auto* r = context_.record<iges::SubfigureInstance>(entry);
  if (!r) return;
  context_.state(entry).consumed = true;
  const DirectoryEntry* definition = context_.resolve(r->definition, is_subfigure_or_reference, "a subfigure definition (308)");
  if (!definition) return;
  const Transform transform = model_placement(context_, entry) * Transform::translation(lengths(context_, r->translation)) *
                              Transform::scale(r->scale);
  if (!is_external(*definition)) return place(part, entry, *definition, transform);
  if (const auto external = external_part(*definition)) place(part, entry, *external, transform);
}

// 412: positions run up the first column, then up the second; the array, not its copies, is turned about its corner.
// 414: positions run around the circle from the start angle.
void StructureReader::add_array(std::uint32_t part, const DirectoryEntry& entry, const iges::TableRecord& record) {
  const DirectoryEntry* base = context_.resolve(record.ref("DE"), is_base, "an entity to be copied");
  if (!base || base == &entry) return;
  const bool rectangular = entry.type == 412;
  const auto columns = static_cast<std::size_t>(record.integer(rectangular ? "NC" : "NX"));
  const std::size_t rows = rectangular ? static_cast<std::size_t>(record.integer("NR")) : 1;
  const auto total = checked_mul(columns, rows);
  const std::size_t most = context_.execution.limits.instances;
  if (!total || *total > most) {
    context_.add(entry, igr::expansion_bomb, "the array has more positions than the limit; it is left out",
                 static_cast<double>(columns) * static_cast<double>(rows), static_cast<double>(most));
    return;
  }
  const std::vector<bool> carried_out = positions(record, *total);
  const double mm = context_.unit.scale;
  const Transform own = model_placement(context_, entry);
  const Vector corner = lengths(context_, record.xyz("X", "Y", "Z"));
  const double turn = rectangular ? record.real("AX") : 0;
  for (std::size_t i = 0; i < *total; ++i) {
    if (!carried_out[i]) continue;
    Vector at;
    if (rectangular) {
      const double x = static_cast<double>(i / rows) * record.real("DX") * mm;
      const double y = static_cast<double>(i % rows) * record.real("DY") * mm;
      at = {x * std::cos(turn) - y * std::sin(turn), x * std::sin(turn) + y * std::cos(turn), 0};
    } else {
      const double angle = record.real("AS") + static_cast<double>(i) * record.real("DA"), r = record.real("R") * mm;
      at = {r * std::cos(angle), r * std::sin(angle), 0};
    }
    const Transform scale = rectangular ? Transform::scale(record.real("S")) : Transform{};
    place(part, entry, *base, own * Transform::translation(corner + at) * scale);
  }
}

}  // namespace trimloop::io::iges_import
