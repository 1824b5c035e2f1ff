#pragma once
// Topology of one body: vertices, edges, loops, faces and shells, each once.

#include "io/step/entity_writer.h"

namespace trimloop::io::step_export {

struct WrittenFace {
  InstanceId id;
  FaceId face;
};
struct WrittenEdge {
  InstanceId id;
  EdgeId edge;
};

struct WrittenShell {
  InstanceId id;
  ShellId shell;  // none: of a single face that was in no shell
};

// What a body became: representation items of their kinds, and the faces for styles and layers.
struct WrittenBody {
  std::vector<InstanceId> solids;    // MANIFOLD_SOLID_BREP, BREP_WITH_VOIDS
  std::vector<InstanceId> surfaces;  // SHELL_BASED_SURFACE_MODEL
  std::vector<InstanceId> curves;    // for a GEOMETRIC_CURVE_SET
  std::vector<WrittenShell> shells;  // CLOSED_SHELL, OPEN_SHELL
  std::vector<WrittenFace> faces;
  std::vector<WrittenEdge> edges;
};
WrittenBody write_body(EntityWriter&, const Body&);

}  // namespace trimloop::io::step_export
