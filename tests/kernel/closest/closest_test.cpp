// Certified nearest points against exhaustive search, closed forms and their own certificates.
//
// The long run, 100 000 queries over 250 surfaces:
//   build/dev/tests/test_kernel_closest --run_test=surfaces_long_run --log_level=message
#include "kernel/closest/closest.h"

#include <boost/test/unit_test.hpp>

#include "tests/kernel/closest/surfaces.h"

using namespace trimloop;
using testing::Random;

namespace {

struct Tally {
  int queries = 0, wrong = 0, above = 0, inconsistent = 0, open = 0;
  double worst_gap = 0, allowed_gap = 1e-6;  // shares of the size
};

// Where questions come from: anywhere around, near the surface, on it.
Point query(Random& random, const std::vector<Point>& samples, const Box& box) {
  const double d = box.diagonal();
  const Point on = samples[static_cast<std::size_t>(random.integer(0, static_cast<int>(samples.size()) - 1))];
  const Vector v{random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)};
  switch (random.integer(0, 3)) {
    case 0:
      return on + 1e-3 * d * v;
    case 1:
      return on + 0.2 * d * v;
    case 2:
      return {random.real(box.lo.x, box.hi.x), random.real(box.lo.y, box.hi.y), random.real(box.lo.z, box.hi.z)};
    default:
      return midpoint(box.lo, box.hi) + d * v;
  }
}

void ask(const NurbsSurface& s, Random& random, int queries, Tally& t) {
  const ClosestOnSurface index(s);
  const testing::Exhaustive exhaustive(s);
  Box box;
  for (const Point p : exhaustive.samples()) box.add(p);
  const double size = box.diagonal() + norm(to_vector(box.lo));
  for (int k = 0; k < queries; ++k, ++t.queries) {
    const Point p = query(random, exhaustive.samples(), box);
    const ClosestPoint found = index.nearest(p);
    const double reference = exhaustive.nearest(p);
    t.wrong += !(found.distance <= reference + 1e-9 * size);
    t.above += !(found.lower <= reference + 1e-12 * size);
    t.inconsistent += !(distance(evaluate(s, found.uv), found.point) <= 1e-12 * size) ||
                      !(std::abs(distance(found.point, p) - found.distance) <= 1e-12 * size) ||
                      !s.range_u().contains(found.uv.u) || !s.range_v().contains(found.uv.v);
    t.open += found.distance - found.lower > t.allowed_gap * size;
    t.worst_gap = std::max(t.worst_gap, (found.distance - found.lower) / size);
  }
}

void check(const Tally& t) {
  BOOST_TEST_MESSAGE(t.queries << " queries, " << t.wrong << " wrong, " << t.above << " false certificates, "
                               << t.inconsistent << " inconsistent, " << t.open << " certified to worse than "
                               << t.allowed_gap << " of the size (worst " << t.worst_gap << ")");
  BOOST_CHECK_EQUAL(t.wrong, 0);
  BOOST_CHECK_EQUAL(t.above, 0);
  BOOST_CHECK_EQUAL(t.inconsistent, 0);
  BOOST_CHECK_EQUAL(t.open, 0);
}

}  // namespace

BOOST_AUTO_TEST_CASE(surfaces_against_exhaustive_search) {
  Random random(31);
  Tally t;
  for (int kind = 0; kind < 60; ++kind) ask(testing::any_surface(random, kind), random, 50, t);
  check(t);
}

BOOST_AUTO_TEST_CASE(surfaces_long_run, *boost::unit_test::disabled()) {
  Random random(32);
  for (int part = 0; part < 10; ++part) {  // kinds one by one, to see which one is to blame
    Tally t;
    for (int i = 0; i < 25; ++i) ask(testing::any_surface(random, part), random, 400, t);
    BOOST_TEST_MESSAGE("kind " << part);
    check(t);
  }
}

// Sizes from 1e-6 to 1e6, far from the origin, squeezed flat, and shrunk to a curve or a point.
BOOST_AUTO_TEST_CASE(odd_sizes_places_and_degenerate_nets) {
  Random random(36);
  Tally t;
  t.allowed_gap = 1e-5;  // where no valley is a bowl, squared distances below rounding stay open: its square root
  for (int round = 0; round < 60; ++round) {
    const NurbsSurface s = testing::any_surface(random, round);
    Transform m;
    const double scale = std::pow(10.0, random.integer(-6, 6));
    for (std::size_t i = 0; i < 3; ++i) m.r[i][i] = scale;
    m.t = (round % 3 == 0 ? 1e4 * scale : 0.0) * Vector{1, -2, 3};
    NurbsSurface moved = transformed(s, m);
    if (round % 4 == 1) {  // flat in z; then all on a line; then one point
      std::vector<Hpoint> poles = moved.poles();
      for (Hpoint& h : poles) h = {h.x, round % 8 == 1 ? h.y : 0, 0, h.w};
      moved =
          NurbsSurface::from_homogeneous(moved.degree_u(), moved.degree_v(), moved.knots_u(), moved.knots_v(), poles)
              .value();
    }
    ask(moved, random, 30, t);
  }
  check(t);
  const NurbsSurface dot =
      NurbsSurface::from_cartesian(1, 1, {0, 0, 1, 1}, {0, 0, 1, 1}, std::vector<Point>(4, Point{1, 2, 3}), {}).value();
  BOOST_CHECK_CLOSE(ClosestOnSurface(dot).nearest({1, 2, 5}).distance, 2, 1e-12);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_CHECK_EQUAL(ClosestOnSurface(dot).nearest({nan, 0, 0}).distance, infinity);
  BOOST_CHECK_EQUAL(ClosestOnSurface(dot).nearest({infinity, 0, 0}).distance, infinity);
}

BOOST_AUTO_TEST_CASE(curves_against_samples) {
  Random random(33);
  for (int round = 0; round < 150; ++round) {
    const NurbsCurve c = random.curve(random.integer(1, 8), round % 3 != 0, round % 4 != 0);
    const ClosestOnCurve index(c);
    std::vector<Point> samples;
    const std::vector<double> at = breaks(c);
    for (std::size_t i = 0; i + 1 < at.size(); ++i)
      for (int k = 0; k <= 400; ++k) samples.push_back(evaluate(c, Interval{at[i], at[i + 1]}.at(k / 400.0)));
    Box box;
    for (const Point p : samples) box.add(p);
    for (int k = 0; k < 30; ++k) {
      const Point p = query(random, samples, box);
      const ClosestPoint found = index.nearest(p);
      double reference = infinity;
      for (const Point q : samples) reference = std::min(reference, distance(p, q));
      BOOST_CHECK_LE(found.distance, reference + 1e-13 * box.diagonal());
      BOOST_CHECK_LE(found.lower, found.distance);
      BOOST_CHECK_GE(found.lower, found.distance - 1e-7 * box.diagonal());
      BOOST_CHECK_SMALL(distance(evaluate(c, found.uv.u), found.point), 1e-12 * (box.diagonal() + 20));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_continuum_of_nearest_points_is_answered_and_bounded) {
  const Frame frame = make_frame({1, 2, 3}, {0, 0, 1});
  const NurbsSurface sphere = to_nurbs(Surface{Sphere{frame, 2}}, {0, two_pi}, {-pi / 2, pi / 2})->surface;
  const ClosestOnSurface on_sphere(sphere);
  const ClosestPoint centre = on_sphere.nearest({1, 2, 3});
  BOOST_CHECK_CLOSE(centre.distance, 2, 1e-10);
  BOOST_CHECK_GE(centre.lower, 2 - 1e-8);
  const ClosestPoint near_centre = on_sphere.nearest({1 + 1e-7, 2, 3});
  BOOST_CHECK_SMALL(near_centre.distance - (2 - 1e-7), 1e-10);
  const NurbsSurface torus = to_nurbs(Surface{Torus{frame, 5, 1}}, {0, two_pi}, {0, two_pi})->surface;
  const ClosestPoint axis = ClosestOnSurface(torus).nearest({1, 2, 3});
  BOOST_CHECK_CLOSE(axis.distance, 4, 1e-10);
  BOOST_CHECK_GE(axis.lower, 4 - 1e-8);
}

BOOST_AUTO_TEST_CASE(all_answers_where_there_are_several) {
  // A circle of radius 2 asked from a point on the x axis: the nearest, and the farthest is no valley.
  const Curve circle{Circle{make_frame({0, 0, 0}, {0, 0, 1}, {1, 0, 0}), 2}};
  const auto on_circle = ClosestOnCurve::make(circle).value();
  BOOST_CHECK_EQUAL(on_circle.all({1, 0, 0}, 10).points.size(), 1u);
  // An ellipse from its centre: two nearest points.
  const Curve ellipse{Ellipse{make_frame({0, 0, 0}, {0, 0, 1}, {1, 0, 0}), 3, 1}};
  const ClosestPoints two = ClosestOnCurve::make(ellipse).value().all({0, 0, 0}, 1e-6);
  BOOST_REQUIRE_EQUAL(two.points.size(), 2u);
  BOOST_CHECK(two.complete);
  for (const ClosestPoint& c : two.points) {
    BOOST_CHECK_CLOSE(c.distance, 1, 1e-9);
    BOOST_CHECK_SMALL(distance(evaluate(ellipse, c.uv.u), c.point), 1e-12);
  }
  // A trough z = x^2 from above: both flanks; from far within, also the bottom's ridge is none.
  const std::vector<Point> net{{-2, 0, 4}, {-2, 1, 4}, {0, 0, -4}, {0, 1, -4}, {2, 0, 4}, {2, 1, 4}};
  const NurbsSurface trough = NurbsSurface::from_cartesian(2, 1, {0, 0, 0, 1, 1, 1}, {0, 0, 1, 1}, net, {}).value();
  const ClosestPoints flanks = ClosestOnSurface(trough).all({0, 0.5, 2}, 1e-6);
  BOOST_REQUIRE_EQUAL(flanks.points.size(), 2u);  // x^2 = 2 - 1/2
  BOOST_CHECK_CLOSE(std::abs(flanks.points[0].point.x), std::sqrt(1.5), 1e-8);
  BOOST_CHECK_CLOSE(std::abs(flanks.points[1].point.x), std::sqrt(1.5), 1e-8);
  BOOST_CHECK_LT(flanks.points[0].point.x * flanks.points[1].point.x, 0);
}

BOOST_AUTO_TEST_CASE(elementary_surfaces_go_by_closed_form_and_others_by_their_exact_nurbs) {
  Random random(34);
  const Frame frame = make_frame({1, 2, 3}, {1, 1, 1});
  const auto sphere = ClosestOnSurface::make({Sphere{frame, 3}}).value();
  const auto curve = std::make_shared<const Curve>(Curve{Ellipse{frame, 4, 2, {0, 3}}});
  const Surface swept{Extrusion{curve, {0, 1, 2}, {0, 5}}};
  const auto extrusion = ClosestOnSurface::make(swept).value();
  for (int k = 0; k < 100; ++k) {
    const Point p{random.real(-9, 9), random.real(-9, 9), random.real(-9, 9)};
    BOOST_CHECK_SMALL(sphere.nearest(p).distance - std::abs(distance(p, frame.origin) - 3), 1e-12);
    const ClosestPoint found = extrusion.nearest(p);
    BOOST_CHECK_SMALL(distance(evaluate(swept, found.uv), found.point), 1e-11);
    BOOST_CHECK_LE(found.distance, closest_point(swept, p).distance + 1e-10);
  }
  BOOST_CHECK(!ClosestOnSurface::make({Extrusion{curve, {0, 1, 2}, {-infinity, infinity}}}));
}

BOOST_AUTO_TEST_CASE(negative_and_zero_weights_are_searched_too) {
  // Half of an ellipse's complement: w runs 1, -0.5, 1; and the half circle with an ideal middle pole.
  const NurbsCurve half =
      NurbsCurve::from_homogeneous(2, {0, 0, 0, 1, 1, 1}, {{1, 0, 0, 1}, {0, 1, 0, 0}, {-1, 0, 0, 1}}).value();
  Random random(35);
  for (int k = 0; k < 50; ++k) {
    const Point p{random.real(-3, 3), random.real(0.1, 3), random.real(-3, 3)};
    const double expected = std::hypot(std::hypot(p.x, p.y) - 1, p.z);
    BOOST_CHECK_SMALL(ClosestOnCurve(half).nearest(p).distance - expected, 1e-9);
  }
}
