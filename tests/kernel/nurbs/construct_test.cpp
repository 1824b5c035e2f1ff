// What the constructors refuse, with what words and numbers, and what they let through.
#include <boost/test/unit_test.hpp>

#include "kernel/nurbs/surface.h"

using namespace trimloop;

namespace {

const double not_a_number = std::nan("");
using Knots = std::vector<double>;

std::vector<Hpoint> ramp(std::size_t count) {
  std::vector<Hpoint> poles(count);
  for (std::size_t i = 0; i < count; ++i) poles[i].x = static_cast<double>(i);
  return poles;
}

Result<NurbsCurve> make(int degree, Knots knots, std::size_t poles, std::optional<Interval> range = {}) {
  return NurbsCurve::from_homogeneous(degree, std::move(knots), ramp(poles), range);
}

template <class T>
void refuse(const Result<T>& result, const std::string& words, double measured = not_measured) {
  BOOST_TEST_REQUIRE(!result.has_value());
  BOOST_TEST((result.error().code == ErrorCode::InvalidArgument));
  BOOST_TEST(result.error().text.find(words) != std::string::npos, result.error().text);
  if (!std::isnan(measured)) BOOST_TEST(result.error().measured == measured);
}

}  // namespace

BOOST_AUTO_TEST_CASE(degrees_outside_1_to_64_are_refused) {
  refuse(make(0, {0, 1}, 1), "degree is 0", 0);
  refuse(make(-3, {0, 1}, 1), "degree is -3", -3);
  refuse(make(65, Knots(132), 66), "degree is 65", 65);
  Knots knots(65, 0.0);
  knots.resize(130, 1.0);
  BOOST_TEST(make(64, knots, 65).has_value());
}

BOOST_AUTO_TEST_CASE(wrong_counts_are_refused) {
  refuse(make(3, {0, 0, 0, 1, 1, 1}, 3), "needs at least 4 poles, there are 3", 3);
  refuse(make(3, {}, 0), "needs at least 4 poles, there are 0", 0);
  refuse(make(2, {0, 0, 0, 1, 1}, 3), "need 6 knots, there are 5", 5);
  refuse(make(2, {0, 0, 0, 1, 1, 1, 1}, 3), "need 6 knots, there are 7", 7);
  refuse(make(2, {}, 3), "need 6 knots, there are 0", 0);
  const std::vector<Point> points(3);
  const std::vector<double> two{1, 1};
  refuse(NurbsCurve::from_cartesian(2, {0, 0, 0, 1, 1, 1}, points, two), "2 weights for 3 points", 2);
}

BOOST_AUTO_TEST_CASE(bad_knots_are_refused_with_index_and_values) {
  refuse(make(1, {0, 0, 3, 2, 4, 4}, 4), "knot 2 is 3, knot 3 is 2", -1);
  refuse(make(1, {0, 0, not_a_number, 1, 1}, 3), "knot 2 is not finite");
  refuse(make(1, {0, 0, 1, infinity}, 2), "knot 3 is not finite", infinity);
  refuse(make(1, {-1e308, -1e308, 1e308, 1e308}, 2), "overflows");
  refuse(make(1, {0, 0, 1e-310, 1, 1}, 3), "differ by", 1e-310);
  refuse(make(2, {0, 1, 1, 1, 1, 2}, 3), "domain is empty: knots 2 and 3 are both 1");
}

BOOST_AUTO_TEST_CASE(multiplicities_are_limited_inside_and_at_the_ends) {
  refuse(make(2, {0, 0, 0, 1, 1, 1, 2, 2, 2}, 6), "knot 3 (1) inside has multiplicity 3", 3);
  refuse(make(1, {0, 0, 0, 1, 1}, 3), "knot 0 (0) at an end has multiplicity 3", 3);
  BOOST_TEST(make(2, {0, 0, 0, 1, 1, 2, 2, 2}, 5).has_value());
  // Any end multiplicity up to degree + 1, also beginning before the domain does.
  for (const Knots& k : {Knots{0, 1, 2, 3, 4, 5}, Knots{0, 0, 1, 2, 2, 3}, Knots{0, 1, 1, 2, 2, 2}})
    BOOST_TEST(make(2, k, 3).has_value());
  // Three knots at the start of the domain, the first of them knot 1: pole 0 has no say.
  const NurbsCurve c = make(2, {-1, 0, 0, 0, 1, 1, 1}, 4).value();
  BOOST_TEST(c.domain().lo == 0);
  BOOST_TEST(evaluate(c, 0).x == 1);
  BOOST_TEST(trimmed(c, c.domain()).poles().size() == 3u);
}

BOOST_AUTO_TEST_CASE(knots_that_differ_in_the_last_bit_are_different) {
  const double next = std::nextafter(1.0, 2.0);
  const NurbsCurve c = make(2, {0, 0, 0, 1, 1, next, 2, 2, 2}, 6).value();
  BOOST_TEST(breaks(c).size() == 4u);
  BOOST_TEST(is_finite(evaluate(c, next)));
  BOOST_TEST(is_finite(jet(c, 1).d2));
}

BOOST_AUTO_TEST_CASE(poles_must_be_finite_and_have_a_weight_somewhere) {
  const Knots k{0, 0, 1, 1};
  refuse(NurbsCurve::from_homogeneous(1, k, {{0, 0, 0, 1}, {0, not_a_number, 0, 1}}), "pole 1 is not finite");
  refuse(NurbsCurve::from_homogeneous(1, k, {{0, 0, 0, infinity}, {0, 0, 0, 1}}), "pole 0 is not finite");
  refuse(NurbsCurve::from_homogeneous(1, k, {{1, 0, 0, 0}, {2, 0, 0, 0}}), "all weights are zero");
  const std::vector<Point> points{{1e200, 0, 0}, {0, 0, 0}};
  const std::vector<double> huge{1e200, 1}, none{not_a_number, not_a_number}, endless{infinity, infinity};
  for (const auto& weights : {huge, none, endless})
    refuse(NurbsCurve::from_cartesian(1, k, points, weights), "pole 0 is not finite");
}

BOOST_AUTO_TEST_CASE(equal_weights_make_a_polynomial_with_the_digits_of_its_points) {
  const std::vector<Point> points{{0.1, 0.2, 0.3}, {0.7, 1.1, 1.3}};
  const std::vector<double> thirds{1.0 / 3, 1.0 / 3}, minus{-2, -2}, different{1, 2};
  for (const auto& weights : {std::vector<double>{}, thirds, minus}) {
    const NurbsCurve c = NurbsCurve::from_cartesian(1, {0, 0, 1, 1}, points, weights).value();
    BOOST_TEST(!c.is_rational());
    BOOST_TEST(c.poles()[1].y == 1.1);
    BOOST_TEST(c.poles()[1].w == 1);
  }
  BOOST_TEST(NurbsCurve::from_cartesian(1, {0, 0, 1, 1}, points, different).value().is_rational());
  const NurbsCurve c = NurbsCurve::from_homogeneous(1, {0, 0, 1, 1}, {{2, 4, 6, 2}, {8, 6, 4, 2}}).value();
  BOOST_TEST(!c.is_rational());
  BOOST_TEST(distance(evaluate(c, 0.5), {2.5, 2.5, 2.5}) == 0);
}

BOOST_AUTO_TEST_CASE(a_range_is_inside_the_domain_up_to_rounding) {
  const Knots k{0, 0, 100, 100};
  BOOST_TEST(make(1, k, 2).value().range().hi == 100);
  BOOST_TEST(make(1, k, 2, Interval{25, 50}).value().range().lo == 25);
  const NurbsCurve cut = make(1, k, 2, Interval{-5e-8, 100 + 5e-8}).value();
  BOOST_TEST(cut.range().lo == 0);
  BOOST_TEST(cut.range().hi == 100);
  refuse(make(1, k, 2, Interval{-2e-7, 50}), "leaves the knot domain [0, 100] by 2e-07", 2e-7);
  refuse(make(1, k, 2, Interval{50, 101}), "leaves the knot domain", 1);
  refuse(make(1, k, 2, Interval{50, 50}), "range [50, 50] is empty", 0);
  refuse(make(1, k, 2, Interval{60, 50}), "is empty", -10);
  refuse(make(1, k, 2, Interval{not_a_number, 50}), "is empty");
  refuse(make(1, k, 2, Interval{0, infinity}), "leaves the knot domain", infinity);
  refuse(make(1, k, 2, Interval{-1e-8, 0}), "no length inside");
}

BOOST_AUTO_TEST_CASE(with_range_cuts_to_the_domain) {
  const NurbsCurve c = make(1, {0, 0, 100, 100}, 2).value().with_range({-5, 40});
  BOOST_TEST(c.range().lo == 0);
  BOOST_TEST(c.range().hi == 40);
}

BOOST_AUTO_TEST_CASE(surfaces_say_which_direction_is_wrong) {
  const Knots good{0, 0, 1, 1}, bad{0, 0, 1, 0};
  const auto surface = [&](Knots ku, Knots kv, std::size_t poles, std::optional<Interval> u = {},
                           std::optional<Interval> v = {}) {
    return NurbsSurface::from_homogeneous(1, 1, std::move(ku), std::move(kv), ramp(poles), u, v);
  };
  BOOST_TEST(surface(good, good, 4).has_value());
  refuse(surface(bad, good, 4), "u: knots descend");
  refuse(surface(good, bad, 4), "v: knots descend");
  refuse(surface({}, good, 4), "u: degree 1 needs at least 2 poles", 0);
  refuse(surface(good, {0, 1}, 4), "v: degree 1 needs at least 2 poles", 0);
  for (std::size_t poles : {0u, 3u, 5u, 6u, 8u})
    refuse(surface(good, good, poles), "ask for 2 x 2 poles", static_cast<double>(poles));
  refuse(surface(good, good, 4, Interval{0, 2}), "u: range");
  refuse(surface(good, good, 4, {}, Interval{0, 2}), "v: range");
  refuse(NurbsSurface::from_homogeneous(-1, 1, good, good, ramp(4)), "u: degree is -1");
  refuse(NurbsSurface::from_homogeneous(1, 2147483647, good, good, ramp(4)), "v: degree is 2147483647");
  const std::vector<Point> points(4);
  const std::vector<double> weights(3, 1.0), zeros(4, 0.0);
  refuse(NurbsSurface::from_cartesian(1, 1, good, good, points, weights), "3 weights for 4 points");
  refuse(NurbsSurface::from_cartesian(1, 1, good, good, points, zeros), "all weights are zero");
}
