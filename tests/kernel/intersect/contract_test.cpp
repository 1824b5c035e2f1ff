// What the intersections promise beside the corpus: symmetry, budgets, refusals, size and place.
#include <boost/test/unit_test.hpp>

#include "kernel/intersect/intersect.h"
#include "tests/kernel/geometry/shapes.h"
#include "tests/kernel/intersect/corpus.h"

using namespace trimloop;

BOOST_AUTO_TEST_SUITE(contract)

BOOST_AUTO_TEST_CASE(the_order_of_curves_does_not_matter) {
  for (const test::CurvePair& pair : test::plane_corpus()) {
    BOOST_TEST_CONTEXT(pair.name) {
      const auto found = intersect(pair.b, pair.a);
      BOOST_REQUIRE(found);
      BOOST_TEST(static_cast<int>(found->points.size()) == pair.expected.points);
      BOOST_TEST(static_cast<int>(found->overlaps.size()) == pair.expected.overlaps);
      BOOST_TEST(found->undecided.empty());
    }
  }
}

BOOST_AUTO_TEST_CASE(the_order_of_surfaces_does_not_matter) {
  for (const test::SurfacePair& pair : test::surface_corpus()) {
    BOOST_TEST_CONTEXT(pair.name) {
      SurfaceIntersectOptions coarse;
      coarse.fit_mm = 1e-5;
      const auto found = intersect(pair.b, pair.a, coarse);
      BOOST_REQUIRE(found);
      BOOST_TEST(found->components == pair.expected.components);
      BOOST_TEST(static_cast<int>(found->overlaps.size()) == pair.expected.overlaps);
      BOOST_TEST(found->undecided.empty());
    }
  }
}

BOOST_AUTO_TEST_CASE(size_and_place_do_not_matter) {
  for (const double scale : {1e-3, 1e3})
    for (const test::CurvePair& pair : test::plane_corpus()) {
      if (std::holds_alternative<Line>(pair.a.shape) && !is_bounded(pair.a)) continue;
      BOOST_TEST_CONTEXT(pair.name << " times " << scale) {
        const Transform m = Transform::translation({3 * scale, -2 * scale, 0}) * Transform::scale(scale);
        const auto a = transformed(pair.a, m), b = transformed(pair.b, m);
        BOOST_REQUIRE(a);
        BOOST_REQUIRE(b);
        const auto found = intersect(*a, *b);
        BOOST_REQUIRE(found);
        BOOST_TEST(static_cast<int>(found->points.size()) == pair.expected.points);
        BOOST_TEST(static_cast<int>(found->overlaps.size()) == pair.expected.overlaps);
      }
    }
}

BOOST_AUTO_TEST_CASE(a_wide_tolerance_joins_what_nearly_meets) {
  IntersectOptions wide;
  wide.tolerance_mm = 1e-3;
  const Curve line{Line{{-2, 1.0005, 0}, {2, 1.0005, 0}}}, circle{Circle{Frame{}, 1}};
  const auto near = intersect(line, circle, wide), exact = intersect(line, circle);
  BOOST_REQUIRE(near);
  BOOST_REQUIRE(exact);
  BOOST_TEST(exact->points.empty());
  BOOST_REQUIRE(near->points.size() == 1);
  BOOST_TEST((near->points[0].kind == ContactKind::Touch));
  BOOST_TEST(near->points[0].gap_mm <= 1e-3);
  const auto skew = intersect(Curve{Line{{-1, 0, 0}, {1, 0, 0}}}, Curve{Line{{0, -1, 5e-4}, {0, 1, 5e-4}}}, wide);
  BOOST_REQUIRE(skew);
  BOOST_REQUIRE(skew->points.size() == 1);
  BOOST_TEST(std::abs(skew->points[0].gap_mm - 5e-4) < 1e-12);
}

BOOST_AUTO_TEST_CASE(an_exhausted_budget_names_its_boxes) {
  IntersectOptions poor;
  poor.cells = 10;
  const auto found = intersect(Curve{Circle{Frame{}, 1}}, Curve{Ellipse{Frame{}, 2, 0.5}}, poor);
  BOOST_REQUIRE(found);
  BOOST_TEST(found->cells <= 10u);
  BOOST_TEST(!found->undecided.empty());
  SurfaceIntersectOptions little;
  little.cells = 10;
  const auto surfaces = intersect(Surface{Torus{Frame{}, 2, 0.5}}, Surface{Sphere{Frame{{2, 0, 0}}, 0.6}}, little);
  BOOST_REQUIRE(surfaces);
  BOOST_TEST(!surfaces->undecided.empty());
}

BOOST_AUTO_TEST_CASE(what_is_refused_and_why) {
  const std::vector<Point> poles{{0, 0, 0}, {1, 1, 0}, {2, 0, 0}};
  const Curve negative{*NurbsCurve::from_cartesian(2, {0, 0, 0, 1, 1, 1}, poles, std::vector<double>{1, -0.5, 1})};
  const auto refused = intersect(negative, Curve{Line{{0, -1, 0}, {2, 3, 0}}});
  BOOST_REQUIRE(!refused);
  BOOST_TEST((refused.error().code == ErrorCode::Unsupported));
  BOOST_TEST(refused.error().measured == -0.5);
  const CurvePtr base = std::make_shared<const Curve>(Curve{Circle{Frame{}, 1}});
  BOOST_TEST(!intersect(Curve{OffsetCurve{base, 0.1}}, Curve{Line{{0, 0, 0}, {2, 0, 0}}}));
  BOOST_TEST(!intersect(Surface{Cylinder{}}, Surface{Plane{Frame{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}}}}));
}

BOOST_AUTO_TEST_CASE(lines_and_planes_without_ends) {
  const auto line = [](Point p, Vector d) { return Curve{Line{p, p + d, {-infinity, infinity}}}; };
  const auto crossing = intersect(line({1, 2, 3}, {1, 0, 0}), line({-500, 2, 3}, {1, 1e-3, 0}));
  BOOST_REQUIRE(crossing);
  BOOST_REQUIRE(crossing->points.size() == 1);
  BOOST_TEST(distance(crossing->points[0].point, {-500, 2, 3}) < 1e-9);
  BOOST_TEST(intersect(line({0, 0, 0}, {1, 0, 0}), line({0, 0, 1}, {0, 1, 0}))->points.empty());
  BOOST_TEST(intersect(line({0, 0, 0}, {1, 0, 0}), line({0, 1, 0}, {-1, 0, 0}))->overlaps.empty());
  const auto same = intersect(line({0, 0, 0}, {1, 0, 0}), line({3, 0, 0}, {-2, 0, 0}));
  BOOST_REQUIRE(same->overlaps.size() == 1);
  BOOST_TEST(same->overlaps[0].opposed);

  const Surface a{Plane{test::tilted_frame()}}, b{Plane{make_frame({4, 1, -2}, {-1, 0.3, 2})}};
  const auto found = intersect(a, b);
  BOOST_REQUIRE(found);
  BOOST_REQUIRE(found->branches.size() == 1);
  const IntersectionBranch& branch = found->branches[0];
  for (const double t : {-100.0, 0.0, 7.0}) {
    BOOST_TEST(distance(evaluate(branch.curve, t), evaluate(a, evaluate(branch.first, t))) < 1e-12);
    BOOST_TEST(distance(evaluate(branch.curve, t), evaluate(b, evaluate(branch.second, t))) < 1e-12);
  }
  const Surface above{Plane{make_frame({0, 0, 1}, {0, 0, 1})}}, ground{Plane{}};
  BOOST_TEST(intersect(ground, above)->components == 0);
  BOOST_TEST(intersect(ground, ground)->overlaps.size() == 1u);
}

BOOST_AUTO_TEST_CASE(branches_run_on_over_the_seam) {
  // A ring about a cylinder that starts inside its turn: one closed branch, its image one turn long.
  const auto found = intersect(Surface{Cylinder{Frame{}, 1}}, Surface{Plane{make_frame({0, 0, 0.3}, {0.2, 0.1, 1})}},
                               {}, Interval{0, two_pi}, Interval{-2, 2});
  BOOST_REQUIRE(found);
  BOOST_REQUIRE(found->branches.size() == 1);
  const IntersectionBranch& b = found->branches[0];
  BOOST_TEST(b.closed);
  const Interval r = range(b.curve);
  BOOST_TEST(std::abs(std::abs(evaluate(b.first, r.hi).u - evaluate(b.first, r.lo).u) - two_pi) < 1e-6);
}

// Two ways to the same count: branches by subdivision of four parameters, their ends by curve and surface on the sides.
BOOST_AUTO_TEST_CASE(ends_of_branches_of_random_splines_are_contacts_of_their_sides) {
  for (unsigned seed = 30; seed < 42; ++seed) {
    BOOST_TEST_CONTEXT("seed " << seed) {
      const double k = seed;
      const NurbsSurface a = test::wavy_surface(seed);
      const Transform m = Transform::rotation({1.5, 2, 0}, {0.2 * std::fmod(k, 5) - 0.4, 0.1 * std::fmod(k, 3), 1},
                                              0.3 * std::fmod(k, 7) - pi / 2);
      const NurbsSurface b = transformed(swapped(test::wavy_surface(seed + 1000)), m);
      const auto found = intersect(Surface{a}, Surface{b});
      BOOST_REQUIRE(found);
      BOOST_TEST(found->undecided.empty());
      std::size_t ends = 0, contacts = 0;
      for (const IntersectionBranch& branch : found->branches) {
        BOOST_TEST(branch.bound_mm <= 1e-7);
        ends += branch.closed ? 0 : 2;
      }
      for (const auto& [s, other] : {std::pair{a, b}, std::pair{b, a}}) {
        for (const double u : {s.range_u().lo, s.range_u().hi})
          contacts += intersect(isocurve_u(s, u), other)->points.size();
        for (const double v : {s.range_v().lo, s.range_v().hi})
          contacts += intersect(isocurve_v(s, v), other)->points.size();
      }
      BOOST_TEST(ends == contacts);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
