#pragma once
// How the operations of this folder make their results: valid by construction, so nothing is checked again
// (not part of the public face).

#include "kernel/nurbs/surface.h"

namespace trimloop {

struct NurbsBuilder {
  static NurbsCurve curve(int degree, bool rational, std::vector<double> knots, std::vector<Hpoint> poles,
                          Interval range) {
    NurbsCurve c;
    c.degree_ = degree;
    c.rational_ = rational;
    c.knots_ = std::move(knots);
    c.poles_ = std::move(poles);
    c.range_ = range;
    if (!rational) set_unit_weights(c.poles_);
    return c;
  }

  static NurbsSurface surface(int degree_u, int degree_v, bool rational, std::vector<double> knots_u,
                              std::vector<double> knots_v, std::vector<Hpoint> poles, Interval range_u,
                              Interval range_v) {
    NurbsSurface s;
    s.degree_u_ = degree_u;
    s.degree_v_ = degree_v;
    s.rational_ = rational;
    s.knots_u_ = std::move(knots_u);
    s.knots_v_ = std::move(knots_v);
    s.poles_ = std::move(poles);
    s.range_u_ = range_u;
    s.range_v_ = range_v;
    if (!rational) set_unit_weights(s.poles_);
    return s;
  }

 private:
  // Sums of basis functions are one up to rounding; a polynomial promises weights of exactly one.
  static void set_unit_weights(std::vector<Hpoint>& poles) {
    for (Hpoint& h : poles) h.w = 1;
  }
};

}  // namespace trimloop
