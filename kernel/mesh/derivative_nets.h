#pragma once
// Ranges of the second and third derivatives of one component of a B-spline surface: n . N - c w for the numerator N and
// the weight w. They are hulls of the poles of the derivatives (The NURBS Book, 3.3): those along a triangle's normal stay
// narrow where the derivatives themselves change a lot along the surface.

#include <array>
#include <optional>
#include <span>

#include "kernel/geometry/surface.h"

namespace trimloop::mesh {

class DerivativeNets {
 public:
  // The part over u x v, with knots inserted (the surface stays the same) until no span is much wider than `cell`.
  DerivativeNets(const NurbsSurface&, Interval u, Interval v, Uv cell);

  bool is_rational() const { return rational_; }

  // The function x . X + y . Y + z . Z + w . W of the poles, these taken from `origin()`.
  struct Component {
    double x = 0, y = 0, z = 0, w = 0;
  };
  Component component(Vector n) const { return {n.x, n.y, n.z, 0}; }
  Component height_over(Point p, Vector n) const { return {n.x, n.y, n.z, -dot(n, p - origin_)}; }  // n . (N - p w)
  Point origin() const { return origin_; }

  // Every value lies within `half` of `mid`.
  struct Spread {
    double mid = 0, half = 0;
    double largest() const { return std::abs(mid) + half; }
  };
  using Firsts = std::array<Spread, 2>;   // u, v
  using Seconds = std::array<Spread, 3>;  // uu, uv, vv
  using Thirds = std::array<Spread, 4>;   // uuu, uuv, uvv, vvv

  // Knot spans, first and last.
  struct Window {
    std::array<std::size_t, 2> u{}, v{};
  };
  // Of the spans that a rectangle touches (a border touched within rounding does not count); none when they are too many.
  std::optional<Window> window(Interval u, Interval v) const;

  // Of the surface itself, along vectors; `near` is a place on it in the window. False when nothing can be said.
  bool firsts(const Window&, Point near, std::span<const Vector>, std::span<Firsts>);
  void seconds(const Window&, std::span<const Component>, std::span<Seconds>);
  void thirds(const Window&, std::span<const Component>, std::span<Thirds>);
  Interval weights(const Window&) const;
  // Largest |n . (S - p)|.
  double largest_height(const Window&, Point p, Vector n);

 private:
  struct Net {
    std::size_t rows = 0, columns = 0;
    std::vector<double> x, y, z, w;
  };
  struct Direction {
    int degree = 1;
    std::vector<double> knots, borders;
    std::vector<std::size_t> spans;                // knot index of each span
    std::array<std::vector<double>, 4> amplified;  // rounding of a pole, by the derivative of that order, in each span
    std::vector<double> divisors(int order) const;
    void count(Interval, double cell, std::vector<double>& added) const;
    void finish(Interval);
    std::array<std::size_t, 2> touched(Interval) const;
  };
  Net& net(int a, int b);
  void differentiate(const Net& from, Net& to, bool in_u, int order) const;
  template <std::size_t K>  // components; out[k * stride] for component k
  void spreads(int a, int b, const Window&, const Component*, Spread* out, std::size_t stride);
  Spread spread(int a, int b, const Window&, const Component&);

  bool rational_ = false;
  Point origin_;
  Direction u_, v_;
  std::array<std::array<Net, 4>, 4> nets_;
  double noise_ = 0;  // of a pole
};

}  // namespace trimloop::mesh
