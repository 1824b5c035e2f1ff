#pragma once
// Rational B-spline surface over the same conventions as kernel/nurbs/curve.h.
// Pole (i, j) with i along u, j along v is poles[i * poles_v + j].

#include "kernel/nurbs/curve.h"

namespace trimloop {

struct SurfaceJet {  // value, first and second partial derivatives
  Point point;
  Vector du, dv, duu, duv, dvv;
};

class NurbsSurface {
 public:
  static Result<NurbsSurface> from_homogeneous(int degree_u, int degree_v, std::vector<double> knots_u,
                                               std::vector<double> knots_v, std::vector<Hpoint> poles,
                                               std::optional<Interval> range_u = {},
                                               std::optional<Interval> range_v = {});
  static Result<NurbsSurface> from_cartesian(int degree_u, int degree_v, std::vector<double> knots_u,
                                             std::vector<double> knots_v, std::span<const Point> points,
                                             std::span<const double> weights, std::optional<Interval> range_u = {},
                                             std::optional<Interval> range_v = {});

  int degree_u() const { return degree_u_; }
  int degree_v() const { return degree_v_; }
  std::size_t poles_u() const { return knots_u_.size() - static_cast<std::size_t>(degree_u_) - 1; }
  std::size_t poles_v() const { return knots_v_.size() - static_cast<std::size_t>(degree_v_) - 1; }
  const std::vector<double>& knots_u() const { return knots_u_; }
  const std::vector<double>& knots_v() const { return knots_v_; }
  const std::vector<Hpoint>& poles() const { return poles_; }
  const Hpoint& pole(std::size_t i, std::size_t j) const { return poles_[i * poles_v() + j]; }
  Interval range_u() const { return range_u_; }
  Interval range_v() const { return range_v_; }
  Interval domain_u() const { return {knots_u_[static_cast<std::size_t>(degree_u_)], knots_u_[poles_u()]}; }
  Interval domain_v() const { return {knots_v_[static_cast<std::size_t>(degree_v_)], knots_v_[poles_v()]}; }
  bool is_rational() const { return rational_; }  // false when all weights are equal; they are stored as 1 then
  // Another active range, cut to the domain; it may have no length but must not descend.
  NurbsSurface with_range(Interval u, Interval v) const;

 private:
  friend struct NurbsBuilder;  // the operations of this folder
  NurbsSurface() = default;
  int degree_u_ = 1, degree_v_ = 1;
  bool rational_ = false;
  std::vector<double> knots_u_, knots_v_;
  std::vector<Hpoint> poles_;
  Interval range_u_, range_v_;
};

// (u,v) is clamped to the knot domain. A3.5/A4.3, A3.6/A4.4.
Point evaluate(const NurbsSurface&, Uv);
void jet1(const NurbsSurface&, Uv, Point& point, Vector& du, Vector& dv);  // the fast path of quadrature and meshing
SurfaceJet jet(const NurbsSurface&, Uv);

// As their namesakes of curves, in one direction or both.
NurbsSurface refine_u(const NurbsSurface&, std::span<const double> new_knots);
NurbsSurface refine_v(const NurbsSurface&, std::span<const double> new_knots);
NurbsSurface elevate(const NurbsSurface&, int by_u, int by_v);  // clamped in the directions that are raised
NurbsSurface swapped(const NurbsSurface&);                      // u <-> v
NurbsSurface reversed_u(const NurbsSurface&);
NurbsSurface trimmed(const NurbsSurface&, Interval u, Interval v);
NurbsCurve isocurve_u(const NurbsSurface&, double u);  // v -> S(u, v); u is clamped to the domain
NurbsCurve isocurve_v(const NurbsSurface&, double v);  // u -> S(u, v)
NurbsSurface transformed(const NurbsSurface&, const struct Transform&);
Box bounding_box(const NurbsSurface&);              // encloses it over its range
std::vector<double> breaks_u(const NurbsSurface&);  // ends of the range and distinct knots inside
std::vector<double> breaks_v(const NurbsSurface&);

}  // namespace trimloop
