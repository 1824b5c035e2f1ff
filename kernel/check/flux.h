#pragma once
// The integrals over a trimmed face (kernel/check/flux.cpp; not part of the public face).

#include "kernel/check/measure.h"

namespace trimloop::detail {

// Integrals over the face of |n|, (p - o).n / 3 and further moments, n = Su x Sv. Moment..: of the volume, as a flux of
// x^2 / 2 or x^3 / 3 or x^2 y / 2 along one axis. Area..: of the area.
enum class What : std::uint8_t {
  Area,
  Volume,
  MomentX,
  MomentY,
  MomentZ,
  MomentXX,
  MomentYY,
  MomentZZ,
  MomentXY,
  MomentYZ,
  MomentZX,
  AreaX,
  AreaY,
  AreaZ,
  AreaXX,
  AreaYY,
  AreaZZ,
  AreaXY,
  AreaYZ,
  AreaZX
};
// Not turned by Face::reversed. An error below `absolute_error` is good enough.
Measured face_integral(const Body&, FaceId, What, Point origin, double relative_error, double absolute_error = 0);

}  // namespace trimloop::detail
