#pragma once
// Chart: the plane in which a face is triangulated.
//
// A Delaunay triangulation is good where the plane is isotropic, that is where the admissible step (the longest chord
// within the deflection and the angle) is the same in both directions. The chart stretches u and v each by its own
// monotone piecewise-linear function so that this holds as well as a product of two functions can make it hold;
// a common factor of both is free, so a sphere gets Mercator's map. Local steps are about 1 in chart units.

#include <vector>

#include "kernel/geometry/surface.h"

namespace trimloop::mesh {

// Longest admissible steps along u and v at one place, as parameter lengths; infinite where nothing curves.
struct Steps {
  double u = infinity, v = infinity;
  double length_u = 0, length_v = 0;  // |Su|, |Sv|
  bool elliptic = false;              // what bounds the steps is alike in all directions
  bool valid = false;                 // false where the surface has no normal
};
Steps admissible_steps(const SurfaceJet&, double deflection_mm, double angle_rad);

// Monotone piecewise-linear function through (from[i], to[i]); continued beyond its ends.
struct PiecewiseLinear {
  std::vector<double> from, to;
  double at(double x) const { return map(from, to, x); }
  double inverse(double y) const { return map(to, from, y); }

 private:
  static double map(const std::vector<double>& a, const std::vector<double>& b, double x);
};

struct Chart {
  PiecewiseLinear u, v;            // parameter -> chart coordinate
  std::vector<Steps> steps;        // cell (i, j) between u.from[i], u.from[i + 1] and v.from[j], v.from[j + 1] at i * cells_v + j
  bool curved = false;             // false: no cell asks for any step

  std::size_t cells_u() const { return u.from.size() - 1; }
  std::size_t cells_v() const { return v.from.size() - 1; }
  const Steps& cell(std::size_t i, std::size_t j) const { return steps[i * cells_v() + j]; }
  Uv to_chart(Uv p) const { return {u.at(p.u), v.at(p.v)}; }
  Uv to_uv(Uv q) const { return {u.inverse(q.u), v.inverse(q.v)}; }
};

// `size_mm`: of the face; no step is longer.
Chart make_chart(const Surface&, Interval u, Interval v, double size_mm, double deflection_mm, double angle_rad);

}  // namespace trimloop::mesh
