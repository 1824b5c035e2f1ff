#pragma once
// The neighbourhood of one face or vertex as a mesh of its own, for refining it alone (not part of the public face).

#include "kernel/subdivision/control_mesh.h"

namespace trimloop::subdivision::detail {

struct LocalMesh {
  ControlMesh mesh;
  Adjacency adjacency;
  std::uint32_t half = 0;  // the half-edge that says where: first side of the face, or first side that leaves the vertex
};

// The face of `half` and all faces around its corners. Corners that these corners do not see become points of their own,
// so that the neighbourhood is a disc whatever the mesh. Kept and rounded corners stay so.
Result<LocalMesh> around_face(const ControlMesh&, const Adjacency&, std::uint32_t half);
// The same for the faces around the vertex that `half` leaves; the vertex is an inner one.
Result<LocalMesh> around_vertex(const ControlMesh&, const Adjacency&, std::uint32_t half);

}  // namespace trimloop::subdivision::detail
