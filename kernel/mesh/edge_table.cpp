#include "kernel/mesh/edge_table.h"

#include <algorithm>

namespace trimloop::mesh {

void EdgeTable::reset(std::size_t edges) {
  std::size_t size = 16;
  while (size < 2 * edges) size *= 2;
  if (slots_.size() < size) slots_.resize(size);
  mask_ = size - 1;
  std::fill_n(slots_.begin(), size, none);
  entries_.clear();
  uses_.clear();
}

// The slot that holds the edge, or the free one where it would go. a < b.
std::size_t EdgeTable::slot_of(std::uint32_t a, std::uint32_t b) const {
  std::uint64_t h = (std::uint64_t{a} << 32 | b) * 0x9e3779b97f4a7c15u;
  std::size_t slot = static_cast<std::size_t>(h ^ h >> 32) & mask_;
  while (slots_[slot] != none && (entries_[slots_[slot]].a != a || entries_[slots_[slot]].b != b))
    slot = (slot + 1) & mask_;
  return slot;
}

void EdgeTable::grow() {
  const std::size_t size = 2 * (mask_ + 1);
  if (slots_.size() < size) slots_.resize(size);
  mask_ = size - 1;
  std::fill_n(slots_.begin(), size, none);
  for (std::uint32_t e = 0; e < entries_.size(); ++e) slots_[slot_of(entries_[e].a, entries_[e].b)] = e;
}

void EdgeTable::add(std::uint32_t a, std::uint32_t b, std::uint32_t constraint, std::int32_t times,
                    std::uint8_t moved) {
  if (a > b) std::swap(a, b), times = -times;
  if (2 * entries_.size() > mask_) grow();
  const std::size_t slot = slot_of(a, b);
  if (slots_[slot] == none) {
    slots_[slot] = static_cast<std::uint32_t>(entries_.size());
    entries_.push_back({a, b, 0, none});
  }
  Entry& entry = entries_[slots_[slot]];
  entry.winding += times;
  // A constraint that rounding has sent back and forth is one use. The newest are enough to look at: more than that run
  // along one edge only where loops repeat.
  int looked_at = 0;
  for (std::uint32_t u = entry.first; u != none && looked_at < 8; u = uses_[u].next, ++looked_at) {
    if (uses_[u].constraint != constraint) continue;
    uses_[u].times += times;
    uses_[u].moved = std::max(uses_[u].moved, moved);
    return;
  }
  uses_.push_back({constraint, times, moved, entry.first});
  entry.first = static_cast<std::uint32_t>(uses_.size() - 1);
}

std::int32_t EdgeTable::winding(std::uint32_t a, std::uint32_t b) const {
  const std::uint32_t e = slots_[slot_of(std::min(a, b), std::max(a, b))];
  return e == none ? 0 : a < b ? entries_[e].winding : -entries_[e].winding;
}

std::uint32_t EdgeTable::first_use(std::uint32_t a, std::uint32_t b) const {
  const std::uint32_t e = slots_[slot_of(std::min(a, b), std::max(a, b))];
  return e == none ? none : entries_[e].first;
}

const std::vector<EdgeTable::Use>& EdgeTable::release(std::uint32_t a, std::uint32_t b) {
  released_.clear();
  const std::uint32_t e = slots_[slot_of(std::min(a, b), std::max(a, b))];
  if (e == none) return released_;
  entries_[e].winding = 0;
  for (std::uint32_t u = std::exchange(entries_[e].first, none); u != none; u = uses_[u].next)
    released_.push_back(uses_[u]);
  // Once for each constraint: else the uses of edges that rounding takes apart and joins again multiply.
  std::sort(released_.begin(), released_.end(), [](const Use& x, const Use& y) { return x.constraint < y.constraint; });
  std::size_t kept = 0;
  for (const Use& use : released_) {
    if (kept > 0 && released_[kept - 1].constraint == use.constraint) {
      released_[kept - 1].times += use.times;
      released_[kept - 1].moved = std::max(released_[kept - 1].moved, use.moved);
    } else {
      released_[kept++] = use;
    }
  }
  released_.resize(kept);
  return released_;
}

void EdgeTable::split(std::uint32_t a, std::uint32_t w, std::uint32_t b) {
  if (a > b) std::swap(a, b);
  for (const Use& use : release(a, b)) {
    add(a, w, use.constraint, use.times, use.moved);
    add(w, b, use.constraint, use.times, use.moved);
  }
}

}  // namespace trimloop::mesh
