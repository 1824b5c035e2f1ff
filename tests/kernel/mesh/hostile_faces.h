#pragma once
// Faces as damaged files have them: loops that cross themselves and each other, touch, overlap, are given twice or the
// wrong way round, do not close, straddle a seam, shrink to needles, or lie at the ends of the range of doubles.

#include <algorithm>
#include <vector>

#include "kernel/mesh/triangulation.h"
#include "tests/kernel/mesh/exact_signs.h"

namespace trimloop::test {

struct HostileFace {
  std::vector<Uv> points;
  std::vector<mesh::Segment> constraints;
  mesh::Inside rule = mesh::Inside::Nonzero;
};

namespace hostile_detail {

using Loop = std::vector<Uv>;

inline Loop loop(Random& r) {
  Loop out;
  const Uv centre{r.between(0, two_pi), r.between(-1, 1)};
  const double ru = r.between(0.05, 2), rv = r.between(0.05, 1);
  const int n = r.whole(0, 7) == 0 ? r.whole(30, 120) : r.whole(3, 24);
  switch (r.whole(0, 6)) {
    case 0:  // smooth, with or without waves
    case 1: {
      const double waves = r.whole(0, 1) * r.unit();
      for (int i = 0; i < n; ++i) {
        const double angle = two_pi * i / n, radius = 1 + waves * std::sin(5 * angle);
        out.push_back(centre + Uv{ru * radius * std::cos(angle), rv * radius * std::sin(angle)});
      }
      break;
    }
    case 2:  // any way through a box: crosses itself again and again
      for (int i = 0; i < std::min(n, 24); ++i)
        out.push_back(centre + Uv{ru * r.between(-1, 1), rv * r.between(-1, 1)});
      break;
    case 3:  // on a coarse grid: touches, overlaps, goes there and back
      for (int i = 0; i < std::min(n, 16); ++i) out.push_back({r.whole(0, 8) * 0.25, r.whole(0, 8) * 0.125});
      break;
    case 4: {  // a star polygon
      const int odd = 2 * std::min(n / 2, 8) + 3;
      for (int i = 0; i < odd; ++i) {
        const double angle = two_pi * i * (odd / 2) / odd;
        out.push_back(centre + Uv{ru * std::cos(angle), rv * std::sin(angle)});
      }
      break;
    }
    case 5: {  // a million times longer than wide
      const double width = 1e-6 * ru;
      for (int i = 0; i < n; ++i) out.push_back(centre + Uv{ru * i / n, width * r.unit()});
      for (int i = n; i > 0; --i) out.push_back(centre + Uv{ru * i / n, -width * r.unit()});
      break;
    }
    default:  // a rectangle across the whole period
      out = {{0, -rv}, {two_pi, -rv}, {two_pi, rv}, {0, rv}};
  }
  return out;
}

inline void damage(Loop& l, Random& r) {
  const auto any = [&] { return static_cast<std::size_t>(r.whole(0, static_cast<int>(l.size()) - 1)); };
  const auto place = [&](std::size_t i) { return l.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::size_t one = any(), other = any();  // not as arguments, whose order of evaluation is the compiler's
  switch (r.whole(0, 5)) {
    case 0:  // repeated points
      for (int k = r.whole(1, 4); k > 0; --k) {
        const Uv again = l[any()];
        l.insert(place(any()), again);
      }
      break;
    case 1:
      std::reverse(l.begin(), l.end());
      break;
    case 2:  // a spike there and back
      l.insert(place(one), {l[0], l[l.size() / 2], l[0]});
      break;
    case 3:  // two points exchanged: crosses itself
      std::swap(l[one], l[other]);
      break;
    case 4:  // all a little beside
      for (Uv& p : l) p = nudged(p, r, 3);
      break;
    default:  // a bay of half the loop, a few units in the last place from the rest
      for (std::size_t i = l.size() / 2; i > 0; --i) l.push_back(nudged(l[i], r, 1));
  }
}

}  // namespace hostile_detail

inline HostileFace hostile_face(Random& r) {
  using hostile_detail::Loop;
  HostileFace face;
  face.rule = static_cast<mesh::Inside>(r.whole(0, 2));
  std::vector<Loop> loops;
  for (int k = r.whole(1, 4); k > 0; --k) {
    loops.push_back(hostile_detail::loop(r));
    while (r.whole(0, 2) == 0) hostile_detail::damage(loops.back(), r);
  }
  const std::size_t own = loops.size();
  for (std::size_t i = 0; i < own; ++i) {
    Loop copy = loops[i];
    switch (r.whole(0, 11)) {
      case 0:  // given twice
        loops.push_back(copy);
        break;
      case 1:  // and once the other way round
        std::reverse(copy.begin(), copy.end());
        loops.push_back(copy);
        break;
      case 2:  // straddles the seam: once more a period on, with both copies of the seam
        for (Uv& p : copy) p.u += two_pi;
        loops.push_back(copy);
        loops.push_back({{0, -2}, {two_pi, -2}, {two_pi, 2}, {0, 2}});
        break;
      case 3: {  // touches: moved so that a corner meets a corner, or the middle of a side, of the first
        const Uv to = r.whole(0, 1) == 0 ? loops[0][0] : 0.5 * (loops[0][0] + loops[0][1]), from = loops[i].back();
        for (Uv& p : copy) p = p + to - from;
        loops.push_back(copy);
        break;
      }
      default:
        break;
    }
  }
  for (const Loop& l : loops) {
    const auto first = static_cast<std::uint32_t>(face.points.size()), n = static_cast<std::uint32_t>(l.size());
    face.points.insert(face.points.end(), l.begin(), l.end());
    const std::uint32_t missing =
        r.whole(0, 9) == 0 ? static_cast<std::uint32_t>(r.whole(0, static_cast<int>(n) - 1)) : n;
    for (std::uint32_t i = 0; i < n; ++i) {
      if (i != missing) face.constraints.push_back({first + i, first + (i + 1) % n});
    }
  }
  for (int k = r.whole(0, 20); k > 0; --k) face.points.push_back({r.between(0, two_pi), r.between(-1, 1)});
  if (r.whole(0, 7) == 0) {  // the same very small, down to subnormal numbers, very large, or far from the origin
    const int scale = std::array{-1074, -1060, -1020, -300, 300, 1000, 1018}[static_cast<std::size_t>(r.whole(0, 6))];
    for (Uv& p : face.points) p = {std::ldexp(p.u, scale), std::ldexp(p.v, scale)};
  } else if (r.whole(0, 7) == 0) {
    const double far = std::ldexp(1, r.whole(10, 50));
    for (Uv& p : face.points) p.u += far;
  }
  return face;
}

}  // namespace trimloop::test
