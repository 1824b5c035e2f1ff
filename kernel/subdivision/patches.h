#pragma once
// What the limit surfaces of both schemes share (not part of the public face).

#include <algorithm>
#include <array>

#include "kernel/subdivision/limit_surface.h"

namespace trimloop::subdivision::detail {

// Bernstein poles of a square patch of degree n: (n + 1)^2 points, the first parameter's index first.
struct Square {
  int degree = 3;
  std::vector<Point> poles;
};

NurbsSurface to_surface(const Square&);  // over [0,1]^2
Square quarter(const Square&, bool upper_u, bool upper_v);
// Largest distance of corresponding poles: bounds the distance of corresponding points.
double difference(const Square&, const Square&);
// Largest distance from a point of one set to one of the other: bounds the distance of points of their hulls.
double spread(const std::vector<Point>&, const std::vector<Point>&);

// The uniform B-spline patch over [0,1]^2 whose poles are the (degree + 1)^2 control points; degree 2 or 3.
NurbsSurface uniform_patch(int degree, const std::vector<Point>& net);
Square bernstein(int degree, const std::vector<Point>& net);

// A patch of the limit with its irregular corner at (0,0) consists of rings of three regular quarters, (1,0), (1,1) and
// (0,1), ever smaller. `Corner` has
//   int degree; Result<Ring> descend();   the ring; the corner becomes its own quarter (0,0)
//   Square approximation() const;         equal to the neighbours' along shared sides
//   std::vector<Point> hull() const;      points whose hull holds the patch
using Ring = std::array<std::vector<Point>, 3>;

struct Levels {
  std::vector<Ring> rings;             // of levels 0, 1, ...
  std::vector<Square> approximations;  // what would stand at each level
  std::vector<Point> last_hull;        // of the quarter below the last ring
  int rounds = 0;                      // the first level within the tolerance, or the last one allowed
};

inline constexpr int rings_compared = 8;  // below them hulls are compared

// How far the approximation at a level may be from the limit: ring by ring, then hull against hull.
double cap_bound(const Levels&, int degree, std::size_t level);

template <class Corner>
Result<Levels> levels(Corner corner, const LimitOptions& options) {
  Levels out;
  for (int level = 0;; ++level) {
    out.approximations.push_back(corner.approximation());
    out.last_hull = corner.hull();
    out.rounds = std::max(0, level - rings_compared);
    if (level >= rings_compared && (out.rounds >= options.most_rounds ||
                                    cap_bound(out, corner.degree, static_cast<std::size_t>(out.rounds)) <= options.tolerance))
      return out;
    auto ring = corner.descend();
    if (!ring) return tl::unexpected(ring.error());
    out.rings.push_back(std::move(*ring));
  }
}

// Patches of all corners, each to the same number of rounds, so that shared sides stay the same curve.
struct CornerPatches {
  std::vector<Levels> corners;
  std::vector<std::uint32_t> from;  // control face or vertex of each
};
void add_corners(LimitSurface&, const CornerPatches&, int degree);

}  // namespace trimloop::subdivision::detail
