#pragma once
// The squared distance from a point to a curve or surface as polynomials (not part of the public face).
//
// On a Bezier piece with homogeneous form (A, w), |A - w p|^2 = w^2 D, where D is the squared distance of p. With c an
// origin near the piece and A, p taken relative to it, the left side is A.A - 2 p.(w A) + |p|^2 w^2: three fixed
// polynomials of twice the degree in Bernstein form, whose combination for a given p is one linear pass. Their
// coefficients bound what they stand for: D >= T on the piece when all coefficients of w^2 (D - T) are >= 0.

#include <vector>

#include "kernel/batch/pieces.h"

namespace trimloop::closest {

// Coefficient (i, j), i along u, is at [i * (n + 1) + j]. Curves have n = 0.
struct SquaredDistance {
  struct Piece {
    Interval u, v;
    Point origin;
    double radius = 0;     // of the poles about the origin; infinite when a weight is not positive
    Box box;               // of the poles
    double weight_hi = 1;  // of w^2
  };
  static constexpr std::size_t group = 16;  // pieces that share a box

  int m = 2, n = 0;  // degrees: twice those of the shape
  bool rational = false;
  std::vector<Piece> pieces;
  std::vector<Box> groups;
  std::vector<double> numbers;  // of each piece: A.A, w A (x, y, z), and w^2 when rational
  double size = 0;              // largest coordinate of a pole: what rounding is relative to

  std::size_t count() const { return static_cast<std::size_t>((m + 1) * (n + 1)); }
  std::size_t arrays() const { return rational ? 5 : 4; }

  // w^2 D for the point, and w^2 when rational. Returns a bound of the rounding error of any of the former.
  double combine(std::size_t piece, Point p, double* product, double* weight) const;
};

SquaredDistance squared_distance(const SurfacePieces&);
SquaredDistance squared_distance(const CurvePieces&);

}  // namespace trimloop::closest
