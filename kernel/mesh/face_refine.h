#pragma once
// Inserts points into the triangulation of one face until each inside triangle is within the deflection and the angle.
//
// Distance is measured against the triangle through S at the three corners, in three steps of rising cost:
// the middles of the sides (shared with the neighbour) and the centroid; a quadratic through these, whose maximum is
// exact while the surface bends evenly; more points where the centroid contradicts the quadratic or knot lines cross
// the triangle. Works on the chart, so that the pieces of surface measured tile the face.

#include <array>
#include <stop_token>

#include "kernel/mesh/chart.h"
#include "kernel/mesh/face_boundary.h"

namespace trimloop::mesh {

struct RefineLimits {
  double deflection_mm = 0.1;
  double angle_rad = 0.35;
  std::size_t max_triangles = 5'000'000;
  std::stop_token stop;
};

struct SurfaceVertex {
  Uv uv;
  Point point;    // S(uv)
  Vector normal;  // Su x Sv, unit
  std::array<int, 2> span{};   // smooth span of the surface in u and v
  std::array<int, 2> cell{};   // of the chart
  PoleSide pole = PoleSide::None;
  int depth = 0;               // of halvings for the sake of folds and turns that led to it
};

class FaceRefiner {
 public:
  FaceRefiner(const Surface&, const Chart&, const FaceBoundary&, Triangulation&, const RefineLimits&);

  void run();

  const std::vector<SurfaceVertex>& vertices() const { return vertices_; }  // by triangulation vertex
  double deviation_mm() const { return deviation_; }   // estimated largest over the inside triangles
  bool limit_reached() const { return limit_reached_; }
  bool cancelled() const { return cancelled_; }

 private:
  struct Side {
    Point middle;
    bool known = false;
  };
  struct Entry {
    std::uint32_t triangle, stamp;
  };
  struct Finding {
    double deviation = 0;   // estimate for the triangle
    bool split = false;
    bool by_shape = false;  // for a fold or a turn, not for the distance
    Uv at;                  // chart place to insert when `split`
  };

  void add_vertices();
  SurfaceVertex surface_vertex(Uv uv, PoleSide) const;
  void enqueue(std::uint32_t triangle);
  bool insert(std::uint32_t triangle, const Finding&);
  Finding measure(std::uint32_t triangle);
  const Point& side_middle(std::uint32_t triangle, int side, Uv a, Uv b);
  void look_closer(const std::array<Uv, 3>& q, Point origin, Vector n, int points_per_side, Finding&) const;
  bool folds(const Triangulation::Triangle&, const std::array<Uv, 3>& q, const std::array<SurfaceVertex, 3>& corner,
             const std::array<Vector, 3>& bow, Vector n, Finding&) const;
  bool turns_too_far(const Triangulation::Triangle&, const std::array<Uv, 3>& q,
                     const std::array<SurfaceVertex, 3>& corner, Finding&) const;

  const Surface& surface_;
  const Chart& chart_;
  const FaceBoundary& boundary_;
  Triangulation& triangulation_;
  const RefineLimits& limits_;
  std::vector<double> breaks_u_, breaks_v_;
  std::vector<SurfaceVertex> vertices_;
  std::vector<std::array<Side, 3>> sides_;
  std::vector<std::uint32_t> stamp_;
  std::vector<double> deviation_of_;
  std::vector<Entry> queue_;
  std::vector<std::uint32_t> touched_;
  double deviation_ = 0;
  bool limit_reached_ = false, cancelled_ = false;
};

}  // namespace trimloop::mesh
