#pragma once
// The analytic curve or surface that a NURBS is, when it is one to rounding, and the map between both parametrizations.
// Found by closed forms (osculating circle, conjugate diameters of a rational quadratic) and then checked: deviations
// are polynomials of known degree in each Bezier piece, so they are looked at in more places than that degree.

#include <optional>

#include "kernel/geometry/surface.h"

namespace trimloop {

// Between the parameter of a NURBS curve and that of the analytic curve, which runs the same way: both ascend.
class CurveRelation {
 public:
  CurveRelation(NurbsCurve nurbs, Curve analytic);
  double to_analytic(double s) const;  // closed form at the point, the right turn chosen
  double to_nurbs(double t) const;     // its inverse, by bracketing; clamped to the ends
  bool ascends() const { return ascends_; }

 private:
  double raw(double s) const;
  NurbsCurve nurbs_;
  Curve analytic_;
  std::vector<double> at_, value_;
  double turn_ = 0;  // 2 pi for angles
  bool ascends_ = true;
};

struct RecognizedCurve {
  Curve curve;  // line, circle, ellipse, parabola or hyperbola over the range of the NURBS
  CurveRelation relation;
  double deviation = 0;  // largest distance seen, mm
};
// Nothing unless the deviation is at most `relative` of the size of the poles. Weights must be positive.
std::optional<RecognizedCurve> recognize(const NurbsCurve&, double relative = 1e-12);

struct RecognizedSurface {
  Surface surface;        // plane, cylinder, cone, sphere, torus; else extrusion, revolution, ruled
  bool swapped = false;   // u of the NURBS is v of the surface
  bool separable = true;  // each parameter depends on one of the NURBS's only; then both maps are closed or bracketed
  double deviation = 0;   // of points at mapped parameters (of points alone when not separable), mm
  NurbsSurface nurbs;
  struct Direction {                        // analytic parameter = offset + factor * (that of the isocurve's relation)
    std::optional<CurveRelation> relation;  // none: the NURBS parameter itself
    double offset = 0, factor = 1;
  };
  Direction u, v;  // of the analytic surface
};
std::optional<RecognizedSurface> recognize(const NurbsSurface&, double relative = 1e-12);
Uv map_to_analytic(const RecognizedSurface&, Uv nurbs);
Uv map_to_nurbs(const RecognizedSurface&, Uv analytic);  // not separable: by the nearest point

}  // namespace trimloop
