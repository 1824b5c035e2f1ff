#pragma once
// Whether a parameter pair lies inside a face's loops (not part of the public face).

#include "kernel/topology/body.h"

namespace trimloop::closest {

// Parity over polylines through the pcurves; within the polylines' reach of a pcurve, the pcurve's own side decides.
class Loops {
 public:
  void add(const std::vector<Coedge>& loop);
  bool empty() const { return sides_.empty(); }
  Interval reach_u() const { return u_; }
  Interval reach_v() const { return v_; }
  bool contains(Uv) const;
  // No part of the rectangle is inside; false when that is not plain to see.
  bool misses(Interval u, Interval v) const;

 private:
  struct Side {
    Curve2 pcurve;
    Interval range;
    bool reversed;
    double reach = 0;  // twice the largest distance of the middle of a chord from the pcurve
    std::vector<Uv> at;
    Interval u, v;
  };
  std::vector<Side> sides_;
  Interval u_{infinity, -infinity}, v_{infinity, -infinity};
};

}  // namespace trimloop::closest
