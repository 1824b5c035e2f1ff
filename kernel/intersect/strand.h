#pragma once
// Chains of many pairs of patches joined to whole branches and fitted (not part of the public face).

#include "kernel/intersect/intersect.h"
#include "kernel/intersect/surface_chain.h"

namespace trimloop::detail {

// One of the two surfaces with its pieces.
struct Side {
  const Surface& surface;
  const ToNurbsSurface& nurbs;
  std::vector<Bezier> pieces;
  double period_u = 0, period_v = 0;  // of surfaces that can be evaluated beyond their rectangle
};
struct PairOfPieces {
  std::size_t a = 0, b = 0;
  SurfaceCells cells;
};

// What one arc carries from x0 to x1, with turns added to the surfaces' own parameters.
struct Stretch {
  std::size_t pair = 0, arc = 0;
  Parameters x0{}, x1{};
  Parameters shift{};
};
struct Strand {
  std::vector<Stretch> stretches;
  bool tangential = false, closed = false;
};

class Weaver {
 public:
  Weaver(const Side& a, const Side& b, const std::vector<PairOfPieces>& pairs, Point origin, double size)
      : a_(a), b_(b), pairs_(pairs), origin_(origin), size_(size), near_(1e-8 * size) {}

  void add(std::size_t pair, const Chain&);
  // Joins, drops what was found twice, fits.
  Result<std::vector<IntersectionBranch>> branches(double fit_mm);

 private:
  struct Node {
    Point point;     // in space, not moved
    Vector tangent;  // unit
    Uv a, b;         // own parameters
    Uv da, db;       // by millimetres along the tangent
  };
  Parameters own(const Stretch&, const Parameters& unit) const;
  Point point(const Stretch&, const Parameters& unit) const;
  Node node(const Stretch&, const Parameters& unit, Point towards, double sign) const;
  void drop_doubles();
  void join();
  bool match(const Strand& s, bool at_end, const Strand& t, bool t_at_end, Parameters& shift) const;
  void fit_stretch(const Stretch&, double tolerance, std::vector<std::array<Node, 2>>& out) const;
  bool good(const Stretch&, const std::array<Node, 2>&, double tolerance) const;
  Result<IntersectionBranch> fit(const Strand&, double tolerance) const;

  const Side &a_, &b_;
  const std::vector<PairOfPieces>& pairs_;
  const Point origin_;
  const double size_, near_;
  std::vector<Strand> strands_;
};

}  // namespace trimloop::detail
