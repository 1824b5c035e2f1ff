#pragma once
// Boolean trees (180) and selected components (182), carried out by kernel/boolean.

#include <functional>
#include <map>

#include "io/iges/solids.h"
#include "kernel/boolean/boolean.h"

namespace trimloop::io::iges_import {

bool is_operand(const DirectoryEntry&);  // 150-168 180 182 186 430

class TreeReader {
 public:
  // What a primitive or a 186 is; nothing after a finding.
  using Solid = std::function<std::optional<Body>(const DirectoryEntry&)>;
  TreeReader(Context& context, Solid solid) : context_(context), solid_(std::move(solid)) {}

  // The solids that the entity stands for, under its own matrix; made once. An error says which operator was not decided
  // and why.
  const Result<std::vector<Body>>& solids(const DirectoryEntry& entry);
  // Of all that was carried out so far: no new edge is farther from its faces.
  double bound_mm() const { return bound_mm_; }

 private:
  static constexpr std::size_t most_pairs = 20'000'000;  // of faces, compared over all operators of a file

  Result<std::vector<Body>> read(const DirectoryEntry& entry);
  Result<std::vector<Body>> evaluated(const DirectoryEntry& entry, const iges::TableRecord& record);
  Result<std::vector<Body>> component(const DirectoryEntry& entry, const iges::TableRecord& record);

  Context& context_;
  Solid solid_;
  std::map<std::int32_t, Result<std::vector<Body>>> known_;  // by DE
  std::size_t pairs_ = 0;
  double bound_mm_ = 0;
};

}  // namespace trimloop::io::iges_import
