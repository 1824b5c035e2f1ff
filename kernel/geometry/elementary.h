#pragma once

#include "kernel/geometry/surface.h"

namespace trimloop {

struct Elementary {
  Surface surface;  // plane, cylinder, cone, sphere or torus
  UvMap map;        // from the parameters of the surface it was found in
};
// The elementary surface that a revolution or extrusion is: of a line about or along an axis in its plane, of an arc
// whose plane holds the axis or stands across the direction. Nothing when the shapes differ by more than rounding
// (1e-11 of their size), when the parameters are not related by an affine map (a turned line that stays in one plane),
// and where a cone would pass its apex or an arc its axis within `v`.
std::optional<Elementary> as_elementary(const Surface&, Interval v);

}  // namespace trimloop
