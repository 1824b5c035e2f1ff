#pragma once
// What the parts of the certificate share (not part of the public face).

#include "kernel/mesh/certificate.h"

namespace trimloop::mesh::certificate_detail {

constexpr double lagrange = 0.125 / 6;           // see the head of certificate.h; found on a grid of 16 million places
constexpr double cubic_share = 0.1181;         // likewise
constexpr double slope_share = 0.5;              // of the derivative along an edge, in place of lagrange; largest at a corner
constexpr double linear = 0.125;
constexpr double curve_remainder = 0.0481126 / 6;  // of t (t - 1/2) (t - 1), the same in one dimension
constexpr double rounding = 256 * 0x1p-53;      // of evaluated points, as a share of the coordinates
constexpr double needle = 1e-9;                 // area over the square of the longest side
constexpr double ignored = 1e-11;               // of the box: nearer than that a line does not cross

inline Uv between(Uv a, Uv b) { return {0.5 * (a.u + b.u), 0.5 * (a.v + b.v)}; }
inline Interval spread(double a, double b, double c) { return {std::min({a, b, c}), std::max({a, b, c})}; }

inline std::array<double, 3> barycentric(Point p, const Facet& f) {
  const Vector d = p - f.corner[0];
  const double b = dot(d, f.gradient[1]), c = dot(d, f.gradient[2]);
  return {1 - b - c, b, c};
}

// Largest |q| over the triangle and where, q the quadratic with values h at the corners and m at the middles opposite.
struct Peak {
  double value = 0;
  std::array<double, 3> at{};
};
Peak peak(const std::array<double, 3>& h, const std::array<double, 3>& m);

// Lines well inside an interval: first and past the last.
struct Lines {
  const double *first, *last;
  std::ptrdiff_t count() const { return last - first; }
};
Lines inside(const std::vector<double>& lines, Interval x, double whole);

// What is known of one barycentric coordinate l_k + psi_k of a facet over its own piece: psi_k is zero at the corners.
struct ByThird {
  std::array<double, 3> psi;     // at the middles of the sides
  Cubic cubic;                   // what constant third derivatives add
  double stray;                  // of its derivative along an edge, beside that
  std::array<double, 3> third;   // largest third derivative along each side
};
struct BySecond {
  std::array<double, 3> bend, sway;  // second derivative along each side: middle and half of its range
  double bend_01, sway_01;           // along the edges 0-1 and 0-2
  double jump;                       // of its first derivative, over the piece
};
// What lies beyond a side of a facet, seen along its normal: between the chord and a parabola of height bow * stretch.
struct Lens {
  double bow = 0, stretch = 1;
};
// False when the piece may be folded over.
bool find_lenses(const Facet&, const std::array<ByThird, 3>&, std::array<Lens, 3>& out);
bool find_lenses(const Facet&, const std::array<BySecond, 3>&, std::array<Lens, 3>& out);

// Largest |q| over what lies beyond side k, q the quadratic that is zero at the corners and m at the middles; `psi` of
// that side's coordinate at the middles, `rest` what it strays from such a quadratic.
double near_side(const std::array<double, 3>& m, const std::array<double, 3>& psi, double rest, std::size_t k);

// What is beyond side k of a facet: on the side's curve it is at most `at_side` high and `reach` from the side, and towards
// the side higher and nearer in proportion, to `beside` there.
struct Edge {
  double at_side, reach, beside;
};
// Bound for a facet's own piece, `across` its plane.
double with_lenses(const Facet&, const std::array<const Facet*, 3>& neighbours, const std::array<Lens, 3>&, double across,
                   const std::array<Edge, 3>&, double noise);

}  // namespace trimloop::mesh::certificate_detail
