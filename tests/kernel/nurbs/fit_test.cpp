// Curves and surfaces through points and near them (The NURBS Book, chapter 9).
#include "kernel/nurbs/fit.h"

#include <boost/test/unit_test.hpp>

#include "kernel/nurbs/hodograph.h"
#include "tests/kernel/nurbs/random_nurbs.h"

using namespace trimloop;
using testing::Random;

namespace {

std::vector<Point> helix(std::size_t count) {
  std::vector<Point> out;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = 6.0 * static_cast<double>(i) / static_cast<double>(count - 1);
    out.push_back({std::cos(t), std::sin(t), 0.3 * t});
  }
  return out;
}

std::vector<Point> random_points(Random& random, std::size_t count) {
  std::vector<Point> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back({random.real(-5, 5), random.real(-5, 5), random.real(-5, 5)});
  return out;
}

double worst_distance(const Fit& fit, std::span<const Point> points) {
  double worst = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    worst = std::max(worst, distance(evaluate(fit.curve, fit.parameters[i]), points[i]));
  return worst;
}

}  // namespace

BOOST_AUTO_TEST_CASE(interpolants_go_through_their_points) {
  Random random(111);
  for (int i = 0; i < 60; ++i) {
    std::vector<Point> points = random_points(random, static_cast<std::size_t>(random.integer(8, 40)));
    if (i % 3 == 0) points.insert(points.begin() + 3, points[3]), points.push_back(points.back());  // repeated data
    for (const Spacing s : {Spacing::ChordLength, Spacing::Centripetal, Spacing::Uniform}) {
      const Fit fit = interpolate(points, random.integer(1, 6), s).value();
      BOOST_TEST(fit.parameters.size() == points.size());
      BOOST_TEST(worst_distance(fit, points) <= fit.error);
      BOOST_TEST(fit.error < 1e-10);
    }
  }
  // Points of a cubic at its own parameters give the cubic back where the parameters are the chord lengths: a line.
  const std::vector<Point> line{{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {5, 10, 15}};
  BOOST_TEST(distance(evaluate(interpolate(line)->curve, 0.5), {2.5, 5, 7.5}) < 1e-14);
}

BOOST_AUTO_TEST_CASE(interpolation_says_what_is_wrong) {
  const std::vector<Point> same(5, Point{1, 1, 1}), few{{0, 0, 0}, {1, 0, 0}},
      bad{{0, 0, 0}, {1, 0, 0}, {std::nan(""), 0, 0}};
  BOOST_TEST(!interpolate(same).has_value());
  BOOST_TEST(interpolate(few, 3).error().text.find("distinct points") != std::string::npos);
  BOOST_TEST(interpolate(bad, 1).error().text.find("point 2") != std::string::npos);
  BOOST_TEST(!interpolate(few, 0).has_value());
}

BOOST_AUTO_TEST_CASE(end_derivatives_are_met) {
  Random random(112);
  for (int degree = 2; degree <= 5; ++degree) {
    const std::vector<Point> points = random_points(random, 12);
    const Vector a{1, 2, -3}, b{-4, 1, 2};
    const Fit both = interpolate(points, degree, a, b).value(),
              one = interpolate(points, degree, std::nullopt, b).value();
    BOOST_TEST(both.error < 1e-11);
    BOOST_TEST(norm(derivatives(both.curve, 0, 1)[1] - a) < 1e-10);
    BOOST_TEST(norm(derivatives(both.curve, 1, 1)[1] - b) < 1e-10);
    BOOST_TEST(one.error < 1e-11);
    BOOST_TEST(norm(derivatives(one.curve, 1, 1)[1] - b) < 1e-10);
    std::vector<Vector> slopes;
    for (std::size_t i = 0; i < points.size(); ++i)
      slopes.push_back({random.real(-9, 9), random.real(-9, 9), random.real(-9, 9)});
    const Fit all = interpolate_with_derivatives(points, slopes, degree).value();
    BOOST_TEST(all.error < 1e-9);
    for (std::size_t i = 0; i < points.size(); ++i)
      BOOST_TEST(norm(derivatives(all.curve, all.parameters[i], 1)[1] - slopes[i]) < 1e-8);
  }
}

BOOST_AUTO_TEST_CASE(closed_interpolants_close_smoothly) {
  Random random(113);
  for (const int degree : {1, 3, 5}) {
    std::vector<Point> ring;
    for (int i = 0; i < 17; ++i) {
      const double a = two_pi * (i + random.real(-0.2, 0.2)) / 17;
      ring.push_back({3 * std::cos(a), 2 * std::sin(a), random.real(-0.2, 0.2)});
    }
    const Fit fit = interpolate_closed(ring, degree).value();
    BOOST_TEST(worst_distance(fit, ring) <= fit.error);
    BOOST_TEST(fit.error < 1e-11);
    const auto a = derivatives(fit.curve, fit.curve.domain().lo, degree, Side::Right);
    const auto b = derivatives(fit.curve, fit.curve.domain().hi, degree, Side::Left);
    for (int k = 0; k < degree; ++k)
      BOOST_TEST(norm(a[static_cast<std::size_t>(k)] - b[static_cast<std::size_t>(k)]) <
                 1e-9 * (1 + norm(a[static_cast<std::size_t>(k)])));
  }
  BOOST_TEST(!interpolate_closed(helix(9), 2).has_value());
}

BOOST_AUTO_TEST_CASE(local_interpolants_are_smooth_and_local) {
  Random random(114);
  const std::vector<Point> points = helix(15);
  const Fit fit = interpolate_local(points).value();
  BOOST_TEST(fit.error < 1e-13);
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Vector l = derivatives(fit.curve, fit.parameters[i], 1, Side::Left)[1],
                 r = derivatives(fit.curve, fit.parameters[i], 1, Side::Right)[1];
    BOOST_TEST(norm(l - r) < 1e-10 * norm(l));
  }
  for (int i = 0; i <= 200; ++i) {  // near the helix
    const Point p = evaluate(fit.curve, i / 200.0);
    BOOST_TEST(std::abs(std::hypot(p.x, p.y) - 1) < 5e-3);
  }
  // A moved point changes the curve only within two spans of it and one more (tangents).
  std::vector<Point> moved = points;
  moved[7].z += 0.5;
  const Fit other = interpolate_local(moved).value();
  for (int k = 0; k <= 3; ++k) {
    const double a = std::lerp(fit.parameters[0], fit.parameters[4], k / 3.0),
                 b = std::lerp(other.parameters[0], other.parameters[4], k / 3.0);
    BOOST_TEST(distance(evaluate(fit.curve, a), evaluate(other.curve, b)) < 1e-10);
  }
  // A square with points along its sides keeps its corners when asked.
  std::vector<Point> square;
  for (int s = 0; s < 3; ++s)
    for (int k = 0; k < 4; ++k)
      square.push_back(s == 0 ? Point{k / 4.0, 0} : s == 1 ? Point{1, k / 4.0} : Point{1 - k / 4.0, 1});
  const Fit sharp = interpolate_local(square, true).value();
  for (int i = 0; i <= 100; ++i) {
    const Point p = evaluate(sharp.curve, i / 100.0);
    BOOST_TEST(std::min({std::abs(p.y), std::abs(p.x - 1), std::abs(p.y - 1)}) < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(surfaces_go_through_their_nets) {
  Random random(115);
  for (int degree = 1; degree <= 4; ++degree) {
    std::vector<Point> net;
    for (int i = 0; i < 7; ++i)
      for (int j = 0; j < 6; ++j)
        net.push_back({i + random.real(-0.2, 0.2), j + random.real(-0.2, 0.2), random.real(-1, 1)});
    const SurfaceFit fit = interpolate_net(net, 6, degree, 3).value();
    BOOST_TEST(fit.error < 1e-12);
    const SurfaceFit local = interpolate_net_local(net, 6).value();
    BOOST_TEST(local.error < 1e-12);
    // C1 across the lines of the net.
    const auto a = derivatives(local.surface, {local.u[3], 0.37}, 1, Side::Left, Side::Right);
    const auto b = derivatives(local.surface, {local.u[3], 0.37}, 1, Side::Right, Side::Right);
    BOOST_TEST(norm(a[2] - b[2]) < 1e-10 * (1 + norm(a[2])));
  }
  // One row collapsed to a pole.
  std::vector<Point> cap;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) cap.push_back({i * std::cos(j), i * std::sin(j), 4.0 - i * i});
  BOOST_TEST(interpolate_net(cap, 5)->error < 1e-12);
  BOOST_TEST(!interpolate_net(std::vector<Point>(20), 5).has_value());
}

BOOST_AUTO_TEST_CASE(least_squares_meets_constraints_and_the_normal_equations) {
  Random random(116);
  std::vector<Point> points = helix(60);
  for (Point& p : points) p.x += random.real(-0.01, 0.01);
  LeastSquares how;
  how.poles = 12;
  const Fit fit = approximate(points, how).value();
  BOOST_TEST(fit.error < 0.05);
  BOOST_TEST(distance(evaluate(fit.curve, 0), points.front()) < 1e-12);
  // Moving any inner pole does not lower the sum of squares.
  const auto sum = [&](const NurbsCurve& c) {
    double s = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      s += dot(evaluate(c, fit.parameters[i]) - points[i], evaluate(c, fit.parameters[i]) - points[i]);
    return s;
  };
  const double best = sum(fit.curve);
  for (std::size_t k = 1; k + 1 < 12; ++k)
    for (const double step : {1e-4, -1e-4}) {
      std::vector<Hpoint> poles = fit.curve.poles();
      poles[k].y += step;
      BOOST_TEST(sum(NurbsCurve::from_homogeneous(3, fit.curve.knots(), poles).value()) > best);
    }
  // Constraints: through point 20, with a derivative at point 40.
  how.weights.assign(points.size(), 1);
  how.weights[20] = -1;
  how.derivatives = {{40, {1, 2, 3}, -1}, {10, {0, 0, 1}, 0.5}};
  const Fit tied = approximate(points, how).value();
  BOOST_TEST(distance(evaluate(tied.curve, tied.parameters[20]), points[20]) < 1e-11);
  BOOST_TEST(norm(derivatives(tied.curve, tied.parameters[40], 1)[1] - Vector{1, 2, 3}) < 1e-9);
  how.poles = 100;
  BOOST_TEST(!approximate(points, how).has_value());
  // As many poles as points: interpolation.
  LeastSquares all;
  all.poles = points.size();
  BOOST_TEST(approximate(points, all)->error < 1e-8);
}

BOOST_AUTO_TEST_CASE(surface_least_squares_reproduces_a_surface_of_its_space) {
  Random random(117);
  std::vector<Point> net;
  for (int i = 0; i < 21; ++i)
    for (int j = 0; j < 16; ++j) net.push_back({i / 20.0, j / 15.0, std::sin(3 * i / 20.0) * std::cos(2 * j / 15.0)});
  const SurfaceFit fit = approximate_net(net, 16, 3, 3, 8, 7, Spacing::Uniform).value();
  BOOST_TEST(fit.error < 2e-3);
  BOOST_TEST(distance(evaluate(fit.surface, {0, 0}), net.front()) < 1e-13);
  BOOST_TEST(distance(evaluate(fit.surface, {1, 1}), net.back()) < 1e-13);
  std::vector<Point> flat;  // a plane is in every such space
  for (int i = 0; i < 21; ++i)
    for (int j = 0; j < 16; ++j) flat.push_back({i / 20.0, j / 15.0, 2.0 * i / 20.0 - j / 15.0});
  BOOST_TEST(approximate_net(flat, 16, 2, 3, 5, 6)->error < 1e-12);
  double last = infinity;
  for (const double tolerance : {1e-1, 1e-3, 1e-5}) {
    const SurfaceFit within = approximate_net_within(net, 16, tolerance).value();
    BOOST_TEST(within.error <= tolerance);
    BOOST_TEST(within.error <= last * 1.1);
    last = within.error;
  }
  BOOST_TEST(!approximate_net(net, 16, 3, 3, 3, 7).has_value());
}

BOOST_AUTO_TEST_CASE(approximation_within_a_bound_keeps_it_with_few_poles) {
  Random random(118);
  std::vector<Point> points = helix(200);
  points.insert(points.begin() + 50, points[50]);  // repeated data
  double last = 0;
  for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
    const Fit fit = approximate_within(points, tolerance).value();
    BOOST_TEST(fit.error <= tolerance);
    BOOST_TEST(worst_distance(fit, points) <= fit.error);
    BOOST_TEST(static_cast<double>(fit.curve.poles().size()) >= last);
    BOOST_TEST(fit.curve.poles().size() < 70u);
    last = static_cast<double>(fit.curve.poles().size());
    BOOST_TEST_MESSAGE("helix, 200 points, tolerance " << tolerance << ": " << fit.curve.poles().size() << " poles");
  }
  BOOST_TEST(!approximate_within(points, 0).has_value());
}

BOOST_AUTO_TEST_CASE(single_arcs_fit_what_is_one) {
  std::vector<Point> circle, cubic;
  for (int i = 0; i <= 12; ++i) {
    const double a = 0.1 * i, t = i / 12.0;
    circle.push_back({2 * std::cos(a), 2 * std::sin(a), 0});
    const double s = 1 - t;
    cubic.push_back(
        {3 * t * s * s * 1 + 3 * t * t * s * 2 + t * t * t * 3, 3 * t * s * s * 2 + 3 * t * t * s * 2, t * t * t});
  }
  const Fit arc = fit_conic(circle, {0, 1, 0}, {-std::sin(1.2), std::cos(1.2), 0}, 1e-9).value();
  BOOST_TEST(arc.error < 1e-9);
  for (int i = 0; i <= 20; ++i) BOOST_TEST(std::abs(norm(to_vector(evaluate(arc.curve, i / 20.0))) - 2) < 1e-9);
  // The end tangent of the cubic is P3 - P2 = (1, -2, 1) from (2, 2, 0).
  const Fit piece = fit_cubic(cubic, {1, 2, 0}, {1, -2, 1}, 1e-9).value();
  BOOST_TEST(piece.error < 1e-9);
  BOOST_TEST(!fit_conic(helix(30), {0, 1, 0.3}, {0, 1, 0.3}, 1e-6).has_value());
  for (const bool conics : {false, true}) {
    const Fit runs = fit_local(helix(200), 1e-4, conics).value();
    BOOST_TEST(runs.error <= 1e-4);
    BOOST_TEST(runs.curve.poles().size() < 120u);
    for (int i = 0; i <= 500; ++i) {  // near the helix in between as well
      const Point p = evaluate(runs.curve, runs.curve.domain().at(i / 500.0));
      BOOST_TEST(std::abs(std::hypot(p.x, p.y) - 1) < 3e-4);
    }
    std::vector<Point> spiral;  // in a plane
    for (int i = 0; i < 200; ++i)
      spiral.push_back({(1 + 0.01 * i) * std::cos(0.05 * i), (1 + 0.01 * i) * std::sin(0.05 * i), 0});
    const Fit flat = fit_local(spiral, 1e-4, conics).value();
    BOOST_TEST(flat.error <= 1e-4);
    BOOST_TEST(bezier_pieces(flat.curve).size() < 40u);
    BOOST_TEST_MESSAGE("helix, 200 points, 1e-4, " << (conics ? "conics: " : "cubics: ")
                                                   << bezier_pieces(runs.curve).size() << " pieces");
  }
}
