#pragma once
// Area, volume and box of faces, bodies and models by quadrature over the trimmed parameter domain
// (Green's theorem: a boundary integral of inner Gauss integrals). No mesh is involved.

#include "kernel/model/model.h"

namespace trimloop {

struct Measured {
  double value = 0;
  double error = 0;  // estimated absolute error of the quadrature
};

// Area of a face in mm^2. Relative error below `relative_error` unless said in `error`. Failed faces: 0.
Measured area(const Body&, FaceId, double relative_error = 1e-7);
// Signed volume under the face: contribution to 1/3 of the flux of (p - origin) through it, outward by Face::reversed.
Measured volume_contribution(const Body&, FaceId, Point origin, double relative_error = 1e-7);
// Contribution to the first moment of the volume about `origin`: the flux of ((x²/2, 0, 0), ...) for each coordinate. An
// error below `absolute_error` (mm^4) is good enough: contributions of one face may cancel.
Vector moment_contribution(const Body&, FaceId, Point origin, double relative_error, double absolute_error);
// Volume of a closed shell; Degenerate when it is not closed.
Result<Measured> volume(const Body&, ShellId, double relative_error = 1e-7);

// Centre of the volume of a closed shell; Degenerate when it is not closed or holds none.
Result<Point> centroid(const Body&, ShellId, double relative_error = 1e-7);

// Box of the trimmed face: encloses boundary and interior (sampled, then widened by the curvature seen).
Box bounding_box(const Body&, FaceId);

struct ModelMeasures {
  Box box;              // faces, visible and hidden, free curves and points, meshes; unbounded ones left out
  double area_mm2 = 0, area_error = 0;
  // Of the solids, voids negative; where there is none, of the closed shells of sheets (one that lies on a solid would count
  // twice). Nothing when no shell is closed.
  std::optional<double> volume_mm3;
  double curve_length_mm = 0;        // of the free bounded curves
  // Polygon meshes that stand for no body, apart from the exact shapes above; volume of the closed ones.
  double mesh_area_mm2 = 0;
  std::optional<double> mesh_volume_mm3;
};
Result<ModelMeasures> measure(const Model&, const struct Limits&);

}  // namespace trimloop
