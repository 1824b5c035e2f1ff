#include <boost/test/unit_test.hpp>
#include <random>

#include "kernel/splines/biarc.h"

using namespace trimloop;

namespace {

Vector direction(const Curve& c, double t) { return normalized(jet(c, t).d1); }

// Ends met, and equal directions wherever two pieces meet.
void check_smooth(const Curve& chain, double tolerance = 1e-9) {
  const auto& segments = std::get<CompositeCurve>(chain.shape).segments;
  for (std::size_t i = 0; i + 1 < segments.size(); ++i) {
    const Curve &a = *segments[i].curve, &b = *segments[i + 1].curve;
    BOOST_TEST(distance(end_point(a), start_point(b)) <= tolerance);
    BOOST_TEST(norm(direction(a, range(a).hi) - direction(b, range(b).lo)) <= 1e-7);
  }
}

double one_sided(const std::vector<Point>& from, const std::vector<Point>& to) {
  double worst = 0;
  for (const Point& p : from) {
    double nearest = infinity;
    for (std::size_t i = 0; i + 1 < to.size(); ++i) {
      const Vector along = to[i + 1] - to[i];
      const double t = std::clamp(dot(p - to[i], along) / std::max(dot(along, along), 1e-300), 0.0, 1.0);
      nearest = std::min(nearest, distance(p, to[i] + t * along));
    }
    worst = std::max(worst, nearest);
  }
  return worst;
}

std::vector<Point> dense(const Curve& c, int n) {
  std::vector<Point> out;
  for (int i = 0; i <= n; ++i) out.push_back(evaluate(c, range(c).at(static_cast<double>(i) / n)));
  return out;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(biarcs)

BOOST_AUTO_TEST_CASE(a_biarc_meets_both_ends_with_their_directions) {
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> coordinate(-5, 5);
  const auto random = [&] { return Vector{coordinate(engine), coordinate(engine), coordinate(engine)}; };
  for (int i = 0; i < 500; ++i) {
    const Point a = to_point(random()), b = to_point(random());
    const Vector ta = normalized(random()), tb = normalized(random());
    const auto two = biarc(a, ta, b, tb);
    BOOST_REQUIRE(two.has_value());
    const Curve &first = (*two)[0], &second = (*two)[1];
    BOOST_TEST(distance(start_point(first), a) <= 1e-12);
    BOOST_TEST(distance(end_point(second), b) <= 1e-12);
    BOOST_TEST(distance(end_point(first), start_point(second)) <= 1e-9);
    BOOST_TEST(norm(direction(first, range(first).lo) - ta) <= 1e-9);
    BOOST_TEST(norm(direction(second, range(second).hi) - tb) <= 1e-9);
    BOOST_TEST(norm(direction(first, range(first).hi) - direction(second, range(second).lo)) <= 1e-6);
  }
}

BOOST_AUTO_TEST_CASE(points_on_a_circle_give_that_circle) {
  std::vector<Point> points;
  for (int i = 0; i <= 7; ++i) points.push_back({3 * std::cos(0.4 * i) + 1, 3 * std::sin(0.4 * i), 2});
  const auto chain = biarcs_through(points);
  BOOST_REQUIRE(chain.has_value());
  check_smooth(*chain);
  for (const Point& p : dense(*chain, 500)) BOOST_TEST(std::abs(std::hypot(p.x - 1, p.y) - 3) <= 1e-12);
}

BOOST_AUTO_TEST_CASE(chains_pass_their_points_smoothly) {
  const std::vector<Point> points{{0, 0, 0}, {2, 1, 0}, {4, 0, 1}, {5, 0, 1}, {6, 0, 1}, {8, 3, 0}, {7, 5, -1}};
  const auto chain = biarcs_through(points);
  BOOST_REQUIRE(chain.has_value());
  check_smooth(*chain);
  const auto& c = std::get<CompositeCurve>(chain->shape);
  for (std::size_t i = 0; i < points.size(); ++i) BOOST_TEST(distance(evaluate(*chain, c.starts[2 * i]), points[i]) <= 1e-9);
}

BOOST_AUTO_TEST_CASE(the_bound_of_a_chain_along_a_curve_holds) {
  const std::vector<Point> plane{{0, 0, 0}, {10, 25, 0}, {30, -15, 0}, {40, 10, 0}}, space{{0, 0, 0}, {10, 25, 9}, {30, -15, 3}, {40, 10, -8}};
  for (const auto& poles : {plane, space}) {
    const auto curve = NurbsCurve::from_cartesian(3, {0, 0, 0, 0, 1, 1, 1, 1}, poles, std::vector<double>{1, 2, 0.7, 1});
    double arcs = 0;
    for (const double tolerance : {1.0, 0.1, 0.01, 0.001}) {
      const auto chain = biarcs_along(*curve, tolerance);
      BOOST_REQUIRE(chain.has_value());
      BOOST_TEST(chain->bound <= tolerance);
      BOOST_TEST(static_cast<double>(chain->arcs) >= arcs);
      arcs = static_cast<double>(chain->arcs);
      check_smooth(chain->curve, 1e-8);
      const auto a = dense({*curve}, 4000), b = dense(chain->curve, 4000);
      const double coarse = 1e-5;  // of the polylines themselves
      BOOST_TEST(one_sided(a, b) <= chain->bound + coarse);
      BOOST_TEST(one_sided(b, a) <= chain->bound + coarse);
    }
    BOOST_TEST(arcs <= 120.0);
  }
}

BOOST_AUTO_TEST_CASE(what_has_no_biarc_is_refused) {
  BOOST_TEST(!biarc({}, {1, 0, 0}, {}, {1, 0, 0}));
  BOOST_TEST(!biarc({}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}));
  BOOST_TEST(!biarcs_through(std::vector<Point>{{0, 0, 0}}));
  BOOST_TEST(!biarcs_through(std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}));
  BOOST_TEST(!biarcs_through(std::vector<Point>{{0, 0, 0}, {2, 0, 0}, {1, 0, 0}}));
  const auto line = NurbsCurve::from_cartesian(1, {0, 0, 1, 1}, std::vector<Point>{{0, 0, 0}, {1, 0, 0}}, {});
  BOOST_TEST(!biarcs_along(*line, 0));
  BOOST_TEST(biarcs_along(*line, 1e-9)->arcs == 2u);
}

BOOST_AUTO_TEST_SUITE_END()
