#pragma once
// Polynomials in Bernstein form over [0, 1]^2 with a bound of their rounding errors (not part of the public face).

#include <array>
#include <span>
#include <vector>

#include "kernel/nurbs/curve.h"

namespace trimloop::bounds {

constexpr double eps = std::numeric_limits<double>::epsilon();

// Coefficient (i, j), i along u, at [i * (n + 1) + j]; each is off by at most `error`. Curves have n = 0.
struct Polynomial {
  int m = 0, n = 0;
  std::vector<double> c;
  double error = 0;

  double lowest() const;   // the polynomial is nowhere less, nor
  double highest() const;  // more
  double magnitude() const;
};

Polynomial operator*(const Polynomial&, const Polynomial&);
Polynomial operator*(double, const Polynomial&);
// Of like degrees.
Polynomial operator+(const Polynomial&, const Polynomial&);
Polynomial operator-(const Polynomial&, const Polynomial&);
Polynomial along_u(const Polynomial&);  // derivative; zero of degree 0 where there is none
Polynomial along_v(const Polynomial&);

using Vector3 = std::array<Polynomial, 3>;
Vector3 operator*(const Polynomial&, const Vector3&);
Vector3 operator*(double, const Vector3&);
Vector3 operator-(const Vector3&, const Vector3&);
Vector3 cross(const Vector3&, const Vector3&);
Vector3 along_u(const Vector3&);
Vector3 along_v(const Vector3&);
// At most the length of the vector anywhere.
double largest_length(const Vector3&);

// A piece in homogeneous form about an origin near it.
struct Homogeneous {
  Vector3 a;
  Polynomial w;
  Point origin;
};
// Poles (i, j), i along u, at [j * (p + 1) + i]. Their own rounding errors, from the cutting into pieces, are part of
// `error`.
Homogeneous homogeneous(std::span<const Hpoint> poles, int p, int q);

}  // namespace trimloop::bounds
