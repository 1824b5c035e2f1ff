#include "kernel/mesh/insertion_order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace trimloop::mesh {
namespace {

// A key: 4 bits round, 28 bits place on the curve, 32 bits index.
constexpr int curve_bits = 14;  // per axis
constexpr int max_round = 15;
constexpr std::size_t points_per_unit = 16;  // of work, see stop_check.h

// Place of cell (x, y) on the Hilbert curve of order `curve_bits`: digit by digit, keeping which of the four turned
// copies of the curve the digit is in (bit 0: axes swapped, bit 1: both reversed).
std::uint32_t hilbert(std::uint32_t x, std::uint32_t y) {
  constexpr std::array<std::uint8_t, 16> digit{0, 1, 3, 2, 0, 3, 1, 2, 2, 3, 1, 0, 2, 1, 3, 0};
  constexpr std::array<std::uint8_t, 16> next{1, 0, 3, 0, 0, 2, 1, 1, 2, 1, 2, 3, 3, 3, 0, 2};
  std::uint32_t place = 0, turn = 0;
  for (int bit = curve_bits - 1; bit >= 0; --bit) {
    const std::uint32_t cell = turn << 2 | (x >> bit & 1) << 1 | (y >> bit & 1);
    place = place << 2 | digit[cell];
    turn = next[cell];
  }
  return place;
}

// Sorts by the upper half of the keys; stable. False when stopped.
bool sort_keys(std::vector<std::uint64_t>& keys, std::vector<std::uint64_t>& scratch, StopCheck& stop) {
  if (keys.size() < 512) {
    std::sort(keys.begin(), keys.end());  // the index in the lower half makes it stable
    return true;
  }
  scratch.resize(keys.size());
  for (int shift : {32, 43, 54}) {
    std::array<std::uint32_t, 2048> count{};
    for (std::uint64_t k : keys) ++count[k >> shift & 2047];
    std::uint32_t sum = 0;
    for (std::uint32_t& c : count) sum += std::exchange(c, sum);
    for (std::uint64_t k : keys) scratch[count[k >> shift & 2047]++] = k;
    keys.swap(scratch);
    if (stop.spend(keys.size() / (16 * points_per_unit))) return false;
  }
  return true;
}

struct Frame2 {  // square that encloses points; halves, so that no difference overflows
  double u = 0, v = 0, size = 0;

  template <class Points>
  static Frame2 around(const Points& each) {
    Uv lo{infinity, infinity}, hi{-infinity, -infinity};
    each([&](Uv p) {
      lo = {std::min(lo.u, p.u), std::min(lo.v, p.v)};
      hi = {std::max(hi.u, p.u), std::max(hi.v, p.v)};
    });
    return {lo.u / 2, lo.v / 2, std::max(hi.u / 2 - lo.u / 2, hi.v / 2 - lo.v / 2)};
  }
  std::uint32_t place(Uv p) const {
    constexpr double cells = 1 << curve_bits;
    const auto cell = [&](double x, double lo) {
      return static_cast<std::uint32_t>(std::min((x / 2 - lo) / size * cells, cells - 1));
    };
    return size > 0 ? hilbert(cell(p.u, u), cell(p.v, v)) : 0;
  }
};

std::uint32_t index_in(std::uint64_t key) { return static_cast<std::uint32_t>(key); }

// Points that share a cell of the curve (clusters much smaller than the whole) are ordered among themselves in a frame
// of their own, again and again: each time at least the two farthest of them part.
bool refine_runs(std::span<const Uv> points, std::vector<std::uint64_t>& keys, StopCheck& stop) {
  constexpr std::size_t small = 16;
  struct Run {
    std::size_t begin, end;
  };
  std::vector<Run> runs;
  const auto find_runs = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end;) {
      std::size_t j = i + 1;
      while (j < end && keys[j] >> 32 == keys[i] >> 32) ++j;
      if (j - i > small) runs.push_back({i, j});
      i = j;
    }
  };
  find_runs(0, keys.size());
  while (!runs.empty()) {
    const Run run = runs.back();
    runs.pop_back();
    const Frame2 frame = Frame2::around([&](auto&& take) {
      for (std::size_t i = run.begin; i < run.end; ++i) take(points[index_in(keys[i])]);
    });
    if (stop.spend(1 + (run.end - run.begin) / points_per_unit)) return false;
    if (!(frame.size > 0)) continue;  // all equal
    for (std::size_t i = run.begin; i < run.end; ++i) {
      keys[i] = std::uint64_t{frame.place(points[index_in(keys[i])])} << 32 | index_in(keys[i]);
    }
    std::sort(keys.begin() + static_cast<std::ptrdiff_t>(run.begin),
              keys.begin() + static_cast<std::ptrdiff_t>(run.end));
    find_runs(run.begin, run.end);
  }
  return true;
}

}  // namespace

bool insertion_order(std::span<const Uv> points, StopCheck& stop, std::vector<std::uint32_t>& order,
                     std::vector<std::uint64_t>& keys, std::vector<std::uint64_t>& more_keys) {
  const std::size_t n = points.size();
  order.resize(n);
  if (n <= 16) {
    for (std::uint32_t i = 0; i < n; ++i) order[i] = i;
    return true;
  }
  const Frame2 frame = Frame2::around([&](auto&& take) {
    for (Uv p : points) take(p);
  });
  // One point in eight goes to an earlier round, one in eight of these to a still earlier one; the first round has
  // about a hundred. Chosen by a hash of the index: repeatable, and without relation to the shape.
  const int rounds = std::min(max_round, std::max(0, static_cast<int>(std::bit_width(n)) - 7) / 3);
  keys.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    if (i % points_per_unit == 0 && stop.spend()) return false;
    std::uint64_t h = (i + 1) * 0x9e3779b97f4a7c15u;
    h = (h ^ h >> 29) * 0xbf58476d1ce4e5b9u;
    const int level = std::min(rounds, std::countr_zero(h >> 20) / 3);
    keys[i] = std::uint64_t(rounds - level) << 60 | std::uint64_t{frame.place(points[i])} << 32 | i;
  }
  if (!sort_keys(keys, more_keys, stop) || !refine_runs(points, keys, stop)) return false;
  for (std::size_t i = 0; i < n; ++i) order[i] = index_in(keys[i]);
  return true;
}

}  // namespace trimloop::mesh
