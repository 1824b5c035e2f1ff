#pragma once
// What the predicates are tested with: points that are hard in several ways, and the signs of both determinants by
// integers of any length (all coordinates of a call times one power of two are whole numbers, so that these are the
// rationals without their common denominator).

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>

#include "kernel/math/vec.h"

namespace trimloop::test {

struct Random {
  std::mt19937_64 engine;
  explicit Random(std::uint64_t seed = 20240607) : engine(seed) {}
  double unit() { return std::ldexp(static_cast<double>(engine() >> 11), -53); }
  double between(double lo, double hi) { return lo + (hi - lo) * unit(); }
  int whole(int lo, int hi) { return lo + static_cast<int>(engine() % static_cast<unsigned>(hi - lo + 1)); }
  double signed_power(int lo, int hi) {
    const double fraction = between(-1, 1);
    return std::ldexp(fraction, whole(lo, hi));
  }
};

inline double nudged(double x, int steps) {
  for (; steps > 0; --steps) x = std::nextafter(x, infinity);
  for (; steps < 0; ++steps) x = std::nextafter(x, -infinity);
  return x;
}
inline Uv nudged(Uv p, Random& r, int most) {
  return {nudged(p.u, r.whole(-most, most)), nudged(p.v, r.whole(-most, most))};
}

using Sample = std::array<Uv, 4>;

// A family of triples and quadruples, each made to be hard in its own way; 0 to 5 within ordinary magnitudes.
inline Sample sample(Random& r, int family) {
  Sample p;
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
    case 7:  // every exponent a double has
      for (Uv& q : p) q = {r.signed_power(-1073, 1023), r.signed_power(-1073, 1023)};
      break;
    case 8: {  // lines and circles at the lower end of the range, down into the subnormal numbers, and at the upper end
      const bool tiny = r.whole(0, 1) == 0;
      const int scale = tiny ? r.whole(-1074, -1000) : r.whole(960, 1008);
      p = sample(r, r.whole(2, 4));
      for (Uv& q : p) q = nudged({std::ldexp(q.u, scale), std::ldexp(q.v, scale)}, r, 1);
      break;
    }
    default: {  // a line or a circle that has three points, and a fourth one next to one of them
      p = sample(r, r.whole(2, 3));
      p[3] = nudged(p[static_cast<std::size_t>(r.whole(0, 2))], r, 2);
    }
  }
  return p;
}

namespace exact_detail {

namespace mp = boost::multiprecision;
using Narrow = mp::number<mp::cpp_int_backend<1024, 1024, mp::signed_magnitude, mp::unchecked, void>>;
using Wide = mp::cpp_int;

template <std::size_t N>
struct Exponents {
  std::array<std::int64_t, 2 * N> digits{};  // x = digits * 2^exponent
  std::array<int, 2 * N> exponent{};
  int lowest = 0, highest = 0;

  explicit Exponents(const std::array<Uv, N>& points) {
    bool any = false;
    for (std::size_t i = 0; i < 2 * N; ++i) {
      const double x = i % 2 ? points[i / 2].v : points[i / 2].u;
      digits[i] = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent[i]), 53));
      if (x == 0) continue;
      lowest = any ? std::min(lowest, exponent[i]) : exponent[i];
      highest = any ? std::max(highest, exponent[i]) : exponent[i];
      any = true;
    }
  }
  bool is_narrow() const { return 4 * (highest - lowest + 55) < 1024; }
  template <class Whole>
  std::array<Whole, 2 * N> whole() const {
    std::array<Whole, 2 * N> out;
    for (std::size_t i = 0; i < 2 * N; ++i) {
      out[i] = digits[i];
      if (digits[i] != 0) out[i] <<= exponent[i] - lowest;
    }
    return out;
  }
};

template <class Whole>
int orient_sign(const std::array<Whole, 6>& w) {
  const Whole left = (w[0] - w[4]) * (w[3] - w[5]), right = (w[1] - w[5]) * (w[2] - w[4]);
  return left.compare(right);
}

template <class Whole>
int incircle_sign(const std::array<Whole, 8>& w) {
  std::array<Whole, 3> x, y, lift;
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = w[2 * i] - w[6];
    y[i] = w[2 * i + 1] - w[7];
    lift[i] = x[i] * x[i] + y[i] * y[i];
  }
  Whole sum = lift[0] * Whole(x[1] * y[2] - x[2] * y[1]);
  sum += lift[1] * Whole(x[2] * y[0] - x[0] * y[2]);
  sum += lift[2] * Whole(x[0] * y[1] - x[1] * y[0]);
  return sum.sign();
}

}  // namespace exact_detail

inline int exact_orient(Uv a, Uv b, Uv c) {
  const exact_detail::Exponents<3> e({a, b, c});
  const int s = e.is_narrow() ? exact_detail::orient_sign(e.whole<exact_detail::Narrow>())
                              : exact_detail::orient_sign(e.whole<exact_detail::Wide>());
  return (s > 0) - (s < 0);
}

inline int exact_incircle(Uv a, Uv b, Uv c, Uv d) {
  const exact_detail::Exponents<4> e({a, b, c, d});
  return e.is_narrow() ? exact_detail::incircle_sign(e.whole<exact_detail::Narrow>())
                       : exact_detail::incircle_sign(e.whole<exact_detail::Wide>());
}

}  // namespace trimloop::test
