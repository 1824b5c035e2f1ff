#pragma once
// A bound, true for every point, on the distance of a piece of surface from a flat triangle.
//
// The piece is the image of a triangle D of the parameter plane. The six points of S at the corners and the middles of
// the sides of D fix a quadratic Q. What is left has two parts. Were the third derivative C the same everywhere, it would
// be the cubic sum a_ij l_i l_j (l_i - l_j) + b l_0 l_1 l_2 in barycentric coordinates l, a_ij = C[e_ij, e_ij, e_ij] / 12,
// b = a_12 + 3 a_01 - a_20 - C[e_01, e_01, e_02] / 2: at most 0.118 max |a_ij| + |b| / 27. C strays from a constant by
// balls of radii r, and this leaves (Ciarlet and Raviart, "General Lagrange and Hermite interpolation in R^n", 1972), with
// u_i(x) the distance in u from x to node i as a share of U, U x V being the box of D, v_i likewise, and L_i the quadratic
// Lagrange functions, at most
//   1/6 sum |L_i| (u_i^3 U^3 r_uuu + 3 u_i^2 v_i U^2 V r_uuv + 3 u_i v_i^2 U V^2 r_uvv + v_i^3 V^3 r_vvv);
// the sum of |L_i| u_i^3 is at most 0.1242 for any triangle, and so are the mixed ones (Hölder).
// Across the triangle's normal n the largest value of Q is a closed form.
// Along its plane Q stays within the hull of its six Bézier points; with the remainder across each side that gives the
// least barycentric coordinates of S, that is a slightly larger triangle, whose corners are the farthest away. (Or, where the
// sides bow less than the triangle is high, Q stays within 4/3 of the largest bow.)
// Then distance^2 <= (normal part)^2 + (part beyond the triangle in its plane)^2.
// Pieces that are wide and flat do better with the linear function through the corners, from which S strays by at most
// 1/8 (U^2 |n . Suu| + 2 U V |n . Suv| + V^2 |n . Svv|), for the mean square of u about its mean, with the barycentric
// coordinates as weights, is at most U^2 / 4; the smaller of both bounds counts.
// Of a facet's own piece more is known. Where it keeps its orientation, seen along n
// (see `lenses`), it fills what its side curves enclose, and only the lens between a chord and its curve lies beyond the facet. Turned about
// the chord into the neighbour's plane, if it has room there, a point of a lens of height o is away by
// at most h + o sin(angle) along n and o (1 - cos(angle)) across.
// A piece that lies across the common side of two triangles, within their other sides, is as near to them as it is to the
// farther of their planes, over the cosine of half the angle between them.
// Where second derivatives jump inside D, third ones say nothing. There Q has the corners of S and constant second
// derivatives, the centres of their balls (radii r), and what is left is at most 1/8 (U^2 r_uu + 2 U V r_uv + V^2 r_vv); a jump j of a
// first derivative across a line adds at most its width by j / 4.
// Q itself is interpolated by evaluated points: a rounding term is added.

#include <array>
#include <span>

#include "kernel/mesh/derivative_bounds.h"
#include "kernel/mesh/derivative_nets.h"

namespace trimloop::mesh {

namespace certificate_detail {
struct Lens;
}

// A triangle of the mesh.
struct Facet {
  std::array<Point, 3> corner;
  Vector normal;                   // unit; zero when it has no area to speak of
  std::array<Vector, 3> gradient;  // of the barycentric coordinates, within its plane
  double area = 0;                 // of the parallelogram
  double size = 0;                 // largest absolute coordinate: what rounding goes by

  Facet() = default;
  Facet(Point a, Point b, Point c);
  bool is_needle() const { return normal.x == 0 && normal.y == 0 && normal.z == 0; }
};
double distance(Point, const Facet&);

// a01 l_0 l_1 (l_0 - l_1) + a12 l_1 l_2 (l_1 - l_2) + a20 l_2 l_0 (l_2 - l_0) + bubble l_0 l_1 l_2
struct Cubic {
  double a01 = 0, a12 = 0, a20 = 0, bubble = 0;
};

// D with S at its corners and at the middles opposite to them.
struct SurfacePiece {
  std::array<Uv, 3> uv;
  std::array<Point, 3> corner, middle;
};

class Certificate {
 public:
  Certificate(const Surface&, Interval u, Interval v);

  bool proves() const { return bounds_.known(); }
  // Whether the rectangle it was made for holds this one.
  bool covers(Interval u, Interval v) const { return u_.lo <= u.lo && u.hi <= u_.hi && v_.lo <= v.lo && v.hi <= v_.hi; }
  // Whether a crease inside the box of D keeps `estimate` from speaking about it.
  bool crosses_crease(const std::array<Uv, 3>& uv) const;

  struct Estimate {
    double bound = infinity;             // holds everywhere on the piece
    double across = infinity;            // its part along the triangle's normal
    double likely = 0;                   // the largest distance of Q from the triangle's plane; Q goes through the
    bool is_measured = true;             // middles when this is set
    std::array<double, 3> at{};          // and where that is, barycentric
  };
  // One look at six points; no line may cross D.
  Estimate estimate(const SurfacePiece&, const Facet&);
  // Of a facet's own piece (corners alike) with the facet's neighbours across its sides (null: none), onto which S may stray.
  Estimate estimate(const SurfacePiece&, const Facet&, const std::array<const Facet*, 3>& neighbours);

  // Prepares `look_along`: spans are cut to about this size. Nothing but B-splines can be looked at so.
  void set_cells(Uv cell);
  // Of a facet's own piece too, by ranges of the derivatives along the facet's normal and plane (kernel/mesh/derivative_nets.h),
  // and halved for that at most `depth` times; infinite when it is not shown to be within `limit`.
  double look_along(const SurfacePiece&, const Facet&, const std::array<const Facet*, 3>& neighbours, double limit, int depth);

  // For a whole region of the parameter plane that is nearly flat, seen along n: how far the surface over it is from any triangulation
  // of it with corners on the surface. `border`: the straight pieces of its outline. Infinite when above `limit`.
  double flat_bound(Vector n, Point on_plane, std::span<const std::array<Uv, 2>> border, double limit);

  // For the strip as far as `width` on both sides of a straight line of the parameter plane: distance from the side of a facet
  // that ends at `place`, one for each end of the line, in either order.
  double beside_chord(const std::array<Uv, 2>& line, double width, const Facet&, const std::array<Point, 2>& place);

  // Pieces that `bound` has looked at so far.
  std::size_t pieces() const { return pieces_; }

  // The side of D to halve so that the remainder shrinks most.
  std::size_t hardest_side(const std::array<Uv, 3>& uv);

  // What a bound is wanted for: it is not made tighter once it is below `enough_mm` or below `tightness` times what
  // was measured on the way (0: nor once it is clear that `enough_mm` is out of reach); `depth` is how often a piece may be halved.
  struct Aim {
    double enough_mm = 0;
    double tightness = 1.05;
    int depth = 8;
  };
  // Cuts D at creases, and then into halves; each piece may lie near any of the facets (the triangle and its
  // neighbours).
  double bound(const std::array<Uv, 3>& uv, std::span<const Facet> facets, const Aim&);
  double bound(const SurfacePiece&, std::span<const Facet> facets, const Aim&);

 private:
  // What is left of S beside the quadratic: along any direction, and along one.
  struct Remainder {
    HigherPartials d;
    std::array<Uv, 2> edge;  // from corner 0 of D
    double uuu = 0, uuv = 0, uvv = 0, vvv = 0, all = infinity;
    double uu = 0, uv = 0, vv = 0, linear_all = infinity;  // the same beside the linear function of the corners
    double jumps = 0;                                      // of first derivatives, as distances
    bool is_second = false;                                // Q has constant second derivatives: third ones are not known
    Cubic cubic(Vector n) const;  // along n, were the third derivatives constant
    double along(Vector n) const;
    double linear_along(Vector n) const;
  };
  bool remainder(const std::array<Uv, 3>& uv, Remainder& out);
  static bool lenses(const SurfacePiece&, const Facet&, const Remainder&, std::array<certificate_detail::Lens, 3>& out);
  // No more than `across` is found when that is above `enough_mm`.
  static void estimate(const SurfacePiece&, const Facet&, const Remainder&, double enough_mm, Estimate&);
  static double hinge_bound(const SurfacePiece&, const Facet&, const Facet&, const Remainder&);
  double smooth_bound(const SurfacePiece&, std::span<const Facet> facets, const Aim&, int depth, double& seen);
  static void straighten(SurfacePiece&, const Remainder&);
  SurfacePiece piece(const std::array<Uv, 3>& uv) const;

  class Ranges;
  struct Rough {
    std::ptrdiff_t lines = 0, joins = 0;  // the second are some of the first
    double jumps = 0;
  };
  Rough rough(Interval u, Interval v) const;
  bool stays_within(const std::array<Uv, 3>& uv, const std::array<double, 3>& height, const Facet&, double limit, int depth, double& worst);

  const Surface& surface_;
  SurfaceBounds bounds_;
  std::unique_ptr<DerivativeNets> nets_;
  Interval u_, v_;
  std::size_t pieces_ = 0;
};

// Bound on the distance from the curve over [t.lo, t.hi] to the segment a-b, likewise; infinite where nothing is known.
double chord_bound(const Curve&, Interval t, Point a, Point b);

}  // namespace trimloop::mesh
