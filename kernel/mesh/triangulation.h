#pragma once
// Constrained Delaunay triangulation in the plane, standing alone: points and segments in, triangles out.
// Exact predicates, a ghost vertex at infinity, Hilbert insertion order. Of cocircular points the one that is smallest
// by (u, v) gets the diagonals, so that the triangles are a function of the set of points and constraints, not of their
// order. Constraints may cross, touch and repeat; crossings become new vertices.
// Inside is decided by signed crossing counts (winding) so that the order of loops does not matter.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "kernel/math/vec.h"
#include "kernel/mesh/edge_table.h"
#include "kernel/mesh/stop_check.h"

namespace trimloop::mesh {

struct Segment {
  std::uint32_t a = 0, b = 0;
};
enum class Inside : std::uint8_t {
  Nonzero,  // winding number != 0
  Odd,      // odd number of crossings: orientation of loops is irrelevant
  Positive  // winding number > 0: outer loops counter-clockwise, holes clockwise
};

class Triangulation {
 public:
  static constexpr std::uint32_t none = 0xffffffffu;

  // Delaunay triangulation of `points` with `constraints` enforced; replaces the previous content, keeps its memory.
  // Equal points are merged (vertex_of gives the survivor, the one with the smallest index). No triangles when all
  // points are collinear or fewer than three are distinct. Fails only on non-finite points, on a constraint that names
  // a point which is not there, over 2^31 points, and when stopped; then nothing is left. The spans may not lie in this object.
  Result<void> build(std::span<const Uv> points, std::span<const Segment> constraints, StopCheck* = nullptr);
  // Marks each triangle inside or outside by the rule; constraints bound. Call after build.
  void classify(Inside rule);

  const std::vector<Uv>& points() const { return points_; }  // input points, then new ones
  std::uint32_t vertex_of(std::uint32_t input) const { return merged_[input]; }
  struct Crossing {            // a vertex strictly between the ends of a constraint: where it crossed or
    std::uint32_t vertex;      // touched another one, or a point that lies on it
    std::uint32_t constraint;  // index into the input constraints
    double fraction;           // along that constraint, 0..1, rounded
  };
  // By constraint, then along it.
  const std::vector<Crossing>& crossings() const { return crossings_; }
  // Pieces of constraints that were led along existing edges beside the straight way because crossing after crossing
  // fell between representable points. 0 but for hostile input.
  std::size_t diverted() const { return diverted_; }

  // Inserts one more point into the triangle that holds it, keeping the constraints and restoring Delaunay by flips.
  // Returns its vertex, or `none` when it falls on an existing vertex, on a constraint, or outside (of the hull; after
  // classify, of the region).
  // `touched` receives the triangles that changed: exactly those around the new vertex.
  std::uint32_t insert(Uv p, std::uint32_t near_triangle, std::vector<std::uint32_t>& touched);
  // Splits the constrained edge opposite vertex i of triangle t at p, which need not lie exactly on it (a rounded
  // midpoint does not). Both halves are constrained and the regions keep their sides.
  // Returns the new vertex, or `none`, with nothing changed, when p is too far off to keep every triangle positive.
  // `touched` receives the triangles that changed.
  std::uint32_t split_constraint(std::uint32_t t, int i, Uv p, std::vector<std::uint32_t>& touched);

  std::size_t triangle_count() const { return triangles_.size(); }  // ghosts and outside ones included
  struct alignas(32) Triangle {
    std::array<std::uint32_t, 3> v;  // counter-clockwise; one is `none` in a ghost
    std::array<std::uint32_t, 3> n;  // neighbour opposite each vertex
    std::uint8_t constrained = 0;    // bit i: edge opposite v[i] is a constraint
    bool inside = false;
    int bit(std::size_t i) const { return constrained >> i & 1; }
  };
  const Triangle& triangle(std::uint32_t t) const { return triangles_[t]; }
  bool is_inside(std::uint32_t t) const { return triangles_[t].inside; }
  bool is_ghost(std::uint32_t t) const { return index_of(t, none) >= 0; }
  bool is_constrained(std::uint32_t t, int i) const { return (triangles_[t].constrained >> i & 1) != 0; }
  // The index of v in t, or -1.
  int index_of(std::uint32_t t, std::uint32_t v) const {
    const auto& c = triangles_[t].v;
    return c[0] == v ? 0 : c[1] == v ? 1 : c[2] == v ? 2 : -1;
  }
  // A triangle, or ghost, that holds p in its inside or on its border; a ghost holds what lies strictly beyond its hull
  // edge. `from` is where the walk starts; near is fast. `none` when there are no triangles.
  std::uint32_t locate(Uv p, std::uint32_t from) const;

  // A triangle at a vertex; `none` for a vertex that was merged away or when there are no triangles.
  std::uint32_t triangle_at(std::uint32_t vertex) const { return at_vertex_[vertex]; }
  // The next triangle counter-clockwise around a vertex of t.
  std::uint32_t next_around(std::uint32_t t, std::uint32_t vertex) const {
    return triangles_[t].n[static_cast<std::size_t>((index_of(t, vertex) + 1) % 3)];
  }
  struct Edge {
    std::uint32_t t = none;  // with v[i+1] == a and v[i+2] == b: t lies to the left of a -> b
    int i = 0;
  };
  Edge find_edge(std::uint32_t a, std::uint32_t b) const;
  // What runs along every constrained edge.
  const EdgeTable& constrained_edges() const { return edges_; }
  // The smallest input constraint that runs along a constrained edge, or `none`.
  std::uint32_t constraint_of(std::uint32_t t, int i) const;

  // Inside triangles in canonical order: by smallest vertex first, then lexicographic. Fewer when stopped.
  std::vector<std::array<std::uint32_t, 3>> inside_triangles(StopCheck* = nullptr) const;

 private:
  struct Location {
    std::uint32_t t;
    int on;                                                     // bit i: exactly on the edge opposite v[i]
    int edge() const { return on == 1 ? 0 : on == 2 ? 1 : 2; }  // when on one
    int vertex() const { return on == 6 ? 0 : on == 5 ? 1 : on == 3 ? 2 : -1; }  // on two: at their common end
  };
  struct Piece {  // of a constraint, waiting to become an edge
    std::uint32_t from, to, constraint;
    std::int32_t times;  // runs as the constraint does, so often; negative: against it
    std::uint8_t moved;  // how often rounding has moved it
  };
  struct Rim {  // edge of a cavity, which lies to its right
    std::uint32_t from, to;
    std::uint32_t outer;  // triangle on the other side; or, where the cavity is on both sides, a seam
    bool constrained, is_seam;
  };

  // triangulation.cpp: points
  bool insert_all(StopCheck&);
  void merge_collinear();
  void start(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void renumber(std::span<const Uv> points);
  Location walk(Uv p, std::uint32_t from) const;
  Location scan(Uv p) const;
  void add_vertex(std::uint32_t p, Location where);
  void split_triangle(std::uint32_t t, std::uint32_t p);
  void split_edge(std::uint32_t t, int edge, std::uint32_t p);
  void relink(std::uint32_t t, std::uint32_t from, std::uint32_t to);
  bool wants_flip(std::uint32_t p, std::uint32_t a, std::uint32_t b, std::uint32_t q) const;
  void flip(std::uint32_t t, std::uint32_t u, std::size_t j);
  void settle_star(std::uint32_t t);
  void note_star(std::uint32_t t, std::vector<std::uint32_t>* touched);
  void settle_edges(std::vector<std::uint32_t>* touched = nullptr);
  void rotate(std::uint32_t t, std::size_t i);
  std::uint32_t new_point(Uv p);
  Edge find_edge(std::uint32_t a, std::uint32_t b, bool& b_is_smaller) const;

  // triangulation_constraints.cpp
  struct Exit {
    Edge edge;
    bool is_along;
  };
  struct Passage {
    std::uint32_t end;  // vertex reached; or none, and
    Edge blocked;       // the constraint in the way
  };
  bool enforce_all(std::span<const Segment> constraints, StopCheck&);
  void enforce(Piece piece);
  void mark(Edge edge, const Piece& piece);
  void set_mark(Edge edge, bool on);
  Exit leave(std::uint32_t a, std::uint32_t b) const;
  Passage march(std::uint32_t a, std::uint32_t b, Edge edge, bool stop_at_constraints);
  void carve();
  std::uint32_t fill(std::vector<Rim>& rim, std::size_t& used);
  void attach(std::uint32_t t, std::size_t i, const Rim& rim);
  void divert(const Piece& piece);
  void cross(Piece piece, Edge blocked);
  std::uint32_t crossing_vertex(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, std::uint32_t near);
  std::uint32_t add_crossing(Uv p, Location where);
  void release(std::uint32_t c, std::uint32_t d, std::uint32_t w);
  void list_crossings(std::span<const Segment> constraints);

  std::vector<Uv> points_;
  std::vector<std::uint32_t> merged_;
  std::vector<Crossing> crossings_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> at_vertex_;
  EdgeTable edges_;
  std::size_t diverted_ = 0, crossings_left_ = 0, detour_left_ = 0;
  bool is_classified_ = false;

  // Scratch, kept for its memory.
  std::vector<std::uint64_t> keys_, more_keys_;
  std::vector<std::uint32_t> order_, cavity_, seams_, open_;
  std::vector<Edge> unsettled_;
  std::vector<Piece> pieces_;
  std::vector<Rim> left_, right_;
  std::vector<std::int32_t> winding_;
};

}  // namespace trimloop::mesh
