#include <boost/test/unit_test.hpp>

#include "kernel/splines/procedural.h"

using namespace trimloop;

namespace {

double to_segment(Point p, Point a, Point b) {
  const Vector along = b - a;
  const double t = std::clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0);
  return distance(p, a + t * along);
}

double to_polygon(Point p, const std::vector<Point>& polygon, bool closed) {
  double least = infinity;
  for (std::size_t i = closed ? 0 : 1; i < polygon.size(); ++i)
    least = std::min(least, to_segment(p, polygon[(i + polygon.size() - 1) % polygon.size()], polygon[i]));
  return least;
}

double one_sided(const std::vector<Point>& from, const std::vector<Point>& to, bool closed) {
  double worst = 0;
  for (const Point& p : from) worst = std::max(worst, to_polygon(p, to, closed));
  return worst;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(curves_by_procedure)

BOOST_AUTO_TEST_CASE(cutting_at_a_quarter_gives_the_quadratic_b_spline) {
  const std::vector<Point> polygon{{0, 0, 0}, {4, 0, 0}, {5, 3, 1}, {2, 6, 0}, {-1, 3, 2}};
  for (int rounds = 0; rounds <= 6; ++rounds) {
    const auto level = cut_corners(polygon, true, 0.25, rounds);
    BOOST_REQUIRE(level.has_value());
    BOOST_TEST(level->points.size() == polygon.size() << rounds);
    // The limit's parabolas: from side middle to side middle.
    double worst = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point a = polygon[i], b = polygon[(i + 1) % 5], c = polygon[(i + 2) % 5];
      for (int k = 0; k <= 1009; ++k) {
        const double t = k / 1009.0;
        const Vector p = 0.5 * (1 - t) * (1 - t) * to_vector(a) + (0.5 + t * (1 - t)) * to_vector(b) + 0.5 * t * t * to_vector(c);
        worst = std::max(worst, to_polygon(to_point(p), level->points, true));
      }
    }
    BOOST_TEST(worst <= level->bound);
    BOOST_TEST(worst >= 0.5 * level->bound);  // and the bound is no waste
  }
}

BOOST_AUTO_TEST_CASE(the_distance_to_the_limit_holds_for_any_ratio) {
  const std::vector<Point> polygon{{0, 0, 0}, {10, 0, 0}, {10, 1, 0}, {-3, 2, 5}, {0, 9, 1}};
  for (const bool closed : {true, false}) {
    for (const double ratio : {0.1, 0.25, 1.0 / 3, 0.45}) {
      const auto fine = cut_corners(polygon, closed, ratio, 13);
      for (int rounds = 0; rounds <= 5; ++rounds) {
        const auto level = cut_corners(polygon, closed, ratio, rounds);
        BOOST_TEST(one_sided(fine->points, level->points, closed) <= level->bound + fine->bound);
        BOOST_TEST(one_sided(level->points, fine->points, closed) <= level->bound + fine->bound);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(koch_grows_by_four_and_stays_within_its_bound) {
  const std::vector<Point> triangle{{0, 0, 0}, {1, 0, 0}, {0.5, -std::sqrt(3.0) / 2, 0}};
  const auto fine = koch(triangle, true, 7);
  BOOST_REQUIRE(fine.has_value());
  BOOST_TEST(fine->points.size() == 3u << 14);
  for (int rounds = 0; rounds <= 3; ++rounds) {
    const auto level = koch(triangle, true, rounds);
    const double worst = one_sided(fine->points, level->points, true);
    BOOST_TEST(worst <= level->bound * (1 + 1e-12));
    BOOST_TEST(worst >= 0.999 * level->bound);  // the next apex is that far away
  }
}

BOOST_AUTO_TEST_CASE(what_cannot_be_done_is_refused) {
  const std::vector<Point> line{{0, 0, 0}, {1, 0, 0}};
  BOOST_TEST(!cut_corners(line, true, 0.25, 1));
  BOOST_TEST(!cut_corners(line, false, 0.5, 1));
  BOOST_TEST(!cut_corners(line, false, std::nan(""), 1));
  BOOST_TEST(!cut_corners(line, false, 0.25, -1));
  BOOST_REQUIRE(!koch(line, false, 40));
  BOOST_TEST((koch(line, false, 40).error().code == ErrorCode::Limit));
  BOOST_TEST(!koch(std::vector<Point>{{0, 0, 0}, {1, 0, 1}}, false, 1));
}

BOOST_AUTO_TEST_SUITE_END()
