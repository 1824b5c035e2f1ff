#pragma once
// Pairs of shapes whose intersections are known by construction, for our tests and for OpenCASCADE's score
// (tests/oracle/intersections.cpp).

#include <string>

#include "kernel/geometry/surface.h"

namespace trimloop::test {

struct Expected {
  int points = 0;    // separate common points, touches included
  int touches = -1;  // of them; -1: either kind will do (ends that meet)
  int overlaps = 0;
};

struct CurvePair {
  std::string name;
  Curve a, b;
  Expected expected;
  bool planar = true;             // in z = 0
  std::vector<Point> where = {};  // when known in closed form
  double zone = 1e-4;             // a touch may be placed so far off: there the gap is still below the tolerance
};
std::vector<CurvePair> plane_corpus();
std::vector<CurvePair> space_corpus();  // the same pairs moved in space, and those that only space has

struct CurveSurfacePair {
  std::string name;
  Curve curve;
  Surface surface;
  Expected expected;
  std::vector<Point> where = {};
};
std::vector<CurveSurfacePair> curve_surface_corpus();

struct SurfaceExpected {
  int components = 0;  // connected sets of curves and points
  int loops = 0;       // of them closed curves without branch points
  int touches = 0;     // isolated points
  int tangential = 0;  // curves of tangency
  int overlaps = 0;
  int branchings = 0;
};
struct SurfacePair {
  std::string name;
  Surface a, b;
  SurfaceExpected expected;
  double length = 0;  // of all curves together, where known
};
std::vector<SurfacePair> surface_corpus();

// z = sum c[i][j] x^i y^j over a rectangle as a Bézier patch.
NurbsSurface graph_patch(const std::vector<std::vector<double>>& c, Interval x, Interval y);

}  // namespace trimloop::test
