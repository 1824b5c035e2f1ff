// The predicates against rational arithmetic: every sign must be the exact one, whatever the magnitudes.

#include "kernel/mesh/predicates.h"

#include <boost/test/unit_test.hpp>

#include "tests/kernel/mesh/exact_signs.h"

using namespace trimloop;
using namespace trimloop::mesh;

using namespace trimloop::test;

namespace {

int sign_of(double x) { return (x > 0) - (x < 0); }

struct Count {
  std::int64_t calls = 0, wrong = 0, ties = 0;
};

// Each sample is asked about in both ways. The families that are slow in the reference come less often.
Count compare_signs(std::int64_t calls, std::uint64_t seed) {
  Random r{seed};
  Count count;
  const auto note = [&](double sign, int expected) {
    ++count.calls;
    count.wrong += sign_of(sign) != expected;
    count.ties += expected == 0;
  };
  for (std::int64_t i = 0; count.calls < calls; ++i) {
    const auto in_200 = static_cast<int>(i % 200);
    const int family = in_200 < 3 ? 6 + in_200 : in_200 % 20 == 10 ? 9 : in_200 % 6;
    const auto [a, b, c, d] = sample(r, family);
    note(orient2d(a, b, c), exact_orient(a, b, c));
    note(incircle(a, b, c, d), exact_incircle(a, b, c, d));
  }
  return count;
}

}  // namespace

BOOST_AUTO_TEST_CASE(ten_million_signs_are_the_exact_ones) {
  const Count count = compare_signs(10'000'000, 20240607);
  BOOST_TEST(count.wrong == 0);
  BOOST_TEST(count.ties > 200'000);
}

// By name only: test_kernel_mesh --run_test=a_thousand_million_signs_are_the_exact_ones --log_level=message
BOOST_AUTO_TEST_CASE(a_thousand_million_signs_are_the_exact_ones, *boost::unit_test::disabled()) {
  Count sum;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Count count = compare_signs(10'000'000, seed);
    sum = {sum.calls + count.calls, sum.wrong + count.wrong, sum.ties + count.ties};
    BOOST_TEST_MESSAGE(sum.calls << " calls, " << sum.wrong << " wrong, " << sum.ties << " ties");
    BOOST_REQUIRE(sum.wrong == 0);
  }
}

BOOST_AUTO_TEST_CASE(overflow_and_underflow_do_not_matter) {
  const double big = std::numeric_limits<double>::max(), tiny = std::numeric_limits<double>::denorm_min();
  BOOST_TEST(orient2d({-big, -big}, {big, -big}, {0, big}) > 0);
  BOOST_TEST(orient2d({-big, -big}, {big, big}, {0, tiny}) > 0);
  BOOST_TEST(orient2d({-big, -big}, {big, big}, {tiny, tiny}) == 0);
  BOOST_TEST(orient2d({0, 0}, {tiny, 0}, {0, tiny}) > 0);
  BOOST_TEST(incircle({0, 0}, {tiny, 0}, {tiny, tiny}, {0, tiny}) == 0);
  BOOST_TEST(incircle({0, 0}, {2 * tiny, 0}, {2 * tiny, 2 * tiny}, {tiny, tiny}) > 0);
  BOOST_TEST(incircle({-big, 0}, {0, -big}, {big, 0}, {0, big}) == 0);
  BOOST_TEST(incircle({-big, 0}, {0, -big}, {big, 0}, {tiny, 0}) > 0);
}

BOOST_AUTO_TEST_CASE(a_crossing_point_is_near_both_lines_and_inside_both_boxes) {
  Random r;
  int tried = 0;
  for (int i = 0; i < 100'000; ++i) {
    auto p = sample(r, i % 6);
    const auto [a, b, c, d] = p;
    if (orient2d(a, b, c) * orient2d(a, b, d) >= 0 || orient2d(c, d, a) * orient2d(c, d, b) >= 0) continue;
    ++tried;
    const Uv x = crossing_point(a, b, c, d);
    BOOST_REQUIRE(x.u >= std::max(std::min(a.u, b.u), std::min(c.u, d.u)));
    BOOST_REQUIRE(x.u <= std::min(std::max(a.u, b.u), std::max(c.u, d.u)));
    BOOST_REQUIRE(x.v >= std::max(std::min(a.v, b.v), std::min(c.v, d.v)));
    BOOST_REQUIRE(x.v <= std::min(std::max(a.v, b.v), std::max(c.v, d.v)));
    const Uv y = crossing_point(d, c, a, b);
    BOOST_REQUIRE(x.u == y.u);
    BOOST_REQUIRE(x.v == y.v);
    // Distance to each line, in exact numbers rounded once: a few units in the last place of the coordinates.
    double largest = 0;
    for (Uv q : p) largest = std::max({largest, std::abs(q.u), std::abs(q.v)});
    using Real = boost::multiprecision::cpp_rational;
    for (auto [s, e] : {std::pair(a, b), std::pair(c, d)}) {
      const Real cross =
          (Real(e.u) - Real(s.u)) * (Real(x.v) - Real(s.v)) - (Real(e.v) - Real(s.v)) * (Real(x.u) - Real(s.u));
      BOOST_REQUIRE(std::abs(static_cast<double>(cross)) / norm(e - s) <= 16 * 0x1p-53 * largest);
    }
  }
  BOOST_TEST(tried > 5'000);
}
