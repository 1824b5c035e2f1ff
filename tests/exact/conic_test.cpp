// Circles whose implicit equation holds identically in the stored numbers, and conversions of quadrics: residuals in
// exact arithmetic.
#include <boost/test/unit_test.hpp>

#include "kernel/geometry/surface.h"
#include "kernel/nurbs/construct_conic.h"
#include "kernel/nurbs/construct_surface.h"
#include "tests/exact/cases.h"

using namespace trimloop;
using namespace trimloop::exact;

namespace {

const Rational radius = 8;  // exact in all products

// x^2 + y^2 - r^2 w^2, a polynomial of degree 2 p: zero at 2 p + 1 parameters is zero everywhere.
void is_circle_identically(const Result<NurbsCurve>& c) {
  BOOST_TEST_REQUIRE(c.has_value());
  const Spline s = exact::exact(*c);
  for (int i = 0; i <= 2 * c->degree(); ++i) {
    const Row h = blossom(s, s.degree, std::vector<Rational>(s.degree, Rational(i) / 7 - 1));
    BOOST_TEST((h[0] * h[0] + h[1] * h[1] == radius * radius * h[3] * h[3]));
    BOOST_TEST((h[2] == 0));
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(rational_circles_hold_identically) {
  is_circle_identically(rational_quarter_circle({}, 8));
  is_circle_identically(quintic_circle({}, 8));
  is_circle_identically(quartic_circle({}, 8));
  is_circle_identically(ideal_half_circle({}, 8));
  // The figures of seed 000, section 3.
  const NurbsCurve c = quintic_circle({}, 1).value();
  const std::vector<double> weights{5, 1, 1, 1, 1, 5};
  for (std::size_t i = 0; i < 6; ++i) BOOST_TEST(c.poles()[i].w == weights[i]);
  BOOST_TEST(project(c.poles()[2]).x == -3);
  BOOST_TEST(project(c.poles()[2]).y == 2);
}

BOOST_AUTO_TEST_CASE(square_root_circles_are_right_to_rounding) {
  Cases cases(41);
  for (int i = 0; i < 400; ++i) {
    const double from = cases.real(-7, 7), turn = i % 7 == 0 ? two_pi : cases.real(0.01, two_pi);
    const NurbsCurve c = circle_arc({}, 8, {from, from + turn}).value();
    const Row h = value(exact::exact(c), cases.in(c.domain()));
    // Radius off by rounding of poles and weights: 4 units in the last place of r.
    const double off = as_double((h[0] * h[0] + h[1] * h[1]) / (h[3] * h[3]) - radius * radius) / 16;
    BOOST_TEST(std::abs(off) <= 4 * epsilon * 8);
  }
}

BOOST_AUTO_TEST_CASE(converted_quadrics_satisfy_their_equations) {
  Cases cases(42);
  const Frame f;  // the axes
  double worst = 0;
  for (int i = 0; i < 120; ++i) {
    const double lo = cases.real(-6, 6), vlo = cases.real(-1.5, 0);
    const Interval u{lo, lo + cases.real(0.1, two_pi)}, v{vlo, vlo + cases.real(0.1, 1.5)};
    const auto check = [&](const Surface& s, auto residual, double scale) {
      const NurbsSurface n = to_nurbs(s, u, v).value().surface;
      const Row h = value(along_v(n, value(exact::exact(n), cases.in(n.domain_u()))), cases.in(n.domain_v()));
      const Row p = projected(h);
      const double off = std::abs(as_double(residual(p))) / scale;
      BOOST_TEST(off <= 8 * epsilon);
      worst = std::max(worst, off / epsilon);
    };
    const auto square = [](const Rational& r) { return Rational(r * r); };
    check(
        Surface{Plane{f}}, [&](const Row& p) { return p[2]; }, 1);
    check(
        Surface{Cylinder{f, 8}}, [&](const Row& p) { return Rational(square(p[0]) + square(p[1]) - 64); }, 128);
    check(
        Surface{Sphere{f, 8}}, [&](const Row& p) { return Rational(square(p[0]) + square(p[1]) + square(p[2]) - 64); },
        128);
    const Rational slope(std::tan(0.25));
    check(
        Surface{Cone{f, 8, 0.25}},
        [&](const Row& p) { return Rational(square(p[0]) + square(p[1]) - square(8 + slope * p[2])); }, 128);
    // Torus: (rho^2 + z^2 + R^2 - r^2)^2 = 4 R^2 rho^2, gradient about 8 R^2 r.
    check(
        Surface{Torus{f, 8, 2}},
        [&](const Row& p) {
          const Rational rho2 = square(p[0]) + square(p[1]);
          return Rational(square(rho2 + square(p[2]) + 60) - 256 * rho2);
        },
        8 * 64 * 2 * 10);
  }
  BOOST_TEST_MESSAGE("quadrics and torus as NURBS: largest residual " << worst << " eps of the size");
}

BOOST_AUTO_TEST_CASE(a_revolved_rational_quarter_makes_an_exact_octant) {
  // Two rational quarters multiplied: a piece of the sphere whose equation holds in the stored numbers.
  const NurbsCurve a = rational_quarter_circle({}, 1).value();
  std::vector<Hpoint> poles;
  for (const Hpoint& p : a.poles())
    for (const Hpoint& q : a.poles()) poles.push_back({8 * q.x * p.x, 8 * q.x * p.y, 8 * q.y * p.w, p.w * q.w});
  const NurbsSurface s = NurbsSurface::from_homogeneous(2, 2, a.knots(), a.knots(), poles).value();
  for (int i = 0; i <= 4; ++i)
    for (int k = 0; k <= 4; ++k) {
      const Row h = value(along_v(s, value(exact::exact(s), Rational(i) / 5)), Rational(k) / 5);
      BOOST_TEST((h[0] * h[0] + h[1] * h[1] + h[2] * h[2] == 64 * h[3] * h[3]));
    }
}
