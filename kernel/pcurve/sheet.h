#pragma once
// Sheet: a surface as trimming sees it. Which directions close, where the poles are, how far apart in millimetres two
// parameters lie, and what a parameter outside the rectangle means.
//
// A loop is drawn in the cover: along a closed direction the parameter may run on, and u and u + period are the same
// place. Surfaces that are periodic by nature (a cylinder) can be evaluated anywhere in the cover, a NURBS surface
// that merely closes only inside its rectangle: `home` brings a parameter back there.

#include <vector>

#include "kernel/geometry/surface.h"

namespace trimloop::pcurve {

struct Pole {
  bool at_v = true;   // the side v = value (u is free), else the side u = value
  double value = 0;
  Point point;
};

class Sheet {
 public:
  // `tolerance_mm`: what counts as closed or as one point.
  Sheet(const Surface& surface, double tolerance_mm);

  const Surface& surface() const { return surface_; }
  const SurfaceDomain& domain() const { return domain_; }
  // Period along a direction, 0 where it does not close.
  double period_u() const { return period_u_; }
  double period_v() const { return period_v_; }
  // Parameters at whose border the surface holds still when asked beyond it; infinite where it goes on.
  Interval hold_u() const { return hold_u_; }
  Interval hold_v() const { return hold_v_; }
  bool covers_u() const { return covers_u_; }  // can be evaluated anywhere along u
  bool covers_v() const { return covers_v_; }
  const std::vector<Pole>& poles() const { return poles_; }
  // The pole that the parameter, whose point is `p`, belongs to.
  const Pole* pole_at(Uv, Point p, double tolerance_mm) const;

  Uv home(Uv) const;
  Point point(Uv) const;
  void jet(Uv, Point&, Vector& du, Vector& dv) const;
  // Length of the step from a to b on the surface, to first order at a.
  double millimetres(Uv a, Uv b) const;

  // Nearest point anywhere, and from a start (unwrapped: the answer lies in the same turn as the start).
  SurfaceFoot foot(Point) const;
  SurfaceFoot foot_near(Point, Uv start) const;

 private:
  void find_poles();

  const Surface& surface_;
  SurfaceDomain domain_;
  double period_u_ = 0, period_v_ = 0;
  Interval hold_u_{-infinity, infinity}, hold_v_{-infinity, infinity};
  bool covers_u_ = false, covers_v_ = false;
  std::vector<Pole> poles_;
};

}  // namespace trimloop::pcurve
