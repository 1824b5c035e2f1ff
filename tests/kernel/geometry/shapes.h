#pragma once
// Shapes that several tests of this folder use.

#include <random>

#include "kernel/geometry/surface.h"

namespace trimloop::test {

inline Frame tilted_frame() { return make_frame({1, -2, 3}, {1, 2, 2}, {0, 1, -0.3}); }
inline CurvePtr share(Curve c) { return std::make_shared<const Curve>(std::move(c)); }
template <class Shape>
CurvePtr share(Shape shape) {
  return std::make_shared<const Curve>(Curve{std::move(shape)});
}
template <class Shape>
SurfacePtr share_surface(Shape shape) {
  return std::make_shared<const Surface>(Surface{std::move(shape)});
}

// A rational cubic in space with a double knot.
inline NurbsCurve wavy_curve() {
  const std::vector<Point> poles{{0, 0, 0}, {1, 2, 0.5}, {2, -1, 1}, {4, 1, 0}, {5, 3, -1}, {6, 0, 0}, {8, 1, 2}};
  const std::vector<double> weights{1, 2, 0.5, 1, 3, 1, 0.8};
  return *NurbsCurve::from_cartesian(3, {0, 0, 0, 0, 1, 2.5, 2.5, 4, 4, 4, 4}, poles, weights);
}

// A bicubic over [0, 3] x [0, 4] with a random height field and random weights.
inline NurbsSurface wavy_surface(unsigned seed) {
  std::mt19937 random(seed);
  const auto real = [&](double lo, double hi) { return lo + (hi - lo) * static_cast<double>(random()) / 4294967295.0; };
  std::vector<Point> poles;
  std::vector<double> weights;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 7; ++j) {
      poles.push_back({i + real(-0.3, 0.3), j + real(-0.3, 0.3), real(-1.5, 1.5)});
      weights.push_back(real(0.5, 2));
    }
  return *NurbsSurface::from_cartesian(3, 3, {0, 0, 0, 0, 1, 2, 3, 3, 3, 3}, {0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4}, poles,
                                       weights);
}

inline std::vector<Curve> every_curve() {
  const Frame f = tilted_frame();
  return {{Line{{1, 2, 3}, {4, 4, 4}, {-1, 2}}},
          {Circle{f, 3, {0.5, 5}}},
          {Ellipse{f, 3, 5, {-1, 4}}},
          {Parabola{f, 2, {-1, 2}}},
          {Hyperbola{f, 2, 1, {-0.5, 1.5}}},
          {Polyline{{{0, 0, 0}, {1, 0, 0}, {1, 3, 0}, {2, 2, 2}}}},
          {wavy_curve()},
          {OffsetCurve{share(wavy_curve()), 0.1, {0, 0, 1}}},
          {OffsetCurve{share(Hyperbola{f, 2, 1}), 0.3, f.z}},
          {make_composite({{share(Line{{0, 0, 0}, {1, 1, 0}, {0, 2}})},
                           {share(Circle{{{2, 1, 0}}, 1, {0, pi / 2}}), true},
                           {share(wavy_curve())}})}};
}

// Every bounded surface type with a rectangle in its domain.
struct Patch {
  const char* name;
  Surface surface;
  Interval u, v;
};
inline std::vector<Patch> every_patch() {
  const Frame f = tilted_frame();
  const CurvePtr profile = share(wavy_curve());
  return {{"plane", {Plane{f}}, {-1, 2}, {0, 3}},
          {"cylinder", {Cylinder{f, 2}}, {0.3, 5}, {-1, 4}},
          {"cone", {Cone{f, 2, 0.4}}, {0, two_pi}, {-1, 4}},
          {"sphere", {Sphere{f, 2}}, {0, two_pi}, {-pi / 2, pi / 2}},
          {"torus", {Torus{f, 5, 2}}, {0, two_pi}, {0, two_pi}},
          {"revolution", {Revolution{{0, -20, 0}, normalized(Vector{1, 0.2, 0}), profile, {0.5, 4}}}, {0.5, 4}, {0, 4}},
          {"extrusion", {Extrusion{profile, {0, 1, 3}, {0, 2}}}, {0, 4}, {0, 2}},
          {"ruled", {make_ruled(profile, share(Line{{0, 0, 9}, {8, 3, 9}}), true)}, {0, 1}, {0, 1}},
          {"ruled by length", {make_ruled(profile, share(Circle{f, 9, {0, 2}}), false, true)}, {0, 1}, {0, 1}},
          {"offset", {OffsetSurface{share_surface(wavy_surface(3)), 0.05}}, {0, 3}, {0, 4}},
          {"nurbs", {wavy_surface(7)}, {0, 3}, {0, 4}}};
}

}  // namespace trimloop::test
