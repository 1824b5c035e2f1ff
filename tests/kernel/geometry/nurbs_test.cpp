// Exact conversion to NURBS: the shape, and the parameter map both ways.

#include <boost/test/unit_test.hpp>

#include "shapes.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

void check_curve(const Curve& c) {
  const auto nurbs = to_nurbs(c);
  BOOST_REQUIRE(nurbs.has_value());
  BOOST_TEST(nurbs->deviation == 0);
  const double size = bounding_box(c).diagonal() + norm(to_vector(start_point(c)));
  for (int i = 0; i <= 200; ++i) {
    const double t = range(c).at(i / 200.0);
    const double s = map_to_nurbs(*nurbs, t);
    BOOST_TEST(distance(evaluate(nurbs->curve, s), evaluate(c, t)) <= 1e-13 * size);
    BOOST_TEST(std::abs(map_from_nurbs(*nurbs, s) - t) <= 1e-13 * (1 + std::abs(t)));
  }
  BOOST_TEST(map_to_nurbs(*nurbs, range(c).lo) == nurbs->curve.range().lo);
  BOOST_TEST(map_to_nurbs(*nurbs, range(c).hi) == nurbs->curve.range().hi);
}

void check_surface(const Surface& s, Interval u, Interval v) {
  const auto nurbs = to_nurbs(s, u, v);
  BOOST_REQUIRE(nurbs.has_value());
  const Box box = bounding_box(s, u, v);
  const double size = box.diagonal() + norm(to_vector(box.lo));
  for (int i = 0; i <= 30; ++i)
    for (int k = 0; k <= 30; ++k) {
      const Uv p{u.at(i / 30.0), v.at(k / 30.0)};
      const Uv q = map_to_nurbs(*nurbs, p);
      BOOST_TEST(distance(evaluate(nurbs->surface, q), evaluate(s, p)) <= 1e-13 * size);
      BOOST_TEST(norm(map_from_nurbs(*nurbs, q) - p) <= 1e-12);
    }
  BOOST_TEST(nurbs->surface.range_u().lo == map_to_nurbs(nurbs->map_u, u.lo));
  BOOST_TEST(nurbs->surface.range_v().hi == map_to_nurbs(nurbs->map_v, v.hi));
}

}  // namespace

BOOST_AUTO_TEST_SUITE(to_nurbs_is_exact)

BOOST_AUTO_TEST_CASE(curves_keep_their_points) {
  for (const Curve& c : every_curve())
    if (!std::holds_alternative<OffsetCurve>(c.shape) && !std::holds_alternative<CompositeCurve>(c.shape))
      check_curve(c);
  const Frame f = tilted_frame();
  for (const Interval r : {Interval{0, two_pi}, Interval{-1, -0.9}, Interval{3, 3 + two_pi}, Interval{0, pi / 2}}) {
    check_curve(Curve{Circle{f, 3, r}});
    check_curve(Curve{Ellipse{f, 3, 0.5, r}});
  }
  check_curve(Curve{Hyperbola{f, 3, 0.5, {-4, 3}}});
  check_curve(with_range(Curve{wavy_curve()}, {0.5, 3}));
}

BOOST_AUTO_TEST_CASE(a_full_circle_closes_to_the_bit) {
  const auto nurbs = to_nurbs(Curve{Circle{tilted_frame(), 3}});
  BOOST_REQUIRE(nurbs.has_value());
  BOOST_TEST(nurbs->curve.poles().size() == 9u);
  BOOST_TEST(distance(project(nurbs->curve.poles().front()), project(nurbs->curve.poles().back())) == 0);
}

BOOST_AUTO_TEST_CASE(a_composite_mixes_arcs_lines_and_splines) {
  const CurvePtr line = share(Line{{0, 0, 0}, {1, 0, 0}, {0, 2}});
  const CurvePtr arc = share(Circle{{{2, 1, 0}}, 1, {-pi / 2, 2}});
  const Point end = end_point(*arc);
  const CurvePtr back = share(Polyline{{{5, 5, 5}, {3, 1, 1}, end}});
  const CurvePtr spline = share(transformed(Curve{wavy_curve()}, Transform::translation({5, 5, 5})).value());
  check_curve(Curve{make_composite({{line}, {arc}, {share(reversed(*back))}})});
  check_curve(Curve{make_composite(
      {{line}, {arc}, {share(reversed(*back)), false}, {share(Line{{5, 5, 5}, {5, 5, 5}}), true}, {spline}})});
  const CurvePtr nested = share(make_composite({{line}, {arc}}));
  check_curve(
      Curve{make_composite({{share(reversed(*back)), true}, {nested, true}, {share(Line{{0, 0, 0}, {-1, 2, 0}})}})});
}

BOOST_AUTO_TEST_CASE(gaps_of_a_composite_are_told) {
  const Curve c{make_composite({{share(Line{{0, 0, 0}, {1, 0, 0}})}, {share(Line{{1, 1e-3, 0}, {1, 5, 0}})}})};
  const auto nurbs = to_nurbs(c);
  BOOST_REQUIRE(nurbs.has_value());
  BOOST_TEST(nurbs->deviation == 1e-3, boost::test_tools::tolerance(1e-12));
  for (int i = 0; i <= 100; ++i) {
    const double t = 2 * i / 100.0;
    BOOST_TEST(distance(evaluate(nurbs->curve, map_to_nurbs(*nurbs, t)), evaluate(c, t)) <= 1e-3 * (1 + 1e-12));
  }
}

BOOST_AUTO_TEST_CASE(what_is_no_spline_is_refused) {
  BOOST_TEST(!to_nurbs(Curve{Line{{}, {1, 0, 0}, {0, infinity}}}).has_value());
  BOOST_TEST(!to_nurbs(Curve{Polyline{{{1, 1, 1}}}}).has_value());
  BOOST_TEST(!to_nurbs(Curve{CompositeCurve{}}).has_value());
  BOOST_TEST(!to_nurbs(Curve{Circle{{}, 1, {1, 1}}}).has_value());
  BOOST_TEST((to_nurbs(Curve{OffsetCurve{share(wavy_curve()), 1}}).error().code == ErrorCode::Unsupported));
  BOOST_TEST(!to_nurbs(Surface{Plane{}}, {-infinity, 1}, {0, 1}).has_value());
  BOOST_TEST(!to_nurbs(Surface{Plane{}}, {0, 0}, {0, 1}).has_value());
  BOOST_TEST(!to_nurbs(Surface{Ruled{}}, {0, 1}, {0, 1}).has_value());
  BOOST_TEST(!to_nurbs(Surface{Revolution{}}, {0, 1}, {0, 1}).has_value());
}

BOOST_AUTO_TEST_CASE(surfaces_keep_their_points) {
  for (const Patch& patch : every_patch()) {
    if (std::holds_alternative<OffsetSurface>(patch.surface.shape)) continue;
    if (const auto* ruled = std::get_if<Ruled>(&patch.surface.shape); ruled && ruled->equal_arc_length) continue;
    BOOST_TEST_CONTEXT(patch.name) {
      check_surface(patch.surface, patch.u, patch.v);
      check_surface(patch.surface, {patch.u.at(0.2), patch.u.at(0.9)}, {patch.v.at(0.1), patch.v.at(0.5)});
    }
  }
}

BOOST_AUTO_TEST_CASE(a_generatrix_may_touch_the_axis) {
  const Frame f = tilted_frame();
  const CurvePtr half = share(Circle{{f.origin, f.x, f.z, -f.y}, 2, {-pi / 2, pi / 2}});
  check_surface(Surface{Revolution{f.origin, f.z, half}}, {0, two_pi}, {-pi / 2, pi / 2});
  check_surface(Surface{Cone{f, 0, 0.5}}, {0, two_pi}, {0, 3});
}

BOOST_AUTO_TEST_CASE(ruled_surfaces_of_unlike_curves) {
  const Frame f = tilted_frame();
  const CurvePtr cubic = share(wavy_curve()), line = share(Line{{0, 0, 9}, {9, 0, 9}});
  const CurvePtr polyline = share(Polyline{{{0, 0, 5}, {1, 2, 5}, {4, 3, 6}, {7, 0, 5}}});
  const std::vector<Point> poles{{0, 0, 0}, {1, 3, 0}, {4, 3, 0}, {6, 0, 0}};
  const CurvePtr polynomial = share(*NurbsCurve::from_cartesian(2, {0, 0, 0, 0.3, 1, 1, 1}, poles, {}));
  const Interval unit{0, 1};
  check_surface(Surface{make_ruled(polynomial, line)}, unit, unit);            // weights one
  check_surface(Surface{make_ruled(polynomial, polyline, true)}, unit, unit);  // degrees and knots differ
  check_surface(Surface{make_ruled(cubic, polyline)}, unit, unit);             // weights differ
  check_surface(Surface{make_ruled(cubic, share(reversed(Curve{wavy_curve()})))}, {0.1, 0.8}, {0.2, 1});
  const CurvePtr arc = share(Circle{f, 2, {0, 4}}),
                 ellipse = share(Ellipse{{f.origin + 5 * f.z, f.x, f.y, f.z}, 3, 1, {1, 5}});
  check_surface(Surface{make_ruled(arc, ellipse)}, unit, unit);
  check_surface(Surface{make_ruled(arc, ellipse, true)}, {0.3, 0.7}, {0, 0.5});
  check_surface(Surface{make_ruled(arc, share(Circle{f, 3, {0, 4}}), false, true)}, unit,
                unit);  // lengths: still angles
  BOOST_TEST((to_nurbs(Surface{make_ruled(arc, line)}, unit, unit).error().code == ErrorCode::Unsupported));
  BOOST_TEST((to_nurbs(Surface{make_ruled(arc, share(Circle{f, 3, {0, 3}}))}, unit, unit).error().code ==
              ErrorCode::Unsupported));
  BOOST_TEST(
      (to_nurbs(Surface{make_ruled(cubic, line, false, true)}, unit, unit).error().code == ErrorCode::Unsupported));
}

BOOST_AUTO_TEST_CASE(knots_that_differ_by_rounding_are_one) {
  std::vector<double> a{0, 0}, b{0, 0};
  std::vector<Point> poles{{0, 0, 0}};
  for (int i = 1; i < 10; ++i) {
    a.push_back(i * 0.1);
    b.push_back(1 - (10 - i) * 0.1);
    poles.push_back({i * 1.0, i % 2 * 1.0, 0});
  }
  a.insert(a.end(), {1, 1});
  b.insert(b.end(), {1, 1});
  poles.push_back({10, 0, 0});
  BOOST_REQUIRE(a != b);
  const CurvePtr first = share(*NurbsCurve::from_cartesian(1, a, poles, {}));
  const CurvePtr second = share(*NurbsCurve::from_cartesian(1, b, poles, {}));
  const auto nurbs = to_nurbs(Surface{make_ruled(first, second)}, {0, 1}, {0, 1});
  BOOST_REQUIRE(nurbs.has_value());
  BOOST_TEST(nurbs->surface.poles_u() == 11u);
}

BOOST_AUTO_TEST_SUITE_END()
