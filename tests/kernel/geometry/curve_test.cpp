// Points, derivatives, ranges, joints and lengths of every curve type.

#include "kernel/geometry/curve.h"

#include <boost/test/unit_test.hpp>

#include "shapes.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

void check_derivatives(const Curve& c, double t, double scale = 1) {
  const double h = 1e-5;
  const CurveJet j = jet(c, t);
  const Vector d1 = (evaluate(c, t + h) - evaluate(c, t - h)) / (2 * h);
  const Vector d2 = (jet(c, t + h).d1 - jet(c, t - h).d1) / (2 * h);
  BOOST_TEST(distance(j.point, evaluate(c, t)) == 0);
  BOOST_TEST(norm(j.d1 - d1) <= 1e-8 * scale);
  BOOST_TEST(norm(j.d2 - d2) <= 1e-8 * scale);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(curves)

BOOST_AUTO_TEST_CASE(conics_have_their_closed_forms) {
  const Frame f = tilted_frame();
  const double t = 0.7;
  BOOST_TEST(distance(evaluate(Curve{Circle{f, 3}}, t), f.origin + 3 * (std::cos(t) * f.x + std::sin(t) * f.y)) <
             1e-15);
  BOOST_TEST(distance(evaluate(Curve{Ellipse{f, 3, 5}}, t),
                      f.origin + (3 * std::cos(t) * f.x + 5 * std::sin(t) * f.y)) < 1e-14);
  BOOST_TEST(distance(evaluate(Curve{Parabola{f, 2}}, t), f.origin + (2 * t * t * f.x + 4 * t * f.y)) < 1e-14);
  BOOST_TEST(distance(evaluate(Curve{Hyperbola{f, 2, 3}}, t),
                      f.origin + (2 * std::cosh(t) * f.x + 3 * std::sinh(t) * f.y)) < 1e-14);
}

BOOST_AUTO_TEST_CASE(derivatives_are_those_of_the_points) {
  for (const Curve& c : every_curve()) {
    const Interval r = range(c);
    for (const double f : {0.13, 0.41, 0.77}) check_derivatives(c, r.at(f), 100);
  }
}

BOOST_AUTO_TEST_CASE(a_line_meets_both_its_points_exactly) {
  const Curve c{Line{{0.1, 0.2, 0.3}, {1e9 + 0.7, -0.3, 1e-9}}};
  BOOST_TEST(distance(end_point(c), Point{1e9 + 0.7, -0.3, 1e-9}) == 0);
  BOOST_TEST(distance(start_point(c), Point{0.1, 0.2, 0.3}) == 0);
  BOOST_TEST(distance(evaluate(Curve{Line{{0, 0, 0}, {1, 2, 3}}}, 5), Point{5, 10, 15}) == 0);
}

BOOST_AUTO_TEST_CASE(an_unbounded_line_has_no_breaks) {
  const Curve c{Line{{0, 0, 0}, {1, 0, 0}, {-infinity, infinity}}};
  BOOST_TEST(!is_bounded(c));
  BOOST_TEST(breaks(c).empty());
  BOOST_TEST(std::isinf(length(c)));
  BOOST_TEST(bounding_box(c).empty());
  const Curve ray{Line{{0, 0, 0}, {1, 0, 0}, {0, infinity}}};
  BOOST_TEST(breaks(ray).size() == 1u);
}

BOOST_AUTO_TEST_CASE(a_polyline_is_clamped_and_met_at_its_points) {
  const Curve c{Polyline{{{0, 0, 0}, {1, 0, 0}, {1, 3, 0}}}};
  BOOST_TEST(range(c).hi == 2);
  BOOST_TEST(breaks(c).size() == 3u);
  BOOST_TEST(distance(evaluate(c, 1), Point{1, 0, 0}) == 0);
  BOOST_TEST(distance(evaluate(c, -5), Point{0, 0, 0}) == 0);
  BOOST_TEST(distance(evaluate(c, 7), Point{1, 3, 0}) == 0);
  BOOST_TEST(jet(c, 1).d1.y == 3);  // of the piece that begins there
  BOOST_TEST(jet(c, 2).d1.y == 3);
  BOOST_TEST(length(c) == 4);
}

BOOST_AUTO_TEST_CASE(degenerate_curves_answer_without_harm) {
  for (const Curve& c : {Curve{Polyline{}}, Curve{Polyline{{{1, 2, 3}}}}, Curve{CompositeCurve{}}, Curve{OffsetCurve{}},
                         Curve{Line{{1, 1, 1}, {1, 1, 1}}}, Curve{Circle{{}, 0}}}) {
    BOOST_TEST(is_finite(evaluate(c, 0.3)));
    BOOST_TEST(is_finite(jet(c, 0.3).d1));
    BOOST_TEST(breaks(c).size() >= 2u);
    BOOST_TEST(length(c) == 0);
    BOOST_TEST(is_finite(start_point(reversed(c))));
    const CurveFoot foot = closest_point(c, {4, 5, 6});
    BOOST_TEST(std::isfinite(foot.distance));
    BOOST_TEST(std::isfinite(closest_point_near(c, {4, 5, 6}, 0.5).distance));
  }
}

BOOST_AUTO_TEST_CASE(a_composite_adds_the_spans_of_its_children_and_may_turn_them) {
  const CurvePtr a = share(Line{{0, 0, 0}, {2, 0, 0}, {0, 2}});   // to (4,0,0)
  const CurvePtr b = share(Circle{{{4, 1, 0}}, 1, {0, pi / 2}});  // (5,1) .. (4,2), to be turned
  const CurvePtr c = share(Polyline{{{5, 1, 0}, {6, 1, 0}, {6, 5, 0}}});
  const CompositeCurve composite = make_composite({{a}, {nullptr}, {b, true}, {c}});
  const Curve curve{composite};
  BOOST_REQUIRE(composite.segments.size() == 3u);
  BOOST_TEST(range(curve).hi == 2 + pi / 2 + 2, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(distance(evaluate(curve, 1), Point{2, 0, 0}) == 0);
  BOOST_TEST(distance(evaluate(curve, 2), evaluate(*b, pi / 2)) == 0);
  BOOST_TEST(distance(evaluate(curve, 2.5), evaluate(*b, pi / 2 - 0.5)) < 1e-15);
  BOOST_TEST(norm(jet(curve, 2.5).d1 + jet(*b, pi / 2 - 0.5).d1) < 1e-15);
  BOOST_TEST(norm(jet(curve, 2.5).d2 - jet(*b, pi / 2 - 0.5).d2) < 1e-15);
  BOOST_TEST(distance(end_point(curve), Point{6, 5, 0}) == 0);
  BOOST_TEST(distance(evaluate(curve, 100), Point{6, 5, 0}) == 0);
  BOOST_TEST(breaks(curve).size() == 5u);
  BOOST_TEST(length(curve) == 4 + pi / 2 + 5, boost::test_tools::tolerance(1e-14));
  const Curve back = reversed(curve);
  for (const double t : {0.0, 0.5, 1.9, 2.7, 4.0})
    BOOST_TEST(distance(evaluate(back, range(back).lo + (range(curve).hi - t)), evaluate(curve, t)) < 1e-13);
}

BOOST_AUTO_TEST_CASE(a_composite_takes_a_unit_of_an_unbounded_line) {
  const CompositeCurve c = make_composite({{share(Line{{1, 0, 0}, {2, 0, 0}, {0, infinity}})}});
  BOOST_TEST(range(Curve{c}).hi == 1);
  BOOST_TEST(distance(end_point(Curve{c}), Point{2, 0, 0}) == 0);
}

BOOST_AUTO_TEST_CASE(composites_nest) {
  const CurvePtr inner =
      share(make_composite({{share(Line{{0, 0, 0}, {1, 0, 0}})}, {share(Line{{1, 0, 0}, {1, 1, 0}})}}));
  const Curve outer{make_composite({{inner, true}, {share(Line{{0, 0, 0}, {0, -1, 0}})}})};
  BOOST_TEST(distance(evaluate(outer, 0.25), Point{1, 0.75, 0}) == 0);
  BOOST_TEST(distance(evaluate(outer, 1.25), Point{0.75, 0, 0}) == 0);
  BOOST_TEST(breaks(outer).size() == 4u);
}

BOOST_AUTO_TEST_CASE(lengths_agree_with_closed_forms) {
  const Frame f = tilted_frame();
  BOOST_TEST(length(Curve{Circle{f, 3, {1, 2.5}}}) == 4.5, boost::test_tools::tolerance(1e-15));
  // Perimeter of the ellipse 2, 1: 4 a E(e), E(3/4) = 1.2110560275684594...
  BOOST_TEST(length(Curve{Ellipse{f, 2, 1}}) == 8 * 1.2110560275684595, boost::test_tools::tolerance(1e-12));
  // y^2 = 4 f x from the vertex to t = 1: f (t sqrt(1 + t^2) + asinh t).
  BOOST_TEST(length(Curve{Parabola{f, 2, {0, 1}}}) == 2 * (std::sqrt(2.0) + std::asinh(1.0)),
             boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_parallel_of_a_circle_is_a_circle) {
  const Frame f = tilted_frame();
  const Curve c{OffsetCurve{share(Circle{f, 3}), 0.5, f.z}};
  for (const double t : {0.0, 1.0, 5.0}) {
    BOOST_TEST(distance(evaluate(c, t), evaluate(Curve{Circle{f, 3.5}}, t)) < 1e-14);
    BOOST_TEST(norm(jet(c, t).d1 - jet(Curve{Circle{f, 3.5}}, t).d1) < 1e-14);
    BOOST_TEST(norm(jet(c, t).d2 - jet(Curve{Circle{f, 3.5}}, t).d2) < 1e-14);
  }
}

BOOST_AUTO_TEST_SUITE_END()
