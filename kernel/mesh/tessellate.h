#pragma once
// Body -> triangles within a chord and an angle bound. Each edge is sampled once; the loops are triangulated in
// parameter space (kernel/mesh/triangulation.h) and refined until the bound holds.

#include <span>

#include "base/limits.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/stop_check.h"

namespace trimloop::mesh {

struct TessellationOptions {
  double deflection_mm = 0.1;
  double angle_rad = 20 * pi / 180;      // largest turn of the normal across a triangle side
  std::size_t max_triangles_per_face = 5'000'000;
  // Prove the deflection for every triangle, refining until it succeeds; not offsets nor ruled by arc length, and given up when
  // it wants far too many triangles (FaceMesh::bound_kind says so). Else distances are sampled, some missed; five times faster.
  bool prove = true;
  // For tests: told, from the thread that works, how much was done since it last looked at the stop token.
  StopCheck::OnLook on_look;
};

// Same input, same bytes, at any number of jobs. Failed faces stay empty with their reason.
Result<BodyMesh> tessellate(const Body&, const TessellationOptions&, const Execution& = {});

// Several bodies at once, which keeps all threads busy where each body has few faces; the same meshes as one by one.
// Progress never falls. A request to stop is heeded within some thousand steps of work per thread (kernel/mesh/stop_check.h).
struct BodyTask {
  const Body* body = nullptr;
  TessellationOptions options;
};
Result<std::vector<BodyMesh>> tessellate(std::span<const BodyTask>, const Execution& = {});

// Points and chords of one free curve within the same bounds.
std::vector<Point> sample(const Curve&, double deflection_mm, double angle_rad);

}  // namespace trimloop::mesh
