#include <fmt/format.h>

#include "tests/kernel/intersect/corpus.h"

namespace trimloop::test {
namespace {

using Polynomial = std::vector<std::vector<double>>;  // c[i][j] x^i y^j

Polynomial times(const Polynomial& a, const Polynomial& b) {
  Polynomial r(a.size() + b.size() - 1, std::vector<double>(a[0].size() + b[0].size() - 1, 0.0));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < a[0].size(); ++j)
      for (std::size_t k = 0; k < b.size(); ++k)
        for (std::size_t l = 0; l < b[0].size(); ++l) r[i + k][j + l] += a[i][j] * b[k][l];
  return r;
}
// (x - a)^2 + (y - b)^2 - r^2
Polynomial circle(double a, double b, double r) {
  return {{a * a + b * b - r * r, -2 * b, 1}, {-2 * a, 0, 0}, {1, 0, 0}};
}
Surface graph(const Polynomial& c, double lo = -1, double hi = 1) { return {graph_patch(c, {lo, hi}, {lo, hi})}; }
// A flat patch a little larger, with borders elsewhere.
Surface floor_at(double z, double size = 1.3) {
  return {graph_patch({{z}}, {-size, size * 1.07}, {-size * 1.03, size})};
}
Frame frame_at(Point origin, Vector axis) { return make_frame(origin, axis); }
const Vector slanted = normalized(Vector{0.6, 0.3, 0.5});

void planes_and_spheres(std::vector<SurfacePair>& out) {
  const Surface sphere{Sphere{Frame{}, 1}};
  const auto plane = [](double at) { return Surface{Plane{frame_at(Point{} + at * slanted, slanted)}}; };
  out.push_back({"plane cuts sphere", sphere, plane(0.6), {1, 1}, two_pi * 0.8});
  out.push_back({"plane through the middle of sphere", sphere, plane(0), {1, 1}, two_pi});
  out.push_back({"plane through the poles of sphere", sphere, {Plane{frame_at({}, {0.3, 1, 0})}}, {1}, two_pi});
  out.push_back({"plane touches sphere", sphere, plane(1), {1, 0, 1}});
  out.push_back({"plane passes sphere at 1e-9", sphere, plane(1 + 1e-9), {}});
  for (const double r : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5})
    out.push_back({fmt::format("plane cuts a loop of radius {} from sphere", r),
                   sphere,
                   plane(std::sqrt(1 - r * r)),
                   {1, 1},
                   two_pi * r});
  out.push_back(
      {"spheres cross", sphere, {Sphere{frame_at(Point{} + 1.2 * slanted, {1, 0, 1}), 1}}, {1, 1}, two_pi * 0.8});
  out.push_back({"spheres touch outside", sphere, {Sphere{frame_at(Point{} + 3 * slanted, {1, 0, 1}), 2}}, {1, 0, 1}});
  out.push_back(
      {"spheres touch inside", sphere, {Sphere{frame_at(Point{} + 0.5 * slanted, {1, 0, 1}), 0.5}}, {1, 0, 1}});
  out.push_back({"spheres 1e-9 apart", sphere, {Sphere{frame_at(Point{} + (3 + 1e-9) * slanted, {1, 0, 1}), 2}}, {}});
  out.push_back({"spheres in a lens of radius 1e-5",
                 sphere,
                 {Sphere{frame_at(Point{} + (2 - 1e-10) * slanted, {1, 0, 1}), 1}},
                 {1, 1},
                 two_pi * 1e-5});
  out.push_back({"concentric spheres", sphere, {Sphere{frame_at({}, {1, 0, 1}), 0.99}}, {}});
}

void cylinders_and_cones(std::vector<SurfacePair>& out) {
  const Surface ball{Sphere{frame_at({}, slanted), 1}};
  const auto tube = [](Point at, Vector axis, double r, double half) {  // bounded: a circle pushed along
    Frame f = frame_at(at - half * normalized(axis), axis);
    return Surface{Extrusion{std::make_shared<const Curve>(Curve{Circle{f, r}}), normalized(axis), {0, 2 * half}}};
  };
  const Surface cylinder = tube({}, {0, 0, 1}, 1, 3);
  out.push_back({"plane across cylinder", cylinder, {Plane{frame_at({0, 0, 0.3}, {0, 0, 1})}}, {1, 1}, two_pi});
  out.push_back({"plane slants across cylinder", cylinder, {Plane{frame_at({0, 0, 0.3}, slanted)}}, {1, 1}});
  out.push_back({"plane along cylinder", cylinder, {Plane{frame_at({0.6, 0, 0}, {1, 0, 0})}}, {2}, 12});
  out.push_back({"plane touches cylinder", cylinder, {Plane{frame_at({0.6, 0.8, 0}, {0.6, 0.8, 0})}}, {1, 0, 0, 1}, 6});
  out.push_back(
      {"plane passes cylinder at 1e-4", cylinder, {Plane{frame_at({0.60006, 0.80008, 0}, {0.6, 0.8, 0})}}, {}});
  out.push_back(
      {"plane just inside cylinder", cylinder, {Plane{frame_at({0.59994, 0.79992, 0}, {0.6, 0.8, 0})}}, {2}, 12});
  out.push_back({"thin cylinder through cylinder", cylinder, tube({0, 0, 0.1}, {1, 0.2, 0.1}, 0.4, 3), {2, 2}});
  out.push_back({"equal cylinders cross",
                 cylinder,
                 tube({0, 0, 0.1}, {1, 0.2, 0}, 1, 3),
                 {1, 0, 0, 0, 0, 2},
                 2 * 7.640395578055424});
  out.push_back({"cylinders touch crosswise", cylinder, tube({0, 1.5, 0.1}, {1, 0, 0.2}, 0.5, 3), {1, 0, 1}});
  out.push_back({"parallel cylinders cross", cylinder, tube({1.2, 0, 0.1}, {0, 0, 1}, 1, 2), {2}, 8});
  out.push_back({"parallel cylinders touch", cylinder, tube({0.9, 1.2, 0.1}, {0, 0, 1}, 0.5, 2), {1, 0, 0, 1}, 4});
  out.push_back({"the same cylinder turned and shorter",
                 cylinder,
                 {Extrusion{std::make_shared<const Curve>(
                                Curve{Circle{Frame{{0, 0, -1}, {0.6, 0.8, 0}, {-0.8, 0.6, 0}, {0, 0, 1}}, 1}}),
                            {0, 0, 1},
                            {0, 2}}},
                 {0, 0, 0, 0, 1}});
  out.push_back({"cylinder bites a ball", ball, tube({0.9, 0, 0}, {0, 0.1, 1}, 0.4, 3), {1, 1}});
  out.push_back({"cylinder through a ball", ball, tube({0.2, 0, 0}, {0, 0.1, 1}, 0.4, 3), {2, 2}});
  out.push_back({"cylinder about a ball", ball, tube({}, {0.2, 0.1, 1}, 1, 3), {1, 0, 0, 1}, two_pi});
  out.push_back({"Viviani's curve", ball, tube({0.5, 0, 0}, {0, 0, 1}, 0.5, 3), {1, 0, 0, 0, 0, 1}, 7.640395578055424});
  out.push_back({"ball touches cylinder", {Sphere{frame_at({1.5, 2, 0.1}, slanted), 1.5}}, cylinder, {1, 0, 1}});
  const Surface cone{Cone{Frame{}, 1, pi / 4}};
  out.push_back({"plane across cone", cone, {graph_patch({{0.5}}, {-3, 3}, {-3, 3.1})}, {1, 1}, two_pi * 1.5});
  out.push_back({"ball in cone", {Sphere{frame_at({0, 0, 1}, slanted), std::sqrt(2.0)}}, cone, {1, 0, 0, 1}, two_pi});
  out.push_back({"ball cuts cone in two circles", {Sphere{frame_at({0, 0, 1}, slanted), 1.6}}, cone, {2, 2}});
}

void tori(std::vector<SurfacePair>& out) {
  const Surface torus{Torus{Frame{}, 2, 0.5}};
  const auto plane = [](Point at, Vector n) { return Surface{Plane{frame_at(at, n)}}; };
  out.push_back({"plane across torus", torus, plane({}, {0, 0, 1}), {2, 2}, two_pi * 4});
  out.push_back({"plane on top of torus", torus, plane({0, 0, 0.5}, {0, 0, 1}), {1, 0, 0, 1}, two_pi * 2});
  out.push_back({"plane 1e-4 above torus", torus, plane({0, 0, 0.5001}, {0, 0, 1}), {}});
  out.push_back({"plane through the axis of torus", torus, plane({}, {0.3, 1, 0}), {2, 2}, two_pi});
  out.push_back({"plane touches torus outside", torus, plane({2.5, 0, 0}, {1, 0, 0}), {1, 0, 1}});
  out.push_back({"plane touches torus inside", torus, plane({1.5, 0, 0}, {1, 0, 0}), {1, 0, 0, 0, 0, 1}});
  out.push_back({"plane touches torus twice (Villarceau)",
                 torus,
                 plane({}, {0.5, 0, -std::sqrt(4 - 0.25)}),
                 {1, 0, 0, 0, 0, 2},
                 2 * two_pi * 2});
  out.push_back(
      {"plane cuts a loop of radius about 1e-4 from torus", torus, plane({2.5 - 1e-8, 0, 0}, {1, 0, 0}), {1, 1}});
  out.push_back({"ball in the tube of torus", torus, {Sphere{frame_at({2, 0, 0}, slanted), 0.5}}, {1, 0, 0, 1}, pi});
  out.push_back({"ball through torus", torus, {Sphere{frame_at({2, 0, 0}, slanted), 0.6}}, {2, 2}});
}

void graphs(std::vector<SurfacePair>& out) {
  const Surface ground = floor_at(0);
  out.push_back({"graph with two circles",
                 graph(times(circle(-0.5, 0.1, 0.3), circle(0.45, -0.2, 0.2))),
                 ground,
                 {2, 2},
                 two_pi * 0.5});
  out.push_back({"graph with nested circles",
                 graph(times(circle(0.1, 0.05, 0.7), circle(0.05, 0.1, 0.3))),
                 ground,
                 {2, 2},
                 two_pi});
  out.push_back({"graph with three circles",
                 graph(times(times(circle(-0.5, 0.1, 0.3), circle(0.45, -0.2, 0.2)), circle(0.4, 0.6, 0.1))),
                 ground,
                 {3, 3},
                 two_pi * 0.6});
  for (const double r : {1e-2, 1e-3, 1e-4, 1e-5})
    out.push_back({fmt::format("bump grazes the ground in a loop of radius {}", r),
                   graph(circle(0.123, -0.234, r)),
                   ground,
                   {1, 1},
                   two_pi * r});
  out.push_back({"two small loops beside each other",
                 graph(times(circle(0.1, 0.1, 1e-3), circle(0.11, 0.1, 1e-3))),
                 ground,
                 {2, 2},
                 two_pi * 2e-3});
  out.push_back({"bump touches the ground", graph(circle(0.123, -0.234, 0)), ground, {1, 0, 1}});
  out.push_back({"bump 1e-9 above the ground", graph({{1e-9, 0, 1}, {0, 0, 0}, {1, 0, 0}}), ground, {}});
  out.push_back({"two bumps, one touches, one cuts",
                 graph(times(circle(-0.5, 0.1, 0), circle(0.45, -0.2, 0.2))),
                 ground,
                 {2, 1, 1},
                 two_pi * 0.2});
  out.push_back({"saddle: two lines cross", graph({{0, 0}, {0, 1}}), ground, {1, 0, 0, 0, 0, 1}, 4});
  out.push_back({"saddle just above: two branches", graph({{1e-6, 0}, {0, 1}}), ground, {2}});
  out.push_back({"valley: tangential line", graph({{0.04, -0.4, 1}}), ground, {1, 0, 0, 1}, 2});
  out.push_back({"tangential circle",
                 graph(times(circle(0.1, 0.05, 0.6), circle(0.1, 0.05, 0.6))),
                 ground,
                 {1, 0, 0, 1},
                 two_pi * 0.6});
  out.push_back({"one line", graph({{0.1, 0.2}, {1, 0}}), ground, {1}});
  out.push_back({"parabola to the borders", graph({{-0.3, 1}, {0, 0}, {-1, 0}}), ground, {1}});
  out.push_back({"two graphs crossing in a circle",
                 graph({{0, 0, 1}, {0, 0, 0}, {1, 0, 0}}),
                 {graph_patch({{0.5, 0, -1}, {0, 0, 0}, {-1, 0, 0}}, {-1.1, 1}, {-1, 1.1})},
                 {1, 1},
                 two_pi * 0.5});
  out.push_back(
      {"shared edge", graph({{0, 0}, {0.3, 0}}, 0, 1), {graph_patch({{0, 0}, {-2, 0}}, {0, 1}, {0, 1})}, {1}, 1});
  out.push_back({"shared edge, part of it",
                 graph({{0, 0}, {0.3, 0}}, 0, 1),
                 {graph_patch({{0, 0}, {-2, 0}}, {0, 1}, {0.5, 2})},
                 {1},
                 0.5});
  out.push_back({"corner on the ground", {graph_patch({{0, 1}, {1, 0}}, {0, 1}, {0, 1})}, ground, {1, 0, 1}});
  out.push_back({"edge bows down to the ground",
                 {graph_patch({{0.09, 1}, {-0.6, 0}, {1, 0}}, {0, 1}, {0, 1})},
                 ground,
                 {1, 0, 1}});
  out.push_back({"plates overlap", floor_at(0), {graph_patch({{0}}, {0.2, 3}, {0.1, 3})}, {0, 0, 0, 0, 1}});
  out.push_back(
      {"plates in one plane, apart", {graph_patch({{0}}, {0, 1}, {0, 1})}, {graph_patch({{0}}, {1.1, 3}, {0, 1})}, {}});
}

}  // namespace

std::vector<SurfacePair> surface_corpus() {
  std::vector<SurfacePair> out;
  planes_and_spheres(out);
  cylinders_and_cones(out);
  tori(out);
  graphs(out);
  return out;
}

}  // namespace trimloop::test
