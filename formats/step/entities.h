#pragma once
// The hand-kept table of entities that mean something to us; all others stay raw instances. See entity_list.h.

#include <bitset>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace trimloop::step {

enum class Entity : std::uint16_t {
  None,
#define X(name, keyword, supertype, attributes) name,
#include "formats/step/entity_list.h"
#undef X
  count_
};

using EntitySet = std::bitset<256>;
static_assert(static_cast<std::size_t>(Entity::count_) <= 256);

struct EntityInfo {
  Entity entity = Entity::None, supertype = Entity::None;
  std::string_view keyword, attributes;  // own attributes, separated by commas
  int first = 0, own = 0;                // of a simple instance: attributes of the supertypes, own ones
};

const EntityInfo& info(Entity);
Entity entity_of(std::string_view keyword);          // None when we mean nothing by it; upper case
const EntitySet& with_supertypes(Entity);            // itself and all above it
std::string_view attribute_name(Entity, int index);  // of a simple instance, from 0; empty when there is none

}  // namespace trimloop::step
