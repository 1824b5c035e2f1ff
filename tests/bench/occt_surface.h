#pragma once
// One of our surfaces as OpenCASCADE's.

#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>

#include "kernel/nurbs/surface.h"

namespace trimloop::bench {

inline Handle(Geom_BSplineSurface) to_occt(const NurbsSurface& s) {
  const int rows = static_cast<int>(s.poles_u()), columns = static_cast<int>(s.poles_v());
  TColgp_Array2OfPnt poles(1, rows, 1, columns);
  TColStd_Array2OfReal weights(1, rows, 1, columns);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const Hpoint& h = s.pole(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
      poles(i + 1, j + 1) = gp_Pnt(h.x / h.w, h.y / h.w, h.z / h.w);
      weights(i + 1, j + 1) = h.w;
    }
  const auto distinct = [](const std::vector<double>& flat, std::vector<double>& knots, std::vector<int>& times) {
    for (double t : flat) {
      if (knots.empty() || t != knots.back()) knots.push_back(t), times.push_back(0);
      ++times.back();
    }
  };
  std::vector<double> ku, kv;
  std::vector<int> mu, mv;
  distinct(s.knots_u(), ku, mu);
  distinct(s.knots_v(), kv, mv);
  const TColStd_Array1OfReal uk(ku.front(), 1, static_cast<int>(ku.size()));
  const TColStd_Array1OfReal vk(kv.front(), 1, static_cast<int>(kv.size()));
  const TColStd_Array1OfInteger um(mu.front(), 1, static_cast<int>(mu.size()));
  const TColStd_Array1OfInteger vm(mv.front(), 1, static_cast<int>(mv.size()));
  return new Geom_BSplineSurface(poles, weights, uk, vk, um, vm, s.degree_u(), s.degree_v());
}

}  // namespace trimloop::bench
