// Regions of a Triangulation: which triangles are inside, and what runs along an edge.

#include <algorithm>
#include <limits>
#include <utility>

#include "kernel/mesh/triangulation.h"

namespace trimloop::mesh {
namespace {

constexpr std::array<std::uint8_t, 3> after{1, 2, 0}, before{2, 0, 1};
constexpr std::int32_t unknown = std::numeric_limits<std::int32_t>::min();

bool is_in(std::int32_t winding, Inside rule) {
  switch (rule) {
    case Inside::Nonzero:
      return winding != 0;
    case Inside::Odd:
      return winding % 2 != 0;  // each crossing changes it by one, so its parity counts them
    case Inside::Positive:
      return winding > 0;
  }
  return false;
}

}  // namespace

// The winding number is 0 outside and constant between constraints; on the left of a constraint it is one higher.
// Region after region, those with the fewest constraints between them and the outside first: where loops are not
// closed, and the number depends on the way, the shortest way counts.
void Triangulation::classify(Inside rule) {
  is_classified_ = true;
  if (triangles_.empty()) return;
  winding_.assign(triangles_.size(), unknown);
  auto& region = cavity_;     // triangles of the current region whose neighbours are still to be seen
  auto& border = unsettled_;  // ways into further regions
  region.clear();
  const auto enter = [&](std::uint32_t t, std::int32_t winding) {
    winding_[t] = winding;
    triangles_[t].inside = is_in(winding, rule);
    region.push_back(t);
  };
  std::uint32_t outside = 0;
  while (!is_ghost(outside)) ++outside;
  enter(outside, 0);
  for (std::size_t next = 0;; ++next) {
    while (!region.empty()) {
      const std::uint32_t t = region.back();
      region.pop_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t u = triangles_[t].n[i];
        if (winding_[u] != unknown) continue;
        if (triangles_[t].bit(i) != 0) {
          border.push_back({t, static_cast<int>(i)});
        } else {
          enter(u, winding_[t]);
        }
      }
    }
    if (next == border.size()) break;
    const Triangle& t = triangles_[border[next].t];
    const auto i = static_cast<std::size_t>(border[next].i);
    if (winding_[t.n[i]] != unknown) continue;
    enter(t.n[i], winding_[border[next].t] - edges_.winding(t.v[after[i]], t.v[before[i]]));
  }
  border.clear();
}

std::uint32_t Triangulation::constraint_of(std::uint32_t t, int i) const {
  const auto k = static_cast<std::size_t>(i);
  std::uint32_t smallest = none;
  std::uint32_t use = edges_.first_use(triangles_[t].v[after[k]], triangles_[t].v[before[k]]);
  for (; use != none; use = edges_.use(use).next) smallest = std::min(smallest, edges_.use(use).constraint);
  return smallest;
}

// By counting: the triangles of each smallest vertex find their place, and the few of one vertex are sorted there.
std::vector<std::array<std::uint32_t, 3>> Triangulation::inside_triangles(StopCheck* stop) const {
  StopCheck never;
  StopCheck& check = stop ? *stop : never;
  constexpr std::uint32_t triangles_per_unit = 32;
  std::vector<std::uint32_t> first(points_.size() + 1, 0);  // of each vertex; then, one after it
  const auto smallest = [](const Triangle& t) { return std::min({t.v[0], t.v[1], t.v[2]}); };
  std::size_t count = 0;
  for (const Triangle& t : triangles_)
    if (t.inside) ++first[smallest(t)], ++count;
  std::uint32_t sum = 0;
  for (std::uint32_t& f : first) sum += std::exchange(f, sum);
  std::vector<std::array<std::uint32_t, 3>> out(count);
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    if (i % triangles_per_unit == 0 && check.spend()) return {};
    if (!triangles_[i].inside) continue;
    auto v = triangles_[i].v;
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    out[first[v[0]]++] = v;
  }
  for (std::uint32_t v = 0, begin = 0; v < points_.size(); begin = first[v++]) {
    if (v % triangles_per_unit == 0 && check.spend()) return {};
    std::sort(out.begin() + begin, out.begin() + first[v]);
  }
  return out;
}

}  // namespace trimloop::mesh
