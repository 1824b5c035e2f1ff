#pragma once
// Typed index into an array. Two handles of different Tag do not mix; the default one is "none".

#include <cstdint>
#include <functional>

namespace trimloop {

template <class Tag>
struct Handle {
  static constexpr std::uint32_t none = 0xffffffffu;
  std::uint32_t index = none;
  explicit operator bool() const { return index != none; }
  friend bool operator==(Handle a, Handle b) { return a.index == b.index; }
  friend bool operator!=(Handle a, Handle b) { return a.index != b.index; }
  friend bool operator<(Handle a, Handle b) { return a.index < b.index; }
};

}  // namespace trimloop

template <class Tag>
struct std::hash<trimloop::Handle<Tag>> {
  std::size_t operator()(trimloop::Handle<Tag> h) const noexcept { return std::hash<std::uint32_t>{}(h.index); }
};
