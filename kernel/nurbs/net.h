#pragma once
// The exact operations on knots, once for curves and surfaces: a spline in one direction whose "poles" are rows of
// `width` points (not part of the public face). Only convex combinations are formed, so that no knot vector, however
// uneven, costs digits; combinations of equal points give that point's bits.

#include <span>
#include <vector>

#include "kernel/nurbs/curve.h"

namespace trimloop::detail {

struct Net {
  int degree = 1;
  std::size_t width = 1;
  std::vector<double> knots;
  std::vector<Hpoint> poles;  // row i is poles[i * width] ..

  std::size_t p() const { return static_cast<std::size_t>(degree); }
  std::size_t rows() const { return knots.size() - p() - 1; }
  Interval domain() const { return {knots[p()], knots[rows()]}; }
};

// What may be inserted of `wanted` (in any order): knots of the domain, up to multiplicity degree. Ascending.
std::vector<double> insertable(const Net&, std::span<const double> wanted);

// Same shape over the knots and `added`, which must be as insertable() returns it. A5.4.
Net refined(const Net&, std::span<const double> added);

// The part over `range`, lo < hi inside the domain, with end knots of multiplicity degree + 1.
Net part(const Net&, Interval range);

// Degree + 1 over the whole domain, clamped; each inner knot's multiplicity grows by one.
Net elevated(const Net&);

// Rows and knots mirrored about the middle of the domain, whose ends keep their bits.
Net reversed(Net);

double mirrored(Interval domain, double t);

}  // namespace trimloop::detail
