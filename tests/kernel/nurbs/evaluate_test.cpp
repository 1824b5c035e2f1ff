// Values and derivatives against closed forms and against each other.
#include <boost/test/unit_test.hpp>

#include "kernel/nurbs/surface.h"

using namespace trimloop;

namespace {

// Full circle of radius 2 about the origin: nine rational quadratic poles (NURBS Book, fig. 7.16a).
NurbsCurve circle() {
  const double h = std::sqrt(0.5);
  const std::vector<Point> points{{2, 0}, {2, 2}, {0, 2}, {-2, 2}, {-2, 0}, {-2, -2}, {0, -2}, {2, -2}, {2, 0}};
  const std::vector<double> weights{1, h, 1, h, 1, h, 1, h, 1};
  return NurbsCurve::from_cartesian(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}, points, weights).value();
}

}  // namespace

BOOST_AUTO_TEST_CASE(rational_quadratics_make_a_circle) {
  const NurbsCurve c = circle();
  for (int i = 0; i <= 400; ++i) {
    const CurveJet j = jet(c, 0.01 * i);
    const Vector r = to_vector(j.point);
    BOOST_TEST(std::abs(norm(r) - 2) < 4e-15);
    BOOST_TEST(std::abs(dot(r, j.d1)) < 1e-14);                    // the tangent is perpendicular
    BOOST_TEST(std::abs(dot(j.d1, j.d1) + dot(r, j.d2)) < 1e-13);  // derivative of the line above
    BOOST_TEST(distance(j.point, evaluate(c, 0.01 * i)) == 0);
  }
}
