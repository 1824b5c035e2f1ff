// Offsets: exact where they are, bounds that hold, and nothing left nearer to the curve than the distance.
#include "kernel/geometry/offset.h"

#include <boost/test/unit_test.hpp>

#include "kernel/nurbs/construct_conic.h"
#include "shapes.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

const Vector up{0, 0, 1};

// The least distance to a curve by many samples and a little descent, independent of closest_point.
double sampled_distance(const Curve& c, Point p) {
  const Interval r = range(c);
  double best = infinity, at = 0;
  constexpr int n = 2000;
  for (int i = 0; i <= n; ++i)
    if (const double d = distance(evaluate(c, r.at(i / double{n})), p); d < best) best = d, at = r.at(i / double{n});
  for (double step = r.length() / n; step > 1e-12 * r.length(); step /= 2)
    for (const double t : {r.clamp(at - step), r.clamp(at + step)})
      if (const double d = distance(evaluate(c, t), p); d < best) best = d, at = t;
  return best;
}

// Every point of the pieces is at the distance from the curve, within the bound.
void keeps_its_distance(const Curve& base, const CurveOffset& o, double d, double within) {
  for (const auto& chain : o.chains)
    for (const Curve& piece : chain)
      for (int i = 0; i <= 6; ++i) {
        const double off = sampled_distance(base, evaluate(piece, range(piece).at(i / 6.0)));
        BOOST_TEST(std::abs(off - std::abs(d)) <= o.bound + within);
      }
}

NurbsCurve flat_wave() {
  const std::vector<Point> poles{{0, 0}, {2, 4}, {4, -3}, {6, 4}, {8, -2}, {10, 1}};
  return NurbsCurve::from_cartesian(3, {0, 0, 0, 0, 1, 2, 3, 3, 3, 3}, poles, std::vector<double>{1, 2, 1, 0.7, 1, 1})
      .value();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(offsets)

BOOST_AUTO_TEST_CASE(lines_and_circles_are_exact) {
  const CurveOffset l = offset(Curve{Line{{0, 0, 0}, {4, 0, 0}}}, 2, up).value();
  BOOST_TEST(l.bound == 0);
  BOOST_TEST(distance(start_point(l.chains.at(0).at(0)), {0, -2, 0}) < 1e-15);
  for (const double d : {1.0, -1.0, -5.0}) {
    const CurveOffset c = offset(Curve{Circle{{}, 3}}, d, up, {1e-6, false}).value();
    BOOST_TEST(c.bound == 0);
    BOOST_TEST(std::get<Circle>(c.chains.at(0).at(0).shape).radius == std::abs(3 + d));
    const Curve exact{OffsetCurve{share(Circle{{}, 3}), d, up}};
    for (const double t : {0.0, 1.0, 4.0})
      BOOST_TEST(distance(evaluate(c.chains[0][0], t), evaluate(exact, t)) < 1e-14);
  }
  // Past its centre nothing is left when it is trimmed.
  BOOST_TEST(offset(Curve{Circle{{}, 3}}, -5, up)->chains.empty());
  BOOST_TEST(offset(Curve{quintic_circle({}, 3).value()}, 1, up)->bound == 0);  // recognized
}

BOOST_AUTO_TEST_CASE(splines_are_within_the_bound) {
  for (const double tolerance : {1e-3, 1e-6}) {
    for (const double d : {0.2, -0.15, 0.6}) {
      const Curve base{flat_wave()}, exact{OffsetCurve{share(flat_wave()), d, up}};
      const CurveOffset o = offset(base, d, up, {tolerance, false}).value();
      BOOST_TEST(o.bound <= tolerance);
      double worst = 0;
      for (const Curve& piece : o.chains.at(0)) {
        const Interval r = range(piece);  // its parameter is that of the curve
        for (int i = 0; i <= 40; ++i)
          worst = std::max(worst, distance(evaluate(piece, r.at(i / 40.0)), evaluate(exact, r.at(i / 40.0))));
      }
      BOOST_TEST(worst <= o.bound);
      BOOST_TEST(worst > 1e-3 * o.bound);  // and not a bound of no worth
    }
  }
}

BOOST_AUTO_TEST_CASE(swallowtails_are_trimmed) {
  // The ellipse 5, 2 bends with a radius of 0.8 at its ends: inside, at 1.5, both ends turn inside out.
  const Curve ellipse{Ellipse{{}, 5, 2}};
  const CurveOffset o = offset(ellipse, -1.5, up, {1e-6}).value();
  BOOST_TEST(o.trimmed > 0);
  BOOST_TEST(o.chains.size() >= 1u);
  keeps_its_distance(ellipse, o, 1.5, 1e-8);
  const CurveOffset all = offset(ellipse, -1.5, up, {1e-6, false}).value();
  BOOST_TEST(all.trimmed == 0);
  const CurveOffset outside = offset(ellipse, 1.5, up).value();
  BOOST_TEST(outside.trimmed == 0);
  keeps_its_distance(ellipse, outside, 1.5, 1e-8);
  for (const double d : {1.0, -1.2}) {
    const CurveOffset w = offset(Curve{flat_wave()}, d, up).value();
    BOOST_TEST(w.trimmed > 0);
    keeps_its_distance(Curve{flat_wave()}, w, d, 1e-8);
  }
  BOOST_TEST(offset(ellipse, -2.5, up)->chains.empty());
}

BOOST_AUTO_TEST_CASE(corners_are_rounded_outside_and_cut_inside) {
  const Curve square{Polyline{{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0}}}};  // counter-clockwise
  const CurveOffset out = offset(square, 1, up).value(), in = offset(square, -1, up).value();
  BOOST_TEST(out.chains.size() == 1u);
  BOOST_TEST(out.chains[0].size() == 8u);
  double around = 0;
  for (const Curve& c : out.chains[0]) around += length(c);
  BOOST_TEST(std::abs(around - (16 + two_pi)) < 1e-12);
  around = 0;
  for (const auto& chain : in.chains)
    for (const Curve& c : chain) around += length(c);
  BOOST_TEST(std::abs(around - 8) < 1e-12);  // a square of 2
  keeps_its_distance(square, in, 1, 1e-9);
  keeps_its_distance(square, out, 1, 1e-9);
}

BOOST_AUTO_TEST_CASE(what_has_no_offset_is_refused) {
  BOOST_TEST(!offset(Curve{wavy_curve()}, 1, up).has_value());  // in no plane
  BOOST_TEST(!offset(Curve{flat_wave()}, 1, {}).has_value());
  BOOST_TEST(!offset(Curve{flat_wave()}, std::nan(""), up).has_value());
  BOOST_TEST(!offset(Curve{Line{{0, 0, 0}, {1, 0, 0}, {0, infinity}}}, 1, up).has_value());
}

BOOST_AUTO_TEST_CASE(elementary_surfaces_are_exact) {
  const Frame f = tilted_frame();
  for (const Surface& s : {Surface{Plane{f}}, Surface{Cylinder{f, 3}}, Surface{Cone{f, 3, 0.4}},
                           Surface{Cone{f, 3, -0.3}}, Surface{Sphere{f, 3}}, Surface{Torus{f, 5, 2}}})
    for (const double d : {0.7, -0.7}) {
      const SurfaceOffset o = offset(s, {0, 1}, {0, 1}, d).value();
      BOOST_TEST(o.bound == 0);
      for (const Uv at : {Uv{0.1, 0.2}, Uv{2, -0.5}, Uv{4, 1}}) {
        const Point p = evaluate(o.surface, at);
        BOOST_TEST(distance(p, evaluate(s, at) + d * normal(s, at)) < 1e-14 * 10);
      }
    }
  // As NURBS they are recognized; the side is that of the NURBS's own normal.
  const NurbsSurface tube = to_nurbs(Surface{Cylinder{f, 3}}, {0, 4}, {0, 2})->surface;
  for (const NurbsSurface& n : {tube, swapped(tube)}) {
    const SurfaceOffset o = offset(Surface{n}, n.range_u(), n.range_v(), 0.5).value();
    BOOST_TEST(o.bound == 0);
    BOOST_TEST(std::abs(std::get<Cylinder>(o.surface.shape).radius -
                        (dot(normal(Surface{n}, {1, 1}), evaluate(n, {1, 1}) - f.origin) > 0 ? 3.5 : 2.5)) < 1e-12);
  }
  // A surface of revolution has double knots but no crease; a folded sheet has one.
  const Surface vase{
      Revolution{f.origin, f.z, share(Line{f.origin + (2 * f.x + f.y), f.origin + (3 * f.x + 5 * f.z)}), {0, 3}}};
  const SurfaceOffset v = offset(vase, {0, 3}, {0, 1}, 0.3, 1e-4).value();
  BOOST_TEST(v.bound <= 1e-4);
  const std::vector<Point> fold{{0, 0, 0}, {0, 1, 0}, {1, 0, 1}, {1, 1, 1}, {2, 0, 0}, {2, 1, 0}};
  const NurbsSurface sheet = NurbsSurface::from_cartesian(1, 1, {0, 0, 1, 2, 2}, {0, 0, 1, 1}, fold, {}).value();
  BOOST_TEST(!offset(Surface{sheet}, {0, 2}, {0, 1}, 0.3).has_value());
  BOOST_TEST(!offset(Surface{Cylinder{f, 3}}, {0, 1}, {0, 1}, -3).has_value());
  BOOST_TEST(!offset(Surface{Torus{f, 5, 2}}, {0, 1}, {0, 1}, -2.5).has_value());
}

BOOST_AUTO_TEST_CASE(freeform_surfaces_are_within_the_bound) {
  for (const double tolerance : {1e-2, 1e-4}) {
    for (const bool rational : {false, true}) {
      std::vector<Point> p;
      std::vector<double> w;
      for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k)
          p.push_back({2.0 * i, 2.0 * k, 0.3 * ((i * 3 + k * 5) % 4)}), w.push_back(1 + 0.2 * ((i + k) % 3));
      if (!rational) w.clear();
      const std::vector<double> b{0, 0, 0, 0, 1, 1, 1, 1};
      const Surface s{NurbsSurface::from_cartesian(3, 3, b, b, p, w).value()};
      const SurfaceOffset o = offset(s, {0, 1}, {0, 1}, 0.5, tolerance).value();
      BOOST_TEST(o.bound <= tolerance);
      double worst = 0;
      for (int i = 0; i <= 60; ++i)
        for (int k = 0; k <= 60; ++k) {
          const Uv at{i / 60.0, k / 60.0};
          worst = std::max(worst, distance(evaluate(o.surface, at), evaluate(s, at) + 0.5 * normal(s, at)));
        }
      BOOST_TEST(worst <= o.bound);
      BOOST_TEST_MESSAGE("surface offset, tolerance " << tolerance << ": bound " << o.bound << ", seen " << worst
                                                      << ", poles "
                                                      << std::get<NurbsSurface>(o.surface.shape).poles().size());
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
