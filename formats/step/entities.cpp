#include "formats/step/entities.h"

#include <algorithm>
#include <array>

namespace trimloop::step {
namespace {

constexpr std::size_t entity_count = static_cast<std::size_t>(Entity::count_);

constexpr int fields(std::string_view attributes) {
  if (attributes.empty()) return 0;
  int n = 1;
  for (const char c : attributes) n += c == ',';
  return n;
}

constexpr std::array<EntityInfo, entity_count> make_table() {
  std::array<EntityInfo, entity_count> table{};
  std::size_t i = 1;
#define X(name, word, above, list) \
  table[i++] = {Entity::name, Entity::above, word, list, 0, fields(list)};
#include "formats/step/entity_list.h"
#undef X
  for (i = 1; i < entity_count; ++i) {
    const EntityInfo& above = table[static_cast<std::size_t>(table[i].supertype)];
    table[i].first = above.first + above.own;  // supertypes stand before their subtypes in the list
  }
  return table;
}

constexpr std::array<EntityInfo, entity_count> table = make_table();

constexpr bool supertypes_come_first() {
  for (std::size_t i = 1; i < entity_count; ++i)
    if (static_cast<std::size_t>(table[i].supertype) >= i) return false;
  return true;
}
static_assert(supertypes_come_first());

std::array<EntitySet, entity_count> make_sets() {
  std::array<EntitySet, entity_count> sets;
  for (std::size_t i = 1; i < entity_count; ++i) {
    sets[i] = sets[static_cast<std::size_t>(table[i].supertype)];
    sets[i].set(i);
  }
  return sets;
}

constexpr std::array<std::uint16_t, entity_count - 1> make_order() {
  std::array<std::uint16_t, entity_count - 1> order{};
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint16_t>(i + 1);
  std::sort(order.begin(), order.end(), [](std::uint16_t a, std::uint16_t b) { return table[a].keyword < table[b].keyword; });
  return order;
}

constexpr std::array<std::uint16_t, entity_count - 1> by_keyword = make_order();

}  // namespace

const EntityInfo& info(Entity e) { return table[static_cast<std::size_t>(e)]; }

Entity entity_of(std::string_view keyword) {
  const auto at = std::lower_bound(by_keyword.begin(), by_keyword.end(), keyword,
                                   [](std::uint16_t i, std::string_view word) { return table[i].keyword < word; });
  return at != by_keyword.end() && table[*at].keyword == keyword ? table[*at].entity : Entity::None;
}

const EntitySet& with_supertypes(Entity e) {
  static const std::array<EntitySet, entity_count> sets = make_sets();
  return sets[static_cast<std::size_t>(e)];
}

std::string_view attribute_name(Entity e, int index) {
  while (e != Entity::None && index < info(e).first) e = info(e).supertype;
  if (e == Entity::None || index < 0) return {};
  int skip = index - info(e).first;
  std::string_view list = info(e).attributes;
  if (skip >= info(e).own) return {};
  for (; skip > 0; --skip) list.remove_prefix(list.find(',') + 1);
  return list.substr(0, list.find(','));
}

}  // namespace trimloop::step
