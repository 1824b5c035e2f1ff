#include <boost/test/unit_test.hpp>

#include "kernel/intersect/intersect.h"
#include "tests/kernel/intersect/corpus.h"

using namespace trimloop;

BOOST_AUTO_TEST_SUITE(curve_surface)

BOOST_AUTO_TEST_CASE(every_known_contact_and_no_other) {
  for (const test::CurveSurfacePair& pair : test::curve_surface_corpus()) {
    BOOST_TEST_CONTEXT(pair.name) {
      const auto found = intersect(pair.curve, pair.surface);
      BOOST_REQUIRE(found);
      int touches = 0;
      for (const CurveSurfacePoint& p : found->points) {
        touches += p.kind == ContactKind::Touch;
        BOOST_TEST(distance(evaluate(pair.curve, p.t), evaluate(pair.surface, p.uv)) <= 1e-11);
        BOOST_TEST(distance(evaluate(pair.curve, p.t), p.point) <= 1e-11);
      }
      BOOST_TEST(static_cast<int>(found->points.size()) == pair.expected.points);
      if (pair.expected.touches >= 0) BOOST_TEST(touches == pair.expected.touches);
      BOOST_TEST(static_cast<int>(found->overlaps.size()) == pair.expected.overlaps);
      BOOST_TEST(found->undecided.empty());
      for (const Point& p : pair.where) {
        double nearest = infinity;
        for (const CurveSurfacePoint& q : found->points) nearest = std::min(nearest, distance(p, q.point));
        BOOST_TEST(nearest <= (touches ? 1e-5 : 1e-9));
      }
      for (const CurveSurfaceOverlap& o : found->overlaps)
        for (int k = 0; k <= 20; ++k)
          BOOST_TEST(closest_point(pair.surface, evaluate(pair.curve, o.on_curve.at(k / 20.0))).distance <=
                     o.bound_mm + 1e-12);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
