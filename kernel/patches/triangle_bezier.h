#pragma once
// Triangular Bézier patches, polynomial or rational (seed 001 §8.3; Farin 2002 ch. 17), and their exact forms as
// quadrilateral NURBS. Pole (i, j, k), i + j + k = degree, belongs to the Bernstein polynomial
// n!/(i! j! k!) a^i b^j c^k of the barycentric coordinates (a, b, c) of a point of the domain triangle.

#include <array>
#include <vector>

#include "kernel/nurbs/surface.h"

namespace trimloop {

struct Barycentric {
  double a = 1, b = 0, c = 0;  // sum 1; all >= 0 inside
};

class TriangleBezier {
 public:
  // Poles in the order of index(): from corner a (n,0,0) row by row, b before c. Premultiplied homogeneous.
  static Result<TriangleBezier> from_homogeneous(int degree, std::vector<Hpoint> poles);
  static Result<TriangleBezier> from_cartesian(int degree, std::span<const Point> points,
                                               std::span<const double> weights = {});
  int degree() const { return degree_; }
  bool is_rational() const { return rational_; }  // false when all weights are 1
  const std::vector<Hpoint>& poles() const { return poles_; }
  const Hpoint& pole(int i, int j, int k) const { return poles_[index(degree_, i, j, k)]; }
  // Row m = degree - i holds m + 1 poles, from (i, m, 0) to (i, 0, m).
  static std::size_t index(int degree, int i, int, int k) {
    const auto m = static_cast<std::size_t>(degree - i);
    return m * (m + 1) / 2 + static_cast<std::size_t>(k);
  }
  static std::size_t count(int degree) {
    return static_cast<std::size_t>(degree + 1) * static_cast<std::size_t>(degree + 2) / 2;
  }

 private:
  TriangleBezier() = default;
  int degree_ = 1;
  bool rational_ = false;
  std::vector<Hpoint> poles_;
};

// Polar form: one barycentric argument per degree, in any order. Bivariate de Casteljau with unequal arguments.
Hpoint blossom(const TriangleBezier&, std::span<const Barycentric> arguments);
Point evaluate(const TriangleBezier&, Barycentric);
// Derivatives with respect to b and to c (a = 1 - b - c), and their cross product's direction.
struct TriangleJet {
  Point point;
  Vector db, dc;
  Vector normal;  // unit; zero where the patch has none
};
TriangleJet jet(const TriangleBezier&, Barycentric);
TriangleBezier elevated(const TriangleBezier&);  // degree + 1, same patch
// The three patches around an inner point: (p,B,C), (A,p,C), (A,B,p).
std::array<TriangleBezier, 3> split(const TriangleBezier&, Barycentric at);
// The patch over another domain triangle, given by its corners in this one's coordinates.
TriangleBezier part(const TriangleBezier&, Barycentric a, Barycentric b, Barycentric c);

// Exact, bidegree (n, n): u from corner a (a whole side of the domain, collapsed to that pole) to the side b..c, v from
// b to c: a = 1 - u, b = u (1 - v), c = u v.
NurbsSurface to_collapsed_quad(const TriangleBezier&);
// Exact, three patches of bidegree (n, n) without a collapsed side: patch 0 between corner a, the middle of a b, the
// centroid and the middle of a c, its corner a at (0,0); the others in the cycle a -> b -> c.
std::array<NurbsSurface, 3> to_three_quads(const TriangleBezier&);

// Largest distance of corresponding points of side b..c of `first` from side c..b of `second`, and the largest angle
// (radians) between their normals there, at `samples` points: how two patches join (sampled).
struct TriangleJoint {
  double gap_mm = 0;
  double angle_rad = 0;
};
TriangleJoint joint_along_bc(const TriangleBezier& first, const TriangleBezier& second, int samples = 33);

}  // namespace trimloop
