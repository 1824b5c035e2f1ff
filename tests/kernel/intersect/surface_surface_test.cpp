#include <boost/test/unit_test.hpp>

#include "kernel/intersect/intersect.h"
#include "kernel/pcurve/deviation.h"
#include "tests/kernel/intersect/corpus.h"

using namespace trimloop;

BOOST_AUTO_TEST_SUITE(surface_surface)

BOOST_AUTO_TEST_CASE(every_known_component_and_no_other) {
  for (const test::SurfacePair& pair : test::surface_corpus()) {
    BOOST_TEST_CONTEXT(pair.name) {
      SurfaceIntersectOptions options;
      options.fit_mm = 1e-7;
      const auto found = intersect(pair.a, pair.b, options);
      BOOST_REQUIRE(found);
      int loops = 0, tangential = 0, touches = 0, branchings = 0;
      double length = 0;
      for (const IntersectionBranch& b : found->branches) {
        loops += b.closed && !b.tangential;
        tangential += b.tangential;
        length += trimloop::length(b.curve);
        BOOST_TEST(b.bound_mm <= 1e-7);
        const Interval r = range(b.curve);
        for (int k = 0; k <= 40; ++k) {
          const double t = r.at(k / 40.0);
          const Point p = evaluate(b.curve, t);
          BOOST_TEST(distance(p, evaluate(pair.a, evaluate(b.first, t))) <= b.bound_mm + 1e-14);
          BOOST_TEST(distance(p, evaluate(pair.b, evaluate(b.second, t))) <= b.bound_mm + 1e-14);
        }
      }
      for (const SurfaceSurfacePoint& p : found->points) {
        touches += !p.branching;
        branchings += p.branching;
        BOOST_TEST(distance(evaluate(pair.a, p.first), p.point) <= 1e-10);
        BOOST_TEST(distance(evaluate(pair.b, p.second), p.point) <= 1e-10);
      }
      const test::SurfaceExpected& e = pair.expected;
      BOOST_TEST(found->components == e.components);
      BOOST_TEST(loops == e.loops);
      BOOST_TEST(touches == e.touches);
      BOOST_TEST(tangential == e.tangential);
      BOOST_TEST(branchings == e.branchings);
      BOOST_TEST(static_cast<int>(found->overlaps.size()) == e.overlaps);
      BOOST_TEST(found->undecided.empty());
      if (pair.length > 0) BOOST_TEST(std::abs(length - pair.length) <= 1e-4 * pair.length);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
