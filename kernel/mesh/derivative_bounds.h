#pragma once
// Enclosures of derivatives over a stretch of a curve or a rectangle of a surface: what turns a few evaluated points
// into a bound that holds everywhere between them (kernel/mesh/certificate.h).
//
// An enclosure is a ball: every value lies within `radius` of `centre`. B-splines: the differences of the Bézier poles of
// the piece, rational ones by Leibniz' rule on these. The other types: the value in the middle and the next derivative.

#include <array>
#include <memory>

#include "kernel/geometry/surface.h"

namespace trimloop::mesh {

struct Ball {
  Vector centre;
  double radius = 0;
};
inline double largest_norm(const Ball& b) { return norm(b.centre) + b.radius; }
// Largest |n . x| for x in the ball; `length` of n.
inline double largest_dot(Vector n, double length, const Ball& b) { return std::abs(dot(n, b.centre)) + length * b.radius; }
// A ball around both.
Ball around(const Ball&, const Ball&);

// The value and the first three derivatives.
using CurveBalls = std::array<Ball, 4>;

// Over [t.lo, t.hi], which must lie within one smooth piece (breaks()) of the curve. False where nothing is known:
// offset curves, weights that are not positive.
bool enclose(const Curve&, Interval t, CurveBalls& out);

struct HigherPartials {
  Ball uu, uv, vv, uuu, uuv, uvv, vvv;
};

// Second and third partial derivatives of one surface. Keeps what it has computed: one per thread.
class SurfaceBounds {
 public:
  struct Kind;  // of surface
  // `u`, `v`: the rectangle that will be asked about.
  SurfaceBounds(const Surface&, Interval u, Interval v);
  ~SurfaceBounds();
  SurfaceBounds(SurfaceBounds&&) noexcept;

  // False for surfaces of which nothing can be said: offsets, ruled by arc length.
  bool known() const;
  // Lines inside the rectangle, ascending. Creases: first derivatives jump there. Rough ones: second derivatives do, or
  // the third are out of all proportion; the first change by no more than `jump_u` (of Su) and `jump_v` (of Sv).
  struct Lines {
    std::vector<double> creases_u, creases_v, rough_u, rough_v;
    std::vector<double> joins_u, joins_v;  // of the rough ones, where the first derivatives of a rational surface's numerator and weight jump
    double jump_u = 0, jump_v = 0;
  };
  const Lines& lines() const;
  // Over a rectangle that no crease crosses (up to rounding); third derivatives mean nothing where a rough line does.
  // False where a weight is not positive.
  bool enclose(Interval u, Interval v, HigherPartials& out);

 private:
  std::unique_ptr<Kind> kind_;
};

}  // namespace trimloop::mesh
