#pragma once
// Which entities are parts of others, read from the pointers of the records (OCCT and this reader agree: the pointers
// decide; the subordinate switch of the directory is only compared with them).

#include <map>

#include "io/iges/context.h"

namespace trimloop::io::iges_import {

struct Ownership {
  // By directory index: part of an entity that becomes a shape, a definition or an annotation.
  std::vector<bool> owned;
  // Group (402 forms 1, 7, 14, 15) that lists the entity, the first one in the file; null for most.
  std::vector<const DirectoryEntry*> group;
  // Holes (108 form -1) of bounded planes, by the plane's directory index (402 form 9).
  std::map<std::size_t, std::vector<const DirectoryEntry*>> holes;
};

Ownership ownership(Context& context);

}  // namespace trimloop::io::iges_import
