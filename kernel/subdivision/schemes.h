#pragma once
// One round of a subdivision scheme: a finer control mesh of the same surface (seeds 000 §6.2 and 003).

#include <optional>
#include <string_view>

#include "kernel/subdivision/control_mesh.h"

namespace trimloop::subdivision {

enum class Scheme : std::uint8_t {
  CatmullClark,     // Catmull and Clark 1978: bicubic B-splines where regular; any faces; creases
  DooSabin,         // Doo and Sabin 1978, true weights: biquadratic B-splines where regular; any faces
  DooSabinMidpoint, // seed 000's own rule, midpoints of corner and centroid: smooth, but no B-spline
  MidEdge,          // Habib and Warren 1999, Peters and Reif 1997: edge midpoints; any faces
  Loop,             // Loop 1987: quartic box splines where regular; triangles; creases
  Butterfly,        // Dyn, Gregory and Levin 1990, with Zorin's rules at irregular points; triangles; interpolates
  Sqrt3             // Kobbelt 2000; triangles; each round multiplies the faces by 3
};
std::string_view to_string(Scheme);
std::optional<Scheme> scheme_from_name(std::string_view);  // "catmull-clark", "doo-sabin", ...

// Borders: Catmull-Clark, Loop: cubic B-spline curves, corners of one face kept sharp. Butterfly: the four-point rule.
// Sqrt3: kept, refined by three in every second round (`round` counts from 0). Doo-Sabin, MidEdge: the surface ends
// half a face inside its border, as B-splines of degree 2 over uniform knots do.
// Errors: what adjacency() refuses; a face that is no triangle under Loop, Butterfly, Sqrt3; creases under a scheme
// without them; more than `most_corners` corners in the result (ErrorCode::Limit).
Result<ControlMesh> refined(const ControlMesh&, Scheme, int round = 0, std::size_t most_corners = 200'000'000);
Result<ControlMesh> refined_times(const ControlMesh&, Scheme, int rounds, std::size_t most_corners = 200'000'000);

}  // namespace trimloop::subdivision
