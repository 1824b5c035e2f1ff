#pragma once
// How the operations of this folder make their results: valid by construction, so nothing is checked again
// (not part of the public face).

#include "kernel/nurbs/knots.h"
#include "kernel/nurbs/surface.h"

namespace trimloop {

struct NurbsBuilder {
  static NurbsCurve curve(int degree, bool rational, std::vector<double> knots, std::vector<Hpoint> poles,
                          Interval range) {
    NurbsCurve c;
    c.degree_ = degree;
    c.rational_ = settle_weights(rational, poles);
    c.knots_ = std::move(knots);
    c.poles_ = std::move(poles);
    c.range_ = range;
    return c;
  }

  static NurbsSurface surface(int degree_u, int degree_v, bool rational, std::vector<double> knots_u,
                              std::vector<double> knots_v, std::vector<Hpoint> poles, Interval range_u,
                              Interval range_v) {
    NurbsSurface s;
    s.degree_u_ = degree_u;
    s.degree_v_ = degree_v;
    s.rational_ = settle_weights(rational, poles);
    s.knots_u_ = std::move(knots_u);
    s.knots_v_ = std::move(knots_v);
    s.poles_ = std::move(poles);
    s.range_u_ = range_u;
    s.range_v_ = range_v;
    return s;
  }

 private:
  // Sums of basis functions are one up to rounding, but a polynomial promises weights of exactly one. A part of a
  // rational shape may turn out to have equal weights.
  static bool settle_weights(bool rational, std::vector<Hpoint>& poles) {
    if (rational) return detail::divide_out_equal_weights(poles);
    for (Hpoint& h : poles) h.w = 1;
    return false;
  }
};

}  // namespace trimloop
