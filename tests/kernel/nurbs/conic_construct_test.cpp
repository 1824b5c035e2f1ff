// Conic arcs by their data, classes by the shape factor, complements (The NURBS Book, chapter 7).
#include <boost/test/unit_test.hpp>

#include "kernel/nurbs/construct_conic.h"
#include "tests/kernel/nurbs/random_nurbs.h"

using namespace trimloop;
using testing::Random;

BOOST_AUTO_TEST_CASE(arcs_begin_and_end_where_they_are_told) {
  const Frame f = make_frame({1, 2, 3}, {1, 1, 1});
  for (const double turn : {0.1, 1.0, 0.5 * pi, 2.0, pi, 4.0, 1.5 * pi, 6.0, two_pi}) {
    const NurbsCurve c = circle_arc(f, 5, {0.3, 0.3 + turn}).value();
    const auto at = [&](double a) { return f.origin + 5 * (std::cos(a) * f.x + std::sin(a) * f.y); };
    BOOST_TEST(distance(evaluate(c, c.range().lo), at(0.3)) < 1e-14);
    BOOST_TEST(distance(evaluate(c, c.range().hi), at(0.3 + turn)) < 1e-14);
    BOOST_TEST(static_cast<int>(bezier_pieces(c).size()) ==
               std::max(1, static_cast<int>(std::ceil(turn / (0.5 * pi) - 1e-12))));
    for (int i = 0; i <= 20; ++i)
      BOOST_TEST(std::abs(distance(evaluate(c, c.range().at(i / 20.0)), f.origin) - 5) < 2e-14);
  }
  BOOST_TEST(!circle_arc(f, 5, {0, 7}).has_value());
  BOOST_TEST(!circle_arc(f, 5, {1, 1}).has_value());
  BOOST_TEST(!circle_arc(f, std::nan(""), {0, 1}).has_value());
}

BOOST_AUTO_TEST_CASE(one_arc_goes_through_its_point_with_its_tangents) {
  Random random(91);
  int made = 0;
  for (int i = 0; i < 500; ++i) {
    // Data from a conic that exists: weights 1, w, 1 over a random triangle, w of either sign.
    const auto point = [&] { return Point{random.real(-5, 5), random.real(-5, 5), random.real(-5, 5)}; };
    const Point a = point(), b = point(), m = point();
    const double w = random.real(-0.9, 4), t = random.real(0.2, 0.8);
    const std::vector<Hpoint> poles{{a.x, a.y, a.z, 1}, {w * m.x, w * m.y, w * m.z, w}, {b.x, b.y, b.z, 1}};
    const NurbsCurve right = NurbsCurve::from_homogeneous(2, {0, 0, 0, 1, 1, 1}, poles).value();
    const auto got = one_conic_arc(a, m - a, b, b - m, evaluate(right, t));
    BOOST_TEST_REQUIRE(got.has_value());
    BOOST_TEST(std::abs(got->poles()[1].w - w) < 1e-9 * (1 + std::abs(w)) * 100);
    BOOST_TEST(distance(evaluate(*got, t), evaluate(right, t)) < 1e-8);
    ++made;
    const auto open = open_conic(a, m - a, b, b - m, evaluate(right, t));
    BOOST_TEST_REQUIRE(open.has_value());
    for (const Hpoint& h : open->poles()) BOOST_TEST(h.w > 0);
    for (int k = 0; k <= 10; ++k) BOOST_TEST(distance(evaluate(*open, k / 10.0), evaluate(*got, k / 10.0)) < 1e-10);
  }
  BOOST_TEST(made == 500);
}

BOOST_AUTO_TEST_CASE(parallel_tangents_give_an_ideal_pole) {
  // The half ellipse x^2 / 9 + y^2 / 4 = 1 over the x axis.
  const double a = 1.1;
  const NurbsCurve c =
      one_conic_arc({3, 0, 0}, {0, 1, 0}, {-3, 0, 0}, {0, -1, 0}, {3 * std::cos(a), 2 * std::sin(a), 0}).value();
  BOOST_TEST(c.poles()[1].w == 0);
  for (int i = 0; i <= 20; ++i) {
    const Point p = evaluate(c, i / 20.0);
    BOOST_TEST(std::abs(p.x * p.x / 9 + p.y * p.y / 4 - 1) < 1e-14);
  }
  BOOST_TEST((conic_class(c)->kind == ConicClass::Ellipse));
  BOOST_TEST(open_conic({3, 0, 0}, {0, 1, 0}, {-3, 0, 0}, {0, -1, 0}, {0, 2, 0})->poles()[1].w > 0);
}

BOOST_AUTO_TEST_CASE(impossible_conic_data_are_refused) {
  BOOST_TEST(!one_conic_arc({0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}).has_value());     // no chord
  BOOST_TEST(!one_conic_arc({0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}).has_value());     // no tangent
  BOOST_TEST(!one_conic_arc({0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {1, -1, 0}, {1, 0.5, 1}).has_value());  // off the plane
  BOOST_TEST(!one_conic_arc({0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {1, -1, 0}, {3, 0.5, 0}).has_value());  // outside
}

BOOST_AUTO_TEST_CASE(the_shape_factor_tells_the_class) {
  const std::vector<Point> corner{{1, 0}, {1, 1}, {0, 1}};
  const auto with = [&](double w) {
    return NurbsCurve::from_cartesian(2, {0, 0, 0, 1, 1, 1}, corner, std::vector<double>{1, w, 1}).value();
  };
  BOOST_TEST((conic_class(with(std::sqrt(0.5)))->kind == ConicClass::Ellipse));
  BOOST_TEST((conic_class(with(1))->kind == ConicClass::Parabola));
  BOOST_TEST((conic_class(with(2))->kind == ConicClass::Hyperbola));
  BOOST_TEST(conic_class(with(2))->shape_factor == 4);
  // The factor is that of the curve, not of its weights.
  const NurbsCurve scaled =
      NurbsCurve::from_cartesian(2, {0, 0, 0, 1, 1, 1}, corner, std::vector<double>{1, 2, 4}).value();
  BOOST_TEST((conic_class(scaled)->kind == ConicClass::Parabola));
  const std::vector<Point> straight{{0, 0}, {1, 1}, {3, 3}};
  const auto line = NurbsCurve::from_cartesian(2, {0, 0, 0, 1, 1, 1}, straight, std::vector<double>{1, 2, 1}).value();
  BOOST_TEST((conic_class(line)->kind == ConicClass::Line));
  BOOST_TEST(!conic_class(circle_arc({}, 1, {0, 6}).value()).has_value());
  // The complement runs over the rest of the circle.
  const NurbsCurve rest = complementary_arc(with(std::sqrt(0.5))).value();
  for (int i = 1; i < 20; ++i) {
    const Point p = evaluate(rest, i / 20.0);
    BOOST_TEST(std::abs(p.x * p.x + p.y * p.y - 1) < 1e-14);
    BOOST_TEST(!(p.x > 0 && p.y > 0));
  }
}
