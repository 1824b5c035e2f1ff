#pragma once
// Points, vectors, parameter pairs, intervals and boxes: plain data. Lengths in millimetres, angles in radians.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace trimloop {

constexpr double pi = std::numbers::pi;
constexpr double two_pi = 2 * std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Vector {
  double x = 0, y = 0, z = 0;
};
struct Point {
  double x = 0, y = 0, z = 0;
};
struct Uv {
  double u = 0, v = 0;
};

inline Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector operator-(Vector a) { return {-a.x, -a.y, -a.z}; }
inline Vector operator*(double s, Vector a) { return {s * a.x, s * a.y, s * a.z}; }
inline Vector operator*(Vector a, double s) { return s * a; }
inline Vector operator/(Vector a, double s) { return {a.x / s, a.y / s, a.z / s}; }
inline Vector& operator+=(Vector& a, Vector b) { return a = a + b; }
inline Vector operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Point operator+(Point p, Vector v) { return {p.x + v.x, p.y + v.y, p.z + v.z}; }
inline Point operator-(Point p, Vector v) { return {p.x - v.x, p.y - v.y, p.z - v.z}; }
inline double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(Vector a) { return std::sqrt(dot(a, a)); }
inline double distance(Point a, Point b) { return norm(a - b); }
inline Point midpoint(Point a, Point b) { return {0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0.5 * (a.z + b.z)}; }
inline Vector to_vector(Point p) { return {p.x, p.y, p.z}; }
inline Point to_point(Vector v) { return {v.x, v.y, v.z}; }
// Unit vector, or the zero vector when `a` has no direction.
inline Vector normalized(Vector a) {
  const double n = norm(a);
  return n > 0 && std::isfinite(n) ? a / n : Vector{};
}
inline bool is_finite(Point p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }
inline bool is_finite(Vector p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

inline Uv operator+(Uv a, Uv b) { return {a.u + b.u, a.v + b.v}; }
inline Uv operator-(Uv a, Uv b) { return {a.u - b.u, a.v - b.v}; }
inline Uv operator*(double s, Uv a) { return {s * a.u, s * a.v}; }
inline double dot(Uv a, Uv b) { return a.u * b.u + a.v * b.v; }
inline double cross(Uv a, Uv b) { return a.u * b.v - a.v * b.u; }
inline double norm(Uv a) { return std::hypot(a.u, a.v); }
inline bool is_finite(Uv p) { return std::isfinite(p.u) && std::isfinite(p.v); }

// Closed interval; either end may be infinite. lo > hi is the empty one.
struct Interval {
  double lo = 0, hi = 0;
  double length() const { return hi - lo; }
  double mid() const { return 0.5 * (lo + hi); }
  bool contains(double t) const { return lo <= t && t <= hi; }
  double clamp(double t) const { return std::min(std::max(t, lo), hi); }
  double at(double fraction) const { return fraction == 1 ? hi : lo + fraction * (hi - lo); }
  bool is_bounded() const { return std::isfinite(lo) && std::isfinite(hi); }
};

struct Box {
  Point lo{infinity, infinity, infinity};
  Point hi{-infinity, -infinity, -infinity};
  bool empty() const { return !(lo.x <= hi.x); }
  void add(Point p) {
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y), std::min(lo.z, p.z)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y), std::max(hi.z, p.z)};
  }
  void add(const Box& b) {
    if (!b.empty()) add(b.lo), add(b.hi);
  }
  double diagonal() const { return empty() ? 0 : distance(lo, hi); }
};

// Right-handed orthonormal frame.
struct Frame {
  Point origin;
  Vector x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
};
// Frame with the given axis; x is `reference` made orthogonal, or any direction when that is not possible.
Frame make_frame(Point origin, Vector axis, Vector reference = {});

}  // namespace trimloop
