#pragma once
// Curves and surfaces cut at their knots into Bezier pieces, once, for everything that asks many questions of the same
// shape: batch evaluation (kernel/batch/batch.h), closest points, bounds.

#include <cstdint>
#include <span>
#include <vector>

#include "kernel/nurbs/surface.h"

namespace trimloop {

// The distinct knots over a range, and a table of equal cells that finds a parameter's span in constant time.
// Spans are half open; a parameter on a knot belongs to the span that begins there, the last one to the last span.
class Spans {
 public:
  explicit Spans(std::vector<double> breaks);  // ascending, at least two
  std::size_t size() const { return inverse_lengths_.size(); }
  Interval operator[](std::size_t i) const { return {breaks_[i], breaks_[i + 1]}; }
  double lo() const { return breaks_.front(); }
  double hi() const { return breaks_[size()]; }
  std::size_t locate(double t) const;           // the span of t, which is clamped; the first one for NaN
  double local(std::size_t i, double t) const;  // from lo to hi of span i, where t is clamped: -1 to 1
  std::span<const double> breaks() const { return {breaks_.data(), size() + 1}; }

 private:
  friend struct BatchAccess;
  std::vector<double> breaks_, inverse_lengths_;  // one break more, infinite, is there to be compared with
  std::vector<std::uint32_t> first_;
  std::uint32_t steps_ = 0;
  double cells_per_unit_ = 0;
};

// A NURBS curve over its range. Piece i: poles i * (degree + 1) .. of the Bezier form over spans()[i].
class CurvePieces {
 public:
  explicit CurvePieces(const NurbsCurve&);  // range() must have a length
  int degree() const { return degree_; }
  bool is_rational() const { return rational_; }
  const Spans& spans() const { return spans_; }
  std::size_t size() const { return spans_.size(); }
  std::span<const Hpoint> bezier(std::size_t piece) const;

 private:
  friend struct BatchAccess;
  int degree_;
  bool rational_;
  Spans spans_;
  std::vector<Hpoint> bezier_, monomial_;  // monomial_: degree <= 3 only
};

// A NURBS surface over its range. Patch (a, b) covers spans_u()[a] x spans_v()[b]; its pole (i, j), i along u, is
// bezier(a, b)[j * (degree_u + 1) + i]. Memory: 32 bytes a Bezier pole, twice that up to degree 3.
class SurfacePieces {
 public:
  explicit SurfacePieces(const NurbsSurface&);  // range_u() and range_v() must have a length
  int degree_u() const { return degree_u_; }
  int degree_v() const { return degree_v_; }
  bool is_rational() const { return rational_; }
  const Spans& spans_u() const { return spans_u_; }
  const Spans& spans_v() const { return spans_v_; }
  std::size_t size() const { return spans_u_.size() * spans_v_.size(); }
  std::span<const Hpoint> bezier(std::size_t a, std::size_t b) const;

 private:
  friend struct BatchAccess;
  int degree_u_, degree_v_;
  bool rational_;
  Spans spans_u_, spans_v_;
  std::vector<Hpoint> bezier_, monomial_;
};

}  // namespace trimloop
