#include "kernel/mesh/edge_sampling.h"

#include <boost/test/unit_test.hpp>

#include "kernel/mesh/distance.h"
#include "kernel/mesh/tessellate.h"

using namespace trimloop;

namespace {

double deviation(const Curve& curve, const std::vector<Point>& points) {
  const Interval r = range(curve);
  double worst = 0;
  for (int i = 0; i <= 5000; ++i) {
    const Point p = evaluate(curve, r.at(i / 5000.0));
    double nearest = infinity;
    for (std::size_t k = 0; k + 1 < points.size(); ++k)
      nearest = std::min(nearest, mesh::distance_to_segment(p, points[k], points[k + 1]));
    worst = std::max(worst, nearest);
  }
  return worst;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_line_is_its_two_ends) {
  const std::vector<Point> points = mesh::sample({Line{{0, 0, 0}, {3, 4, 0}}}, 0.01, 0.3);
  BOOST_REQUIRE_EQUAL(points.size(), 2u);
  BOOST_CHECK_EQUAL(points[1].y, 4);
}

BOOST_AUTO_TEST_CASE(a_circle_gets_as_many_chords_as_its_sagitta_asks) {
  const Curve circle{Circle{{}, 10, {0, two_pi}}};
  for (const double deflection : {0.5, 0.01, 0.0001}) {
    const std::vector<Point> points = mesh::sample(circle, deflection, 3);
    const double chords = static_cast<double>(points.size() - 1);
    BOOST_CHECK_LE(deviation(circle, points), deflection * 1.0001);
    BOOST_CHECK_LE(chords, 1.1 * pi / std::acos(1 - deflection / 10) + 1);
  }
  BOOST_CHECK_EQUAL(mesh::sample(circle, 100, pi / 9).size(), 19u);  // 18 turns of 20 degrees
}

BOOST_AUTO_TEST_CASE(an_inflection_does_not_look_straight) {
  const std::vector<Point> poles{{0, 0, 0}, {1, 6, 0}, {3, -6, 0}, {4, 0, 0}};
  const Curve curve{*NurbsCurve::from_cartesian(3, {0, 0, 0, 0, 1, 1, 1, 1}, poles, {})};
  const std::vector<Point> points = mesh::sample(curve, 0.01, 3);
  BOOST_CHECK_LE(deviation(curve, points), 0.01);
  BOOST_CHECK_GT(points.size(), 10u);
}

BOOST_AUTO_TEST_CASE(corners_are_samples_and_smooth_joints_need_not_be) {
  const std::vector<Point> points =
      mesh::sample({Polyline{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}}}}, 0.01, 0.3);
  BOOST_REQUIRE_EQUAL(points.size(), 3u);
  BOOST_CHECK_EQUAL(points[1].x, 2);
  BOOST_CHECK_EQUAL(points[1].y, 0);
}

BOOST_AUTO_TEST_CASE(a_digitised_circle_is_thinned_out) {
  Polyline dense;
  for (int i = 0; i <= 3600; ++i) dense.points.push_back({10 * std::cos(i * pi / 1800), 10 * std::sin(i * pi / 1800), 0});
  const std::vector<Point> points = mesh::sample({dense}, 0.05, 3);
  BOOST_CHECK_LE(deviation({dense}, points), 0.05);
  BOOST_CHECK_LT(points.size(), 45u);
}

BOOST_AUTO_TEST_CASE(unbounded_curves_and_senseless_bounds_give_nothing) {
  BOOST_CHECK(mesh::sample({Line{{0, 0, 0}, {1, 0, 0}, {0, infinity}}}, 0.1, 0.3).empty());
  BOOST_CHECK(mesh::sample({Circle{}}, 0, 0.3).empty());
  BOOST_CHECK(mesh::sample({Circle{}}, not_measured, 0.3).empty());
}
