// Nearest points against dense sampling and closed forms.

#include <boost/test/unit_test.hpp>

#include "shapes.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

struct Random {
  std::mt19937 engine;
  double operator()(double lo, double hi) { return lo + (hi - lo) * static_cast<double>(engine()) / 4294967295.0; }
  Point in(const Box& b, double margin) {
    const double x = (*this)(b.lo.x - margin, b.hi.x + margin), y = (*this)(b.lo.y - margin, b.hi.y + margin);
    return {x, y, (*this)(b.lo.z - margin, b.hi.z + margin)};
  }
};

// The reference: a dense grid of points, made once a surface.
struct Dense {
  std::vector<Point> points;
  Dense(const Surface& s, Interval u, Interval v, int n) {
    for (int i = 0; i <= n; ++i)
      for (int k = 0; k <= n; ++k)
        points.push_back(evaluate(s, {u.at(static_cast<double>(i) / n), v.at(static_cast<double>(k) / n)}));
  }
  double to(Point p) const {
    double best = infinity;
    for (const Point q : points) best = std::min(best, dot(q - p, q - p));
    return std::sqrt(best);
  }
};

// A true foot: inside, the connection is normal to the surface; on a side it does not point inwards.
void check_foot(const Surface& s, Point p, const SurfaceFoot& foot, Interval u, Interval v) {
  const SurfaceJet j = jet(s, foot.uv);
  const Vector r = j.point - p;
  const auto stationary = [&](double t, Interval i, Vector d) {
    const double slope = dot(d, r) / (norm(d) * std::max(norm(r), 1e-3) + 1e-300);
    if (t > i.lo && t < i.hi) return std::abs(slope) < 1e-6;
    return t <= i.lo ? slope > -1e-6 : slope < 1e-6;
  };
  BOOST_TEST(stationary(foot.uv.u, u, j.du));
  BOOST_TEST(stationary(foot.uv.v, v, j.dv));
  BOOST_TEST(distance(evaluate(s, foot.uv), foot.point) < 1e-12);
  BOOST_TEST(std::abs(distance(foot.point, p) - foot.distance) < 1e-12);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(closest)

BOOST_AUTO_TEST_CASE(nearest_points_of_wavy_bicubics_are_the_nearest) {
  Random random{std::mt19937(12)};
  int on_boundary = 0;
  for (unsigned seed = 0; seed < 3; ++seed) {
    const Surface s{wavy_surface(seed)};
    const SurfaceDomain d = domain(s);
    const Dense dense(s, d.u, d.v, 240);
    const Box box = bounding_box(s, d.u, d.v);
    for (int i = 0; i < 200; ++i) {
      const Point p = random.in(box, 1);
      const SurfaceFoot foot = closest_point(s, p);
      BOOST_TEST(foot.distance <= dense.to(p) + 1e-12);
      check_foot(s, p, foot, d.u, d.v);
      const bool inside = foot.uv.u > d.u.lo && foot.uv.u < d.u.hi && foot.uv.v > d.v.lo && foot.uv.v < d.v.hi;
      on_boundary += !inside;
    }
  }
  BOOST_TEST(on_boundary > 50);  // the test has met what it is for
}

BOOST_AUTO_TEST_CASE(nearest_points_of_every_type_are_the_nearest) {
  Random random{std::mt19937(5)};
  for (const Patch& patch : every_patch()) {
    BOOST_TEST_CONTEXT(patch.name)
    for (const double shrink : {0.0, 0.2}) {
      const Interval u{patch.u.at(shrink), patch.u.at(1 - shrink)}, v{patch.v.at(shrink), patch.v.at(1 - shrink)};
      const Dense dense(patch.surface, u, v, 150);
      const Box box = bounding_box(patch.surface, u, v);
      for (int i = 0; i < 40; ++i) {
        const Point p = random.in(box, 0.3 * box.diagonal());
        const SurfaceFoot foot = closest_point(patch.surface, p, u, v);
        BOOST_TEST(foot.distance <= dense.to(p) + 1e-9);
        BOOST_TEST(foot.uv.u >= u.lo);
        BOOST_TEST(foot.uv.u <= u.hi);
        BOOST_TEST(foot.uv.v >= v.lo);
        BOOST_TEST(foot.uv.v <= v.hi);
        BOOST_TEST(distance(evaluate(patch.surface, foot.uv), foot.point) < 1e-12);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_point_of_the_surface_is_its_own_foot) {
  Random random{std::mt19937(6)};
  for (const Patch& patch : every_patch()) {
    BOOST_TEST_CONTEXT(patch.name)
    for (int i = 0; i < 20; ++i) {
      const Uv uv{patch.u.at(random(0, 1)), patch.v.at(random(0, 1))};
      const Point p = evaluate(patch.surface, uv);
      BOOST_TEST(closest_point(patch.surface, p, patch.u, patch.v).distance < 1e-9);
      const Uv start{patch.u.clamp(uv.u + 0.02 * patch.u.length()), patch.v.clamp(uv.v - 0.02 * patch.v.length())};
      const SurfaceFoot near = closest_point_near(patch.surface, p, start);
      BOOST_TEST(near.distance < 1e-9);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_refined_start_is_never_worse) {
  Random random{std::mt19937(7)};
  for (const Patch& patch : every_patch()) {
    BOOST_TEST_CONTEXT(patch.name)
    for (int i = 0; i < 50; ++i) {
      const Box box = bounding_box(patch.surface, patch.u, patch.v);
      const Point p = random.in(box, box.diagonal());
      const Uv start{patch.u.at(random(0, 1)), patch.v.at(random(0, 1))};
      const SurfaceFoot near = closest_point_near(patch.surface, p, start);
      BOOST_TEST(near.distance <= distance(evaluate(patch.surface, start), p) + 1e-12);
      BOOST_TEST(distance(evaluate(patch.surface, near.uv), near.point) < 1e-12);
    }
  }
}

BOOST_AUTO_TEST_CASE(unbounded_shapes_have_nearest_points) {
  const Frame f = tilted_frame();
  const SurfaceFoot on_plane = closest_point(Surface{Plane{f}}, f.origin + (1e6 * f.x - 3 * f.y + 7 * f.z));
  BOOST_TEST(on_plane.distance == 7, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(on_plane.uv.u == 1e6, boost::test_tools::tolerance(1e-12));
  const Curve line{Line{f.origin, f.origin + 2 * f.x, {-infinity, infinity}}};
  const CurveFoot on_line = closest_point(line, f.origin + (-100 * f.x + 3 * f.y));
  BOOST_TEST(on_line.t == -50, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(on_line.distance == 3, boost::test_tools::tolerance(1e-12));
  const Surface wall{Extrusion{share(wavy_curve()), {0, 0, 2}, {-infinity, infinity}}};
  BOOST_TEST(closest_point(wall, evaluate(wall, {1.7, 321})).distance < 1e-9);
  BOOST_TEST(closest_point_near(wall, evaluate(wall, {1.7, 321}), {1.6, 0}).distance < 1e-9);
}

BOOST_AUTO_TEST_CASE(on_the_axis_the_angle_of_the_start_is_kept) {
  const Frame f = tilted_frame();
  for (const Surface& s :
       {Surface{Cylinder{f, 2}}, Surface{Cone{f, 2, 0.3}}, Surface{Sphere{f, 2}}, Surface{Torus{f, 5, 2}}})
    BOOST_TEST(closest_point_near(s, f.origin + 9 * f.z, {2.5, 0.1}).uv.u == 2.5);
}

BOOST_AUTO_TEST_CASE(angles_follow_the_start_over_the_seam) {
  const Frame f = tilted_frame();
  const CurvePtr half = share(Circle{{f.origin, f.x, f.z, -f.y}, 2, {-pi / 2, pi / 2}});
  for (const Surface& s : {Surface{Cylinder{f, 2}}, Surface{Sphere{f, 2}}, Surface{Torus{f, 5, 2}},
                           Surface{Revolution{f.origin, f.z, half}}}) {
    const Point p = evaluate(s, {0.1, 0.2});
    BOOST_TEST(closest_point_near(s, p, {two_pi - 0.1, 0.2}).uv.u == two_pi + 0.1, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(closest_point_near(s, p, {0.3, 0.2}).uv.u == 0.1, boost::test_tools::tolerance(1e-12));
  }
  const Surface nurbs{to_nurbs(Surface{Sphere{f, 2}}, {0, two_pi}, {-pi / 2, pi / 2})->surface};
  const Point p = evaluate(nurbs, {0.1, 0.2});  // comes in again on the other side, and stays inside
  const SurfaceFoot foot = closest_point_near(nurbs, p, {two_pi - 0.05, 0.2});
  BOOST_TEST(foot.distance < 1e-12);
  BOOST_TEST(foot.uv.u == 0.1, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(a_pole_is_no_trap) {
  const Frame f = tilted_frame();
  const Surface ball{Sphere{f, 2}};
  const CurvePtr half = share(Circle{{f.origin, f.x, f.z, -f.y}, 2, {-pi / 2, pi / 2}});
  const Surface nurbs{to_nurbs(ball, {0, two_pi}, {-pi / 2, pi / 2})->surface};
  for (const Surface& s : {ball, nurbs, Surface{Revolution{f.origin, f.z, half}}})
    for (const double u : {0.3, 2.0, 5.5})
      for (const double v : {pi / 2, -pi / 2}) {
        const Point p = evaluate(ball, {u, 0.8 * v});
        BOOST_TEST(closest_point_near(s, p, {0, v}).distance < 1e-9);
        BOOST_TEST(closest_point_near(s, evaluate(ball, {u, v}), {0, v}).distance < 1e-12);
      }
}

BOOST_AUTO_TEST_CASE(a_side_without_derivative_is_no_trap) {
  std::vector<Point> poles;
  for (const double x : {0.0, 0.0, 2.0, 3.0})  // the doubled row makes Su vanish at u = 0
    for (const double y : {0.0, 1.0, 2.0}) poles.push_back({x, y, 0.3 * x * y});
  const Surface s{*NurbsSurface::from_cartesian(3, 2, {0, 0, 0, 0, 1, 1, 1, 1}, {0, 0, 0, 1, 1, 1}, poles, {})};
  for (const double u : {0.01, 0.1, 0.5})
    BOOST_TEST(closest_point_near(s, evaluate(s, {u, 0.4}), {0, 0.35}).distance < 1e-9);
}

BOOST_AUTO_TEST_CASE(nearest_points_of_curves_are_the_nearest) {
  Random random{std::mt19937(8)};
  for (const Curve& c : every_curve()) {
    std::vector<Point> dense;
    for (int i = 0; i <= 20000; ++i) dense.push_back(evaluate(c, range(c).at(i / 20000.0)));
    const Box box = bounding_box(c);
    for (int i = 0; i < 60; ++i) {
      const Point p = random.in(box, 0.3 * box.diagonal());
      double reference = infinity;
      for (const Point q : dense) reference = std::min(reference, distance(p, q));
      const CurveFoot foot = closest_point(c, p);
      BOOST_TEST(foot.distance <= reference + 1e-12);
      BOOST_TEST(range(c).contains(foot.t));
      BOOST_TEST(distance(evaluate(c, foot.t), foot.point) < 1e-12);
      const double start = range(c).at(random(0, 1));
      BOOST_TEST(closest_point_near(c, p, start).distance <= distance(evaluate(c, start), p));
      BOOST_TEST(closest_point_near(c, p, foot.t).distance <= foot.distance + 1e-14);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_crease_is_found_exactly) {
  // Degree 1 with a roof: the nearest point of what lies above is the ridge.
  const std::vector<Point> roof{{0, 0, 0}, {0, 5, 0}, {1, 0, 1}, {1, 5, 1}, {2, 0, 0}, {2, 5, 0}};
  const Surface s{*NurbsSurface::from_cartesian(1, 1, {0, 0, 1, 2, 2}, {0, 0, 1, 1}, roof, {})};
  const SurfaceFoot foot = closest_point(s, {1.2, 2, 4});
  BOOST_TEST(std::abs(foot.uv.u - 1) < 1e-12);
  BOOST_TEST(foot.distance == std::hypot(0.2, 3.0), boost::test_tools::tolerance(1e-12));
  const std::vector<Point> ridge{{0, 0, 0}, {1, 1, 0}, {2, 0, 0}};
  const Curve c{*NurbsCurve::from_cartesian(1, {0, 0, 1, 2, 2}, ridge, {})};
  BOOST_TEST(std::abs(closest_point(c, {1.2, 4, 0}).t - 1) < 1e-12);
  BOOST_TEST(std::abs(closest_point_near(c, {1.2, 4, 0}, 0.1).t - 1) < 1e-9);
}

BOOST_AUTO_TEST_SUITE_END()
