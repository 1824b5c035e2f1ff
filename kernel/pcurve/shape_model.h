#pragma once
// Curves and surfaces evaluated over an interval of their parameter: Taylor models of point and first derivative
// (not part of the public face). A model whose radius is infinite says that nothing is known over so long an interval;
// halve it. A parameter that runs over a knot or joint gets the model of one side, widened by what the others differ.

#include "kernel/geometry/surface.h"
#include "kernel/pcurve/taylor_model.h"

namespace trimloop::detail {

struct CurveModel {
  ModelPoint point, d1;
};
struct SurfaceModel {
  ModelPoint point, du, dv;
};
CurveModel model(const Curve&, const TaylorModel& t);
// Without `slopes` a spline's du and dv may be left out: half the work.
SurfaceModel model(const Surface&, const TaylorModel& u, const TaylorModel& v, bool slopes = true);
CurveModel model(const NurbsCurve&, const TaylorModel& t);
SurfaceModel model(const NurbsSurface&, const TaylorModel& u, const TaylorModel& v, bool slopes = true);

inline ModelPoint operator+(const Point& p, const ModelPoint& a) {
  return {TaylorModel(p.x) + a.x, TaylorModel(p.y) + a.y, TaylorModel(p.z) + a.z};
}
inline ModelPoint operator*(const TaylorModel& s, const Vector& a) { return {a.x * s, a.y * s, a.z * s}; }

}  // namespace trimloop::detail
