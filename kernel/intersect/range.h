#pragma once
// Interval arithmetic with outward rounding, as far as the intersections need it (not part of the public face).
// Every result is widened by one unit in the last place, which covers the rounding of the operation before it.

#include <cmath>
#include <limits>

#include "kernel/math/vec.h"

namespace trimloop::detail {

struct Range {
  double lo = 0, hi = 0;
  Range() = default;
  constexpr Range(double at) : lo(at), hi(at) {}
  constexpr Range(double l, double h) : lo(l), hi(h) {}
  double mid() const { return 0.5 * (lo + hi); }
  double width() const { return hi - lo; }
  double magnitude() const { return std::max(std::abs(lo), std::abs(hi)); }
  bool contains(double x) const { return lo <= x && x <= hi; }
  bool excludes_zero() const { return lo > 0 || hi < 0; }
};

inline Range outward(Range r) {
  constexpr double ulp = std::numeric_limits<double>::epsilon(), tiny = std::numeric_limits<double>::min();
  return {r.lo - ulp * std::abs(r.lo) - tiny, r.hi + ulp * std::abs(r.hi) + tiny};
}
inline Range around(double centre, double radius) { return outward({centre - radius, centre + radius}); }
inline Range hull(Range a, Range b) { return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)}; }
inline Range operator+(Range a, Range b) { return outward({a.lo + b.lo, a.hi + b.hi}); }
inline Range operator-(Range a, Range b) { return outward({a.lo - b.hi, a.hi - b.lo}); }
inline Range operator-(Range a) { return {-a.hi, -a.lo}; }
inline Range operator*(double s, Range a) {
  return outward(s >= 0 ? Range{s * a.lo, s * a.hi} : Range{s * a.hi, s * a.lo});
}
inline Range operator*(Range a, Range b) {
  const double p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
  return outward({std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s))});
}
// `b` must be positive.
inline Range operator/(Range a, Range b) {
  return outward({a.lo / (a.lo < 0 ? b.lo : b.hi), a.hi / (a.hi > 0 ? b.lo : b.hi)});
}

struct RangeVector {
  Range x, y, z;
  Vector mid() const { return {x.mid(), y.mid(), z.mid()}; }
};
inline RangeVector operator+(const RangeVector& a, const RangeVector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline RangeVector operator-(const RangeVector& a, const RangeVector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline RangeVector operator-(const RangeVector& a) { return {-a.x, -a.y, -a.z}; }
inline RangeVector operator*(Range s, const RangeVector& a) { return {s * a.x, s * a.y, s * a.z}; }
inline RangeVector operator/(const RangeVector& a, Range s) { return {a.x / s, a.y / s, a.z / s}; }
inline Range dot(Vector a, const RangeVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Range dot(const RangeVector& a, const RangeVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline RangeVector cross(const RangeVector& a, const RangeVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline RangeVector widened(const RangeVector& a, double by) {
  const auto wide = [by](Range r) { return outward({r.lo - by, r.hi + by}); };
  return {wide(a.x), wide(a.y), wide(a.z)};
}

}  // namespace trimloop::detail
