#include "kernel/pcurve/project.h"

#include <boost/test/unit_test.hpp>

#include "tests/kernel/geometry/shapes.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

// A thread on a cone frustum (slope 0: cylinder) about `f`: cubic Hermite pieces, so many to the turn.
NurbsCurve thread(const Frame& f, double radius, double slope, double pitch, int turns, int per_turn) {
  const auto at = [&](double a) {
    const double r = radius + slope * pitch * a / two_pi;
    return f.origin + (r * std::cos(a) * f.x + r * std::sin(a) * f.y + pitch * a / two_pi * f.z);
  };
  const auto along = [&](double a) {
    const double r = radius + slope * pitch * a / two_pi, r1 = slope * pitch / two_pi;
    return (r1 * std::cos(a) - r * std::sin(a)) * f.x + (r1 * std::sin(a) + r * std::cos(a)) * f.y +
           pitch / two_pi * f.z;
  };
  const int pieces = turns * per_turn;
  const double h = two_pi / per_turn;
  std::vector<Point> poles{at(0)};
  std::vector<double> knots(4, 0.0);
  for (int i = 0; i < pieces; ++i) {
    const double a = i * h, b = (i + 1) * h;
    poles.push_back(at(a) + h / 3 * along(a));
    poles.push_back(at(b) - h / 3 * along(b));
    if (i + 1 < pieces) knots.insert(knots.end(), 2, b);
  }
  poles.push_back(at(pieces * h));
  knots.insert(knots.end(), 4, pieces * h);
  return *NurbsCurve::from_cartesian(3, knots, poles, {});
}

Point in_cover(const Surface& s, Uv uv, double period_u) {
  const SurfaceDomain d = domain(s);
  if (period_u > 0 && d.period_u == 0)
    uv.u = d.u.lo + std::fmod(std::fmod(uv.u - d.u.lo, period_u) + period_u, period_u);
  return evaluate(s, uv);
}

// Largest distance at many places; never above the bound.
double check(const ProjectedCurve& p, const Curve& c, Interval r, const Surface& s, double period_u = 0) {
  double worst = 0;
  for (int i = 0; i <= 3000; ++i) {
    const double x = i / 3000.0;
    worst = std::max(worst, distance(in_cover(s, evaluate(p.pcurve, p.range.at(x)), period_u), evaluate(c, r.at(x))));
  }
  BOOST_TEST(p.deviation.proven());
  BOOST_TEST(worst <= p.deviation.bound_mm);
  BOOST_TEST(p.deviation.bound_mm <= 1.06 * p.deviation.measured_mm + 1.1e-7);
  return worst;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(projected_curves)

BOOST_AUTO_TEST_CASE(a_thread_of_ten_turns_on_a_cylinder) {
  const Frame f = tilted_frame();
  const Surface cylinder{Cylinder{f, 5}};
  for (const int per_turn : {3, 4, 8, 32}) {
    BOOST_TEST_CONTEXT(per_turn << " pieces to the turn") {
      const Curve c{thread(f, 5, 0, 1.25, 10, per_turn)};
      const auto p = project(c, range(c), cylinder);
      BOOST_REQUIRE(p);
      check(*p, c, range(c), cylinder);
      const double turn = evaluate(p->pcurve, p->range.hi).u - evaluate(p->pcurve, p->range.lo).u;
      BOOST_TEST(std::abs(turn - 10 * two_pi) < 1e-6);
      // Hermite pieces of a circle leave it by about r h^4 / 384; that is all the distance there is.
      BOOST_TEST(p->deviation.bound_mm < 5 * std::pow(two_pi / per_turn, 4) / 300 + 1e-6);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_thread_of_ten_turns_on_a_spline_cylinder) {
  const Frame f = tilted_frame();
  const Surface analytic{Cylinder{f, 5}};
  const auto tube = to_nurbs(analytic, {0, two_pi}, {-1, 14});
  BOOST_REQUIRE(tube);
  const Surface s{tube->surface};
  const double period = tube->surface.range_u().length();
  const Curve c{thread(f, 5, 0, 1.25, 10, 16)};
  const auto p = project(c, range(c), s);
  BOOST_REQUIRE(p);
  check(*p, c, range(c), s, period);
  BOOST_TEST(std::abs(evaluate(p->pcurve, p->range.hi).u - evaluate(p->pcurve, p->range.lo).u - 10 * period) < 1e-6);
}

BOOST_AUTO_TEST_CASE(a_conical_thread) {
  const Frame f = tilted_frame();
  const Surface cone{Cone{f, 5, 0.2}};
  const Curve c{thread(f, 5, std::tan(0.2), 1.25, 12, 16)};
  const auto p = project(c, range(c), cone);
  BOOST_REQUIRE(p);
  check(*p, c, range(c), cone);
  BOOST_TEST(std::abs(evaluate(p->pcurve, p->range.hi).u - evaluate(p->pcurve, p->range.lo).u - 12 * two_pi) < 1e-6);
}

BOOST_AUTO_TEST_CASE(the_sheet_asked_for) {
  const Surface cylinder{Cylinder{Frame{}, 1}};
  const Curve arc{Circle{Frame{}, 1, {0.5, 2}}};
  ProjectOptions o;
  o.start = Uv{0.5 + 3 * two_pi, 0};
  const auto p = project(arc, {0.5, 2}, cylinder, o);
  BOOST_REQUIRE(p);
  BOOST_TEST(std::abs(evaluate(p->pcurve, p->range.lo).u - (0.5 + 3 * two_pi)) < 1e-9);
  check(*p, arc, {0.5, 2}, cylinder);
}

BOOST_AUTO_TEST_CASE(curves_on_and_off_a_wavy_spline) {
  const NurbsSurface wavy = wavy_surface(9);
  const Surface s{wavy};
  // On it: a skew line of its parameters, as a fine cubic; off it: the same, lifted.
  for (const double lift : {0.0, 1e-3, 0.05}) {
    BOOST_TEST_CONTEXT("lifted by " << lift) {
      std::vector<Point> points;
      for (int i = 0; i <= 60; ++i) {
        const Uv uv{0.2 + 2.5 * i / 60, 3.7 - 3.3 * i / 60};
        points.push_back(evaluate(s, uv) + lift * normal(s, uv));
      }
      std::vector<double> knots(4, 0.0);
      for (int i = 1; i + 3 <= 60; ++i) knots.push_back(i);
      knots.insert(knots.end(), 4, 58.0);
      const Curve c{*NurbsCurve::from_cartesian(3, knots, points, {})};
      const auto p = project(c, range(c), s);
      BOOST_REQUIRE(p);
      const double worst = check(*p, c, range(c), s);
      double off = 0;  // the curve's own distance from the surface
      for (int i = 0; i <= 3000; ++i)
        off = std::max(off, closest_point(s, evaluate(c, range(c).at(i / 3000.0))).distance);
      BOOST_TEST(worst <= off * (1 + 1e-6) + 1e-6);
    }
  }
}

BOOST_AUTO_TEST_CASE(what_cannot_be_asked) {
  const Surface plane{Plane{}};
  BOOST_TEST(!project({Line{{0, 0, 0}, {1, 0, 0}}}, {1, 1}, plane));
  BOOST_TEST(!project({Line{{0, 0, 0}, {1, 0, 0}, {0, infinity}}}, {0, infinity}, plane));
}

BOOST_AUTO_TEST_SUITE_END()
