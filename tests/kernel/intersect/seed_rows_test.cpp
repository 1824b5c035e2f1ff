// Row C23 of the seed documents: line and curve, nearest point to a cursor, flattening to a pixel; against closed
// forms.
#include <boost/test/unit_test.hpp>

#include "kernel/bounds/bounds.h"
#include "kernel/closest/closest.h"
#include "kernel/intersect/intersect.h"

using namespace trimloop;

BOOST_AUTO_TEST_SUITE(row_c23)

BOOST_AUTO_TEST_CASE(intersections_of_a_line_and_a_curve) {
  // Lines at all heights and slopes through an ellipse: the quadratic's roots.
  const double a = 3, b = 1.5;
  const Curve ellipse{Ellipse{Frame{}, a, b}};
  for (int k = -12; k <= 12; ++k)
    for (const double slope : {0.0, 0.5, -2.0}) {
      const double h = 0.31 * k;
      // x^2/a^2 + (h + s x)^2/b^2 = 1
      const double p = 1 / (a * a) + slope * slope / (b * b), q = h * slope / (b * b), r = h * h / (b * b) - 1;
      const double d = q * q - p * r;
      const auto found = intersect(Curve{Line{{0, h, 0}, {1, h + slope, 0}, {-infinity, infinity}}}, ellipse);
      BOOST_REQUIRE(found);
      BOOST_TEST(found->undecided.empty());
      BOOST_REQUIRE(found->points.size() == (d > 0 ? 2u : 0u));
      for (std::size_t i = 0; i < found->points.size(); ++i)
        BOOST_TEST(std::abs(found->points[i].t_first - (-q + (i == 0 ? -1 : 1) * std::sqrt(d)) / p) < 1e-12);
    }
}

BOOST_AUTO_TEST_CASE(nearest_point_to_a_cursor) {
  const auto circle = ClosestOnCurve::make(Curve{Circle{Frame{}, 2}});
  BOOST_REQUIRE(circle);
  for (int k = 0; k < 50; ++k) {
    const Point cursor{3 * std::sin(k), 2.5 * std::cos(1.7 * k), 0};
    const ClosestPoint near = circle->nearest(cursor);
    BOOST_TEST(std::abs(near.distance - std::abs(norm(to_vector(cursor)) - 2)) < 1e-12);
    BOOST_TEST(near.lower <= near.distance);
  }
}

BOOST_AUTO_TEST_CASE(flattening_to_a_pixel) {
  const auto circle = to_nurbs(Curve{Circle{Frame{}, 100}});
  BOOST_REQUIRE(circle);
  for (const double pixel : {0.5, 0.01}) {
    const auto flat = flatten(circle->curve, pixel);
    BOOST_REQUIRE(flat);
    BOOST_TEST(flat->bound <= pixel);
    double worst = 0;  // sagitta of each chord, by closed form
    for (std::size_t i = 0; i + 1 < flat->points.size(); ++i)
      worst = std::max(worst, 100 - norm(to_vector(midpoint(flat->points[i], flat->points[i + 1]))));
    BOOST_TEST(worst <= flat->bound);
    BOOST_TEST(flat->points.size() <= 4 * pi / std::acos(1 - pixel / 100));  // at most four times the fewest
  }
}

BOOST_AUTO_TEST_SUITE_END()
