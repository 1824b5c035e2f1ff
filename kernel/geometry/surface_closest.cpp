// Nearest points of surfaces. The elementary ones in closed form; elsewhere the smooth patches are visited in the order
// of a lower bound of their distance, samples find the valleys of each, and Newton's method, held inside the patch,
// finds their bottoms. As every patch counts its own sides, a nearest point on the boundary or on a crease is found
// like any other.

#include <array>

#include "kernel/geometry/surface_descent.h"

namespace trimloop {
namespace {

using detail::foot_at;
using detail::keep_nearer;
using detail::Rectangle;

struct SearchPatch {
  double bound;  // of the distance, from below
  Interval u, v;
};

// Samples of a patch at the corners of nu x nv cells.
struct Grid {
  std::size_t rows, columns;
  std::vector<SurfaceFoot> at;
  Grid(const Surface& s, Point p, const SearchPatch& patch, int nu, int nv)
      : rows(static_cast<std::size_t>(nu) + 1), columns(static_cast<std::size_t>(nv) + 1) {
    at.reserve(rows * columns);
    for (int i = 0; i <= nu; ++i)
      for (int k = 0; k <= nv; ++k)
        at.push_back(foot_at(s, p, {patch.u.at(static_cast<double>(i) / nu), patch.v.at(static_cast<double>(k) / nv)}));
  }
  const SurfaceFoot& operator()(std::size_t i, std::size_t k) const { return at[i * columns + k]; }
  bool is_valley(std::size_t i, std::size_t k) const {
    for (std::size_t a = i == 0 ? 0 : i - 1; a <= std::min(i + 1, rows - 1); ++a)
      for (std::size_t b = k == 0 ? 0 : k - 1; b <= std::min(k + 1, columns - 1); ++b)
        if ((*this)(a, b).distance < (*this)(i, k).distance) return false;
    return true;
  }
};

// Where a descent may start, with an estimate from below of the distances around it.
struct Seed {
  double bound;
  Uv from;
};
void sort_and_cut(std::vector<Seed>& seeds, std::size_t most) {
  std::stable_sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) { return a.bound < b.bound; });
  if (seeds.size() > most) seeds.resize(most);
}

// A cell is taken for the ball about the mean of its corners, somewhat enlarged for its curvature.
Seed cell_seed(const Grid& grid, Point p, std::size_t i, std::size_t k) {
  const std::array<Point, 4> corners{grid(i, k).point, grid(i + 1, k).point, grid(i, k + 1).point,
                                     grid(i + 1, k + 1).point};
  const Point centre = midpoint(midpoint(corners[0], corners[3]), midpoint(corners[1], corners[2]));
  double radius = 0;
  for (const Point q : corners) radius = std::max(radius, distance(centre, q));
  return {distance(centre, p) - 1.25 * radius, 0.5 * (grid(i, k).uv + grid(i + 1, k + 1).uv)};
}
// A cell's side: of its points q, |q - p| >= (|a - p| + |b - p| - length) / 2.
Seed side_seed(const SurfaceFoot& a, const SurfaceFoot& b) {
  return {0.5 * (a.distance + b.distance - 1.25 * distance(a.point, b.point)), 0.5 * (a.uv + b.uv)};
}

// The valleys among the samples, then the cells, and the sides of cells on the patch's own sides, that can hold
// something nearer: a narrow valley may run between samples, and about a corner there may be one on either side.
void search_patch(const Surface& s, Point p, const SearchPatch& patch, int nu, int nv, SurfaceFoot& best) {
  const Grid grid(s, p, patch, nu, nv);
  std::vector<Seed> valleys, cells;
  for (std::size_t i = 0; i < grid.rows; ++i)
    for (std::size_t k = 0; k < grid.columns; ++k) {
      const SurfaceFoot& at = grid(i, k);
      const bool last_row = i + 1 == grid.rows, last_column = k + 1 == grid.columns;
      keep_nearer(best, at);
      if (grid.is_valley(i, k)) valleys.push_back({at.distance, at.uv});
      if (!last_row && !last_column) cells.push_back(cell_seed(grid, p, i, k));
      if (!last_row && (k == 0 || last_column)) cells.push_back(side_seed(at, grid(i + 1, k)));
      if (!last_column && (i == 0 || last_row)) cells.push_back(side_seed(at, grid(i, k + 1)));
    }
  sort_and_cut(valleys, 8);
  sort_and_cut(cells, 32);
  const Rectangle r{patch.u, patch.v};
  for (const Seed& valley : valleys) keep_nearer(best, detail::descend(s, p, valley.from, r, 50, false));
  for (const Seed& cell : cells) {
    if (cell.bound >= best.distance) break;
    keep_nearer(best, detail::descend(s, p, cell.from, r, 50, false));
  }
}

std::vector<double> cuts(std::vector<double> breaks, Interval part, double longest) {
  std::vector<double> out{part.lo};
  breaks.push_back(part.hi);
  for (double b : breaks) {
    b = std::min(b, part.hi);
    const double from = out.back();
    if (!(b > from)) continue;
    const int pieces = static_cast<int>(std::min(std::ceil((b - from) / longest), 64.0));
    for (int i = 1; i < pieces; ++i) out.push_back(from + (b - from) * i / pieces);
    out.push_back(b);
  }
  if (out.size() == 1) out.push_back(part.hi);
  return out;
}

// Lower bound of the distance by the poles of the patch that holds (u, v).
double pole_bound(const NurbsSurface& s, Point p, Uv middle) {
  const int ku = find_span(s.degree_u(), s.knots_u(), s.poles_u(), middle.u);
  const int kv = find_span(s.degree_v(), s.knots_v(), s.poles_v(), middle.v);
  Box box;
  for (int i = ku - s.degree_u(); i <= ku; ++i)
    for (int k = kv - s.degree_v(); k <= kv; ++k) {
      const Hpoint& h = s.pole(static_cast<std::size_t>(i), static_cast<std::size_t>(k));
      if (!(h.w > 0)) return 0;
      box.add(project(h));
    }
  return detail::distance(box, p);
}

SurfaceFoot search(const Surface& s, Point p, Interval u, Interval v) {
  const auto* nurbs = std::get_if<NurbsSurface>(&s.shape);
  const bool angle_u = std::holds_alternative<Revolution>(s.shape);
  const std::vector<double> at_u = cuts(breaks_u(s), u, angle_u ? pi / 2 : infinity),
                            at_v = cuts(breaks_v(s), v, infinity);
  const auto samples = [](int degree) { return degree == 1 ? 1 : std::min(degree + 1, 16); };
  int nu = nurbs ? samples(nurbs->degree_u()) : 6, nv = nurbs ? samples(nurbs->degree_v()) : 6;
  if (nurbs && nu == 1 && nv > 1) nu = 2;  // across a bilinear or ruled patch the distance may have two valleys
  if (nurbs && nv == 1 && nu > 1) nv = 2;
  std::vector<SearchPatch> patches;
  for (std::size_t i = 0; i + 1 < at_u.size(); ++i)
    for (std::size_t k = 0; k + 1 < at_v.size(); ++k) {
      const SearchPatch patch{0, {at_u[i], at_u[i + 1]}, {at_v[k], at_v[k + 1]}};
      patches.push_back(patch);
      if (nurbs) patches.back().bound = pole_bound(*nurbs, p, {patch.u.mid(), patch.v.mid()});
    }
  std::stable_sort(patches.begin(), patches.end(),
                   [](const SearchPatch& a, const SearchPatch& b) { return a.bound < b.bound; });
  SurfaceFoot best = foot_at(s, p, {u.lo, v.lo});
  for (const SearchPatch& patch : patches) {
    if (patch.bound >= best.distance) break;
    search_patch(s, p, patch, nu, nv, best);
  }
  return best;
}

// The part of an unbounded extrusion that can hold the nearest point: where p and the directrix lie along its
// direction.
Interval bounded_v(const Extrusion& e, Point p, Interval u, Interval v) {
  if (v.is_bounded() || !e.directrix) return v;
  const double length2 = dot(e.direction, e.direction);
  Interval reach{infinity, -infinity};
  const Box box = bounding_box(with_range(*e.directrix, u));
  for (int corner = 0; corner < 8 && length2 > 0 && !box.empty(); ++corner) {
    const Point q{corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y, corner & 4 ? box.hi.z : box.lo.z};
    const double at = dot(p - q, e.direction) / length2;
    reach = {std::min(reach.lo, at), std::max(reach.hi, at)};
  }
  if (!reach.is_bounded()) reach = {0, 0};
  return {v.clamp(reach.lo), v.clamp(reach.hi)};
}

}  // namespace

SurfaceFoot closest_point(const Surface& s, Point p, std::optional<Interval> u, std::optional<Interval> v) {
  const Rectangle r = detail::rectangle(s);
  const Interval in_u = u.value_or(r.u);
  Interval in_v = v.value_or(r.v);
  if (const auto foot = detail::closest_elementary(s, p, in_u, in_v)) return *foot;
  if (const auto* e = std::get_if<Extrusion>(&s.shape)) in_v = bounded_v(*e, p, in_u, in_v);
  if (!in_u.is_bounded() || !in_v.is_bounded()) return foot_at(s, p, {in_u.clamp(0), in_v.clamp(0)});
  return search(s, p, in_u, in_v);
}

SurfaceFoot closest_point_near(const Surface& s, Point p, Uv start) {
  if (const auto foot = detail::closest_elementary_near(s, p, start)) return *foot;
  const Rectangle r = detail::rectangle(s);
  return detail::descend(s, p, detail::off_singular_side(s, p, start, r), r, 20, true);
}

}  // namespace trimloop
