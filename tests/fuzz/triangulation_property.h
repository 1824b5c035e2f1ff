#pragma once
// What must hold for every triangulation, whatever the input: shared by the tests, the fuzzer and the replay of its
// finds. Each check returns the first thing that is wrong, or an empty string.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "kernel/mesh/predicates.h"
#include "kernel/mesh/triangulation.h"

namespace trimloop::mesh {
namespace property {

inline constexpr std::uint32_t none = Triangulation::none;

inline bool equal(Uv a, Uv b) { return a.u == b.u && a.v == b.v; }
inline bool smaller(Uv a, Uv b) { return a.u != b.u ? a.u < b.u : a.v < b.v; }

inline std::string broken_merging(const Triangulation& t, std::span<const Uv> points) {
  if (t.points().size() < points.size()) return "points were lost";
  std::map<std::pair<double, double>, std::uint32_t> first;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (!equal(t.points()[i], points[i])) return "an input point has moved";
    const auto survivor = first.try_emplace({points[i].u + 0.0, points[i].v + 0.0}, i).first->second;
    if (t.vertex_of(i) != survivor) return "equal points are not merged into the first of them";
  }
  return {};
}

inline std::string broken_triangles(const Triangulation& t, std::size_t vertices) {
  const auto& p = t.points();
  std::size_t ghosts = 0;
  for (std::uint32_t k = 0; k < t.triangle_count(); ++k) {
    const auto& tri = t.triangle(k);
    const bool ghost = t.is_ghost(k);
    ghosts += ghost;
    if (ghost && tri.inside) return "a ghost is inside";
    if (!ghost && !(orient2d(p[tri.v[0]], p[tri.v[1]], p[tri.v[2]]) > 0)) return "a triangle is not positive";
    for (std::size_t i = 0; i < 3; ++i) {
      if (tri.n[i] >= t.triangle_count()) return "a neighbour is missing";
      const auto& other = t.triangle(tri.n[i]);
      const auto j = static_cast<std::size_t>(std::find(other.n.begin(), other.n.end(), k) - other.n.begin());
      if (j == 3) return "a neighbour does not know its neighbour";
      const std::uint32_t a = tri.v[(i + 1) % 3], b = tri.v[(i + 2) % 3];
      if (other.v[(j + 1) % 3] != b || other.v[(j + 2) % 3] != a) return "neighbours share no edge";
      if (tri.bit(i) != other.bit(j)) return "an edge is a constraint on one side only";
      if (tri.bit(i) != 0 && (a == none || b == none)) return "a ghost edge is a constraint";
      if (tri.bit(i) == 0 && tri.inside != other.inside) return "a region ends where no constraint is";
      if (ghost) {
        // Around the hull: x -> y and the next hull edge y -> z turn right or go straight, seen from outside.
        if (tri.v[i] != none) continue;
        const auto& next = t.triangle(t.next_around(k, a));
        const auto g = static_cast<std::size_t>(std::find(next.v.begin(), next.v.end(), none) - next.v.begin());
        if (g < 3 && next.v[(g + 2) % 3] == a && orient2d(p[next.v[(g + 1) % 3]], p[a], p[b]) > 0)
          return "the hull is not convex";
        continue;
      }
      const std::uint32_t q = other.v[j];
      if (tri.bit(i) != 0 || q == none) continue;
      const double in = incircle(p[tri.v[0]], p[tri.v[1]], p[tri.v[2]], p[q]);
      if (in > 0) return "an edge is not Delaunay";
      const Uv on = smaller(p[a], p[b]) ? p[a] : p[b], off = smaller(p[q], p[tri.v[i]]) ? p[q] : p[tri.v[i]];
      if (in == 0 && smaller(off, on)) return "cocircular points have the wrong diagonal";
    }
  }
  if (t.triangle_count() != 0 && t.triangle_count() != 2 * vertices - 2) return "Euler's count is wrong";
  if (t.triangle_count() != 0 && ghosts < 3) return "the hull has fewer than three edges";
  return {};
}

inline std::string broken_constraints(const Triangulation& t, std::span<const Segment> constraints) {
  if (t.triangle_count() == 0) return {};
  // 1. The table and the triangles speak of the same edges.
  std::size_t used = 0, marked = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;  // (constraint, vertex) -> pieces out less pieces in
  for (const EdgeTable::Entry& entry : t.constrained_edges().entries()) {
    if (entry.first == none) continue;
    ++used;
    const auto edge = t.find_edge(entry.a, entry.b);
    if (edge.t == none) return "a constraint is no edge";
    if (!t.is_constrained(edge.t, edge.i)) return "a constraint is not marked";
    int winding = 0;
    for (std::uint32_t u = entry.first; u != none; u = t.constrained_edges().use(u).next) {
      const auto& use = t.constrained_edges().use(u);
      winding += use.times;
      balance[{use.constraint, entry.a}] += use.times;
      balance[{use.constraint, entry.b}] -= use.times;
    }
    if (winding != entry.winding) return "the windings along an edge do not add up";
  }
  for (std::uint32_t k = 0; k < t.triangle_count(); ++k)
    marked += std::size_t(t.triangle(k).bit(0) + t.triangle(k).bit(1) + t.triangle(k).bit(2));
  if (marked != 2 * used) return "an edge is marked and nothing runs there";
  // 2. Each constraint is a chain from its start to its end.
  for (std::uint32_t c = 0; c < constraints.size(); ++c) {
    const std::uint32_t a = t.vertex_of(constraints[c].a), b = t.vertex_of(constraints[c].b);
    --balance[{c, a}];
    ++balance[{c, b}];
  }
  for (const auto& [where, sum] : balance) {
    if (sum != 0) return "a constraint is interrupted";
  }
  // 3. And a straight one but for rounding, unless it had to be led around.
  double largest = 0;
  for (Uv p : t.points()) largest = std::max({largest, std::abs(p.u), std::abs(p.v)});
  for (const auto& crossing : t.crossings()) {
    if (t.diverted() != 0 || largest < 1e-100 || largest > 1e100) break;
    const auto [ia, ib] = constraints[crossing.constraint];
    const Uv a = t.points()[ia], b = t.points()[ib], x = t.points()[crossing.vertex];
    const double length = norm(b - a);
    if (std::abs(cross((1 / largest) * (b - a), (1 / largest) * (x - a))) > 1e-14 * (length / largest))
      return "a crossing is far from its constraint";
  }
  return {};
}

// Of constraints that form closed loops: the winding number, 0 outside, changes by what runs along each edge, whatever
// the way; inside is what the rule says of it; and the area that it counts is that of the input but for rounding.
inline std::string broken_regions(const Triangulation& t, std::span<const Uv> points,
                                  std::span<const Segment> constraints, Inside rule) {
  if (t.triangle_count() == 0) return {};
  std::map<std::uint32_t, int> balance;
  for (Segment s : constraints) ++balance[t.vertex_of(s.a)], --balance[t.vertex_of(s.b)];
  if (std::any_of(balance.begin(), balance.end(), [](const auto& b) { return b.second != 0; })) return {};

  constexpr int unknown = 0x7fffffff;
  std::vector<int> winding(t.triangle_count(), unknown);
  std::vector<std::uint32_t> open;
  for (std::uint32_t k = 0; k < t.triangle_count(); ++k) {
    if (t.is_ghost(k)) winding[k] = 0, open.push_back(k);
  }
  while (!open.empty()) {
    const std::uint32_t k = open.back();
    open.pop_back();
    const auto& tri = t.triangle(k);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = tri.v[(i + 1) % 3], b = tri.v[(i + 2) % 3];
      const int step = tri.bit(i) != 0 ? t.constrained_edges().winding(a, b) : 0;
      int& beyond = winding[tri.n[i]];
      if (beyond == unknown) {
        beyond = winding[k] - step;
        open.push_back(tri.n[i]);
      } else if (beyond != winding[k] - step) {
        return "the winding number depends on the way";
      }
    }
  }
  double largest = 0;
  for (Uv p : t.points()) largest = std::max({largest, std::abs(p.u), std::abs(p.v)});
  const auto area2 = [&](Uv a, Uv b, Uv c) { return cross((1 / largest) * (b - a), (1 / largest) * (c - a)); };
  long double counted = 0, expected = 0, length = 0;
  for (std::uint32_t k = 0; k < t.triangle_count(); ++k) {
    const auto& [a, b, c] = t.triangle(k).v;
    const int w = winding[k];
    if (t.is_inside(k) != (rule == Inside::Nonzero ? w != 0 : rule == Inside::Odd ? w % 2 != 0 : w > 0))
      return "inside is not what the rule says";
    if (w != 0 && !t.is_ghost(k)) counted += w * area2(t.points()[a], t.points()[b], t.points()[c]);
  }
  if (t.diverted() != 0 || largest < 1e-100 || largest > 1e100) return {};
  for (Segment s : constraints) {
    expected += area2(points[constraints[0].a], points[s.a], points[s.b]);
    length += norm((1 / largest) * (points[s.b] - points[s.a]));
  }
  if (std::abs(counted - expected) > 1e-14 * (length + 1)) return "the area is not that of the loops";
  return {};
}

struct Bytes {
  const std::uint8_t* at;
  std::size_t left;
  std::uint8_t take() { return left == 0 ? std::uint8_t{0} : (--left, *at++); }
};

// A coordinate by one of several scales: small grids make ties, odd fractions make rounding, the rest makes trouble.
inline double coordinate(Bytes& in, int scale) {
  const int x = in.take() - 128;
  switch (scale) {
    case 0:
      return x % 8;
    case 1:
      return x;
    case 2:
      return x / 10.0;
    case 3:
      return std::ldexp(x, -1074);
    case 4:
      return std::ldexp(x, 1000);
    case 5:
      return std::ldexp(x, in.take() * 8 - 1060);
    case 6:
      return 1 + std::ldexp(x, -52);
    default: {
      double any = 0;
      std::array<std::uint8_t, 8> raw;
      for (auto& r : raw) r = in.take();
      std::memcpy(&any, raw.data(), 8);
      return any;
    }
  }
}

}  // namespace property

// Exact and complete: neighbours, orientation, convex hull, Euler's count, local Delaunay with the canonical choice
// among cocircular points, every constraint a chain from its start to its end, merged points, regions that end at
// constraints.
inline std::string broken_invariant(const Triangulation& t, std::span<const Uv> points,
                                    std::span<const Segment> constraints) {
  std::set<std::uint32_t> vertices;
  using property::none;
  for (std::uint32_t k = 0; k < t.triangle_count(); ++k) {
    for (std::uint32_t v : t.triangle(k).v) {
      if (v != none) vertices.insert(v);
    }
  }
  for (std::uint32_t v : vertices) {
    if (t.triangle_at(v) == none || t.index_of(t.triangle_at(v), v) < 0)
      return "a vertex does not know a triangle of its own";
  }
  if (t.triangle_count() != 0) {
    for (std::uint32_t i = 0; i < t.points().size(); ++i) {
      if (vertices.contains(i) != (i >= points.size() || t.vertex_of(i) == i))
        return "a point is no vertex, or a merged one is";
    }
  }
  for (auto broken : {property::broken_merging(t, points), property::broken_triangles(t, vertices.size()),
                      property::broken_constraints(t, constraints)}) {
    if (!broken.empty()) return broken;
  }
  return {};
}

// One run of the fuzzer: bytes become points and constraints, these a triangulation, which is checked, grown by
// insertion and splitting, and checked again.
inline std::string broken_by(const std::uint8_t* bytes, std::size_t size) {
  using property::coordinate;
  property::Bytes in{bytes, size};
  const int scale = in.take() % 8, form = in.take();
  std::vector<Uv> points(in.take() % 64);
  for (Uv& p : points) p.u = coordinate(in, scale), p.v = coordinate(in, scale);
  std::vector<Segment> constraints;
  const auto n = static_cast<std::uint32_t>(points.size());
  if (n > 0) {
    for (int count = in.take() % 32; count > 0; --count) constraints.push_back({in.take() % n, in.take() % n});
    if (form & 1) {  // one closed loop through all points
      for (std::uint32_t i = 0; i < n; ++i) constraints.push_back({i, (i + 1) % n});
    }
  }
  Triangulation t;
  if (!t.build(points, constraints)) {
    const bool finite = std::all_of(points.begin(), points.end(), [](Uv p) { return is_finite(p); });
    return finite ? "finite points were refused" : "";
  }
  const auto rule = static_cast<Inside>(form / 2 % 3);
  t.classify(rule);
  if (auto broken = broken_invariant(t, points, constraints); !broken.empty()) return broken;
  if (auto broken = property::broken_regions(t, points, constraints, rule); !broken.empty()) return broken;
  std::vector<std::uint32_t> touched;
  for (int k = in.take() % 16; k > 0 && t.triangle_count() > 0; --k) {
    const std::uint32_t from = in.take() % static_cast<std::uint32_t>(t.triangle_count());
    const auto& tri = t.triangle(from);
    const std::size_t i = in.take() % 3;
    if (tri.bit(i) != 0 && (form & 8)) {
      const Uv a = t.points()[tri.v[(i + 1) % 3]], b = t.points()[tri.v[(i + 2) % 3]];
      t.split_constraint(from, static_cast<int>(i), {a.u / 2 + b.u / 2, a.v / 2 + b.v / 2}, touched);
    } else {
      const Uv p{coordinate(in, scale), coordinate(in, scale)};
      const std::uint32_t v = t.insert(p, from, touched);
      if (v != property::none && !property::equal(t.points()[v], p)) return "an inserted point has moved";
    }
  }
  const std::string broken = broken_invariant(t, points, constraints);
  return broken.empty() ? broken : broken + " after insertions";
}

}  // namespace trimloop::mesh
