#pragma once
// Area and flux of an OpenCASCADE face by our own quadrature over its geometry. BRepGProp is off by up to 3e-3 on spline
// faces whatever is asked of it; this subdivides until two levels agree.

#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

namespace trimloop::test {

struct FaceFlux {
  double area = 0;    // positive
  double volume = 0;  // of p . n / 3 with the face's own orientation
  double change = 0;  // relative change of the area at the last refinement
  bool measured = false;
};
FaceFlux face_flux(const TopoDS_Face& face);
// Length of its curve, every smooth piece halved until that changes nothing.
double edge_length(const TopoDS_Edge& edge);

}  // namespace trimloop::test
