#pragma once
// Random splines made to hurt, their exact twins, and the unit that errors are counted in.

#include <random>

#include "kernel/nurbs/surface.h"
#include "tests/exact/reference.h"

namespace trimloop::exact {

enum class Weights { None, Positive, Mixed, WithZeros };  // ratios up to 1e6; signs; ideal poles

class Cases {
 public:
  explicit Cases(unsigned seed) : engine_(seed) {}
  double real(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(engine_); }
  int integer(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(engine_); }
  bool chance(double p) { return real(0, 1) < p; }
  double in(Interval i) { return i.clamp(real(i.lo, i.hi)); }
  Weights weights() { return static_cast<Weights>(integer(0, 3)); }

  // Mostly low, up to `highest`.
  int degree(int highest = 25) {
    const double r = real(0, 1);
    return std::min(highest, r < 0.8 ? integer(1, 5) : r < 0.97 ? integer(6, 10) : integer(11, 25));
  }

  // Spacing over twelve decades, any multiplicity, clamped or with loose ends.
  std::vector<double> knots(int p, int most_inner = 4) {
    const bool clamped = chance(0.7), wild = chance(0.6);
    std::vector<double> k;
    double t = chance(0.3) ? 0 : real(-3, 3);
    const auto run = [&](int count) { k.insert(k.end(), static_cast<std::size_t>(count), t); };
    const auto step = [&] { t += wild ? std::pow(10.0, real(-12, 0)) : real(0.2, 2); };
    const auto end = [&] {
      if (clamped) return run(p + 1);
      for (int left = p + 1; left > 0;) {
        const int m = integer(1, left);
        run(m);
        if (left -= m; left > 0) step();
      }
    };
    end();
    step();
    for (int i = integer(0, most_inner); i > 0; --i) run(chance(0.6) ? 1 : integer(1, p)), step();
    end();
    return k;
  }

  std::vector<Hpoint> poles(std::size_t count, Weights kind) {
    const double scale = std::pow(10.0, integer(-3, 3));
    std::vector<Hpoint> out(count);
    for (Hpoint& h : out) {
      double w = kind == Weights::None ? 1 : std::pow(10.0, real(-3, 3));
      if (kind >= Weights::Mixed && chance(0.3)) w = -w;
      if (kind == Weights::WithZeros && chance(0.25)) w = 0;
      const double f = scale * (w == 0 ? 1 : w);
      h = {f * real(-1, 1), f * real(-1, 1), f * real(-1, 1), w};
    }
    out[0].w = out[0].w == 0 ? 1 : out[0].w;  // all zero is refused
    return out;
  }

  NurbsCurve curve(int p, Weights kind, int most_inner = 4) {
    for (;;) {
      std::vector<double> k = knots(p, most_inner);
      const std::size_t n = k.size() - static_cast<std::size_t>(p) - 1;
      if (auto c = NurbsCurve::from_homogeneous(p, std::move(k), poles(n, kind))) return *c;
    }
  }
  NurbsSurface surface(int p, int q, Weights kind, int most_inner = 2) {
    for (;;) {
      std::vector<double> ku = knots(p, most_inner), kv = knots(q, most_inner);
      const std::size_t n =
          (ku.size() - static_cast<std::size_t>(p) - 1) * (kv.size() - static_cast<std::size_t>(q) - 1);
      if (auto s = NurbsSurface::from_homogeneous(p, q, std::move(ku), std::move(kv), poles(n, kind))) return *s;
    }
  }

  // Inside, on a knot, beside a knot, at an end.
  double parameter(std::span<const double> knots, Interval domain) {
    const double r = real(0, 1);
    const auto any = [&] { return domain.clamp(knots[static_cast<std::size_t>(integer(0, int(knots.size()) - 1))]); };
    if (r < 0.2) return any();
    if (r < 0.35) return domain.clamp(std::nextafter(any(), chance(0.5) ? infinity : -infinity));
    if (r < 0.6) {  // inside a random span, however short
      const double a = any();
      const auto b = std::upper_bound(knots.begin(), knots.end(), a);
      if (b != knots.end()) return domain.clamp(in({a, *b}));
    }
    return in(domain);
  }

 private:
  std::mt19937 engine_;
};

inline std::vector<Rational> exact(const std::vector<double>& v) { return {v.begin(), v.end()}; }
inline void append(Row& row, const Hpoint& h) { row.insert(row.end(), {h.x, h.y, h.z, h.w}); }

inline Spline exact(const NurbsCurve& c) {
  Spline s{static_cast<std::size_t>(c.degree()), exact(c.knots()), {}};
  for (const Hpoint& h : c.poles()) append(s.poles.emplace_back(), h);
  return s;
}
// Along u, on rows of poles.
inline Spline exact(const NurbsSurface& s) {
  Spline out{static_cast<std::size_t>(s.degree_u()), exact(s.knots_u()), {}};
  for (std::size_t i = 0; i < s.poles_u(); ++i) {
    Row& row = out.poles.emplace_back();
    for (std::size_t j = 0; j < s.poles_v(); ++j) append(row, s.pole(i, j));
  }
  return out;
}
// A row of a surface as a spline along v.
inline Spline along_v(const NurbsSurface& s, const Row& row) {
  Spline out{static_cast<std::size_t>(s.degree_v()), exact(s.knots_v()), {}};
  for (std::size_t j = 0; j < row.size(); j += 4) out.poles.push_back({row[j], row[j + 1], row[j + 2], row[j + 3]});
  return out;
}

inline double as_double(const Rational& r) { return static_cast<double>(r); }
inline double difference(const Rational& a, double b) { return std::abs(as_double(a - Rational(b))); }
inline double difference(const Row& a, Point b) {
  return std::max({difference(a[0], b.x), difference(a[1], b.y), difference(a[2], b.z)});
}
inline double difference(const Row& a, const Hpoint& b) {
  return std::max({difference(a[0], b.x), difference(a[1], b.y), difference(a[2], b.z), difference(a[3], b.w)});
}
inline Row projected(const Row& h) { return {h[0] / h[3], h[1] / h[3], h[2] / h[3]}; }

// Largest coordinate and largest weight of poles, premultiplied.
struct Size {
  double point = 0, weight = 0;
  void add(const Hpoint& h) {
    point = std::max({point, std::abs(h.x), std::abs(h.y), std::abs(h.z)});
    weight = std::max(weight, std::abs(h.w));
  }
};
inline Size size_of(std::span<const Hpoint> poles) {
  Size s;
  for (const Hpoint& h : poles) s.add(h);
  return s;
}

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// eps (max |w_i P_i| + |S| max |w_i|) / |w| at an exact homogeneous point.
inline double unit(const Row& h, const Size& size) {
  const double w = std::abs(as_double(h[3]));
  const Row s = projected(h);
  const double largest = std::max({std::abs(as_double(s[0])), std::abs(as_double(s[1])), std::abs(as_double(s[2]))});
  return epsilon * (size.point + largest * size.weight) / w;
}

}  // namespace trimloop::exact
