#pragma once
// The schemes themselves, each in its own file (not part of the public face). The mesh and its adjacency are sound.

#include "kernel/subdivision/control_mesh.h"

namespace trimloop::subdivision::detail {

ControlMesh catmull_clark(const ControlMesh&, const Adjacency&);
ControlMesh doo_sabin(const ControlMesh&, const Adjacency&, bool midpoint_rule);
ControlMesh mid_edge(const ControlMesh&, const Adjacency&);
ControlMesh loop(const ControlMesh&, const Adjacency&);
ControlMesh butterfly(const ControlMesh&, const Adjacency&);
ControlMesh sqrt3(const ControlMesh&, const Adjacency&, int round);

// A sum of multiples of points, divided once at the end, so that whole-number weights stay exact.
struct Mean {
  Vector sum;
  double weight = 0;
  void add(double w, Point p) {
    sum += w * to_vector(p);
    weight += w;
  }
  Point point() const { return to_point(sum / weight); }
};

Point face_centre(const ControlMesh&, std::size_t face);
Point edge_middle(const ControlMesh&, const Adjacency&, std::uint32_t edge);

// Sharpness of each edge for this round: borders are infinitely sharp.
double sharpness(const Adjacency&, std::uint32_t edge);

// How a vertex of Catmull-Clark or Loop moves. With two sharp edges it stays on their curve, with more it stays; between
// two rules when the sharpness is below one (DeRose, Kass and Truong 1998, §3). `smooth` is the scheme's own position.
Point crease_vertex(const ControlMesh&, const Adjacency&, std::uint32_t vertex, Point smooth);

// Creases of the two halves of each sharp edge; `edge_point` gives the new point on an edge.
std::vector<Crease> halved_creases(const ControlMesh&, const Adjacency&, const std::vector<std::uint32_t>& vertex_point,
                                   const std::vector<std::uint32_t>& edge_point);

// Four triangles for one: Loop and Butterfly. New vertices come first, then one per edge.
ControlMesh split_triangles(const ControlMesh&, const Adjacency&, std::vector<Point> vertex_points,
                            const std::vector<Point>& edge_points);

}  // namespace trimloop::subdivision::detail
