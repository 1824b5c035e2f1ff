#include <boost/test/unit_test.hpp>

#include "kernel/intersect/intersect.h"
#include "tests/kernel/intersect/corpus.h"

using namespace trimloop;

namespace {

void check(const test::CurvePair& pair) {
  BOOST_TEST_CONTEXT(pair.name) {
    const auto found = intersect(pair.a, pair.b);
    BOOST_REQUIRE(found);
    int touches = 0;
    for (const CurveCurvePoint& p : found->points) {
      touches += p.kind == ContactKind::Touch;
      BOOST_TEST(distance(evaluate(pair.a, p.t_first), evaluate(pair.b, p.t_second)) <= 1e-11);
      BOOST_TEST(distance(evaluate(pair.a, p.t_first), p.point) <= 1e-11);
    }
    BOOST_TEST(static_cast<int>(found->points.size()) == pair.expected.points);
    if (pair.expected.touches >= 0) BOOST_TEST(touches == pair.expected.touches);
    BOOST_TEST(static_cast<int>(found->overlaps.size()) == pair.expected.overlaps);
    BOOST_TEST(found->undecided.empty());
    for (const Point& p : pair.where) {
      double nearest = infinity;
      for (const CurveCurvePoint& q : found->points) nearest = std::min(nearest, distance(p, q.point));
      BOOST_TEST(nearest <= (touches ? pair.zone : 1e-9));
    }
    for (const CurveCurveOverlap& o : found->overlaps)
      for (int k = 0; k <= 20; ++k)
        BOOST_TEST(closest_point(pair.b, evaluate(pair.a, o.first.at(k / 20.0))).distance <= o.bound_mm + 1e-12);
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(curve_curve)

BOOST_AUTO_TEST_CASE(every_known_contact_in_the_plane_and_no_other) {
  for (const test::CurvePair& pair : test::plane_corpus()) check(pair);
}

BOOST_AUTO_TEST_CASE(every_known_contact_in_space_and_no_other) {
  for (const test::CurvePair& pair : test::space_corpus()) check(pair);
}

BOOST_AUTO_TEST_SUITE_END()
