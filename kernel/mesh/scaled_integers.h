#pragma once
// Exact signs by integer arithmetic, for numbers that one power of two turns into whole numbers below 2^62: a few
// multiplications of 64 and 128 bits where expansions take hundreds of operations.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace trimloop::mesh {

template <std::size_t N>
struct ScaledIntegers {
  std::array<std::int64_t, N> value;
  bool exact = false;  // whether `value` is the input times a power of two

  // Magnitudes must lie in 2^-960..2^960, or be 0.
  explicit ScaledIntegers(const std::array<double, N>& x);
  std::int64_t operator[](std::size_t i) const { return value[i]; }
};

#ifdef __SIZEOF_INT128__

template <std::size_t N>
ScaledIntegers<N>::ScaledIntegers(const std::array<double, N>& x) {
  double largest = 0;
  for (double each : x) largest = std::max(largest, std::abs(each));
  const std::uint64_t exponent = std::bit_cast<std::uint64_t>(largest) >> 52;
  const double scale = std::bit_cast<double>((2 * 1023 + 61 - std::max<std::uint64_t>(exponent, 64)) << 52);
  for (std::size_t i = 0; i < N; ++i) {
    const double scaled = x[i] * scale;
    value[i] = static_cast<std::int64_t>(scaled);
    if (static_cast<double>(value[i]) != scaled) return;
  }
  exact = true;
}

__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 Unsigned128;

inline double sign_of(Int128 x) { return static_cast<double>(x > 0) - static_cast<double>(x < 0); }
inline Int128 cross_of(std::int64_t ax, std::int64_t ay, std::int64_t bx, std::int64_t by) {
  return Int128{ax} * by - Int128{ay} * bx;
}
inline double cross_sign(std::int64_t ax, std::int64_t ay, std::int64_t bx, std::int64_t by) {
  return sign_of(cross_of(ax, ay, bx, by));
}

struct Int256 {  // two's complement
  Int128 hi;
  Unsigned128 lo;
  double sign() const { return hi != 0 ? sign_of(hi) : static_cast<double>(lo != 0); }
  friend Int256 operator+(Int256 a, Int256 b) {
    const Unsigned128 low = a.lo + b.lo;
    return {a.hi + b.hi + (low < a.lo), low};
  }
};
// |a| and b below 2^126.
inline Int256 product(Int128 a, Unsigned128 b) {
  const auto a0 = static_cast<std::uint64_t>(a), b0 = static_cast<std::uint64_t>(b);
  const auto a1 = static_cast<std::int64_t>(a >> 64), b1 = static_cast<std::int64_t>(b >> 64);
  const Int128 middle = Int128{a1} * b0 + Int128{b1} * a0;
  const Int256 outer{Int128{a1} * b1, Unsigned128{a0} * b0};
  return outer + Int256{middle >> 64, static_cast<Unsigned128>(middle) << 64};
}
// The lifted determinant of three differences, as incircle has it.
inline double lifted_sign(std::int64_t ax, std::int64_t ay, std::int64_t bx, std::int64_t by, std::int64_t cx,
                          std::int64_t cy) {
  const auto lift = [](std::int64_t x, std::int64_t y) {
    return static_cast<Unsigned128>(Int128{x} * x) + static_cast<Unsigned128>(Int128{y} * y);
  };
  return (product(cross_of(bx, by, cx, cy), lift(ax, ay)) + product(cross_of(cx, cy, ax, ay), lift(bx, by)) +
          product(cross_of(ax, ay, bx, by), lift(cx, cy)))
      .sign();
}

#else  // without integers of 128 bits the other arithmetics do it

template <std::size_t N>
ScaledIntegers<N>::ScaledIntegers(const std::array<double, N>&) : value{} {}
inline double cross_sign(std::int64_t, std::int64_t, std::int64_t, std::int64_t) { return 0; }
inline double lifted_sign(std::int64_t, std::int64_t, std::int64_t, std::int64_t, std::int64_t, std::int64_t) {
  return 0;
}

#endif

}  // namespace trimloop::mesh
