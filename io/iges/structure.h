#pragma once
// From directory to model: what stands for itself, definitions and their copies (read_instances.cpp), groups (402), bodies,
// annotation and drawings.

#include <unordered_map>

#include "io/iges/ownership.h"
#include "io/iges/trees.h"

namespace trimloop::io::iges_import {

class StructureReader {
 public:
  StructureReader(Context& context, Model& model);
  void read();

 private:
  using Entries = std::vector<const DirectoryEntry*>;

  Entries roots() const;
  void fill(std::uint32_t part, const Entries& entries);
  void add(std::uint32_t part, const DirectoryEntry& entry);
  void add_solid(std::uint32_t part, const DirectoryEntry& entry);
  void add_face(std::uint32_t part, const DirectoryEntry& entry);
  void add_curve(std::uint32_t part, const DirectoryEntry& entry);
  void add_points(std::uint32_t part, const DirectoryEntry& entry);
  void add_annotation(std::uint32_t part, const DirectoryEntry& entry);
  void add_flash(std::uint32_t part, const DirectoryEntry& entry);
  void add_copy(std::uint32_t part, const DirectoryEntry& entry);      // what is_copy() holds of
  void add_instance(std::uint32_t part, const DirectoryEntry& entry);
  void add_array(std::uint32_t part, const DirectoryEntry& entry, const iges::TableRecord& record);
  void add_external(std::uint32_t part, const DirectoryEntry& entry);
  std::optional<std::uint32_t> external_part(const DirectoryEntry& entry);
  void place(std::uint32_t part, const DirectoryEntry& entry, const DirectoryEntry& definition, const Transform& transform);
  void place(std::uint32_t part, const DirectoryEntry& entry, std::uint32_t definition, const Transform& transform);
  void fill_part(std::uint32_t part);
  void fill_tree(std::uint32_t part, const DirectoryEntry& entry);
  void fill_with_operands(std::uint32_t part, const DirectoryEntry& tree);
  std::optional<Body> brep_body(const DirectoryEntry& entry);
  std::optional<Body> solid_body(const DirectoryEntry& entry);
  void fill_assembly(std::uint32_t part, const DirectoryEntry& entry);
  void add_left_over();
  Body& sheet(std::uint32_t part, const DirectoryEntry& entry);  // where a face without a shell goes
  std::uint32_t part_of(const DirectoryEntry& definition);
  Attributes attributes(const DirectoryEntry& entry);
  bool is_hole(const DirectoryEntry& entry) const;

  Context& context_;
  Model& model_;
  Ownership ownership_;
  TreeReader trees_;
  std::unordered_map<std::int32_t, std::uint32_t> parts_;          // definition -> part
  std::unordered_map<std::int32_t, std::optional<std::uint32_t>> external_;  // 416 -> part, where it could be had
  std::map<std::pair<std::uint32_t, std::int32_t>, std::size_t> sheets_;  // (part, group or 0) -> body
  std::vector<const DirectoryEntry*> definitions_;                 // of parts, in their order; null for the root and other files'
};

bool is_copy(const DirectoryEntry&);  // 180 182 184 408 412 414 420 430
bool is_external(const DirectoryEntry&);  // 416

// Takes out instances that would make a part contain itself (IG-R07), nest too deep (LM-05) or unfold to more
// occurrences than allowed (IG-R08, LM-07). Linear in parts and instances: nothing is unfolded.
void limit_instances(Context& context, Model& model, const std::vector<const DirectoryEntry*>& definitions);

// One finding for each type of entity that has no effect on the model: MD-12 where it means geometry, MD-13 elsewhere. The
// records that nothing asked for are read for their findings.
void report_unused(Context& context);

}  // namespace trimloop::io::iges_import
