#pragma once
// Cubic Bézier pieces, end to end, as one NURBS curve of degree 3.

#include <array>
#include <cstdint>
#include <span>

#include "kernel/nurbs/curve.h"

namespace trimloop {

struct CubicPiece {
  std::array<Point, 4> poles;
  double length = 1;  // of its parameter interval, > 0
};

enum class Smoothness : std::uint8_t {
  C0,  // triple knot: the joint is a pole
  C1   // double knot: the joint is left out, it lies between its neighbours by the lengths of the intervals
};

// Parameter from 0. The caller promises what each joint says; a C0 joint takes the end of the piece before it.
// joints.size() + 1 == pieces.size().
Result<NurbsCurve> join_cubics(std::span<const CubicPiece> pieces, std::span<const Smoothness> joints);

}  // namespace trimloop
