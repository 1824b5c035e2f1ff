#pragma once
// Constrained Delaunay triangulation in the plane, standing alone: points and segments in, triangles out.
// Exact predicates, a ghost vertex at infinity, Hilbert insertion order, canonical tie-breaking by vertex id: the
// result is a function of the input only. Constraints may cross, touch and repeat; crossings become new vertices.
// Inside is decided by signed crossing counts (winding) so that the order of loops does not matter.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "kernel/math/vec.h"

namespace trimloop::mesh {

struct Segment {
  std::uint32_t a = 0, b = 0;
};
enum class Inside : std::uint8_t {
  Nonzero,   // winding number != 0
  Odd,       // odd number of crossings: orientation of loops is irrelevant
  Positive   // winding number > 0: outer loops counter-clockwise, holes clockwise
};

class Triangulation {
 public:
  static constexpr std::uint32_t none = 0xffffffffu;

  // Delaunay triangulation of `points` with `constraints` enforced; replaces the previous content, keeps its memory.
  // Equal points are merged (vertex_of gives the survivor). Fails only on non-finite input or over 2^31 points.
  Result<void> build(std::span<const Uv> points, std::span<const Segment> constraints);
  // Marks each triangle inside or outside by the rule; constraints bound. Call after build.
  void classify(Inside rule);

  const std::vector<Uv>& points() const { return points_; }             // input points, then crossing points
  std::uint32_t vertex_of(std::uint32_t input) const { return merged_[input]; }
  struct Crossing {                      // a vertex made where constraints crossed or touched
    std::uint32_t vertex;
    std::uint32_t constraint;            // index into the input constraints
    double fraction;                     // along that constraint
  };
  const std::vector<Crossing>& crossings() const { return crossings_; }

  // Inserts one more point into the triangle that holds it, keeping the constraints and restoring Delaunay by flips.
  // Returns its vertex, or `none` when it falls on an existing vertex, on a constraint, or outside.
  // `touched` receives the triangles that changed.
  std::uint32_t insert(Uv p, std::uint32_t near_triangle, std::vector<std::uint32_t>& touched);

  std::size_t triangle_count() const { return triangles_.size(); }      // ghosts and outside ones included
  struct Triangle {
    std::array<std::uint32_t, 3> v;      // counter-clockwise; one is `none` in a ghost
    std::array<std::uint32_t, 3> n;      // neighbour opposite each vertex
    std::uint8_t constrained = 0;        // bit i: edge opposite v[i] is a constraint
    bool inside = false;
  };
  const Triangle& triangle(std::uint32_t t) const { return triangles_[t]; }
  bool is_inside(std::uint32_t t) const { return triangles_[t].inside; }
  std::uint32_t locate(Uv p, std::uint32_t from) const;

  // Inside triangles in canonical order: by smallest vertex first, then lexicographic.
  std::vector<std::array<std::uint32_t, 3>> inside_triangles() const;

 private:
  std::vector<Uv> points_;
  std::vector<std::uint32_t> merged_;
  std::vector<Crossing> crossings_;
  std::vector<Triangle> triangles_;
  struct Scratch;
};

}  // namespace trimloop::mesh
