#include <boost/test/unit_test.hpp>

#include "kernel/splines/beta_spline.h"

using namespace trimloop;

namespace {

// Seed 004 §4.1: 16 points with heights 1, 0, 1, 0 from row to row.
std::vector<Point> seed_net(std::size_t rows, std::size_t columns) {
  std::vector<Point> net;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j)
      net.push_back({static_cast<double>(i + 1), static_cast<double>(j + 1), i % 2 == 0 ? 1.0 : 0.0});
  return net;
}

Point by_basis(std::span<const Point> p, std::size_t segment, double t, BetaShape shape) {
  const Matrix<double> m = beta_basis(shape.bias, shape.tension);
  Vector sum{};
  for (std::size_t r = 0; r < 4; ++r) {
    const double b = m(0, r) + t * (m(1, r) + t * (m(2, r) + t * m(3, r)));
    sum += b * to_vector(p[segment + r]);
  }
  return to_point(sum);
}

const BetaShape shapes[] = {{1, 0}, {1, 5}, {1.5, 0}, {0.5, 0}, {2, 12.5}, {5, -3}, {1, 1000}};

}  // namespace

BOOST_AUTO_TEST_SUITE(beta_splines)

BOOST_AUTO_TEST_CASE(curve_is_its_basis_segment_by_segment) {
  std::vector<Point> points;
  for (int i = 0; i < 9; ++i) points.push_back({static_cast<double>(i), std::sin(1.7 * i), std::cos(2.3 * i)});
  for (const BetaShape& shape : shapes) {
    const auto curve = beta_spline(points, shape);
    BOOST_REQUIRE(curve.has_value());
    double at = 0, step = 1;
    for (std::size_t segment = 0; segment + 3 < points.size(); ++segment) {
      for (const double t : {0.0, 0.25, 0.6, 0.99})
        BOOST_TEST(distance(evaluate(*curve, at + t * step), by_basis(points, segment, t, shape)) <= 1e-12);
      at += step;
      step *= shape.bias;
    }
    BOOST_TEST(std::abs(curve->range().hi - at) <= 1e-12 * at);
  }
}

BOOST_AUTO_TEST_CASE(without_tension_the_poles_are_the_control_points) {
  const auto net = seed_net(4, 4);
  const auto curve = beta_spline(std::span(net).first(9), {1.5, 0});
  BOOST_REQUIRE(curve.has_value());
  BOOST_TEST(curve->poles().size() == 9u);
  for (std::size_t i = 0; i < 9; ++i) BOOST_TEST(distance(project(curve->poles()[i]), net[i]) == 0);
  // (1, 0) is the uniform cubic B-spline.
  const auto uniform = beta_spline(std::span(net).first(9), {1, 0});
  for (std::size_t i = 0; i + 1 < uniform->knots().size(); ++i) BOOST_TEST(uniform->knots()[i + 1] - uniform->knots()[i] == 1);
}

BOOST_AUTO_TEST_CASE(tension_makes_double_knots_never_triple_ones) {
  const auto net = seed_net(4, 4);
  const auto curve = beta_spline(std::span(net).first(8), {1, 5});
  BOOST_REQUIRE(curve.has_value());
  for (std::size_t i = 4; i + 6 < curve->knots().size(); ++i) BOOST_TEST(curve->knots()[i] < curve->knots()[i + 2]);
  BOOST_TEST(norm(derivatives(*curve, 1 - 1e-10, 1)[1] - derivatives(*curve, 1, 1)[1]) <= 1e-8);
}

BOOST_AUTO_TEST_CASE(a_steep_bias_over_many_segments_keeps_the_shape) {
  std::vector<Point> points;
  for (int i = 0; i < 60; ++i) points.push_back({static_cast<double>(i), std::sin(0.9 * i), 0});
  const BetaShape shape{3, 2};
  const auto curve = beta_spline(points, shape);
  BOOST_REQUIRE(curve.has_value());
  BOOST_TEST(curve->range().hi == 57.0);
  for (std::size_t segment = 0; segment < 57; ++segment)
    BOOST_TEST(distance(evaluate(*curve, static_cast<double>(segment) + 0.4), by_basis(points, segment, 0.4, shape)) <= 1e-12);
}

BOOST_AUTO_TEST_CASE(the_seeds_net_makes_its_three_surfaces) {
  const auto net = seed_net(4, 4);
  for (const BetaShape& shape : {BetaShape{1, 0}, BetaShape{1, 5}, BetaShape{1.5, 0}}) {
    const auto surface = beta_spline(net, 4, 4, shape, shape);
    BOOST_REQUIRE(surface.has_value());
    for (const double u : {0.0, 0.3, 1.0}) {
      for (const double v : {0.0, 0.8}) {
        std::vector<Point> across;
        for (std::size_t i = 0; i < 4; ++i) across.push_back(by_basis(std::span(net).subspan(4 * i, 4), 0, v, shape));
        BOOST_TEST(distance(evaluate(*surface, {u, v}), by_basis(across, 0, u, shape)) <= 1e-13);
      }
    }
  }
  // The 42-point net as the seed's figure 6 shows it: 6 by 7, heights alternating along the first direction.
  const auto large = beta_spline(seed_net(6, 7), 6, 7, {1, 0}, {1, 0});
  BOOST_REQUIRE(large.has_value());
  BOOST_TEST(large->range_u().hi == 3.0);
  BOOST_TEST(large->range_v().hi == 4.0);
}

BOOST_AUTO_TEST_CASE(shapes_without_a_basis_are_refused) {
  const auto net = seed_net(4, 4);
  BOOST_TEST(!beta_spline(std::span(net).first(3), {1, 0}));
  BOOST_TEST(!beta_spline(net, {0, 0}));
  BOOST_TEST(!beta_spline(net, {-1, 0}));
  BOOST_TEST(!beta_spline(net, {1, -12}));
  BOOST_TEST(!beta_spline(net, {1, std::nan("")}));
  BOOST_TEST(!beta_spline(net, 5, 4, {1, 0}, {1, 0}));
}

BOOST_AUTO_TEST_SUITE_END()
