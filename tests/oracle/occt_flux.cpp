#include "tests/oracle/occt_flux.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <BRepAdaptor_Curve.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_Surface.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>

namespace trimloop::test {
namespace {

// Ten points of Gauss and Legendre on [-1, 1], the positive half.
constexpr double nodes[5] = {0.14887433898163122, 0.4333953941292472, 0.6794095682990244, 0.8650633666889845, 0.9739065285171717};
constexpr double weights[5] = {0.29552422471475287, 0.26926671930999635, 0.21908636251598204, 0.1494513491505806,
                               0.06667134430868814};

struct Pair {
  double area = 0, volume = 0;
  void add(double w, Pair p) { area += w * p.area, volume += w * p.volume; }
};

template <class F>
Pair gauss(double a, double b, F f) {
  Pair sum;
  const double mid = 0.5 * (a + b), half = 0.5 * (b - a);
  for (int i = 0; i < 5; ++i) {
    sum.add(half * weights[i], f(mid - half * nodes[i]));
    sum.add(half * weights[i], f(mid + half * nodes[i]));
  }
  return sum;
}

class FaceIntegral {
 public:
  explicit FaceIntegral(const TopoDS_Face& face)
      : face_(TopoDS::Face(face.Oriented(TopAbs_FORWARD))), surface_(BRep_Tool::Surface(face)) {
    double v0, v1, u1;
    BRepTools::UVBounds(face_, u0_, u1, v0, v1);
    adaptor_.Load(surface_);
    const int n = adaptor_.NbUIntervals(GeomAbs_CN);
    TColStd_Array1OfReal at(1, n + 1);
    adaptor_.UIntervals(at, GeomAbs_CN);
    for (int i = 1; i <= n + 1; ++i) breaks_.push_back(at(i));
    const int m = adaptor_.NbVIntervals(GeomAbs_CN);
    TColStd_Array1OfReal across(1, m + 1);
    adaptor_.VIntervals(across, GeomAbs_CN);
    for (int i = 2; i <= m; ++i) breaks_v_.push_back(across(i));
    for (TopExp_Explorer e(face_, TopAbs_EDGE); e.More(); e.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(e.Current());
      double a = 0, b = 0;
      const Handle(Geom2d_Curve) c = BRep_Tool::CurveOnSurface(edge, face_, a, b);
      if (edge.Orientation() != TopAbs_FORWARD && edge.Orientation() != TopAbs_REVERSED) continue;
      if (c.IsNull()) {
        complete_ = false;
        continue;
      }
      sides_.push_back({c, a, b, edge.Orientation() == TopAbs_FORWARD ? 1.0 : -1.0});
    }
  }

  bool complete() const { return complete_ && !sides_.empty(); }

  Pair at_level(int panels) {
    Pair sum;
    for (const Side& side : sides_) {
      Geom2dAdaptor_Curve c(side.curve, side.a, side.b);
      const std::vector<double> at = pieces_of(c);
      for (std::size_t i = 0; i + 1 < at.size(); ++i) {
        for (int k = 0; k < panels; ++k) {
          const double lo = at[i] + (at[i + 1] - at[i]) * k / panels, hi = at[i] + (at[i + 1] - at[i]) * (k + 1) / panels;
          sum.add(side.sign, gauss(lo, hi, [&](double t) {
                    gp_Pnt2d p;
                    gp_Vec2d d;
                    c.D1(t, p, d);
                    if (d.Y() == 0) return Pair{};
                    Pair inner = along_u(p.X(), p.Y(), panels);
                    inner.area *= d.Y();
                    inner.volume *= d.Y();
                    return inner;
                  }));
        }
      }
    }
    return sum;
  }

 private:
  struct Side {
    Handle(Geom2d_Curve) curve;
    double a, b, sign;
  };

  // Where the curve is not smooth, and where it crosses a knot of the surface (in pieces that run one way).
  std::vector<double> pieces_of(const Geom2dAdaptor_Curve& c) const {
    const int n = c.NbIntervals(GeomAbs_CN);
    TColStd_Array1OfReal at(1, n + 1);
    c.Intervals(at, GeomAbs_CN);
    std::vector<double> out{at(1)};
    for (int i = 1; i <= n; ++i) {
      for (const double v : breaks_v_) {
        double lo = at(i), hi = at(i + 1);
        const bool rising = c.Value(lo).Y() < c.Value(hi).Y();
        if ((c.Value(lo).Y() < v) == (c.Value(hi).Y() < v)) continue;
        for (int k = 0; k < 60; ++k) {
          const double mid = 0.5 * (lo + hi);
          ((c.Value(mid).Y() < v) == rising ? lo : hi) = mid;
        }
        out.push_back(0.5 * (lo + hi));
      }
      out.push_back(at(i + 1));
    }
    std::sort(out.begin(), out.end());
    return out;
  }

  Pair along_u(double u, double v, int panels) {
    const double lo = std::min(u0_, u), hi = std::max(u0_, u), sign = u < u0_ ? -1 : 1;
    std::vector<double> cuts{lo};
    for (const double b : breaks_) {
      if (b > lo && b < hi) cuts.push_back(b);
    }
    cuts.push_back(hi);
    Pair sum;
    for (std::size_t i = 1; i < cuts.size(); ++i) {
      for (int k = 0; k < panels; ++k) {
        const double a = cuts[i - 1] + (cuts[i] - cuts[i - 1]) * k / panels, b = cuts[i - 1] + (cuts[i] - cuts[i - 1]) * (k + 1) / panels;
        sum.add(sign, gauss(a, b, [&](double w) {
                  gp_Pnt p;
                  gp_Vec du, dv;
                  adaptor_.D1(w, v, p, du, dv);
                  const gp_Vec n = du.Crossed(dv);
                  return Pair{n.Magnitude(), (p.X() * n.X() + p.Y() * n.Y() + p.Z() * n.Z()) / 3};
                }));
      }
    }
    return sum;
  }

  TopoDS_Face face_;
  Handle(Geom_Surface) surface_;
  GeomAdaptor_Surface adaptor_;
  std::vector<double> breaks_, breaks_v_;
  std::vector<Side> sides_;
  double u0_ = 0;
  bool complete_ = true;
};

}  // namespace

FaceFlux face_flux(const TopoDS_Face& face) {
  FaceFlux out;
  FaceIntegral integral(face);
  if (!integral.complete()) return out;
  Pair last = integral.at_level(1), now = last;
  for (int panels = 2; panels <= 32; panels *= 2) {
    now = integral.at_level(panels);
    out.change = std::abs(now.area - last.area) / std::max(std::abs(now.area), 1e-300);
    if (out.change < 1e-10) break;
    last = now;
  }
  out.measured = true;
  out.area = std::abs(now.area);
  // Loops run counter-clockwise about the surface's normal where the area came out positive.
  out.volume = (face.Orientation() == TopAbs_REVERSED ? -1 : 1) * now.volume;
  return out;
}

double edge_length(const TopoDS_Edge& edge) {
  BRepAdaptor_Curve c(edge);
  const int n = c.NbIntervals(GeomAbs_CN);
  TColStd_Array1OfReal at(1, n + 1);
  c.Intervals(at, GeomAbs_CN);
  double last = -1, now = 0;
  for (int panels = 1; panels <= 4096 && std::abs(now - last) > 1e-13 * now; panels *= 2) {
    last = now;
    now = 0;
    for (int i = 1; i <= n; ++i)
      for (int k = 0; k < panels; ++k) {
        const double lo = at(i) + (at(i + 1) - at(i)) * k / panels, hi = at(i) + (at(i + 1) - at(i)) * (k + 1) / panels;
        now += gauss(lo, hi, [&](double t) {
                 gp_Pnt p;
                 gp_Vec d;
                 c.D1(t, p, d);
                 return Pair{d.Magnitude(), 0};
               }).area;
      }
  }
  return now;
}

}  // namespace trimloop::test
