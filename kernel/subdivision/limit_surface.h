#pragma once
// The limit surface of Catmull-Clark and Doo-Sabin as NURBS patches, and of Loop as triangular Bézier patches.
//
// Where the mesh is regular the limit is a B-spline and the patch is exact: its poles are the control points. Around an
// irregular vertex (or face, for Doo-Sabin) every ring of faces is regular after enough rounds: rings come out exact,
// each a quarter of the size of the last, and the cap that is left is approximated. The bound of a cap is the largest
// distance of corresponding points: differences of Bernstein coefficients ring by ring, and in the middle, that no ring
// reaches, the distance of hulls. It holds (Lane and Riesenfeld 1980; convex weights of the schemes).

#include "kernel/nurbs/surface.h"
#include "kernel/patches/triangle_bezier.h"
#include "kernel/subdivision/control_mesh.h"

namespace trimloop::subdivision {

struct LimitPatch {
  NurbsSurface surface;     // normal as the control mesh
  std::uint32_t face = 0;   // control face it comes from (Catmull-Clark), or control vertex (Doo-Sabin), after the
                            // rounds that make the mesh regular enough
  double bound = 0;         // 0: exact
};

struct LimitSurface {
  std::vector<LimitPatch> patches;
  std::size_t exact = 0, caps = 0;
  double bound = 0;         // the largest of the patches
};

// Caps are refined until their bound is at most `tolerance` or `most_rounds` are reached; then the bound says what was
// achieved. Sharp edges and borders are exact too. Unsupported: a crease that ends inside the surface, more than
// `most_patches` (ErrorCode::Limit).
struct LimitOptions {
  double tolerance = 1e-3;
  int most_rounds = 12;
  std::size_t most_patches = 2'000'000;
};
Result<LimitSurface> catmull_clark_limit(const ControlMesh&, const LimitOptions& = {});
Result<LimitSurface> doo_sabin_limit(const ControlMesh&, const LimitOptions& = {});

// Quartic triangles of every face whose corners are inner ones of valence 6 (exact); the other faces are listed.
struct LoopPatches {
  std::vector<TriangleBezier> patches;
  std::vector<std::uint32_t> faces;      // of the patches
  std::vector<std::uint32_t> irregular;  // faces without one
};
Result<LoopPatches> loop_regular_patches(const ControlMesh&);

}  // namespace trimloop::subdivision
