#pragma once
// Topology of one body: vertices, edges, loops, faces and shells, each once.

#include "io/step/entity_writer.h"

namespace trimloop::io::step_export {

struct WrittenFace {
  InstanceId id;
  FaceId face;
};

// What a body became: representation items of their kinds, and the faces for styles and layers.
struct WrittenBody {
  std::vector<InstanceId> solids;    // MANIFOLD_SOLID_BREP, BREP_WITH_VOIDS
  std::vector<InstanceId> surfaces;  // SHELL_BASED_SURFACE_MODEL
  std::vector<InstanceId> curves;    // for a GEOMETRIC_CURVE_SET
  std::vector<InstanceId> shells;    // CLOSED_SHELL, OPEN_SHELL
  std::vector<WrittenFace> faces;
};
WrittenBody write_body(EntityWriter&, const Body&);

}  // namespace trimloop::io::step_export
