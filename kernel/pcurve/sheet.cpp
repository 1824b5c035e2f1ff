#include "kernel/pcurve/sheet.h"

namespace trimloop::pcurve {
namespace {

bool extends(const Curve& c) {  // evaluated beyond its range as what it is, not held at the end
  return std::holds_alternative<Line>(c.shape) || std::holds_alternative<Circle>(c.shape) ||
         std::holds_alternative<Ellipse>(c.shape) || std::holds_alternative<Parabola>(c.shape) ||
         std::holds_alternative<Hyperbola>(c.shape);
}

struct Holds {
  Interval u{-infinity, infinity}, v{-infinity, infinity};
};

Holds holds_of(const Surface& surface, const SurfaceDomain& d) {
  const Surface* s = &surface;
  while (const auto* offset = std::get_if<OffsetSurface>(&s->shape)) s = offset->basis.get();
  Holds h;
  if (const auto* n = std::get_if<NurbsSurface>(&s->shape)) {
    h.u = n->domain_u(), h.v = n->domain_v();
  } else if (const auto* r = std::get_if<Revolution>(&s->shape)) {
    if (r->generatrix && !extends(*r->generatrix)) h.v = d.v;
  } else if (const auto* e = std::get_if<Extrusion>(&s->shape)) {
    if (e->directrix && !extends(*e->directrix)) h.u = d.u;
  } else if (std::holds_alternative<Ruled>(s->shape)) {
    h.u = d.u;
  }
  return h;
}

double into(Interval range, double period, double t) {
  return range.contains(t) ? t : range.clamp(t - period * std::floor((t - range.lo) / period));
}

}  // namespace

Sheet::Sheet(const Surface& surface, double tolerance_mm)
    : surface_(surface), domain_(trimloop::domain(surface, tolerance_mm)) {
  const Holds holds = holds_of(surface, domain_);
  hold_u_ = holds.u;
  hold_v_ = holds.v;
  covers_u_ = domain_.period_u > 0;
  covers_v_ = domain_.period_v > 0;
  period_u_ = covers_u_ ? domain_.period_u : domain_.closed_u && domain_.u.is_bounded() ? domain_.u.length() : 0;
  period_v_ = covers_v_ ? domain_.period_v : domain_.closed_v && domain_.v.is_bounded() ? domain_.v.length() : 0;
  // A strip so narrow that its two sides lie within the tolerance is not closed: its middle would have to be elsewhere.
  const auto returns = [&](Uv side, Uv middle) {
    return distance(evaluate(surface_, side), evaluate(surface_, middle)) > 4 * tolerance_mm;
  };
  const double mid_u = domain_.u.is_bounded() ? domain_.u.mid() : 0, mid_v = domain_.v.is_bounded() ? domain_.v.mid() : 0;
  if (period_u_ > 0 && !covers_u_ && !returns({domain_.u.lo, mid_v}, {mid_u, mid_v})) period_u_ = 0;
  if (period_v_ > 0 && !covers_v_ && !returns({mid_u, domain_.v.lo}, {mid_u, mid_v})) period_v_ = 0;
  find_poles();
}

void Sheet::find_poles() {
  const auto add = [&](bool at_v, double value) {
    if (!std::isfinite(value)) return;
    const double other = at_v ? (domain_.u.is_bounded() ? domain_.u.mid() : 0) : (domain_.v.is_bounded() ? domain_.v.mid() : 0);
    const Uv uv = at_v ? Uv{other, value} : Uv{value, other};
    poles_.push_back({at_v, value, evaluate(surface_, uv)});
  };
  if (domain_.pole_v_lo) add(true, domain_.v.lo);
  if (domain_.pole_v_hi) add(true, domain_.v.hi);
  if (domain_.pole_u_lo) add(false, domain_.u.lo);
  if (domain_.pole_u_hi) add(false, domain_.u.hi);
  if (const auto* cone = std::get_if<Cone>(&surface_.shape); cone && poles_.empty()) {
    const double slope = std::tan(cone->half_angle_rad);
    if (slope != 0) add(true, -cone->radius / slope);
  }
}

// Near in space and near the side in parameters: a surface may pass its own pole elsewhere.
const Pole* Sheet::pole_at(Uv uv, Point p, double tolerance_mm) const {
  for (const Pole& pole : poles_) {
    const Interval range = pole.at_v ? domain_.v : domain_.u;
    const double off = std::abs((pole.at_v ? uv.v : uv.u) - pole.value);
    if (range.is_bounded() && off > 0.01 * range.length()) continue;
    if (distance(p, pole.point) <= tolerance_mm) return &pole;
  }
  return nullptr;
}

Uv Sheet::home(Uv uv) const {
  if (period_u_ > 0 && !covers_u_) uv.u = into(domain_.u, period_u_, uv.u);
  if (period_v_ > 0 && !covers_v_) uv.v = into(domain_.v, period_v_, uv.v);
  return uv;
}

Point Sheet::point(Uv uv) const { return evaluate(surface_, home(uv)); }

void Sheet::jet(Uv uv, Point& p, Vector& du, Vector& dv) const { jet1(surface_, home(uv), p, du, dv); }

double Sheet::millimetres(Uv a, Uv b) const {
  Point p;
  Vector du, dv;
  jet(a, p, du, dv);
  return norm((b.u - a.u) * du + (b.v - a.v) * dv);
}

SurfaceFoot Sheet::foot(Point p) const {
  std::optional<Interval> u, v;
  if (period_u_ > 0 && !domain_.u.is_bounded()) u = Interval{0, period_u_};
  if (period_v_ > 0 && !domain_.v.is_bounded()) v = Interval{0, period_v_};
  return closest_point(surface_, p, u, v);
}

SurfaceFoot Sheet::foot_near(Point p, Uv start) const {
  const Uv base = home(start);
  SurfaceFoot found = closest_point_near(surface_, p, base);
  // A search that ran into the seam of a closed surface goes on from the other side.
  const auto hit = [](double t, Interval range) { return t <= range.lo ? -1 : t >= range.hi ? 1 : 0; };
  for (int direction = 0; direction < 2; ++direction) {
    const bool is_u = direction == 0;
    const double period = is_u ? period_u_ : period_v_;
    if (!(period > 0) || (is_u ? covers_u_ : covers_v_)) continue;
    const Interval range = is_u ? domain_.u : domain_.v;
    const int side = hit(is_u ? found.uv.u : found.uv.v, range);
    if (side == 0) continue;
    Uv other = found.uv;
    (is_u ? other.u : other.v) = side > 0 ? range.lo : range.hi;
    const SurfaceFoot beyond = closest_point_near(surface_, p, other);
    if (beyond.distance < found.distance) found = beyond;
  }
  const auto unwrap = [](double t, double period, double near) {
    return period > 0 ? t + period * std::round((near - t) / period) : t;
  };
  found.uv = {unwrap(found.uv.u, period_u_, start.u), unwrap(found.uv.v, period_v_, start.v)};
  return found;
}

}  // namespace trimloop::pcurve
