#include "kernel/mesh/triangulation.h"

#include <algorithm>

#include "kernel/mesh/insertion_order.h"
#include "kernel/mesh/predicates.h"

// Points: location by walking, insertion, Delaunay flips. Constraints are in triangulation_constraints.cpp, regions in
// triangulation_regions.cpp.
//
// Every hull edge has a ghost triangle outside, whose third vertex is `none`, so that the surface is closed: no
// triangle lacks a neighbour, and a point outside the hull is inserted like any other.

namespace trimloop::mesh {
namespace {

constexpr std::array<std::uint8_t, 3> after{1, 2, 0}, before{2, 0, 1};  // index of the other two vertices

std::uint8_t bits(int edge0, int edge1 = 0, int edge2 = 0) {
  return static_cast<std::uint8_t>(edge0 | edge1 << 1 | edge2 << 2);
}

bool equal(Uv a, Uv b) { return a.u == b.u && a.v == b.v; }
bool smaller(Uv a, Uv b) { return a.u != b.u ? a.u < b.u : a.v < b.v; }

}  // namespace

Result<void> Triangulation::build(std::span<const Uv> points, std::span<const Segment> constraints, StopCheck* stop) {
  if (points.size() >= 0x80000000u || constraints.size() >= 0x80000000u) {
    return fail(ErrorCode::Limit, "too many points or constraints to triangulate",
                static_cast<double>(std::max(points.size(), constraints.size())), 0x80000000u);
  }
  for (Uv p : points) {
    if (!is_finite(p)) return fail(ErrorCode::InvalidArgument, "a point to triangulate is not finite");
  }
  for (Segment s : constraints) {
    if (std::max(s.a, s.b) >= points.size()) {
      return fail(ErrorCode::InvalidArgument, "a constraint names a point that is not there", std::max(s.a, s.b),
                  static_cast<double>(points.size()));
    }
  }
  triangles_.clear();
  crossings_.clear();
  edges_.reset(constraints.size());
  diverted_ = 0;
  is_classified_ = false;

  // 1. The Delaunay triangulation, with the points in insertion order so that near ones are near in memory.
  StopCheck never;
  StopCheck& check = stop ? *stop : never;
  const auto stopped = [&] {
    triangles_.clear(), points_.clear(), merged_.clear(), at_vertex_.clear(), pieces_.clear(), crossings_.clear();
    edges_.reset(0);
    return fail(ErrorCode::Cancelled, "stopped while triangulating");
  };
  if (!insertion_order(points, check, order_, keys_, more_keys_)) return stopped();
  points_.resize(points.size());
  merged_.resize(points.size());
  for (std::uint32_t k = 0; k < order_.size(); ++k) points_[k] = points[order_[k]], merged_[k] = k;
  if (!insert_all(check)) return stopped();
  // 2. The caller's numbers.
  renumber(points);
  // 3. The constraints.
  if (!triangles_.empty() && !enforce_all(constraints, check)) return stopped();
  return {};
}

// False when stopped.
bool Triangulation::insert_all(StopCheck& stop) {
  const auto n = static_cast<std::uint32_t>(points_.size());
  std::uint32_t b = 1;
  while (b < n && equal(points_[b], points_[0])) ++b;
  std::uint32_t c = b + 1;
  while (c < n && orient2d(points_[0], points_[b], points_[c]) == 0) ++c;
  if (c >= n) {
    merge_collinear();
    return true;
  }
  triangles_.reserve(2 * points_.size());
  if (orient2d(points_[0], points_[b], points_[c]) > 0) {
    start(0, b, c);
  } else {
    start(0, c, b);
  }
  std::uint32_t last = 0;
  for (std::uint32_t k = 1; k < n; ++k) {
    if (k == b || k == c) continue;
    if (stop.spend()) return false;
    const Location where = walk(points_[k], last);
    last = where.t;
    if (where.vertex() >= 0) {
      merged_[k] = triangles_[where.t].v[static_cast<std::size_t>(where.vertex())];
    } else {
      add_vertex(k, where);
    }
  }
  return true;
}

// There will be no triangles, but equal points are still one.
void Triangulation::merge_collinear() {
  cavity_.resize(points_.size());
  for (std::uint32_t k = 0; k < points_.size(); ++k) cavity_[k] = k;
  std::sort(cavity_.begin(), cavity_.end(), [&](auto i, auto j) {
    return smaller(points_[i], points_[j]) || (equal(points_[i], points_[j]) && i < j);
  });
  for (std::size_t i = 1; i < cavity_.size(); ++i) {
    if (equal(points_[cavity_[i]], points_[cavity_[i - 1]])) merged_[cavity_[i]] = merged_[cavity_[i - 1]];
  }
}

// One triangle and its three ghosts.
void Triangulation::start(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  triangles_.push_back({{a, b, c}, {1, 2, 3}});
  triangles_.push_back({{c, b, none}, {3, 2, 0}});
  triangles_.push_back({{a, c, none}, {1, 3, 0}});
  triangles_.push_back({{b, a, none}, {2, 1, 0}});
}

// From the order of insertion to the order of the caller; equal points go by their smallest index.
void Triangulation::renumber(std::span<const Uv> points) {
  const std::size_t n = points.size();
  auto& name = cavity_;
  name = order_;
  for (std::size_t k = 0; k < n; ++k) name[merged_[k]] = std::min(name[merged_[k]], order_[k]);
  at_vertex_.assign(n, none);
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    for (std::uint32_t& v : triangles_[t].v) {
      if (v != none) v = name[v], at_vertex_[v] = t;
    }
  }
  for (std::size_t k = 0; k < n; ++k) name[k] = name[merged_[k]];  // a survivor stands for itself, so order is harmless
  for (std::size_t k = 0; k < n; ++k) merged_[order_[k]] = name[k];
  points_.assign(points.begin(), points.end());
}

// Visibility walk. In a Delaunay triangulation it always arrives; with constraints it may run in circles, which a
// changing first choice makes improbable (Devillers, Pion, Teillaud, "Walking in a triangulation", 2002) and the count
// of steps impossible.
Triangulation::Location Triangulation::walk(Uv p, std::uint32_t from) const {
  std::uint32_t t = from, came_from = none;
  if (const int g = index_of(t, none); g >= 0) t = triangles_[t].n[static_cast<std::size_t>(g)];
  std::uint32_t random = 0x2545f491u;
  for (std::size_t step = 0; step <= triangles_.size(); ++step) {
    const Triangle& tri = triangles_[t];
    random = random * 1664525u + 1013904223u;
    std::size_t i = random >> 16 & 1;
    int on = 0;
    std::uint32_t next = none;
    for (int k = 0; k < 3; ++k, i = after[i]) {
      if (tri.n[i] == came_from) continue;
      const double side = orient2d(points_[tri.v[after[i]]], points_[tri.v[before[i]]], p);
      if (side < 0) {
        next = tri.n[i];
        break;
      }
      if (side == 0) on |= 1 << i;
    }
    if (next == none) return {t, on};
    if (is_ghost(next)) return {next, 0};
    came_from = t;
    t = next;
  }
  return scan(p);
}

Triangulation::Location Triangulation::scan(Uv p) const {
  Location beyond{0, 0};
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    const auto& v = triangles_[t].v;
    int on = 0, out = 0, real = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = v[after[i]], b = v[before[i]];
      if (a == none || b == none) continue;
      const double side = orient2d(points_[a], points_[b], p);
      ++real;
      out += side < 0;
      if (side == 0) on |= 1 << i;
    }
    if (real == 3 && out == 0) return {t, on};
    if (real == 1 && out == 0 && on == 0) beyond = {t, 0};
  }
  return beyond;
}

std::uint32_t Triangulation::locate(Uv p, std::uint32_t from) const {
  if (triangles_.empty() || !is_finite(p)) return none;
  return walk(p, from < triangles_.size() ? from : 0).t;
}

// p is inside `where.t` or on one edge of it, and has coordinates already.
void Triangulation::add_vertex(std::uint32_t p, Location where) {
  if (where.on == 0) {
    split_triangle(where.t, p);
  } else {
    split_edge(where.t, where.edge(), p);
  }
  settle_star(where.t);
}

void Triangulation::split_triangle(std::uint32_t t, std::uint32_t p) {
  const Triangle old = triangles_[t];
  const auto [a, b, c] = old.v;
  const auto t1 = static_cast<std::uint32_t>(triangles_.size()), t2 = t1 + 1;
  triangles_[t] = {{p, b, c}, {old.n[0], t1, t2}, bits(old.bit(0)), old.inside};
  triangles_.push_back({{p, c, a}, {old.n[1], t2, t}, bits(old.bit(1)), old.inside});
  triangles_.push_back({{p, a, b}, {old.n[2], t, t1}, bits(old.bit(2)), old.inside});
  relink(old.n[1], t, t1);
  relink(old.n[2], t, t2);
}

// Two triangles cab and dba become four around p, counter-clockwise: pbc, pca, pad, pdb.
void Triangulation::split_edge(std::uint32_t t, int edge, std::uint32_t p) {
  const Triangle old = triangles_[t];
  const auto i = static_cast<std::size_t>(edge);
  const std::uint32_t u = old.n[i];
  const Triangle other = triangles_[u];
  const std::size_t j = other.n[0] == t ? 0 : other.n[1] == t ? 1 : 2;
  const std::uint32_t c = old.v[i], a = old.v[after[i]], b = old.v[before[i]], d = other.v[j];
  const auto t1 = static_cast<std::uint32_t>(triangles_.size()), u1 = t1 + 1;
  const auto half = [&](const Triangle& from, std::size_t outer, int spoke) {
    return static_cast<std::uint8_t>(from.bit(outer) | old.bit(i) << spoke);
  };
  triangles_[t] = {{p, b, c}, {old.n[after[i]], t1, u1}, half(old, after[i], 2), old.inside};
  triangles_.push_back({{p, c, a}, {old.n[before[i]], u, t}, half(old, before[i], 1), old.inside});
  triangles_[u] = {{p, a, d}, {other.n[after[j]], u1, t1}, half(other, after[j], 2), other.inside};
  triangles_.push_back({{p, d, b}, {other.n[before[j]], t, u}, half(other, before[j], 1), other.inside});
  relink(old.n[before[i]], t, t1);
  relink(other.n[before[j]], u, u1);
}

void Triangulation::relink(std::uint32_t t, std::uint32_t from, std::uint32_t to) {
  auto& n = triangles_[t].n;
  n[n[0] == from ? 0 : n[1] == from ? 1 : 2] = to;
}

// Whether edge ab of triangle pab must give way to pq, q being the opposite vertex on the other side. At infinity:
// whether p sees the next hull edge.
bool Triangulation::wants_flip(std::uint32_t p, std::uint32_t a, std::uint32_t b, std::uint32_t q) const {
  if (std::max({a, b, q}) == none) {
    if (q == none) return false;
    return b == none ? orient2d(points_[a], points_[q], points_[p]) > 0
                     : orient2d(points_[q], points_[b], points_[p]) > 0;
  }
  const double in = incircle(points_[p], points_[a], points_[b], points_[q]);
  if (in != 0) return in > 0;
  // Cocircular. As if the smallest point had been lowered a little on its way to the paraboloid: it gets the diagonal.
  const Uv& with = smaller(points_[p], points_[q]) ? points_[p] : points_[q];
  const Uv& without = smaller(points_[a], points_[b]) ? points_[a] : points_[b];
  return smaller(with, without);
}

// Triangles t = pab and u, which has q opposite ab at index j, become t = paq and u = pqb.
void Triangulation::flip(std::uint32_t t, std::uint32_t u, std::size_t j) {
  Triangle &first = triangles_[t], &second = triangles_[u];
  const auto [p, a, b] = first.v;
  const std::uint32_t q = second.v[j];
  const std::uint32_t beyond_aq = second.n[after[j]], beyond_qb = second.n[before[j]];
  const std::uint32_t beyond_bp = first.n[1], beyond_pa = first.n[2];
  const std::uint8_t first_bits = bits(second.bit(after[j]), 0, first.bit(2));
  const std::uint8_t second_bits = bits(second.bit(before[j]), first.bit(1), 0);
  first = {{p, a, q}, {beyond_aq, u, beyond_pa}, first_bits, first.inside};
  second = {{p, q, b}, {beyond_qb, beyond_bp, t}, second_bits, second.inside};
  relink(beyond_aq, u, t);
  relink(beyond_bp, t, u);
}

// After vertex p came in (the first of each triangle around it, one of which is t): flips until no edge opposite p
// wants to. Goes around p once, staying where a flip brings a new edge.
void Triangulation::settle_star(std::uint32_t t) {
  const std::uint32_t end = triangles_[t].v[1];
  do {
    for (;;) {
      const Triangle& tri = triangles_[t];
      if (tri.bit(0) != 0) break;
      const std::uint32_t u = tri.n[0];
      const auto& n = triangles_[u].n;
      const std::size_t j = n[0] == t ? 0 : n[1] == t ? 1 : 2;
      if (!wants_flip(tri.v[0], tri.v[1], tri.v[2], triangles_[u].v[j])) break;
      flip(t, u, j);
    }
    t = triangles_[t].n[1];
  } while (triangles_[t].v[1] != end);
}

// After settle_star: notes the triangles of the star at their vertices, and for the caller.
void Triangulation::note_star(std::uint32_t t, std::vector<std::uint32_t>* touched) {
  const std::uint32_t end = triangles_[t].v[1];
  at_vertex_[triangles_[t].v[0]] = t;
  do {
    if (touched != nullptr) touched->push_back(t);
    if (const std::uint32_t v = triangles_[t].v[1]; v != none) at_vertex_[v] = t;
    t = triangles_[t].n[1];
  } while (triangles_[t].v[1] != end);
}

// Flips from the edges in `unsettled_` on until none wants to; the hull does not change.
void Triangulation::settle_edges(std::vector<std::uint32_t>* touched) {
  while (!unsettled_.empty()) {
    const auto [t, edge] = unsettled_.back();
    unsettled_.pop_back();
    const Triangle& tri = triangles_[t];
    const auto i = static_cast<std::size_t>(edge);
    if (tri.bit(i) != 0) continue;
    const std::uint32_t u = tri.n[i];
    const auto& n = triangles_[u].n;
    const std::size_t j = n[0] == t ? 0 : n[1] == t ? 1 : 2;
    const std::uint32_t p = tri.v[i], a = tri.v[after[i]], b = tri.v[before[i]], q = triangles_[u].v[j];
    if (std::max({p, a, b, q}) == none || !wants_flip(p, a, b, q)) continue;
    rotate(t, i);
    flip(t, u, j);
    if (touched != nullptr) touched->insert(touched->end(), {t, u});
    at_vertex_[p] = at_vertex_[a] = t;
    at_vertex_[q] = at_vertex_[b] = u;
    unsettled_.insert(unsettled_.end(), {{t, 0}, {t, 2}, {u, 0}, {u, 1}});
  }
}

// Brings vertex i of t to the front.
void Triangulation::rotate(std::uint32_t t, std::size_t i) {
  const Triangle old = triangles_[t];
  const std::size_t j = after[i], k = before[i];
  triangles_[t] = {{old.v[i], old.v[j], old.v[k]},
                   {old.n[i], old.n[j], old.n[k]},
                   bits(old.bit(i), old.bit(j), old.bit(k)),
                   old.inside};
}

std::uint32_t Triangulation::insert(Uv p, std::uint32_t near_triangle, std::vector<std::uint32_t>& touched) {
  touched.clear();
  if (triangles_.empty() || !is_finite(p) || points_.size() >= 0x80000000u) return none;
  const Location where = walk(p, near_triangle < triangles_.size() ? near_triangle : 0);
  if (is_ghost(where.t) || where.vertex() >= 0) return none;
  if (where.on != 0 && is_constrained(where.t, where.edge())) return none;
  if (is_classified_ && !triangles_[where.t].inside) return none;
  const std::uint32_t v = new_point(p);
  add_vertex(v, where);
  note_star(where.t, &touched);
  return v;
}

std::uint32_t Triangulation::new_point(Uv p) {
  points_.push_back(p);
  at_vertex_.push_back(none);
  return static_cast<std::uint32_t>(points_.size() - 1);
}

Triangulation::Edge Triangulation::find_edge(std::uint32_t a, std::uint32_t b) const {
  bool b_is_smaller = false;
  return find_edge(a, b, b_is_smaller);
}

// Turns around both ends in step, so that the smaller star bounds the cost; says which one that was when there is none.
Triangulation::Edge Triangulation::find_edge(std::uint32_t a, std::uint32_t b, bool& b_is_smaller) const {
  const std::uint32_t a0 = at_vertex_[a], b0 = at_vertex_[b];
  if (a0 == none || b0 == none) return {};
  std::uint32_t t = a0, u = b0;
  for (;;) {
    const auto i = static_cast<std::size_t>(index_of(t, a)), j = static_cast<std::size_t>(index_of(u, b));
    if (triangles_[t].v[after[i]] == b) return {t, before[i]};
    if (triangles_[u].v[before[j]] == a) return {u, after[j]};
    t = triangles_[t].n[after[i]];
    u = triangles_[u].n[after[j]];
    if (t == a0 || u == b0) {
      b_is_smaller = t != a0;
      return {};
    }
  }
}

}  // namespace trimloop::mesh
