#pragma once
// Inserts points into the triangulation of one face until each inside triangle is within the deflection and the angle.
//
// Distance is sampled in three steps of rising cost: the middles of the sides (shared with the neighbour) and the centroid;
// a quadratic through these, whose maximum is exact while the surface bends evenly; more points where the centroid
// contradicts the quadratic or knot lines cross the triangle.
// Then, when asked for, each triangle is proven to be within the deflection (kernel/mesh/certificate.h), in two steps: the
// middles of the sides and what the third derivatives leave; then pieces of it, against its neighbours too. A proof that
// wants far more triangles or work than the samples did is given up.

#include <array>

#include "kernel/mesh/certificate.h"
#include "kernel/mesh/chart.h"
#include "kernel/mesh/face_boundary.h"

namespace trimloop::mesh {

struct RefineLimits {
  double deflection_mm = 0.1;
  double angle_rad = 0.35;
  std::size_t max_triangles = 5'000'000;
};

struct SurfaceVertex {
  Uv uv;
  Point point;    // S(uv)
  Point place;    // where the mesh has it: on the boundary, on the edge's curve
  Vector normal;  // Su x Sv, unit
  std::array<int, 2> span{};   // smooth span of the surface in u and v
  std::array<int, 2> cell{};   // of the chart
  PoleSide pole = PoleSide::None;
  int depth = 0;               // of halvings for the sake of folds and turns that led to it
};

class FaceRefiner {
 public:
  // `points`: those that the boundary names. `certificate`: of the boundary's box; none when nothing is to be proven.
  FaceRefiner(const Surface&, const Chart&, const FaceBoundary&, std::span<const Point> points, Triangulation&,
              const RefineLimits&, Certificate* certificate, StopCheck&);

  // Ends early when stopped; nothing may be asked of it then. With `is_draft` what lies along the boundary is proven first, and
  // nothing else when that wants more of a chord: the face will be meshed again.
  void run(bool is_draft);

  const std::vector<SurfaceVertex>& vertices() const { return vertices_; }  // by triangulation vertex
  // Largest distance over the inside triangles: a bound when it is proven, else an estimate.
  double deviation_mm() const { return deviation_; }
  bool is_proven() const { return is_proving_ && !unprovable_; }
  // Constrained sides of triangles that no point inside can mend.
  struct Coarse {
    std::uint32_t constraint;  // input
    double deviation_mm;       // of the triangle
  };
  const std::vector<Coarse>& coarse_constraints() const { return coarse_; }
  // The proof was begun and not ended: the triangulation holds points that were of no use.
  bool gave_up() const { return unprovable_; }
  // It was left at what lies along the boundary: deviation_mm() does not hold elsewhere.
  bool is_draft() const { return is_draft_; }
  bool limit_reached() const { return limit_reached_; }
  bool cancelled() const { return stop_.stopped(); }

 private:
  struct Side {
    Point middle;
    bool known = false;
  };
  enum class Part { All, Boundary, Rest };
  struct Entry {
    std::uint32_t triangle, stamp;
  };
  struct Finding {
    double deviation = 0;   // bound or estimate for the triangle
    double limit = 0;       // what it may be
    bool split = false;
    bool is_stuck = false;  // on a side of the boundary: its chord must be halved
    bool leans = false;     // proven with the help of the neighbours
    bool by_shape = false;  // for a fold or a turn, not for the distance
    Uv at;                  // where to insert when `split`
  };

  void work_off(Part);
  void collect_coarse();
  void add_vertex();
  Uv mean_extent() const;
  bool prove_flat();
  SurfaceVertex surface_vertex(Uv uv, PoleSide) const;
  void enqueue(std::uint32_t triangle, bool is_same);
  bool insert(std::uint32_t triangle, const Finding&);
  Finding measure(std::uint32_t triangle);
  struct Sides;
  void prove(std::uint32_t triangle, const std::array<SurfaceVertex, 3>& corner, const Facet&, const Sides&, Finding&);
  void prove_fan(const std::array<SurfaceVertex, 3>& corner, const Facet&, Finding&);
  void sample(const std::array<SurfaceVertex, 3>& corner, const Facet&, const Sides&, Finding&);
  Facet facet_of(std::uint32_t triangle) const;
  Uv half_way(Uv a, Uv b) const;
  const Point& side_middle(std::uint32_t triangle, int side, Uv a, Uv b);
  void look_closer(const std::array<SurfaceVertex, 3>& corner, const Facet&, int points_per_side, Finding&) const;
  bool folds(const Triangulation::Triangle&, const std::array<SurfaceVertex, 3>& corner, const Sides&, Vector n,
             Finding&) const;
  bool turns_too_far(const Triangulation::Triangle&, const std::array<SurfaceVertex, 3>& corner, Finding&) const;

  const Surface& surface_;
  const Chart& chart_;
  const FaceBoundary& boundary_;
  Triangulation& triangulation_;
  const RefineLimits& limits_;
  std::span<const Point> points_;
  Certificate* certificate_;
  StopCheck& stop_;
  std::vector<double> breaks_u_, breaks_v_;
  std::vector<SurfaceVertex> vertices_;
  std::vector<std::array<Side, 3>> sides_;
  std::vector<std::uint32_t> stamp_;
  struct Verdict {
    double deviation = 0;
    bool leans = false, over = false, known = false;
  };
  std::vector<Verdict> verdict_;
  std::vector<Coarse> coarse_;
  std::vector<Facet> facets_;
  std::vector<Entry> queue_;
  std::vector<std::uint32_t> touched_;
  double deviation_ = 0;
  std::size_t triangles_ = 0, most_triangles_ = 0, most_pieces_ = 0;
  double share_ = 1;  // of the deflection
  bool limit_reached_ = false, is_proving_ = false, unprovable_ = false, is_draft_ = false;
  Part part_ = Part::All;  // which triangles are measured
};

}  // namespace trimloop::mesh
