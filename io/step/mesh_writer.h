#pragma once
// Polygon meshes -> TESSELLATED_SOLID, TESSELLATED_SHELL and TESSELLATED_WIRE of AP242 (ISO 10303-42:2014, tessellated
// shapes), with links to the body and the faces that they stand for.

#include "io/step/body_writer.h"
#include "kernel/topology/polygon_mesh.h"

namespace trimloop::io::step_export {

struct WrittenMeshFace {
  InstanceId id;
  AttributesId attributes;
};
struct WrittenMesh {
  InstanceId id;
  std::vector<WrittenMeshFace> faces;
};
// At `scale` (negative: mirrored through the origin as well). `body` is what its body became, or null.
WrittenMesh write_mesh(EntityWriter&, const PolygonMesh&, double scale, const WrittenBody* body);

}  // namespace trimloop::io::step_export
