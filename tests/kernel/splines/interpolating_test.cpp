#include <boost/test/unit_test.hpp>

#include "kernel/splines/interpolating.h"

using namespace trimloop;

namespace {

const std::vector<Point> path{{0, 0, 0}, {3, 1, 0}, {4, 4, 1}, {4.5, 4.2, 1}, {9, 2, 0}, {12, 6, -1}};

Vector slope(const NurbsCurve& c, double t) { return derivatives(c, t, 1)[1]; }

void check_point(Point a, Point b, double tolerance = 1e-13) { BOOST_TEST(distance(a, b) <= tolerance); }

}  // namespace

BOOST_AUTO_TEST_SUITE(splines_through_points)

BOOST_AUTO_TEST_CASE(catmull_rom_has_the_seeds_poles) {
  const auto c = spline_through(path, TangentRule::CatmullRom, SplineEnds::Dropped);
  BOOST_REQUIRE(c.has_value());
  BOOST_TEST(c->degree() == 3);
  BOOST_TEST(c->range().hi == 3.0);
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const double t = static_cast<double>(i) - 1;
    check_point(evaluate(*c, t), path[i]);
    const Vector v = 0.5 * (path[i + 1] - path[i - 1]);
    BOOST_TEST(norm(slope(*c, t) - v) <= 1e-13);
  }
  // P+ of point 1 and P- of point 2, by formula.
  check_point(project(c->poles()[1]), path[1] + (path[2] - path[0]) / 6.0);
  check_point(project(c->poles()[2]), path[2] - (path[3] - path[1]) / 6.0);
}

BOOST_AUTO_TEST_CASE(overhauser_interpolates_with_continuous_derivative_over_chord_lengths) {
  const auto c = spline_through(path, TangentRule::Overhauser, SplineEnds::QuadraticC1);
  BOOST_REQUIRE(c.has_value());
  double at = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    check_point(evaluate(*c, at), path[i]);
    if (i > 0 && i + 1 < path.size()) {
      const double in = distance(path[i - 1], path[i]), out = distance(path[i], path[i + 1]);
      const Vector before = (path[i] - path[i - 1]) / in, after = (path[i + 1] - path[i]) / out;
      const Vector v = (out * before + in * after) / (in + out);
      BOOST_TEST(norm(slope(*c, at) - v) <= 1e-12);
      BOOST_TEST(norm(slope(*c, at - 1e-9) - v) <= 1e-7);  // from the left too
    }
    if (i + 1 < path.size()) at += distance(path[i], path[i + 1]);
  }
  BOOST_TEST(c->range().hi == at);
}

BOOST_AUTO_TEST_CASE(end_parabola_has_its_middle_pole_at_the_share_of_the_tangent) {
  for (const auto ends : {SplineEnds::QuadraticG1, SplineEnds::QuadraticC1}) {
    const double share = ends == SplineEnds::QuadraticC1 ? 0.5 : 1 / std::sqrt(2.0);
    const auto c = spline_through(path, TangentRule::CatmullRom, ends);
    BOOST_REQUIRE(c.has_value());
    const Vector v = 0.5 * (path[2] - path[0]);
    const Point middle = path[1] - share * v;
    // Raised from degree 2: a third of the way back from the middle pole.
    check_point(project(c->poles()[1]), path[0] + (2.0 / 3) * (middle - path[0]));
    const NurbsCurve first = trimmed(*c, {0, 1});
    for (const double t : {0.2, 0.5, 0.9}) {
      const Vector parabola = (1 - t) * (1 - t) * to_vector(path[0]) + 2 * t * (1 - t) * to_vector(middle) + t * t * to_vector(path[1]);
      check_point(evaluate(first, t), to_point(parabola), 1e-12);
    }
    // The tangent's direction is kept at the joint under either share.
    const Vector left = slope(*c, 1 - 1e-9), right = slope(*c, 1 + 1e-9);
    BOOST_TEST(norm(cross(normalized(left), normalized(right))) <= 1e-7);
    BOOST_TEST((norm(left - right) <= 1e-6) == (ends == SplineEnds::QuadraticC1));
  }
}

BOOST_AUTO_TEST_CASE(closed_splines_come_back_with_the_same_tangent) {
  for (const auto rule : {TangentRule::CatmullRom, TangentRule::Overhauser}) {
    const auto c = spline_through(path, rule, SplineEnds::Closed);
    BOOST_REQUIRE(c.has_value());
    check_point(evaluate(*c, c->range().hi), path[0]);
    BOOST_TEST(norm(slope(*c, 0) - slope(*c, c->range().hi)) <= 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(overhauser_over_uniform_parameters_is_the_same_shape) {
  const auto c = spline_through(path, TangentRule::Overhauser, SplineEnds::Dropped);
  const auto u = overhauser_uniform(path, SplineEnds::Dropped);
  BOOST_REQUIRE((c && u));
  BOOST_TEST(u->range().hi == 3.0);
  double at = 0;
  for (std::size_t i = 1; i + 2 < path.size(); ++i) {
    const double h = distance(path[i], path[i + 1]);
    for (const double t : {0.0, 0.3, 0.7})
      check_point(evaluate(*c, at + t * h), evaluate(*u, static_cast<double>(i) - 1 + t), 1e-12);
    at += h;
  }
}

BOOST_AUTO_TEST_CASE(bad_points_are_refused_with_their_place) {
  BOOST_TEST(!spline_through(std::span(path).first(2), TangentRule::CatmullRom, SplineEnds::Closed));
  std::vector<Point> twice = path;
  twice[3] = twice[2];
  const auto c = spline_through(twice, TangentRule::Overhauser, SplineEnds::Dropped);
  BOOST_REQUIRE(!c);
  BOOST_TEST(c.error().text.find("points 2 and 3") != std::string::npos);
  BOOST_TEST(spline_through(twice, TangentRule::CatmullRom, SplineEnds::Dropped).has_value());
  twice[1].y = infinity;
  BOOST_TEST(!spline_through(twice, TangentRule::CatmullRom, SplineEnds::Dropped));
}

BOOST_AUTO_TEST_CASE(moving_a_point_moves_four_segments_at_most) {
  std::vector<Point> many;
  for (int i = 0; i < 12; ++i) many.push_back({static_cast<double>(i), std::sin(i * 1.3), std::cos(i * 0.7)});
  auto moved = many;
  moved[6].z += 1;
  const auto a = spline_through(many, TangentRule::CatmullRom, SplineEnds::Dropped);
  const auto b = spline_through(moved, TangentRule::CatmullRom, SplineEnds::Dropped);
  int changed = 0;
  for (int segment = 0; segment < 9; ++segment)
    changed += distance(evaluate(*a, segment + 0.37), evaluate(*b, segment + 0.37)) > 0;
  BOOST_TEST(changed == 4);
}

BOOST_AUTO_TEST_SUITE_END()
