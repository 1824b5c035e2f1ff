#pragma once
// The edges of a body, sampled: each once, for all its faces, with one point per vertex; and sampled again where faces ask.

#include "kernel/mesh/face_mesher.h"

namespace trimloop::mesh {

class EdgeNet {
 public:
  // `body` outlives this.
  EdgeNet(const Body& body, const TessellationOptions&);

  std::size_t size() const { return edges_.size(); }
  // May run for different edges at the same time.
  void sample(std::size_t edge, StopCheck&);
  // Gives the samples their numbers in points(); once, when all edges are sampled.
  void number_points();

  std::span<const SampledEdge> edges() const { return edges_; }
  std::span<const Point> points() const { return points_; }
  std::size_t samples_around(FaceId) const;

  // Adds the samples that the faces just meshed ask for; returns the faces that must be meshed again, ascending.
  std::vector<std::size_t> refine(std::span<const FaceResult> all, std::span<const std::size_t> meshed);

  // Moves everything out.
  void release(BodyMesh&);

 private:
  // What came before a chord: the least bound of those it is a part of, and how often in a row cutting did not improve it.
  struct Ancestry {
    double bound_mm = infinity;
    int failures = 0;
  };
  struct NewSample {
    std::uint32_t edge;
    double t;
    Ancestry of;  // the chord it is to improve
    bool operator<(const NewSample& o) const { return edge != o.edge ? edge < o.edge : t < o.t; }
  };
  void cut_coarse(const CoarseChord&, std::vector<NewSample>& wanted) const;
  bool insert(std::uint32_t edge, std::span<const NewSample> wanted);
  std::uint32_t add_point(Point);

  const Body& body_;
  SampleBounds bounds_;
  double deflection_mm_;
  std::vector<SampledEdge> edges_;
  std::vector<std::vector<std::size_t>> faces_of_edge_;
  std::vector<std::vector<Ancestry>> ancestry_;  // by edge, by chord; empty: nothing came before
  std::vector<Point> points_;
};

}  // namespace trimloop::mesh
