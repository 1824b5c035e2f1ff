#pragma once
// One face -> triangles: boundary, chart, seeds, constrained Delaunay triangulation, refinement, output.

#include <memory>

#include "kernel/mesh/certify.h"
#include "kernel/mesh/crossings.h"
#include "kernel/mesh/face_boundary.h"
#include "kernel/mesh/face_refine.h"
#include "kernel/mesh/tessellate.h"

namespace trimloop::mesh {

// A chord of an edge beside which the mesh is not within the deflection.
struct CoarseChord {
  EdgeId edge;
  std::uint32_t index = 0;
  double bound_mm = 0;  // what is known there
};

struct FaceResult {
  // Points at `own_point` and above are own_points[point - own_point].
  static constexpr std::uint32_t own_point = 0x80000000u;
  FaceMesh mesh;
  std::vector<Point> own_points;
  std::vector<EdgeCut> cuts;      // for edges whose chords cross others, or are too few
  std::vector<CoarseChord> coarse;
  std::unique_ptr<Certificate> certificate;  // for when the face is meshed again
  bool is_draft = false;                     // only good for what it asks for
};

// What one thread keeps from face to face for its memory, and its look at the stop token.
struct MeshingSpace {
  StopCheck stop;
  FaceBoundary boundary;
  Chart chart;
  std::vector<Uv> input;  // chart points: boundary, then seeds
  Triangulation triangulation;
  std::vector<std::uint32_t> face_vertex;
};

class FaceMesher {
 public:
  // `points`: of the edges.
  FaceMesher(const Body& body, std::span<const Point> points, const TessellationOptions& options, MeshingSpace& space)
      : body_(body), points_(points), options_(options), stop_(space.stop), boundary_(space.boundary), chart_(space.chart),
        input_(space.input), triangulation_(space.triangulation), face_vertex_(space.face_vertex) {}

  // `certificate`: of an earlier round, or null. The result is of no use when the stop check says that work was stopped.
  // `may_draft`: the face will be meshed again if the result is a draft.
  FaceResult mesh(FaceId, std::span<const SampledEdge>, std::unique_ptr<Certificate> certificate, bool may_draft);

 private:
  // `chart`: of the points in input_; null: they are surface parameters.
  bool triangulate(std::span<const SampledEdge>, const Chart* chart, FaceResult&);
  void report_crossings(std::span<const SampledEdge>, const Chart* chart, FaceResult&) const;
  void flat(const Plane&, bool reversed, std::span<const SampledEdge>, FaceResult&);
  void curved(const Surface&, bool reversed, std::span<const SampledEdge>, bool may_draft, FaceResult&);
  double strips(FaceCertifier&, Certificate&, std::span<const SampledEdge>, FaceResult&) const;
  void state_bound(double proven, double estimate, FaceMesh&) const;
  double boundary_gap(const FaceRefiner&) const;

  const Body& body_;
  std::span<const Point> points_;  // of the edges
  const TessellationOptions& options_;
  StopCheck& stop_;
  FaceBoundary& boundary_;
  Chart& chart_;
  std::vector<Uv>& input_;
  Triangulation& triangulation_;
  std::vector<std::uint32_t>& face_vertex_;
};

}  // namespace trimloop::mesh
