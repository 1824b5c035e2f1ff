#pragma once
// Taylor models: a polynomial in x over [-1, 1] and a radius that holds what the polynomial leaves out, rounding
// included. A shape evaluated with a model for its parameter gives models of its coordinates, and with them bounds that
// hold over a whole interval. Makino and Berz, "Taylor models and other validated functional inclusion methods" (2003).

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace trimloop::detail {

class TaylorModel {
 public:
  static constexpr int order = 7;

  TaylorModel(double constant = 0) { c_[0] = constant; }
  // centre + radius x: the parameter of an interval.
  static TaylorModel over(double lo, double hi) {
    TaylorModel m(0.5 * (lo + hi));
    m.c_[1] = 0.5 * (hi - lo);
    m.radius_ = ulp * (std::abs(lo) + std::abs(hi));
    m.least_ = lo;
    m.most_ = hi;
    return m;
  }

  double constant() const { return c_[0]; }
  double coefficient(int k) const { return c_[static_cast<std::size_t>(k)]; }
  double radius() const { return radius_; }
  // Bound of |model - constant|.
  double spread() const {
    double sum = radius_;
    for (int k = 1; k <= order; ++k) sum += std::abs(coefficient(k));
    return sum * (1 + 16 * ulp);
  }
  double magnitude() const { return std::abs(c_[0]) + spread(); }
  // Of a model made by over() exactly its ends: a parameter that runs from knot to knot touches one span.
  double lower() const { return std::max(least_, c_[0] - spread()); }
  double upper() const { return std::min(most_, c_[0] + spread()); }
  bool is_finite() const { return std::isfinite(magnitude()); }

  TaylorModel& operator+=(const TaylorModel& b) {
    forget_ends();
    double rounding = 0;
    for (std::size_t k = 0; k < size; ++k) {
      c_[k] += b.c_[k];
      rounding += std::abs(c_[k]);
    }
    radius_ += b.radius_ + 0.6 * ulp * rounding;
    return *this;
  }
  // this += s b
  void add(double s, const TaylorModel& b) {
    forget_ends();
    double rounding = 0;
    for (std::size_t k = 0; k < size; ++k) {
      const double product = s * b.c_[k];
      c_[k] += product;
      rounding += std::abs(product) + std::abs(c_[k]);
    }
    radius_ += std::abs(s) * b.radius_ * (1 + 4 * ulp) + 0.6 * ulp * rounding;
  }
  TaylorModel& operator*=(double s) {
    forget_ends();
    double rounding = 0;
    for (double& c : c_) {
      c *= s;
      rounding += std::abs(c);
    }
    radius_ = std::abs(s) * radius_ * (1 + 4 * ulp) + 0.6 * ulp * rounding;
    return *this;
  }
  TaylorModel& widen(double by) {
    if (by != 0) forget_ends();
    radius_ += by;
    return *this;
  }

  friend TaylorModel operator+(TaylorModel a, const TaylorModel& b) { return a += b; }
  friend TaylorModel operator-(TaylorModel a) {
    a.forget_ends();
    for (double& c : a.c_) c = -c;
    return a;
  }
  friend TaylorModel operator-(const TaylorModel& a, const TaylorModel& b) { return a + -b; }
  friend TaylorModel operator*(double s, TaylorModel a) { return a *= s; }
  friend TaylorModel operator*(const TaylorModel& a, const TaylorModel& b) {
    TaylorModel r;
    double sizes_a = a.radius_, sizes_b = b.radius_, beyond = 0;
    std::array<double, size> tail{};  // sums of |b_j| from j on
    for (std::size_t j = size; j-- > 0;) tail[j] = std::abs(b.c_[j]) + (j + 1 < size ? tail[j + 1] : 0);
    for (std::size_t i = 0; i < size; ++i) {
      const double f = a.c_[i];
      sizes_a += std::abs(f);
      if (f == 0) continue;
      for (std::size_t j = 0; i + j < size; ++j) r.c_[i + j] += f * b.c_[j];
      if (i > 0) beyond += std::abs(f) * tail[size - i];
    }
    sizes_b += tail[0];
    r.radius_ = (beyond + sizes_a * b.radius_ + a.radius_ * tail[0]) * (1 + 16 * ulp) +
                5 * ulp * sizes_a * sizes_b;  // sums of up to eight products
    return r;
  }
  friend TaylorModel square(const TaylorModel& a) { return a * a; }
  // Infinite radius when the divisor may be zero.
  friend TaylorModel reciprocal(const TaylorModel& b) {
    TaylorModel r;  // the series, and how far its product with b is from one
    for (std::size_t k = 0; k < size; ++k) {
      double sum = k == 0 ? 1 : 0;
      for (std::size_t j = 1; j <= k; ++j) sum -= b.c_[j] * r.c_[k - j];
      r.c_[k] = sum / b.c_[0];
    }
    const double off = (TaylorModel(1) - b * r).magnitude();
    if (!(off < 0.5)) return unknown();
    r.radius_ = r.magnitude() * off / (1 - off) * (1 + 16 * ulp);
    return r;
  }
  friend TaylorModel operator/(const TaylorModel& a, const TaylorModel& b) { return a * reciprocal(b); }
  // Infinite radius when the argument may reach zero.
  friend TaylorModel sqrt(const TaylorModel& a) {
    if (!(a.lower() > 0)) return unknown();
    TaylorModel r(std::sqrt(a.c_[0]));
    for (std::size_t k = 1; k < size; ++k) {
      double sum = a.c_[k];
      for (std::size_t j = 1; j < k; ++j) sum -= r.c_[j] * r.c_[k - j];
      r.c_[k] = sum / (2 * r.c_[0]);
    }
    // |sqrt a - r| = |a - r^2| / (sqrt a + r)
    if (!(r.lower() > 0)) return unknown();
    r.radius_ = (a - r * r).magnitude() / (std::sqrt(a.lower()) + r.lower()) * (1 + 16 * ulp);
    return r;
  }
  friend void sin_cos(const TaylorModel& a, TaylorModel& sine, TaylorModel& cosine) {
    series(a, std::sin(a.c_[0]), std::cos(a.c_[0]), -1, sine, cosine);
  }
  friend void sinh_cosh(const TaylorModel& a, TaylorModel& sine, TaylorModel& cosine) {
    series(a, std::sinh(a.c_[0]), std::cosh(a.c_[0]), 1, sine, cosine);
  }
  static TaylorModel unknown() { return TaylorModel(0).widen(std::numeric_limits<double>::infinity()); }

 private:
  static constexpr std::size_t size = order + 1;
  static constexpr double ulp = std::numeric_limits<double>::epsilon();

  // s(a0 + z) = s c(z) + c s(z), c(a0 + z) = c c(z) + sign s s(z), by powers of z; sign -1: circular, 1: hyperbolic.
  static void series(const TaylorModel& a, double s, double c, double sign, TaylorModel& sine, TaylorModel& cosine) {
    TaylorModel z = a;
    z.forget_ends();
    z.c_[0] = 0;
    const double reach = z.magnitude();
    if (!(reach < 4)) {
      sine = cosine = unknown();
      return;
    }
    TaylorModel odd = z, even(1), power = z;
    double factorial = 1, last = 1;
    constexpr int terms = 13;  // the powers come for a few products, and then wide intervals are no matter
    for (int k = 2; k <= terms; ++k) {
      power = power * z;
      factorial *= k;
      const double turn = (k / 2) % 2 == 0 || sign > 0 ? 1 : -1;
      (k % 2 == 0 ? even : odd) += turn / factorial * power;
      last = k;
    }
    const double rest = std::pow(reach, terms + 1) / (factorial * (last + 1)) * (sign > 0 ? std::cosh(reach) : 1);
    even.widen(rest), odd.widen(rest);
    const double rounding = 2 * ulp * (std::abs(s) + std::abs(c));
    sine = (s * even + c * odd).widen(rounding * (1 + reach));
    cosine = (c * even + sign * s * odd).widen(rounding * (1 + reach));
  }

  static constexpr double infinite = std::numeric_limits<double>::infinity();
  void forget_ends() { least_ = -infinite, most_ = infinite; }

  std::array<double, size> c_{};
  double radius_ = 0;
  double least_ = -infinite, most_ = infinite;  // what is known besides
};

struct ModelPoint {
  TaylorModel x, y, z;
};
inline ModelPoint operator+(const ModelPoint& a, const ModelPoint& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline ModelPoint operator-(const ModelPoint& a, const ModelPoint& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline ModelPoint operator*(const TaylorModel& s, const ModelPoint& a) { return {s * a.x, s * a.y, s * a.z}; }
inline ModelPoint cross(const ModelPoint& a, const ModelPoint& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline TaylorModel dot(const ModelPoint& a, const ModelPoint& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
// Bound of the length over the interval.
inline double magnitude(const ModelPoint& a) {
  const double x = a.x.magnitude(), y = a.y.magnitude(), z = a.z.magnitude();
  return std::sqrt(x * x + y * y + z * z) * (1 + 8 * std::numeric_limits<double>::epsilon());
}

}  // namespace trimloop::detail
