#include "kernel/closest/loops.h"

namespace trimloop::closest {

namespace {

void add(Interval& i, double x) { i = {std::min(i.lo, x), std::max(i.hi, x)}; }

double distance_to_segment(Uv p, Uv a, Uv b) {
  const Uv along = b - a;
  const double length2 = dot(along, along), t = length2 > 0 ? Interval{0, 1}.clamp(dot(p - a, along) / length2) : 0;
  return norm(p - (a + t * along));
}

}  // namespace

void Loops::add(const std::vector<Coedge>& loop) {
  const std::size_t first = sides_.size();
  for (const Coedge& c : loop) {
    Side side{c.pcurve,
              {std::min(c.pcurve_range.lo, c.pcurve_range.hi), std::max(c.pcurve_range.lo, c.pcurve_range.hi)},
              c.reversed != (c.pcurve_range.lo > c.pcurve_range.hi),
              0,
              {},
              {infinity, -infinity},
              {infinity, -infinity}};
    std::vector<double> at{side.range.lo};
    for (double t : breaks(c.pcurve.curve))
      if (t > side.range.lo && t < side.range.hi) at.push_back(t);
    at.push_back(side.range.hi);
    const bool straight =
        std::holds_alternative<Line>(c.pcurve.curve.shape) || std::holds_alternative<Polyline>(c.pcurve.curve.shape);
    const int parts = straight ? 1 : 48;
    side.at.push_back(evaluate(c.pcurve, side.range.lo));
    for (std::size_t i = 0; i + 1 < at.size(); ++i)
      for (int k = 1; k <= parts; ++k) {
        const Interval piece{at[i], at[i + 1]};
        const Uv middle = evaluate(c.pcurve, piece.at((k - 0.5) / parts)),
                 end = evaluate(c.pcurve, piece.at(double(k) / parts));
        if (!straight) side.reach = std::max(side.reach, 2 * distance_to_segment(middle, side.at.back(), end));
        side.at.push_back(end);
      }
    for (const Uv p : side.at) {
      closest::add(side.u, p.u), closest::add(side.v, p.v);
    }
    // The curve may bulge beyond its polyline.
    side.u = {side.u.lo - side.reach, side.u.hi + side.reach};
    side.v = {side.v.lo - side.reach, side.v.hi + side.reach};
    closest::add(u_, side.u.lo), closest::add(u_, side.u.hi);
    closest::add(v_, side.v.lo), closest::add(v_, side.v.hi);
    sides_.push_back(std::move(side));
  }
  // Where one ends the next begins, to the last bit: parity counts each level between them once.
  for (std::size_t i = first; i < sides_.size(); ++i) {
    const Side& before = sides_[i];
    Side& after = sides_[i + 1 < sides_.size() ? i + 1 : first];
    const Uv joint = before.reversed ? before.at.front() : before.at.back();
    (after.reversed ? after.at.back() : after.at.front()) = joint;
    closest::add(after.u, joint.u), closest::add(after.v, joint.v);
  }
}

bool Loops::contains(Uv p) const {
  bool inside = false;
  const Side* near = nullptr;
  double nearest = infinity;
  for (const Side& side : sides_) {
    if (p.v < side.v.lo || p.v > side.v.hi || p.u > side.u.hi) continue;
    const bool close = p.u >= side.u.lo;
    for (std::size_t i = 0; i + 1 < side.at.size(); ++i) {
      const Uv a = side.at[i], b = side.at[i + 1];
      if ((a.v > p.v) != (b.v > p.v) && p.u < a.u + (p.v - a.v) / (b.v - a.v) * (b.u - a.u)) inside = !inside;
      if (!close || side.reach == 0) continue;
      if (const double d = distance_to_segment(p, a, b); d <= side.reach && d < nearest) nearest = d, near = &side;
    }
  }
  if (!near) return inside;
  // Loops keep the inside on their left. At the ends of a side the tangent says little: the parity stands.
  const CurveFoot foot = closest_point(with_range(near->pcurve.curve, near->range), {p.u, p.v, 0});
  if (!(foot.t > near->range.lo && foot.t < near->range.hi)) return inside;
  const CurveJet j = jet(near->pcurve.curve, foot.t);
  const double side = cross(Uv{j.d1.x, j.d1.y}, p - Uv{foot.point.x, foot.point.y});
  return near->reversed ? side <= 0 : side >= 0;
}

bool Loops::misses(Interval u, Interval v) const {
  const auto apart = [](Interval a, double lo, double hi) { return hi < a.lo || lo > a.hi; };
  for (const Side& side : sides_) {
    if (apart(u, side.u.lo, side.u.hi) || apart(v, side.v.lo, side.v.hi)) continue;
    for (std::size_t i = 0; i + 1 < side.at.size(); ++i) {
      const Uv a = side.at[i], b = side.at[i + 1];
      if (!apart(u, std::min(a.u, b.u) - side.reach, std::max(a.u, b.u) + side.reach) &&
          !apart(v, std::min(a.v, b.v) - side.reach, std::max(a.v, b.v) + side.reach))
        return false;
    }
  }
  return !contains({u.mid(), v.mid()});
}

}  // namespace trimloop::closest
