#include "kernel/pcurve/deviation.h"

#include <boost/test/unit_test.hpp>
#include <random>

#include "tests/kernel/geometry/shapes.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

double sampled(const Curve2& p, const Surface& s, const Curve& c, Interval r, int n = 4000) {
  double worst = 0;
  for (int i = 0; i <= n; ++i) {
    const double t = r.at(double(i) / n);
    worst = std::max(worst, distance(evaluate(s, evaluate(p, t)), evaluate(c, t)));
  }
  return worst;
}

NurbsCurve spline(const std::vector<Point>& poles, Interval range) {
  const std::size_t n = poles.size();
  std::vector<double> knots(4, range.lo);
  for (std::size_t i = 1; i + 3 < n; ++i) knots.push_back(range.at(double(i) / double(n - 3)));
  knots.insert(knots.end(), 4, range.hi);
  return *NurbsCurve::from_cartesian(3, knots, poles, {});
}

// One of each type of surface, with a rectangle to draw in.
struct Sheet {
  std::string name;
  Surface surface;
  Interval u, v;
};
std::vector<Sheet> sheets() {
  const Frame f = tilted_frame();
  const CurvePtr wavy = share(wavy_curve());
  const SurfacePtr bumpy = std::make_shared<const Surface>(Surface{wavy_surface(5)});
  std::vector<Sheet> out;
  out.push_back({"plane", {Plane{f}}, {-2, 3}, {-1, 4}});
  out.push_back({"cylinder", {Cylinder{f, 1.5}}, {-7, 9}, {-1, 4}});
  out.push_back({"cone", {Cone{f, 1.5, 0.4}}, {-7, 9}, {-1, 4}});
  out.push_back({"sphere", {Sphere{f, 2}}, {-4, 6}, {-1.5, 1.5}});
  out.push_back({"torus", {Torus{f, 3, 1}}, {-4, 6}, {-5, 7}});
  out.push_back({"revolution", {Revolution{{0, -9, 0}, {1, 0, 0}, wavy}}, {0, 6}, {0.1, 3.9}});
  out.push_back({"extrusion", {Extrusion{wavy, {0.3, 0.1, 1}}}, {0.1, 3.9}, {0, 1}});
  out.push_back({"ruled", {make_ruled(wavy, share(Line{{0, 0, 3}, {8, 0, 5}}), true)}, {0.02, 0.98}, {0, 1}});
  out.push_back({"NURBS", *bumpy, {0.1, 2.9}, {0.1, 3.9}});
  out.push_back({"offset", {OffsetSurface{bumpy, 0.05}}, {0.1, 2.9}, {0.1, 3.9}});
  return out;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(deviation_of_pcurves)

BOOST_AUTO_TEST_CASE(never_below_what_is_sampled_and_little_above) {
  std::mt19937 random(17);
  const auto real = [&](double lo, double hi) { return lo + (hi - lo) * static_cast<double>(random()) / 4294967295.0; };
  for (const Sheet& sheet : sheets())
    for (int k = 0; k < 12; ++k) {
      BOOST_TEST_CONTEXT(sheet.name << ' ' << k) {
        std::vector<Point> uv, xyz;
        const double off = std::pow(10, real(-7, 0));
        for (int i = 0; i < 7; ++i) uv.push_back({sheet.u.at(real(0, 1)), sheet.v.at(real(0, 1)), 0});
        const Curve2 pcurve{Curve{spline(uv, {1, 3})}};
        // A curve near it: a polyline of its points moved a little, smoothed by being poles.
        for (int i = 0; i < 40; ++i) {
          const Point p = evaluate(sheet.surface, evaluate(pcurve, Interval{1, 3}.at(i / 39.0)));
          xyz.push_back(p + off * Vector{real(-1, 1), real(-1, 1), real(-1, 1)});
        }
        const Curve curve{spline(xyz, {1, 3})};
        const Deviation d = deviation(pcurve, {1, 3}, sheet.surface, curve, {1, 3});
        const double seen = sampled(pcurve, sheet.surface, curve, {1, 3});
        BOOST_TEST(d.proven());
        BOOST_TEST(seen <= d.bound_mm);
        BOOST_TEST(d.measured_mm <= d.bound_mm);
        BOOST_TEST(d.bound_mm <= 1.06 * seen + 2e-9);
        BOOST_TEST(d.measured_mm <=
                   distance(evaluate(sheet.surface, evaluate(pcurve, d.at)), evaluate(curve, d.at)) + 1e-12);
      }
    }
}

BOOST_AUTO_TEST_CASE(exact_images_deviate_by_rounding) {
  const Surface cylinder{Cylinder{Frame{}, 2}};
  const Curve2 across = make_line2({1, 0.5}, {4, 0.5});
  const Curve arc{Circle{Frame{{0, 0, 0.5}}, 2, {1, 4}}};
  DeviationOptions tight;
  tight.floor_mm = 1e-14;
  BOOST_TEST(deviation(across, {0, 1}, cylinder, arc, {1, 4}, tight).bound_mm < 1e-13);
  const NurbsSurface wavy = wavy_surface(3);
  const Curve iso{isocurve_u(wavy, 1.3)};
  BOOST_TEST(deviation(make_line2({1.3, 0}, {1.3, 4}), {0, 1}, {wavy}, iso, {0, 4}, tight).bound_mm < 1e-11);
}

BOOST_AUTO_TEST_CASE(a_known_distance_is_found) {
  // A circle of radius 2 + 1e-4 against the cylinder of radius 2, and a chord against its arc.
  const Surface cylinder{Cylinder{Frame{}, 2}};
  const Deviation d =
      deviation(make_line2({0, 0}, {two_pi, 0}), {0, 1}, cylinder, {Circle{Frame{}, 2 + 1e-4}}, {0, two_pi});
  BOOST_TEST(std::abs(d.bound_mm - 1e-4) < 6e-6);
  BOOST_TEST(std::abs(d.measured_mm - 1e-4) < 1e-12);
  const Deviation chord =
      deviation({Line{{0, 0, 0}, {1, 0, 0}}}, {0, 1},
                {Parabola{Frame{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}}, 0.5, {0, 1}}}, {0, 1});
  BOOST_TEST(chord.measured_mm <= 0.5);
  BOOST_TEST(chord.bound_mm >= 0.5 - 1e-12);
  BOOST_TEST(chord.bound_mm <= 0.53);
}

BOOST_AUTO_TEST_CASE(over_the_seam_of_a_spline_that_closes) {
  const auto tube = to_nurbs(Surface{Cylinder{Frame{}, 1}}, {0, two_pi}, {0, 1});
  BOOST_REQUIRE(tube);
  const double period = tube->surface.range_u().length();
  // Two full turns along the spline's own u, against two turns of the spline's own section.
  const NurbsCurve section = isocurve_v(tube->surface, 0.5);
  const Curve2 twice = make_line2({0, 0.5}, {2 * period, 0.5});
  DeviationOptions o;
  o.period_u = period;
  const CurvePtr once = share(section);
  const Curve curve{make_composite({{once, false}, {once, false}})};
  const Deviation d = deviation(twice, {0, 1}, {tube->surface}, curve, range(curve), o);
  BOOST_TEST(d.bound_mm < 1.1e-9);
}

BOOST_AUTO_TEST_SUITE_END()
