// The predicates against rational arithmetic: every sign must be the exact one, whatever the magnitudes.

#include "kernel/mesh/predicates.h"

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <boost/test/unit_test.hpp>
#include <random>

using namespace trimloop;
using namespace trimloop::mesh;

namespace {

using Whole = boost::multiprecision::cpp_int;

int sign_of(double x) { return (x > 0) - (x < 0); }

// All coordinates times one power of two that makes them whole numbers.
template <std::size_t N>
std::array<Whole, 2 * N> whole(const std::array<Uv, N>& points) {
  std::array<Whole, 2 * N> out;
  std::array<int, 2 * N> exponent{};
  int lowest = 1100;
  for (std::size_t i = 0; i < 2 * N; ++i) {
    const double x = i % 2 ? points[i / 2].v : points[i / 2].u;
    out[i] = static_cast<long long>(std::ldexp(std::frexp(x, &exponent[i]), 53));
    if (x != 0) lowest = std::min(lowest, exponent[i]);
  }
  for (std::size_t i = 0; i < 2 * N; ++i) {
    if (out[i] != 0) out[i] <<= exponent[i] - lowest;
  }
  return out;
}

int exact_orient(Uv a, Uv b, Uv c) {
  const auto w = whole<3>({a, b, c});
  const Whole left = (w[0] - w[4]) * (w[3] - w[5]), right = (w[1] - w[5]) * (w[2] - w[4]);
  return Whole(left - right).sign();
}

int exact_incircle(Uv a, Uv b, Uv c, Uv d) {
  const auto w = whole<4>({a, b, c, d});
  std::array<Whole, 3> x, y, lift;
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = w[2 * i] - w[6];
    y[i] = w[2 * i + 1] - w[7];
    lift[i] = x[i] * x[i] + y[i] * y[i];
  }
  return Whole(lift[0] * (x[1] * y[2] - x[2] * y[1]) + lift[1] * (x[2] * y[0] - x[0] * y[2]) +
               lift[2] * (x[0] * y[1] - x[1] * y[0]))
      .sign();
}

struct Random {
  std::mt19937_64 engine{20240607};
  double unit() { return std::ldexp(static_cast<double>(engine() >> 11), -53); }
  double between(double lo, double hi) { return lo + (hi - lo) * unit(); }
  int whole(int lo, int hi) { return lo + static_cast<int>(engine() % static_cast<unsigned>(hi - lo + 1)); }
  double signed_power(int lo, int hi) { return std::ldexp(between(-1, 1), whole(lo, hi)); }
};

double nudged(double x, int steps) {
  for (; steps > 0; --steps) x = std::nextafter(x, infinity);
  for (; steps < 0; ++steps) x = std::nextafter(x, -infinity);
  return x;
}
Uv nudged(Uv p, Random& r, int most) { return {nudged(p.u, r.whole(-most, most)), nudged(p.v, r.whole(-most, most))}; }

// A family of triples and quadruples, each made to be hard in its own way.
std::array<Uv, 4> sample(Random& r, int family) {
  std::array<Uv, 4> p;
  switch (family) {
    case 0:  // anywhere
      for (Uv& q : p) q = {r.between(-1, 1), r.between(-1, 1)};
      break;
    case 1:  // small grid: exact ties all the time
      for (Uv& q : p) q = {double(r.whole(0, 4)), double(r.whole(0, 4))};
      break;
    case 2: {  // on a line, a few units in the last place off it
      const Uv o{r.between(-1, 1), r.between(-1, 1)}, w{r.between(-1, 1), r.between(-1, 1)};
      for (Uv& q : p) q = nudged(o + r.between(-2, 2) * w, r, 2);
      break;
    }
    case 3: {  // on a circle, rounded, far from the origin or not
      const Uv o{r.signed_power(-3, 12), r.signed_power(-3, 12)};
      const double radius = std::ldexp(1.0, r.whole(-6, 6));
      for (Uv& q : p) {
        const double angle = r.between(0, two_pi);
        q = nudged(o + radius * Uv{std::cos(angle), std::sin(angle)}, r, 1);
      }
      break;
    }
    case 4: {  // corners of a rectangle around a point with many digits
      const double x = r.between(0, 1), y = r.between(0, 1), w = r.between(0, 1), h = r.between(0, 1);
      p = {Uv{x, y}, Uv{x + w, y}, Uv{x + w, y + h}, Uv{x, y + h}};
      break;
    }
    case 5:  // magnitudes mixed within reason
      for (Uv& q : p) q = {r.signed_power(-60, 60), r.signed_power(-60, 60)};
      break;
    case 6: {  // one huge or tiny scale, near ties
      const int scale = r.whole(-1050, 1000);
      for (Uv& q : p) q = {std::ldexp(r.whole(-9, 9), scale), std::ldexp(r.whole(-9, 9), scale)};
      p[3] = nudged(p[3], r, 1);
      break;
    }
    default:  // every exponent a double has
      for (Uv& q : p) q = {r.signed_power(-1073, 1023), r.signed_power(-1073, 1023)};
  }
  return p;
}

}  // namespace

BOOST_AUTO_TEST_CASE(orientation_has_the_exact_sign) {
  Random r;
  int wrong = 0, ties = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    // The last families are slow in the reference and come less often.
    const int family = i % 200 == 0 ? 7 : i % 200 == 1 ? 6 : i % 6;
    const auto p = sample(r, family);
    const int expected = exact_orient(p[0], p[1], p[2]);
    wrong += sign_of(orient2d(p[0], p[1], p[2])) != expected;
    ties += expected == 0;
  }
  BOOST_TEST(wrong == 0);
  BOOST_TEST(ties > 10'000);
}

BOOST_AUTO_TEST_CASE(incircle_has_the_exact_sign) {
  Random r;
  int wrong = 0, ties = 0;
  for (int i = 0; i < 500'000; ++i) {
    const int family = i % 200 == 0 ? 7 : i % 200 == 1 ? 6 : i % 6;
    const auto p = sample(r, family);
    const int expected = exact_incircle(p[0], p[1], p[2], p[3]);
    wrong += sign_of(incircle(p[0], p[1], p[2], p[3])) != expected;
    ties += expected == 0;
  }
  BOOST_TEST(wrong == 0);
  BOOST_TEST(ties > 10'000);
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
