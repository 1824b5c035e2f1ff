#include "kernel/mesh/triangulation.h"

#include <boost/test/unit_test.hpp>
#include <random>

#include "tests/fuzz/triangulation_property.h"

using namespace trimloop;
using namespace trimloop::mesh;

namespace {

constexpr auto none = Triangulation::none;

struct Random {
  std::mt19937_64 engine{42};
  double unit() { return std::ldexp(static_cast<double>(engine() >> 11), -53); }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine() % n); }
};

// A closed loop through points that it appends.
struct Drawing {
  std::vector<Uv> points;
  std::vector<Segment> constraints;

  void loop(const std::vector<Uv>& corners) {
    const auto first = static_cast<std::uint32_t>(points.size()), n = static_cast<std::uint32_t>(corners.size());
    points.insert(points.end(), corners.begin(), corners.end());
    for (std::uint32_t i = 0; i < n; ++i) constraints.push_back({first + i, first + (i + 1) % n});
  }
  void segment(Uv a, Uv b) {
    const auto first = static_cast<std::uint32_t>(points.size());
    points.insert(points.end(), {a, b});
    constraints.push_back({first, first + 1});
  }
};

std::vector<Uv> ring(Uv centre, double radius, int n, bool clockwise = false, double wobble = 0) {
  std::vector<Uv> out;
  for (int i = 0; i < n; ++i) {
    const double angle = (clockwise ? -1 : 1) * two_pi * i / n;
    const double r = radius * (1 + wobble * std::sin(7 * angle));
    out.push_back(centre + r * Uv{std::cos(angle), std::sin(angle)});
  }
  return out;
}

double polygon_area(const std::vector<Uv>& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    sum += cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  }
  return sum / 2;
}

double inside_area(const Triangulation& t) {
  double sum = 0;
  for (auto [a, b, c] : t.inside_triangles()) {
    sum += cross(t.points()[b] - t.points()[a], t.points()[c] - t.points()[a]) / 2;
  }
  return sum;
}

Triangulation built(const Drawing& d, Inside rule = Inside::Nonzero) {
  Triangulation t;
  BOOST_REQUIRE(t.build(d.points, d.constraints).has_value());
  t.classify(rule);
  BOOST_TEST(broken_invariant(t, d.points, d.constraints) == "");
  return t;
}

bool is_close(double a, double b, double tol) { return std::abs(a - b) <= tol * std::abs(b); }

}  // namespace

BOOST_AUTO_TEST_CASE(fewer_than_three_distinct_points_make_no_triangle) {
  Triangulation t;
  for (const std::vector<Uv>& points :
       {std::vector<Uv>{}, {{1, 1}}, {{1, 1}, {2, 2}}, {{1, 1}, {2, 2}, {1, 1}, {2, 2}, {1, 1}}, {{3, 3}, {3, 3}, {3, 3}}}) {
    BOOST_REQUIRE(t.build(points, {}).has_value());
    t.classify(Inside::Nonzero);
    BOOST_TEST(t.triangle_count() == 0u);
    BOOST_TEST(t.inside_triangles().empty());
    BOOST_TEST(t.locate({0, 0}, 0) == none);
    BOOST_TEST(broken_invariant(t, points, {}) == "");
  }
}

BOOST_AUTO_TEST_CASE(collinear_points_make_no_triangle_and_are_still_merged) {
  Drawing d;
  for (int i = 0; i < 50; ++i) d.points.push_back({i % 10 * 0.5, i % 10 * 1.0});
  d.constraints = {{0, 9}, {3, 3}, {12, 40}};
  const auto t = built(d);
  BOOST_TEST(t.triangle_count() == 0u);
  BOOST_TEST(t.vertex_of(43) == 3u);
}

BOOST_AUTO_TEST_CASE(points_that_are_not_finite_and_constraints_to_nowhere_are_refused) {
  Triangulation t;
  BOOST_TEST(!t.build(std::vector<Uv>{{0, 0}, {1, 0}, {infinity, 0}}, {}));
  BOOST_TEST(!t.build(std::vector<Uv>{{0, 0}, {1, 0}, {0, std::nan("")}}, {}));
  BOOST_TEST(!t.build(std::vector<Uv>{{0, 0}, {1, 0}, {0, 1}}, std::vector<Segment>{{0, 3}}));
}

BOOST_AUTO_TEST_CASE(random_points_make_the_delaunay_triangulation) {
  Random r;
  for (std::size_t n : {3, 4, 5, 17, 100, 3000}) {
    Drawing d;
    for (std::size_t i = 0; i < n; ++i) d.points.push_back({r.unit(), r.unit()});
    built(d);
  }
}

BOOST_AUTO_TEST_CASE(a_square_with_a_hole_with_an_island_has_the_right_area_by_every_rule) {
  Drawing d;
  d.loop({{0, 0}, {10, 0}, {10, 10}, {0, 10}});
  d.loop({{2, 2}, {2, 8}, {8, 8}, {8, 2}});
  d.loop({{4, 4}, {6, 4}, {6, 6}, {4, 6}});
  for (Inside rule : {Inside::Nonzero, Inside::Odd, Inside::Positive}) BOOST_TEST(inside_area(built(d, rule)) == 68);
  // Every loop the same way round: the orientation is irrelevant to one rule and means everything to the other.
  std::swap(d.points[5], d.points[7]);
  BOOST_TEST(inside_area(built(d, Inside::Odd)) == 68);
  BOOST_TEST(inside_area(built(d, Inside::Nonzero)) == 100);
}
