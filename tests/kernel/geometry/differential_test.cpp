// Curvature, torsion, frames and arc length against closed forms.
#include "kernel/geometry/differential.h"

#include <boost/test/unit_test.hpp>

#include "kernel/geometry/arc_length.h"
#include "kernel/geometry/inversion.h"
#include "kernel/nurbs/construct_conic.h"
#include "shapes.h"

using namespace trimloop;
using namespace trimloop::test;

BOOST_AUTO_TEST_SUITE(differential)

BOOST_AUTO_TEST_CASE(frames_follow_the_closed_forms) {
  const Frame f = tilted_frame();
  for (const double t : {0.3, 1.0, 2.5}) {
    const FrenetFrame k = frenet_frame(Curve{Circle{f, 4}}, t).value();
    BOOST_TEST(std::abs(k.curvature - 0.25) < 1e-15);
    BOOST_TEST(std::abs(k.torsion) < 1e-15);
    BOOST_TEST(norm(k.binormal - f.z) < 1e-14);
    const FrenetFrame e = frenet_frame(Curve{Ellipse{f, 5, 3}}, t).value();
    BOOST_TEST(std::abs(e.curvature -
                        15 / std::pow(25 * std::sin(t) * std::sin(t) + 9 * std::cos(t) * std::cos(t), 1.5)) < 1e-14);
    BOOST_TEST(std::abs(dot(e.tangent, e.normal)) < 1e-15);
    BOOST_TEST(distance(osculating_circle(Curve{Circle{f, 4}}, t)->centre, f.origin) < 1e-14);
  }
  // The twisted cubic (t, t^2, t^3): curvature^2 = 4 (9 t^4 + 9 t^2 + 1) / (9 t^4 + 4 t^2 + 1)^3, torsion = 3 / (9 t^4
  // + 9 t^2 + 1).
  const std::vector<Point> poles{{0, 0, 0}, {1 / 3.0, 0, 0}, {2 / 3.0, 1 / 3.0, 0}, {1, 1, 1}};
  const Curve cubic{NurbsCurve::from_cartesian(3, {0, 0, 0, 0, 1, 1, 1, 1}, poles, {}).value()};
  for (const double t : {0.0, 0.2, 0.7, 1.0}) {
    const FrenetFrame k = frenet_frame(cubic, t).value();
    const double a = 9 * std::pow(t, 4) + 9 * t * t + 1, b = 9 * std::pow(t, 4) + 4 * t * t + 1;
    BOOST_TEST(std::abs(k.curvature - 2 * std::sqrt(a / (b * b * b))) < 1e-13);
    BOOST_TEST(std::abs(k.torsion - 3 / a) < 1e-12);
  }
  const std::vector<Point> rest{{0, 0, 0}, {0, 0, 0}, {1, 1, 0}, {2, 0, 0}};  // stands still at its start
  BOOST_TEST(
      !frenet_frame(Curve{NurbsCurve::from_cartesian(3, {0, 0, 0, 0, 1, 1, 1, 1}, rest, {}).value()}, 0).has_value());
  BOOST_TEST(!osculating_circle(Curve{Line{{0, 0, 0}, {1, 1, 1}}}, 0.5).has_value());
}

BOOST_AUTO_TEST_CASE(principal_curvatures_follow_the_closed_forms) {
  const Frame f = tilted_frame();
  const Uv at{0.7, 0.4};
  const SurfaceCurvature p = curvature(Surface{Plane{f}}, at).value();
  BOOST_TEST((p.k1 == 0 && p.k2 == 0));
  const SurfaceCurvature c = curvature(Surface{Cylinder{f, 4}}, at).value();
  BOOST_TEST(std::abs(c.k1) < 1e-15);
  BOOST_TEST(std::abs(c.k2 + 0.25) < 1e-15);  // bends away from its outward normal
  BOOST_TEST(std::abs(std::abs(dot(c.direction1, f.z)) - 1) < 1e-14);
  const SurfaceCurvature s = curvature(Surface{Sphere{f, 4}}, at).value();
  BOOST_TEST(s.umbilic);
  BOOST_TEST(std::abs(s.gaussian - 1 / 16.0) < 1e-15);
  const SurfaceCurvature t = curvature(Surface{Torus{f, 5, 2}}, at).value();
  const double around = std::cos(0.4) / (5 + 2 * std::cos(0.4));
  BOOST_TEST(std::abs(t.k1 + around) < 1e-14);
  BOOST_TEST(std::abs(t.k2 + 0.5) < 1e-14);
  BOOST_TEST(std::abs(t.gaussian - 0.5 * around) < 1e-14);
  BOOST_TEST(norm(cross(t.direction1, t.direction2) - t.normal) < 1e-14);
  // Euler's formula on a freeform surface, in any direction.
  const Surface wavy{wavy_surface(5)};
  const SurfaceCurvature w = curvature(wavy, {1.3, 2.2}).value();
  const SurfaceJet j = jet(wavy, {1.3, 2.2});
  for (const Uv d : {Uv{1, 0}, Uv{0, 1}, Uv{1, -2}, Uv{3, 1}}) {
    const Vector v = normalized(d.u * j.du + d.v * j.dv);
    const double x = dot(v, w.direction1), y = dot(v, w.direction2);
    BOOST_TEST(std::abs(normal_curvature(wavy, {1.3, 2.2}, d).value() - (w.k1 * x * x + w.k2 * y * y)) < 1e-12);
  }
  BOOST_TEST(!curvature(Surface{Sphere{f, 4}}, {0, 0.5 * pi}).has_value());
}

BOOST_AUTO_TEST_CASE(lengths_are_right_within_their_own_error) {
  // Ellipse 5, 3: 4 a E(e), e^2 = 16 / 25, by the arithmetic-geometric mean in long double.
  long double a = 5, b = 3, c2 = a * a - b * b, sum = c2 / 2, power = 1;
  for (int i = 0; i < 8; ++i) {
    const long double next = (a + b) / 2, c = (a - b) / 2;
    b = std::sqrt(a * b), a = next;
    sum += power * c * c, power *= 2;
  }
  const double ellipse = static_cast<double>(2 * 3.14159265358979323846264338327950288L * (25 - sum) / a);
  for (const double tolerance : {1e-4, 1e-8, 1e-12}) {
    const MeasuredLength m = measured_length(Curve{Ellipse{{}, 5, 3}}, tolerance).value();
    BOOST_TEST(std::abs(m.value - ellipse) <= m.error);
    BOOST_TEST(m.error <= std::max(tolerance, 1e-12));
  }
  const NurbsCurve circle = quintic_circle({}, 2).value();
  const MeasuredLength round = measured_length(Curve{circle}, 1e-12).value();
  BOOST_TEST(std::abs(round.value - 4 * pi) <= round.error);
  // A parabola by its closed form: f (s sqrt(1 + s^2) + asinh s) from 0 to s, y = 2 f s.
  const MeasuredLength m = measured_length(Curve{Parabola{{}, 1.5, {0, 2}}}, 1e-12).value();
  BOOST_TEST(std::abs(m.value - 1.5 * (2 * std::sqrt(5.0) + std::asinh(2.0))) <= m.error);
  BOOST_TEST(!measured_length(Curve{Line{{0, 0, 0}, {1, 0, 0}, {0, infinity}}}, 1e-6).has_value());
}

BOOST_AUTO_TEST_CASE(equal_parts_have_equal_lengths) {
  const CurvePtr wavy = share(wavy_curve()), circle = share(quintic_circle({}, 2).value());
  for (const CurvePtr& c : {wavy, circle}) {
    const std::vector<double> at = equal_length_parameters(c, 7).value();
    BOOST_TEST(at.size() == 8u);
    const double whole = length(*c, 1e-12);
    for (std::size_t i = 0; i + 1 < at.size(); ++i)
      BOOST_TEST(std::abs(length(with_range(*c, {at[i], at[i + 1]}), 1e-12) - whole / 7) < 1e-9 * whole);
    const ArcLength table(c);
    BOOST_TEST(std::abs(table.fraction(parameter_at_length(table, 0.3 * whole)) - 0.3) < 1e-10);
  }
  // On the circle of radius 2 equal lengths are equal angles.
  const std::vector<double> at = equal_length_parameters(circle, 8).value();
  for (std::size_t i = 0; i <= 8; ++i) {
    const Point p = evaluate(*circle, at[i]);
    BOOST_TEST(distance(p, {2 * std::cos(two_pi * static_cast<double>(i) / 8),
                            2 * std::sin(two_pi * static_cast<double>(i) / 8)}) < 1e-8);
  }
  BOOST_TEST(!equal_length_parameters(wavy, 0).has_value());
}

BOOST_AUTO_TEST_CASE(extension_by_a_length_adds_that_length) {
  const NurbsCurve c = wavy_curve();
  const double before = length(Curve{c}, 1e-12);
  for (const bool at_start : {true, false}) {
    const auto longer = extended_by_length(c, at_start, 0.25);
    BOOST_TEST_REQUIRE(longer.has_value());
    BOOST_TEST(std::abs(length(Curve{*longer}, 1e-12) - before - 0.25) < 1e-8);
    for (int i = 0; i <= 20; ++i)
      BOOST_TEST(distance(evaluate(*longer, c.range().at(i / 20.0)), evaluate(c, c.range().at(i / 20.0))) < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(points_and_tangents_are_inverted) {
  const Curve c{wavy_curve()};
  const Surface s{wavy_surface(7)};
  for (const double x : {0.0, 0.13, 0.5, 0.77, 1.0}) {
    const double t = range(c).at(x);
    BOOST_TEST(distance(evaluate(c, invert_point(c, evaluate(c, t), 1e-9).value()), evaluate(c, t)) < 1e-9);
    const Uv uv{3 * x, 4 * (1 - x)};
    BOOST_TEST(distance(evaluate(s, invert_point(s, evaluate(s, uv), 1e-9).value()), evaluate(s, uv)) < 1e-9);
    const SurfaceJet j = jet(s, uv);
    const Vector n = normalized(cross(j.du, j.dv));
    const TangentInversion d = invert_tangent(s, uv, 0.3 * j.du - 2.0 * j.dv + 0.25 * n).value();
    BOOST_TEST(norm(d.direction - Uv{0.3, -2}) < 1e-12);
    BOOST_TEST(std::abs(d.off_plane - 0.25) < 1e-12);
  }
  BOOST_TEST(invert_point(c, {0, 0, 50}, 1e-6).error().measured > 40);
  BOOST_TEST(!invert_point(s, {0, 0, 50}, 1e-6).has_value());
  BOOST_TEST(!invert_tangent(Surface{Sphere{{}, 1}}, {0, 0.5 * pi}, {1, 0, 0}).has_value());
}

BOOST_AUTO_TEST_SUITE_END()
