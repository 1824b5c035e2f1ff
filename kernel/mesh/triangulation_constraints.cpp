// Constraints of a Triangulation: each becomes a chain of edges between the vertices that lie on it.
//
// A piece of a constraint is taken from one end: along an edge that is there already, or through the triangles in its
// way up to the first vertex exactly on it; these are carved out and the two halves of the cavity filled again. Where
// another constraint is in the way the crossing point, rounded, becomes a vertex and both constraints turn into two
// pieces each. Rounding moves pieces, so that these may cross something else in turn: hence the stack of pieces. What
// has been moved too often is led along existing edges instead, which ends every such cascade (`diverted`).

#include <algorithm>
#include <tuple>

#include "kernel/mesh/predicates.h"
#include "kernel/mesh/triangulation.h"

namespace trimloop::mesh {
namespace {

constexpr std::array<std::uint8_t, 3> after{1, 2, 0}, before{2, 0, 1};
constexpr int most_moves = 10;
// Triangles that moved pieces may pass, for each point and constraint: what keeps bundles of needles on a
// coarse lattice (subnormal coordinates) from taking quadratic time.
constexpr std::size_t most_detour = 1000;
constexpr double rounding = 0x1p-51;  // of a crossing point, relative

// Whether x lies ahead of a on the way to b; the three are collinear and x is not a.
bool is_ahead(Uv a, Uv b, Uv x) {
  if (a.u != b.u) return (b.u > a.u) == (x.u > a.u);
  return (b.v > a.v) == (x.v > a.v);
}

}  // namespace

// False when stopped.
bool Triangulation::enforce_all(std::span<const Segment> constraints, StopCheck& stop) {
  const std::size_t n = points_.size(), m = constraints.size();
  crossings_left_ = 8 * (n + m) + std::min<std::size_t>(m * m, 1'000'000);
  detour_left_ = most_detour * (n + m);
  for (std::uint32_t c = 0; c < constraints.size(); ++c) {
    const std::uint32_t a = merged_[constraints[c].a], b = merged_[constraints[c].b];
    pieces_.push_back({a, b, c, 1, 0});
    while (!pieces_.empty()) {
      const Piece piece = pieces_.back();
      pieces_.pop_back();
      cavity_.clear();
      enforce(piece);
      if (stop.spend(1 + cavity_.size() / 4)) return false;
    }
  }
  list_crossings(constraints);
  return true;
}

void Triangulation::enforce(Piece piece) {
  while (piece.from != piece.to) {
    // 1. The edge is there, as is mostly the case.
    bool far_end_first = false;
    if (const Edge edge = find_edge(piece.from, piece.to, far_end_first); edge.t != none) {
      mark(edge, piece);
      return;
    }
    // 2. Leave from the end that has fewer neighbours.
    if (far_end_first) std::swap(piece.from, piece.to), piece.times = -piece.times;
    const Exit exit = leave(piece.from, piece.to);
    if (exit.is_along) {
      mark(exit.edge, piece);
      piece.from = triangles_[exit.edge.t].v[before[static_cast<std::size_t>(exit.edge.i)]];
      continue;
    }
    // 3. Through the triangles.
    const bool moved_too_often = piece.moved >= most_moves || (piece.moved > 0 && detour_left_ == 0);
    const bool divert_it = moved_too_often || crossings_left_ == 0;
    const Passage passage = march(piece.from, piece.to, exit.edge, !divert_it);
    if (piece.moved > 0) detour_left_ -= std::min(detour_left_, cavity_.size());
    if (passage.end == none) {
      cross(piece, passage.blocked);
      return;
    }
    if (divert_it) {
      divert(piece);
    } else {
      carve();
      mark(find_edge(piece.from, passage.end), piece);
      settle_edges();
    }
    piece.from = passage.end;
  }
}

void Triangulation::mark(Edge edge, const Piece& piece) {
  const auto i = static_cast<std::size_t>(edge.i);
  set_mark(edge, true);
  edges_.add(triangles_[edge.t].v[after[i]], triangles_[edge.t].v[before[i]], piece.constraint, piece.times,
             piece.moved);
}

void Triangulation::set_mark(Edge edge, bool on) {
  const auto set = [on](Triangle& t, int i) {
    t.constrained = static_cast<std::uint8_t>((t.constrained & ~(1 << i)) | int{on} << i);
  };
  Triangle& t = triangles_[edge.t];
  Triangle& u = triangles_[t.n[static_cast<std::size_t>(edge.i)]];
  set(t, edge.i);
  set(u, u.n[0] == edge.t ? 0 : u.n[1] == edge.t ? 1 : 2);
}

// How the ray from a towards b, which are not joined, leaves a: along an edge at a to a vertex between, or through the
// edge opposite a.
Triangulation::Exit Triangulation::leave(std::uint32_t a, std::uint32_t b) const {
  const Uv pa = points_[a], pb = points_[b];
  std::uint32_t t = at_vertex_[a];
  for (;;) {
    const Triangle& tri = triangles_[t];
    const auto i = static_cast<std::size_t>(index_of(t, a));
    const std::uint32_t x = tri.v[after[i]], y = tri.v[before[i]];
    if (x != none) {
      const double side = orient2d(pa, pb, points_[x]);
      if (side == 0 && is_ahead(pa, pb, points_[x])) return {{t, before[i]}, true};
      if (side < 0 && y != none && orient2d(pa, pb, points_[y]) > 0) return {{t, static_cast<int>(i)}, false};
    }
    t = tri.n[after[i]];
  }
}

// From a through triangles towards b, starting across an edge opposite a, to the first vertex exactly on the way (b at
// the latest) or to a constraint. Notes the triangles, and the edges along the passage: those on the left in the order
// from a, those on the right also from a but pointing back, so that the passage is to the right of all of them.
Triangulation::Passage Triangulation::march(std::uint32_t a, std::uint32_t b, Edge edge, bool stop_at_constraints) {
  cavity_.clear(), left_.clear(), right_.clear();
  std::uint32_t t = edge.t;
  auto i = static_cast<std::size_t>(edge.i);
  const auto rim = [&](std::size_t k, bool left) {
    const Triangle& tri = triangles_[t];
    const Rim r{tri.v[before[k]], tri.v[after[k]], tri.n[k], tri.bit(k) != 0, false};
    (left ? left_ : right_).push_back(r);
  };
  cavity_.push_back(t);
  rim(after[i], true);
  rim(before[i], false);
  for (;;) {
    const Triangle& from = triangles_[t];
    if (stop_at_constraints && from.bit(i) != 0) return {none, {t, static_cast<int>(i)}};
    const std::uint32_t u = from.n[i];
    const auto& n = triangles_[u].n;
    const std::size_t j = n[0] == t ? 0 : n[1] == t ? 1 : 2;
    t = u;
    cavity_.push_back(t);
    // The new vertex z, then the left and the right end of the edge just crossed, in this order around t.
    const std::uint32_t z = triangles_[t].v[j];
    const double side = z == b ? 0 : orient2d(points_[a], points_[b], points_[z]);
    if (side >= 0) rim(before[j], true);
    if (side <= 0) rim(after[j], false);
    if (side == 0) return {z, {}};
    i = side > 0 ? after[j] : before[j];
  }
}

// The passage becomes a cavity of two halves, each bounded by its rim and the straight line, and is filled anew.
// Leaves its edges unsettled.
void Triangulation::carve() {
  // 1. An edge that has the cavity on both sides is in the rim twice, there and back, nested like brackets.
  for (std::uint32_t t : cavity_) triangles_[t].inside = true;  // a mark for now
  seams_.clear();
  for (auto* rim : {&left_, &right_}) {
    open_.clear();
    for (std::uint32_t k = 0; k < rim->size(); ++k) {
      Rim& r = (*rim)[k];
      if (!triangles_[r.outer].inside) continue;
      r.is_seam = true;
      if (!open_.empty() && (*rim)[open_.back()].from == r.to && (*rim)[open_.back()].to == r.from) {
        r.outer = (*rim)[open_.back()].outer;
        open_.pop_back();
      } else {
        r.outer = static_cast<std::uint32_t>(seams_.size());
        seams_.push_back(none);
        open_.push_back(k);
      }
    }
  }
  // 2. Both halves, and the line between them.
  std::reverse(right_.begin(), right_.end());
  std::size_t used = 0;
  const std::uint32_t l = fill(left_, used), r = fill(right_, used);
  triangles_[l].n[2] = r, triangles_[r].n[2] = l;
  // 3. What others rely on.
  for (std::uint32_t t : cavity_) {
    for (int i = 0; i < 3; ++i) {
      at_vertex_[triangles_[t].v[static_cast<std::size_t>(i)]] = t;
      unsettled_.push_back({t, i});
    }
  }
}

// Fills the polygon of a rim and the line from its first to its last vertex; returns the triangle at that line, which
// is opposite its vertex 2. Every rim vertex sees the line along edges that were there, so that each convex corner is
// an ear (Toussaint and Avis, "On a convex hull algorithm for polygons and its application to triangulation problems",
// 1982): one pass with a stack does it, in linear time.
std::uint32_t Triangulation::fill(std::vector<Rim>& rim, std::size_t& used) {
  std::size_t top = 0;  // rim[0 .. top) is the stack
  for (std::size_t k = 0; k < rim.size(); ++k) {
    rim[top++] = rim[k];
    while (top >= 2) {
      const Rim one = rim[top - 2], two = rim[top - 1];
      if (!(orient2d(points_[one.from], points_[two.from], points_[two.to]) < 0)) break;
      const std::uint32_t t = cavity_[used++];
      triangles_[t] = {{one.from, two.to, one.to}, {none, none, none}};
      attach(t, 0, two);
      attach(t, 1, one);
      --top;
      rim[top - 1] = {one.from, two.to, t, false, false};
    }
  }
  return rim[0].outer;
}

// Joins edge i of the new triangle t to what lies beyond that part of the rim.
void Triangulation::attach(std::uint32_t t, std::size_t i, const Rim& rim) {
  std::uint32_t outer = rim.outer;
  if (rim.constrained) triangles_[t].constrained = static_cast<std::uint8_t>(triangles_[t].constrained | 1 << i);
  if (rim.is_seam) {
    std::uint32_t& seam = seams_[rim.outer];
    outer = seam;
    seam = t;
    if (outer == none) return;  // the other side comes later
  }
  triangles_[t].n[i] = outer;
  const auto& v = triangles_[outer].v;
  const auto ends = [&](std::uint32_t x) { return x == rim.from || x == rim.to; };
  triangles_[outer].n[!ends(v[0]) ? 0 : !ends(v[1]) ? 1 : 2] = t;
}

// Leads a piece along the left side of the passage that was found for it.
void Triangulation::divert(const Piece& piece) {
  ++diverted_;
  open_.clear();
  open_.push_back(piece.from);
  for (const Rim& r : left_) {  // there and back cancels
    if (open_.size() >= 2 && open_[open_.size() - 2] == r.to) {
      open_.pop_back();
    } else {
      open_.push_back(r.to);
    }
  }
  for (std::size_t k = 1; k < open_.size(); ++k) mark(find_edge(open_[k - 1], open_[k]), piece);
}

// A constraint is in the way: a vertex where they cross, and both in two pieces.
void Triangulation::cross(Piece piece, Edge blocked) {
  --crossings_left_;
  const Triangle& t = triangles_[blocked.t];
  const auto i = static_cast<std::size_t>(blocked.i);
  const std::uint32_t a = piece.from, b = piece.to, c = t.v[after[i]], d = t.v[before[i]];
  const std::uint32_t w = crossing_vertex(a, b, c, d, blocked.t);
  const auto once_more = static_cast<std::uint8_t>(piece.moved + 1);
  if (w == a || w == b) {
    pieces_.push_back({a, b, piece.constraint, piece.times, once_more});
  } else {
    // Only the way back counts as moved: ahead, a constraint may cross as many others as it likes.
    pieces_.push_back({w, b, piece.constraint, piece.times, piece.moved});
    pieces_.push_back({a, w, piece.constraint, piece.times, once_more});
  }
  if (w != c && w != d) release(c, d, w);
}

// The vertex where ab and cd cross: one that is there already when rounding is all the difference, so that lines
// through one point find one vertex, or a new one.
std::uint32_t Triangulation::crossing_vertex(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d,
                                             std::uint32_t near) {
  const Uv x = crossing_point(points_[a], points_[b], points_[c], points_[d]);
  const Location where = walk(x, near);
  const auto size = [](Uv p) { return std::max(std::abs(p.u), std::abs(p.v)); };
  const auto& corner = triangles_[where.t].v;
  double best = rounding * size(x);
  std::uint32_t w = none;
  for (std::uint32_t v : {a, b, c, d, corner[0], corner[1], corner[2]}) {
    if (v == none) continue;
    const double gap = std::max(std::abs(points_[v].u - x.u), std::abs(points_[v].v - x.v));
    if (gap < best || (gap == best && w == none)) best = gap, w = v;
  }
  return w != none ? w : add_crossing(x, where);
}

std::uint32_t Triangulation::add_crossing(Uv p, Location where) {
  const std::uint32_t w = new_point(p);
  if (where.on != 0 && is_constrained(where.t, where.edge())) {
    const Triangle& t = triangles_[where.t];
    const auto i = static_cast<std::size_t>(where.edge());
    edges_.split(t.v[after[i]], w, t.v[before[i]]);
  }
  add_vertex(w, where);
  note_star(where.t, nullptr);
  return w;
}

// Edge cd is no constraint any more; what ran along it has to go by w.
void Triangulation::release(std::uint32_t c, std::uint32_t d, std::uint32_t w) {
  const Edge edge = find_edge(c, d);
  if (edge.t == none) return;  // w lies exactly on it and has split it
  set_mark(edge, false);
  for (const EdgeTable::Use& use : edges_.release(c, d)) {
    if (use.times == 0) continue;
    const std::uint8_t moved = std::max<std::uint8_t>(use.moved, 1);
    const std::uint32_t lo = std::min(c, d), hi = std::max(c, d);
    pieces_.push_back({lo, w, use.constraint, use.times, moved});
    pieces_.push_back({w, hi, use.constraint, use.times, moved});
  }
  unsettled_.push_back(edge);
  settle_edges();
}

std::uint32_t Triangulation::split_constraint(std::uint32_t t, int edge, Uv p, std::vector<std::uint32_t>& touched) {
  touched.clear();
  if (!is_constrained(t, edge) || !is_finite(p) || points_.size() >= 0x80000000u) return none;
  auto i = static_cast<std::size_t>(edge);
  if (triangles_[t].v[i] == none) {  // from the real side of a hull edge
    const std::uint32_t u = triangles_[t].n[i];
    const auto& n = triangles_[u].n;
    i = n[0] == t ? 0 : n[1] == t ? 1 : 2;
    t = u;
  }
  const std::uint32_t u = triangles_[t].n[i];
  const auto& n = triangles_[u].n;
  const std::uint32_t c = triangles_[t].v[i], a = triangles_[t].v[after[i]], b = triangles_[t].v[before[i]];
  const std::uint32_t d = triangles_[u].v[n[0] == t ? 0 : n[1] == t ? 1 : 2];
  const auto faces_p = [&](std::uint32_t x, std::uint32_t y) {
    return x == none || y == none || orient2d(points_[x], points_[y], p) > 0;
  };
  if (!faces_p(b, c) || !faces_p(c, a) || !faces_p(a, d) || !faces_p(d, b)) return none;

  const bool dents_hull = d == none && orient2d(points_[a], points_[b], p) > 0;
  const std::uint32_t w = new_point(p);
  edges_.split(a, w, b);
  if (!dents_hull) {
    split_edge(t, static_cast<int>(i), w);
  } else {
    // Edge ab stays as hull edge; the sliver between it and the constraint is outside.
    set_mark({t, static_cast<int>(i)}, false);
    split_triangle(t, w);
    std::uint32_t sliver = t;  // wab, between wca and wbc
    while (triangles_[sliver].v[1] != a) sliver = triangles_[sliver].n[1];
    triangles_[sliver].inside = false;
    set_mark({sliver, 1}, true), set_mark({sliver, 2}, true);
  }
  settle_star(t);
  note_star(t, &touched);
  // Beside its line w may lie outside the circle of a triangle that was split, and then an edge at w has to go again.
  for (std::uint32_t around : touched) unsettled_.push_back({around, 2});
  settle_edges(&touched);
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  return w;
}

// Every vertex of a constraint's chain except its two ends.
void Triangulation::list_crossings(std::span<const Segment> constraints) {
  for (const EdgeTable::Entry& entry : edges_.entries()) {
    for (std::uint32_t k = entry.first; k != none; k = edges_.use(k).next) {
      const std::uint32_t c = edges_.use(k).constraint;
      const std::uint32_t a = merged_[constraints[c].a], b = merged_[constraints[c].b];
      for (std::uint32_t v : {entry.a, entry.b}) {
        if (v == a || v == b) continue;
        const Uv p = points_[v], from = points_[a], to = points_[b];
        const double du = to.u / 2 - from.u / 2, dv = to.v / 2 - from.v / 2;  // halves do not overflow
        const double fraction = std::abs(du) > std::abs(dv) ? (p.u / 2 - from.u / 2) / du : (p.v / 2 - from.v / 2) / dv;
        crossings_.push_back({v, c, fraction >= 0 ? std::min(fraction, 1.0) : 0});
      }
    }
  }
  const auto key = [](const Crossing& c) { return std::tuple(c.constraint, c.fraction, c.vertex); };
  std::sort(crossings_.begin(), crossings_.end(), [&](const auto& x, const auto& y) { return key(x) < key(y); });
  const auto same = [&](const auto& x, const auto& y) { return key(x) == key(y); };
  crossings_.erase(std::unique(crossings_.begin(), crossings_.end(), same), crossings_.end());
}

}  // namespace trimloop::mesh
