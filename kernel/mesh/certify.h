#pragma once
// Bounds for a mesh that exists, whoever made it: how far the face may lie from each of its triangles.
//
// The triangles of a face, taken in its parameter plane, cover the polygon of its boundary samples; what lies between that
// polygon and the parameter curves is covered by strips that enclose the curves' bows. Each piece is bounded against
// its triangle and, where it drifts sideways, against the neighbours (kernel/mesh/certificate.h).

#include "kernel/mesh/certificate.h"
#include "kernel/mesh/face_boundary.h"
#include "kernel/mesh/mesh.h"

namespace trimloop::mesh {

struct FaceBounds {
  BoundKind kind = BoundKind::Sampled;  // Sampled: the surface is of a kind of which nothing can be said; no figures then
  std::vector<double> triangle;         // one per triangle
  double beside_chords = 0;             // of the strips along the boundary
  double largest() const;
};

std::vector<FaceBounds> certify(const Body&, const BodyMesh&, const Certificate::Aim&);

struct Pole {
  Point point;
  PoleSide side;
};
std::vector<Pole> poles_of(const Body&, const Face&);

// The same for one face while it is made. `place`: of each of the face's vertices.
class FaceCertifier {
 public:
  FaceCertifier(const Body& body, const FaceMesh& face, std::span<const Point> place, const Certificate::Aim& aim)
      : body_(body), face_(face), place_(place), aim_(aim), poles_(poles_of(body, body[face.face])) {}

  // One bound per triangle.
  std::vector<double> triangles(Certificate&);
  // The largest of those of some triangles and of the neighbours across their sides.
  double around(Certificate&, std::span<const std::uint32_t> changed);
  // For the strip between one chord of a coedge's edge, from t.lo to t.hi of the edge, and the parameter curve; `a` and
  // `b` are the chord's ends among the mesh's points. Zero where the curve is straight.
  double strip(Certificate&, const Coedge&, Interval t, std::uint32_t a, std::uint32_t b);

 private:
  double triangle(Certificate&, std::uint32_t);
  Facet facet(std::uint32_t triangle) const;
  void index_sides();
  template <class Take>
  void at_side(std::uint32_t a, std::uint32_t b, Take take);

  const Body& body_;
  const FaceMesh& face_;
  std::span<const Point> place_;
  Certificate::Aim aim_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> sides_;  // (ends, triangle), sorted
  std::vector<Facet> facets_;
  std::vector<Pole> poles_;
};

// What a fan triangle at a pole stands for: the part of the parameter plane between side b-c and the pole's side.
std::array<std::array<Uv, 3>, 2> fan_pieces(Uv apex, PoleSide, Uv b, Uv c);

}  // namespace trimloop::mesh
