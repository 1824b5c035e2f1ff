#pragma once
// The size of an intersection problem, and unbounded shapes cut to it (not part of the public face).

#include "kernel/geometry/surface.h"

namespace trimloop::detail {

struct Scale {
  Point origin;          // middle of what both may share; problems are moved there
  double size = 1;       // largest coordinate about it
  double tolerance = 0;  // in force
};
Scale scale_of(const Box& a, const Box& b, double tolerance_mm);

inline bool apart(const Box& a, const Box& b, double by) {
  return a.lo.x - by > b.hi.x || b.lo.x - by > a.hi.x || a.lo.y - by > b.hi.y || b.lo.y - by > a.hi.y ||
         a.lo.z - by > b.hi.z || b.lo.z - by > a.hi.z;
}

// An unbounded line cut to the parameters that a box can meet; others as they are.
Curve cut_to(const Curve&, const Box&);
// The part of the rectangle (none: the domain) that a box can meet; bounded unless the box is not.
struct Patch {
  Interval u, v;
};
Patch cut_to(const Surface&, std::optional<Interval> u, std::optional<Interval> v, const Box&);

}  // namespace trimloop::detail
