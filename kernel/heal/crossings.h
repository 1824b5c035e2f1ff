#pragma once
// Where a ring crosses itself, and where the rings of a face cross each other.

#include "kernel/heal/draft.h"

namespace trimloop::heal {

struct Crossing {
  std::size_t piece[2] = {0, 0};  // of the ring, or counted through all rings; the first one earlier
  double t[2] = {0, 0};           // of their pcurves
  Uv at;
};

struct Crossings {
  std::vector<Crossing> found;
  bool complete = true;           // false: a limit ended the search
  std::size_t tests = 0;          // pairs of boxes looked at
};

constexpr std::size_t most_crossings = 256;

// Crossings are seen between the chords of the samples and settled on the curves. Left out: touching without crossing,
// stretches in common, and what is below the tolerance (parts of the ring smaller than that, strands that meet under
// less than a thousandth of a radian). Cost: n log n for n samples while few chords come near each other; never more than
// `most_tests(n)` pairs of boxes.
Crossings self_crossings(const Sheet&, const Ring&, double tolerance_mm);
// Of different rings; seams and poles cross nothing. The size of what lies between two crossings is not looked at.
Crossings mutual_crossings(const Sheet&, const std::vector<Ring>&);
constexpr std::size_t most_tests(std::size_t samples) { return 1'000'000 + 256 * samples; }

}  // namespace trimloop::heal
