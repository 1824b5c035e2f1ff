#pragma once
// Rational B-spline curve. Poles are kept homogeneous and premultiplied (wx, wy, wz, w); knots in full
// (poles + degree + 1). Zero and negative weights are data. The active range may be a part of the knot domain.
// A curve in parameter space is the same thing with z = 0 (kernel/geometry/curve.h, Curve2).

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/result.h"
#include "kernel/math/vec.h"

namespace trimloop {

struct Hpoint {  // homogeneous point, premultiplied
  double x = 0, y = 0, z = 0, w = 1;
};
inline Hpoint operator+(Hpoint a, Hpoint b) { return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w}; }
inline Hpoint operator-(Hpoint a, Hpoint b) { return {a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w}; }
inline Hpoint operator*(double s, Hpoint a) { return {s * a.x, s * a.y, s * a.z, s * a.w}; }
inline Point project(Hpoint h) { return {h.x / h.w, h.y / h.w, h.z / h.w}; }

struct CurveJet {  // value and first two derivatives with respect to the parameter
  Point point;
  Vector d1, d2;
};

class NurbsCurve {
 public:
  // Checks counts, finiteness and order of knots (each refused with the index and values in the error);
  // `range` must lie in [knots[degree], knots[poles]] up to 1e-9 of its length and defaults to it.
  // Multiplicities above degree are allowed at the ends (degree + 1) and refused inside.
  static Result<NurbsCurve> from_homogeneous(int degree, std::vector<double> knots, std::vector<Hpoint> poles,
                                             std::optional<Interval> range = {});
  // Cartesian poles and weights (empty = all one). A zero weight makes an ideal pole (direction `point`).
  static Result<NurbsCurve> from_cartesian(int degree, std::vector<double> knots, std::span<const Point> points,
                                           std::span<const double> weights, std::optional<Interval> range = {});

  int degree() const { return degree_; }
  const std::vector<double>& knots() const { return knots_; }
  const std::vector<Hpoint>& poles() const { return poles_; }
  Interval range() const { return range_; }  // what is meant
  Interval domain() const { return {knots_[static_cast<std::size_t>(degree_)], knots_[poles_.size()]}; }
  bool is_rational() const { return rational_; }  // false when all weights are equal; they are stored as 1 then
  // Another active range, cut to the domain; it may have no length but must not descend.
  NurbsCurve with_range(Interval range) const;

 private:
  friend struct NurbsBuilder;  // the operations of this folder
  NurbsCurve() = default;
  int degree_ = 1;
  bool rational_ = false;
  std::vector<double> knots_;
  std::vector<Hpoint> poles_;
  Interval range_;
};

// Index k with knots[k] <= t < knots[k+1], degree <= k < poles; the last such span at the upper end. NURBS Book A2.1.
int find_span(int degree, std::span<const double> knots, std::size_t poles, double t);

// t is clamped to the knot domain. O(degree^2). Book A3.1/A4.1, A3.2/A4.2.
Point evaluate(const NurbsCurve&, double t);
CurveJet jet(const NurbsCurve&, double t);
// Derivatives 0..order (size order + 1); those above the degree of a polynomial curve are zero.
std::vector<Vector> derivatives(const NurbsCurve&, double t, int order);

// Knots outside the domain and multiplicities above the degree are left out; the shape never changes.
NurbsCurve insert_knot(const NurbsCurve&, double t, int times);           // A5.1
NurbsCurve refine(const NurbsCurve&, std::span<const double> new_knots);  // any order; A5.4
NurbsCurve elevate(const NurbsCurve&, int by);  // clamped; degree + by <= 64; by convex combinations (Prautzsch 1984)
NurbsCurve reversed(const NurbsCurve&);         // same knot domain, t -> lo + hi - t
// Clamped copy of the part over an interval, cut to the domain, where it must have a length.
NurbsCurve trimmed(const NurbsCurve&, Interval);
std::pair<NurbsCurve, NurbsCurve> split(const NurbsCurve&, double t);  // t strictly inside range()
std::vector<NurbsCurve> bezier_pieces(const NurbsCurve&);              // over range(), each on its own span; A5.6
NurbsCurve transformed(const NurbsCurve&, const struct Transform&);
NurbsCurve reparametrized(const NurbsCurve&, Interval new_range);  // affine, range() becomes new_range
// Encloses the curve over range() up to rounding: the poles of that part, clamped. Infinite when one of their weights
// is not positive.
Box bounding_box(const NurbsCurve&);
// Distinct knots strictly inside range(), with both ends of the range: piece boundaries for sampling and quadrature.
std::vector<double> breaks(const NurbsCurve&);

}  // namespace trimloop
