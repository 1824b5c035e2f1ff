#pragma once
// What curves and surfaces share when they are written as B-splines.

#include <vector>

#include "kernel/nurbs/curve.h"

namespace trimloop::io::step_export {

// Knots as Part 42 has them: distinct values and how often each stands.
struct ShortKnots {
  std::vector<double> values;
  std::vector<int> multiplicities;
};
ShortKnots short_knots(const std::vector<double>& full);

// Receivers take a closed spline whose end knots do not stand degree + 1 times for a periodic one: such are cut over
// their own domain.
inline bool is_clamped(int degree, const std::vector<double>& knots) {
  const auto p = static_cast<std::size_t>(degree);
  return knots.front() == knots[p] && knots.back() == knots[knots.size() - 1 - p];
}

// Cartesian pole; the direction of one that lies at infinity.
inline Point cartesian(const Hpoint& h) { return h.w != 0 ? project(h) : Point{h.x, h.y, h.z}; }

}  // namespace trimloop::io::step_export
