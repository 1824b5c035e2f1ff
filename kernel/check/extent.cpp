#include "kernel/check/extent.h"

#include <array>

namespace trimloop::detail {
namespace {

Point placed(Point p, const Transform* at) { return at ? apply(*at, p) : p; }

double coordinate(Point p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

// How far p sticks out of the box in direction 0..5 (+x -x +y -y +z -z); positive: outside.
double excess(const Box& box, Point p, int direction) {
  const int axis = direction / 2;
  return direction % 2 == 0 ? coordinate(p, axis) - coordinate(box.hi, axis)
                            : coordinate(box.lo, axis) - coordinate(p, axis);
}

double along(Point p, int direction) { return (direction % 2 == 0 ? 1 : -1) * coordinate(p, direction / 2); }

// Samples t_i of a smooth path; where the parabola through three neighbours rises above the box, golden section finds
// the top. `point(t)` gives the placed point.
template <class F>
void add_path(Box& box, const std::vector<double>& places, const F& point) {
  std::vector<Point> points;
  points.reserve(places.size());
  for (double t : places) {
    points.push_back(point(t));
    if (is_finite(points.back())) box.add(points.back());
  }
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    for (int d = 0; d < 6; ++d) {
      const double a = along(points[i - 1], d), b = along(points[i], d), c = along(points[i + 1], d);
      if (!(b >= a && b >= c) || (b == a && b == c)) continue;
      const double rise = std::max(b - a, b - c);  // the top is less than this above b
      if (!(excess(box, points[i], d) + rise > 0)) continue;
      constexpr double golden = 0.3819660112501051;
      double lo = places[i - 1], hi = places[i + 1];
      double t1 = lo + golden * (hi - lo), t2 = hi - golden * (hi - lo);
      Point p1 = point(t1), p2 = point(t2);
      for (int k = 0; k < 40; ++k) {
        if (along(p1, d) > along(p2, d)) {
          hi = t2, t2 = t1, p2 = p1, t1 = lo + golden * (hi - lo), p1 = point(t1);
        } else {
          lo = t1, t1 = t2, p1 = p2, t2 = hi - golden * (hi - lo), p2 = point(t2);
        }
      }
      if (is_finite(p1)) box.add(p1);
    }
}

std::vector<double> places_on(const std::vector<double>& stops, int per_span) {
  std::vector<double> out;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i)
    for (int k = 0; k < per_span; ++k) out.push_back(Interval{stops[i], stops[i + 1]}.at(double(k) / per_span));
  if (!stops.empty()) out.push_back(stops.back());
  return out;
}

std::vector<double> within(const std::vector<double>& breaks, Interval range) {
  std::vector<double> out{range.lo};
  for (double b : breaks)
    if (b > out.back() && b < range.hi) out.push_back(b);
  out.push_back(range.hi);
  return out;
}

int per_span(const Curve& c) {
  return std::holds_alternative<Line>(c.shape) || std::holds_alternative<Polyline>(c.shape) ? 1 : 8;
}

// ---- The inside of a face

class Interior {
 public:
  Interior(Box& box, const Body& body, const Face& face, const Transform* at)
      : box_(box), surface_(*face.surface), at_(at) {
    for (const LoopId id : face.loops) add_loop(body, body[id]);
  }

  void run() {
    if (polygons_.empty() || !(u_.lo < u_.hi) || !(v_.lo < v_.hi)) return;
    if (!at_ && boundary_encloses()) return;
    us_ = grid(breaks_u(surface_), u_);
    vs_ = grid(breaks_v(surface_), v_);
    points_.reserve(us_.size() * vs_.size());
    for (double v : vs_)
      for (double u : us_) points_.push_back(point({u, v}));
    mark_inside();
    for (int d = 0; d < 6; ++d) {
      std::size_t best = points_.size();
      double value = -infinity;
      for (std::size_t k = 0; k < points_.size(); ++k)
        if (inside_[k] && along(points_[k], d) > value) best = k, value = along(points_[k], d);
      if (best < points_.size() && may_stick_out(best, d)) climb(best, d);
    }
  }

 private:
  Point point(Uv uv) const { return placed(evaluate(surface_, uv), at_); }

  void add_loop(const Body&, const Loop& loop) {
    std::vector<Uv> polygon;
    for (const Coedge& c : loop.coedges) {
      const Interval r{std::min(c.pcurve_range.lo, c.pcurve_range.hi), std::max(c.pcurve_range.lo, c.pcurve_range.hi)};
      std::vector<double> ts = places_on(within(breaks(c.pcurve.curve), r), per_span(c.pcurve.curve));
      if ((c.pcurve_range.lo > c.pcurve_range.hi) != c.reversed) std::reverse(ts.begin(), ts.end());
      for (double t : ts) {
        const Uv p = evaluate(c.pcurve, t);
        if (!is_finite(p)) continue;
        polygon.push_back(p);
        u_ = {std::min(u_.lo, p.u), std::max(u_.hi, p.u)};
        v_ = {std::min(v_.lo, p.v), std::max(v_.hi, p.v)};
      }
    }
    polygons_.push_back(std::move(polygon));
  }

  bool contains(Uv p) const {
    bool inside = false;
    for (const std::vector<Uv>& polygon : polygons_)
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Uv a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        if ((a.v > p.v) != (b.v > p.v)) {
          const double side = (b.u - a.u) * (p.v - a.v) - (b.v - a.v) * (p.u - a.u);
          if ((side > 0) == (b.v > a.v)) inside = !inside;
        }
      }
    return inside;
  }

  // Row by row: where the loops cross it, parity changes.
  void mark_inside() {
    std::vector<std::vector<double>> crossings(vs_.size());
    for (const std::vector<Uv>& polygon : polygons_)
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Uv a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        auto row = std::upper_bound(vs_.begin(), vs_.end(), std::min(a.v, b.v));
        for (; row != vs_.end() && *row <= std::max(a.v, b.v); ++row)
          crossings[static_cast<std::size_t>(row - vs_.begin())].push_back(a.u + (*row - a.v) / (b.v - a.v) * (b.u - a.u));
      }
    inside_.assign(points_.size(), false);
    for (std::size_t j = 0; j < vs_.size(); ++j) {
      std::sort(crossings[j].begin(), crossings[j].end());
      std::size_t passed = 0;
      for (std::size_t i = 0; i < us_.size(); ++i) {
        while (passed < crossings[j].size() && crossings[j][passed] < us_[i]) ++passed;
        inside_[j * us_.size() + i] = passed % 2 == 1;
      }
    }
  }

  // Between a sample and its neighbours a smooth surface rises by less than it falls to them.
  bool may_stick_out(std::size_t k, int d) const {
    const std::size_t n = us_.size(), i = k % n, j = k / n;
    double rise = 0;
    const auto look = [&](std::size_t other) {
      rise = std::max(rise, std::abs(along(points_[k], d) - along(points_[other], d)));
    };
    if (i > 0) look(k - 1);
    if (i + 1 < n) look(k + 1);
    if (j > 0) look(k - n);
    if (j + 1 < vs_.size()) look(k + n);
    return excess(box_, points_[k], d) + 2 * rise > 0;
  }

  // Often the control net already shows that nothing inside sticks out.
  bool boundary_encloses() const {
    const Box hull = bounding_box(surface_, u_, v_);
    if (hull.empty()) return false;
    for (int d = 0; d < 6; ++d)
      if (!(excess(box_, d % 2 == 0 ? hull.hi : hull.lo, d) <= 1e-9 * box_.diagonal())) return false;
    return true;
  }

  static std::vector<double> grid(const std::vector<double>& breaks, Interval range) {
    const std::vector<double> stops = within(breaks, range);
    constexpr std::size_t wanted = 24;
    const std::size_t spans = stops.size() - 1;
    if (spans > 4 * wanted) return places_on({range.lo, range.hi}, 4 * wanted);
    return places_on(stops, static_cast<int>(std::max<std::size_t>(2, wanted / spans)));
  }

  // From a sample: steps to the best of eight neighbours while that rises, then halves the step. Stays inside the loops.
  void climb(std::size_t start, int d) {
    Uv from{us_[start % us_.size()], vs_[start / us_.size()]};
    Uv step{u_.length() / double(us_.size()), v_.length() / double(vs_.size())};
    double value = along(point(from), d);
    for (int halvings = 0, moves = 0; halvings < 30 && moves < 300;) {
      Uv next = from;
      double best = value;
      for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j) {
          const Uv uv{u_.clamp(from.u + i * step.u), v_.clamp(from.v + j * step.v)};
          const double here = along(point(uv), d);
          if (here > best && contains(uv)) best = here, next = uv;
        }
      if (best > value) {
        value = best, from = next, ++moves;
      } else {
        step = 0.5 * step, ++halvings;
      }
    }
    const Point p = point(from);
    if (is_finite(p)) box_.add(p);
  }

  Box& box_;
  const Surface& surface_;
  const Transform* at_;
  Interval u_{infinity, -infinity}, v_{infinity, -infinity};
  std::vector<std::vector<Uv>> polygons_;
  std::vector<double> us_, vs_;
  std::vector<Point> points_;   // row by row
  std::vector<bool> inside_;
};

}  // namespace

void add_curve(Box& box, const Curve& curve, Interval range, const Transform* at) {
  if (!range.is_bounded()) return;
  add_path(box, places_on(within(breaks(curve), range), per_span(curve)),
           [&](double t) { return placed(evaluate(curve, t), at); });
}

void add_face(Box& box, const Body& body, const Face& face, const Transform* at) {
  if (face.status == FaceStatus::Failed || !face.surface) return;
  Box own;
  for (const LoopId id : face.loops)
    for (const Coedge& c : body[id].coedges) {
      const Edge& e = body[c.edge];
      if (e.curve) {
        add_curve(own, *e.curve, e.range, at);
        continue;
      }
      const Interval r{std::min(c.pcurve_range.lo, c.pcurve_range.hi), std::max(c.pcurve_range.lo, c.pcurve_range.hi)};
      add_path(own, places_on(within(breaks(c.pcurve.curve), r), 8),
               [&](double t) { return placed(evaluate(*face.surface, evaluate(c.pcurve, t)), at); });
    }
  if (!std::holds_alternative<Plane>(face.surface->shape)) Interior(own, body, face, at).run();
  box.add(own);
}

}  // namespace trimloop::detail

namespace trimloop {

Box bounding_box(const Body& body, FaceId id) {
  Box box;
  detail::add_face(box, body, body[id], nullptr);
  return box;
}

}  // namespace trimloop
