#pragma once
// One shape of a description (not part of the public face): its members to a curve or to surfaces. Nothing when a member
// is wrong or the shape impossible; the finding is in the report then.

#include <optional>

#include "io/description/builder.h"
#include "io/description/fields.h"

namespace trimloop::io::description {

struct CurveShape {
  Curve curve;
  double bound_mm = 0;  // 0: exact
};
struct SurfaceShape {
  std::vector<NurbsSurface> patches;
  double bound_mm = 0;
  std::optional<double> joint_angle_rad = {};  // largest angle of normals between the patches, where that is a question
};

bool is_curve(std::string_view type);
bool is_surface(std::string_view type);
std::optional<CurveShape> curve_shape(std::string_view type, Fields&);
std::optional<SurfaceShape> surface_shape(std::string_view type, Fields&);

// A member that is a curve described in place, as NURBS.
std::optional<NurbsCurve> curve_member(Fields&, std::string_view name);
std::optional<NurbsCurve> described_curve(Fields&);

// Knots of `count` poles from "knots" (full, or the short form of the seeds without the outer two), or from "ends":
// clamped, uniform or bezier.
std::vector<double> knots_of(Fields&, std::string_view knots, std::string_view ends, int degree, std::size_t count);

}  // namespace trimloop::io::description
