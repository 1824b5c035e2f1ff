#pragma once
// What the sources of fitting share (not part of the public face).

#include "kernel/nurbs/fit.h"

namespace trimloop::detail {

// Distinct consecutive points; place[i] is where given point i went.
struct Distinct {
  std::vector<Point> points;
  std::vector<std::size_t> place;
};
Result<Distinct> distinct(std::span<const Point>);

// Clamped knots over [0, 1] by averaging degree consecutive parameters (eq. 9.8); a derivative counts as a parameter
// once more, so the list may repeat values.
std::vector<double> averaged_knots(std::span<const double> parameters, int degree);

// Largest distance of the points from the curve at their parameters, with the rounding of the evaluation.
double error_at(const NurbsCurve&, std::span<const Point>, std::span<const double> parameters);

// The conditions of interpolation along one direction: row i asks for derivative order[i] at parameter[i].
struct Conditions {
  std::vector<double> parameters;
  std::vector<int> orders;
};
// Poles over the knots that meet them; right[i * width] .. is the row wanted. False when the system is singular.
bool collocate(int degree, std::span<const double> knots, const Conditions&, std::vector<Hpoint>& right,
               std::size_t width);

// Tangent estimates from five points (eq. 9.29 - 9.33), not normalised; zero where neighbours give none.
std::vector<Vector> estimated_tangents(std::span<const Point>);

}  // namespace trimloop::detail
