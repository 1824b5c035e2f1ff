#pragma once
// Border edges as sewing sees them: sampled, with their ends, and a grid over points.

#include <cstdint>
#include <unordered_map>

#include "kernel/topology/body.h"

namespace trimloop::heal {

// A border edge with points along its curve.
struct Track {
  EdgeId edge;
  FaceId face;
  std::vector<double> t;      // ascending, both ends included
  std::vector<Point> points;
  double sag_mm = 0;          // what the curve leaves the chords by, estimated
  double length_mm = 0;       // of the chords
  std::vector<Box> runs;      // of chords: entry 1 of all, 2 i and 2 i + 1 of the halves of i, the last half of single ones
  Box box() const;
};

Track make_track(const Body&, EdgeId, FaceId);

struct TrackFoot {
  double t = 0, distance = infinity;
};
// Nearest point of the track's curve.
TrackFoot foot(const Body&, const Track&, Point);
// Largest distance of points along `a` from `b`, both ways; stops early beyond `limit`.
double separation(const Body&, const Track& a, const Track& b, double limit);
double one_sided(const Body&, const Track& from, const Track& to, double limit);

// Points in cells of equal size; `size_mm`: of what will be asked about.
class PointGrid {
 public:
  PointGrid(const std::vector<Point>& points, double size_mm, double least_cell_mm);
  double cell() const { return cell_; }
  // Calls visit(index) for every point in the cells that the box meets; may name a point outside of it.
  template <class Visit>
  void near(const Box& box, Visit visit) const {
    const auto range = [&](double lo, double hi, double origin) {
      return std::pair<std::int64_t, std::int64_t>{index(lo, origin), index(hi, origin)};
    };
    const auto [x0, x1] = range(box.lo.x, box.hi.x, origin_.x);
    const auto [y0, y1] = range(box.lo.y, box.hi.y, origin_.y);
    const auto [z0, z1] = range(box.lo.z, box.hi.z, origin_.z);
    for (std::int64_t x = x0; x <= x1; ++x)
      for (std::int64_t y = y0; y <= y1; ++y)
        for (std::int64_t z = z0; z <= z1; ++z)
          if (const auto found = cells_.find(key(x, y, z)); found != cells_.end())
            for (const std::uint32_t i : found->second) visit(i);
  }

 private:
  std::int64_t index(double x, double origin) const { return static_cast<std::int64_t>(std::floor((x - origin) / cell_)); }
  static std::uint64_t key(std::int64_t x, std::int64_t y, std::int64_t z) {
    const auto u = [](std::int64_t k) { return static_cast<std::uint64_t>(k) & 0x1fffff; };
    return u(x) << 42 | u(y) << 21 | u(z);
  }
  double cell_ = 1;
  Point origin_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

inline Box grown(Box b, double by) {
  const Vector d{by, by, by};
  b.lo = b.lo - d;
  b.hi = b.hi + d;
  return b;
}

}  // namespace trimloop::heal
