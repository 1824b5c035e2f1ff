#pragma once
// Boundary representation: solids, shells, faces, loops, edges. ISO 10303-42 5 and 6.

#include <functional>
#include <map>
#include <set>

#include "formats/step/records/topology.h"
#include "io/step/geometry.h"
#include "kernel/heal/make_face.h"

namespace trimloop::io::step_import {

// Fills one body. An edge is one wherever the file names the same EDGE_CURVE, a vertex wherever the same VERTEX.
class BrepReader {
 public:
  using FaceAttributes = std::function<AttributesId(const Record& face, const std::string& name)>;

  BrepReader(Context& context, Geometry& geometry, Body& body, FaceAttributes attributes)
      : context_(context), geometry_(geometry), body_(body), attributes_(std::move(attributes)) {}

  void solid(const Record& instance);                                 // MANIFOLD_SOLID_BREP and its subtypes
  void shell(const Record& instance, bool turned, bool is_void);      // CLOSED_, OPEN_, ORIENTED_ shells; face sets
  FaceId face(const Record& instance);                                // always adds exactly one
  EdgeId edge(const Record& instance);                                // EDGE_CURVE on its own, of a wireframe

  // A face on a bounded surface of a geometric set: rectangular trimmed, curve bounded, a spline.
  FaceId surface_face(const Record& instance);

 private:
  struct EdgeUse {
    EdgeId id;             // none: cannot be used, said so
    bool flipped = false;  // our edge runs from the file's end to its start
    const Record* curve = nullptr;
    Interval whole;        // of the curve before it was cut to the edge
  };

  std::optional<heal::FaceInput> face_input(const Record& instance, step::FaceRecord& record);
  std::optional<heal::TrimLoop> loop(const Record& owner, const Record& instance, bool along, const Record* surface,
                                     const PlacedSurface& placed);
  std::optional<heal::TrimSegment> segment(const Record& instance, bool along, const Record* surface, const PlacedSurface& placed);
  void add_pcurve(const EdgeUse& use, const Record* surface, const PlacedSurface& placed, heal::TrimSegment& segment);
  EdgeUse edge_use(const Record& instance);
  EdgeUse make_edge(const Record& instance);
  std::optional<heal::TrimLoop> poly_loop(const Record& instance, bool along);
  VertexId vertex(const Record& owner, Ref ref);
  VertexId point_vertex(const Record& owner, Ref ref);
  std::optional<Plane> plane_through(const heal::TrimLoop& polygon) const;
  double farthest_corner(const heal::TrimLoop& polygon, const Plane& plane) const;
  template <class Visit>
  void each_point(const std::vector<heal::TrimLoop>& loops, Visit visit) const;
  void choose_part(const std::vector<heal::TrimLoop>& loops, PlacedSurface& placed) const;
  bool is_polygon(const Record& face, const step::FaceRecord& record);
  void turn_void(const Record& owner, ShellId id);
  FaceId add(const Record& instance, std::optional<heal::FaceInput> input, AttributesId attributes, const std::string& why);
  bool boundary_loop(const Record& owner, Ref ref, const PlacedSurface& placed, heal::TrimLoop& out);

  Context& context_;
  Geometry& geometry_;
  Body& body_;
  heal::SharedEdges shared_;
  std::set<FaceId> empty_;         // failed since they enclose no area: no part of a shell
  std::string replaced_plane_;     // of the face at hand: what was wrong with its own
  FaceAttributes attributes_;
  std::unordered_map<std::size_t, EdgeUse> edges_;
  std::unordered_map<std::size_t, VertexId> vertices_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, EdgeId> straight_;  // of POLY_LOOPs, by vertices
  std::unordered_map<std::size_t, FaceId> faces_;
};

// What healing did, as findings about the face and its loops.
void report_healing(Context& context, const Record& face, const heal::FaceInput& input, const heal::FaceOutcome& outcome);

}  // namespace trimloop::io::step_import
