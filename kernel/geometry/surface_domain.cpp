// Where a surface is defined: its rectangle, what closes, what collapses, where smoothness ends. And the unit normal,
// which needs to know in what direction the inside lies.

#include <array>

#include "kernel/geometry/arc_length.h"
#include "kernel/geometry/detail.h"

namespace trimloop {
namespace {

using detail::Rectangle;
constexpr Interval everywhere{-infinity, infinity};

// ---- Rectangles

Rectangle rectangle_of(const Plane&) { return {everywhere, everywhere}; }
Rectangle rectangle_of(const Cylinder&) { return {{0, two_pi}, everywhere, true}; }
// The nappe of positive radius; it ends in the apex.
Rectangle rectangle_of(const Cone& c) {
  const double slope = std::tan(c.half_angle_rad), apex = -c.radius / slope;
  if (!std::isfinite(apex)) return {{0, two_pi}, everywhere, true};
  return {{0, two_pi}, slope > 0 ? Interval{apex, infinity} : Interval{-infinity, apex}, true};
}
Rectangle rectangle_of(const Sphere&) { return {{0, two_pi}, {-pi / 2, pi / 2}, true}; }
Rectangle rectangle_of(const Torus&) { return {{0, two_pi}, {0, two_pi}, true, true}; }
Rectangle rectangle_of(const Revolution& r) {
  Rectangle out;
  out.free_u = detail::is_full_turn(r.range_u);
  out.u = {r.range_u.lo, out.free_u ? r.range_u.lo + two_pi : r.range_u.hi};
  if (r.generatrix) out.v = range(*r.generatrix), out.free_v = detail::is_periodic(*r.generatrix);
  return out;
}
Rectangle rectangle_of(const Extrusion& e) {
  Rectangle out;
  if (e.directrix) out.u = range(*e.directrix), out.free_u = detail::is_periodic(*e.directrix);
  out.v = e.range_v;
  return out;
}
Rectangle rectangle_of(const Ruled&) { return {{0, 1}, {0, 1}}; }
Rectangle rectangle_of(const OffsetSurface& s) { return s.basis ? detail::rectangle(*s.basis) : Rectangle{}; }
Rectangle rectangle_of(const NurbsSurface& s) { return {s.range_u(), s.range_v()}; }

// ---- Sides, by samples

// Enough places along a side to tell two curves of it apart: the breaks and degree + 1 between two of them.
std::vector<double> sample_places(const std::vector<double>& breaks, int between) {
  std::vector<double> out;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    for (int k = 0; k <= between; ++k) out.push_back(breaks[i] + (breaks[i + 1] - breaks[i]) * k / (between + 1));
  if (!breaks.empty()) out.push_back(breaks.back());
  // The middle first: sides that differ mostly differ there, and the comparison ends at the first difference.
  if (out.size() > 2) std::swap(out[0], out[out.size() / 2]);
  return out;
}

enum class Along { U, V };
struct Sides {
  const Surface& surface;
  Rectangle r;
  double tolerance;
  std::vector<double> places_u, places_v;

  // The side lo or hi of the direction across `along`.
  Point at(Along along, bool hi, double t) const {
    return along == Along::U ? evaluate(surface, {t, hi ? r.v.hi : r.v.lo})
                             : evaluate(surface, {hi ? r.u.hi : r.u.lo, t});
  }
  const std::vector<double>& places(Along along) const { return along == Along::U ? places_u : places_v; }
  bool coincide(Along along) const {
    for (const double t : places(along))
      if (!(distance(at(along, false, t), at(along, true, t)) <= tolerance)) return false;
    return true;
  }
  bool is_point(Along along, bool hi) const {
    Box box;
    for (const double t : places(along)) {
      box.add(at(along, hi, t));
      if (!(box.diagonal() <= tolerance)) return false;
    }
    return true;
  }
};

int samples_between(const Surface& s, Along along) {
  if (const auto* n = std::get_if<NurbsSurface>(&s.shape)) return along == Along::U ? n->degree_u() : n->degree_v();
  return 7;
}

SurfaceDomain sampled_domain(const Surface& s, double tolerance) {
  const Rectangle r = detail::rectangle(s);
  SurfaceDomain d{r.u, r.v};
  d.period_u = r.free_u ? two_pi : 0;
  d.period_v = r.free_v ? two_pi : 0;
  const Sides sides{s, r, tolerance, sample_places(breaks_u(s), samples_between(s, Along::U)),
                    sample_places(breaks_v(s), samples_between(s, Along::V))};
  const bool u = r.u.is_bounded() && !sides.places_v.empty(), v = r.v.is_bounded() && !sides.places_u.empty();
  d.closed_u = r.free_u || (u && sides.coincide(Along::V));
  d.closed_v = r.free_v || (v && sides.coincide(Along::U));
  d.pole_u_lo = std::isfinite(r.u.lo) && !r.free_u && !sides.places_v.empty() && sides.is_point(Along::V, false);
  d.pole_u_hi = std::isfinite(r.u.hi) && !r.free_u && !sides.places_v.empty() && sides.is_point(Along::V, true);
  d.pole_v_lo = std::isfinite(r.v.lo) && !r.free_v && !sides.places_u.empty() && sides.is_point(Along::U, false);
  d.pole_v_hi = std::isfinite(r.v.hi) && !r.free_v && !sides.places_u.empty() && sides.is_point(Along::U, true);
  return d;
}

// ---- Domains known without samples

SurfaceDomain turned_domain(const Rectangle& r) {
  SurfaceDomain d{r.u, r.v};
  d.period_u = two_pi;
  d.closed_u = true;
  return d;
}
SurfaceDomain domain_of(const Plane& s, const Surface&, double) {
  const Rectangle r = rectangle_of(s);
  return {r.u, r.v};
}
SurfaceDomain domain_of(const Cylinder& s, const Surface&, double) { return turned_domain(rectangle_of(s)); }
SurfaceDomain domain_of(const Cone& s, const Surface&, double) {
  SurfaceDomain d = turned_domain(rectangle_of(s));
  d.pole_v_lo = std::isfinite(d.v.lo);
  d.pole_v_hi = std::isfinite(d.v.hi);
  return d;
}
SurfaceDomain domain_of(const Sphere& s, const Surface&, double) {
  SurfaceDomain d = turned_domain(rectangle_of(s));
  d.pole_v_lo = d.pole_v_hi = true;
  return d;
}
SurfaceDomain domain_of(const Torus& s, const Surface&, double) {
  SurfaceDomain d = turned_domain(rectangle_of(s));
  d.period_v = two_pi;
  d.closed_v = true;
  return d;
}
// Poles where an end of the generatrix lies on the axis.
SurfaceDomain domain_of(const Revolution& s, const Surface& surface, double tolerance) {
  if (!s.generatrix) return {};
  const Rectangle r = rectangle_of(s);
  SurfaceDomain d{r.u, r.v};
  d.period_u = r.free_u ? two_pi : 0;
  d.period_v = r.free_v ? two_pi : 0;
  const auto on_axis = [&](double t) {
    return std::isfinite(t) && norm(cross(evaluate(*s.generatrix, t) - s.axis_origin, s.axis)) <= tolerance;
  };
  d.closed_v =
      r.free_v || (r.v.is_bounded() && distance(start_point(*s.generatrix), end_point(*s.generatrix)) <= tolerance);
  d.closed_u = r.free_u;
  if (!d.closed_u && two_pi - r.u.length() < 1e-3) {  // a nearly full turn closes where the gap is within tolerance
    const Sides sides{surface, r, tolerance, {}, sample_places(breaks(*s.generatrix), 7)};
    d.closed_u = r.v.is_bounded() && sides.coincide(Along::V);
  }
  d.pole_v_lo = on_axis(r.v.lo);
  d.pole_v_hi = on_axis(r.v.hi);
  return d;
}
SurfaceDomain domain_of(const Extrusion& s, const Surface&, double tolerance) {
  if (!s.directrix) return {};
  const Rectangle r = rectangle_of(s);
  SurfaceDomain d{r.u, r.v};
  d.period_u = r.free_u ? two_pi : 0;
  d.closed_u =
      r.free_u || (r.u.is_bounded() && distance(start_point(*s.directrix), end_point(*s.directrix)) <= tolerance);
  return d;
}
SurfaceDomain domain_of(const Ruled& s, const Surface& surface, double tolerance) {
  return s.first && s.second ? sampled_domain(surface, tolerance) : SurfaceDomain{};
}
SurfaceDomain domain_of(const OffsetSurface& s, const Surface& surface, double tolerance) {
  return s.basis ? sampled_domain(surface, tolerance) : SurfaceDomain{};
}
SurfaceDomain domain_of(const NurbsSurface&, const Surface& surface, double tolerance) {
  return sampled_domain(surface, tolerance);
}

// ---- Lines of reduced smoothness

std::vector<double> finite_ends(Interval i) {
  std::vector<double> out;
  if (std::isfinite(i.lo)) out.push_back(i.lo);
  if (std::isfinite(i.hi)) out.push_back(i.hi);
  return out;
}

void add_side_breaks(std::vector<double>& out, const CurvePtr& curve, bool reverse, const ArcLength* table) {
  if (!curve) return;
  const Interval r = range(*curve);
  for (const double t : breaks(*curve)) {
    const double f = table ? table->fraction(t) : (t - r.lo) / r.length();
    if (f > 0 && f < 1) out.push_back(reverse ? 1 - f : f);
  }
}
std::vector<double> ruled_breaks_u(const Ruled& s) {
  std::vector<double> out{0, 1};
  if (!s.equal_arc_length) {
    add_side_breaks(out, s.first, false, nullptr);
    add_side_breaks(out, s.second, s.second_reversed, nullptr);
  } else {
    const Ruled measured =
        s.first_length && s.second_length ? s : make_ruled(s.first, s.second, s.second_reversed, true);
    add_side_breaks(out, s.first, false, measured.first_length.get());
    add_side_breaks(out, s.second, s.second_reversed, measured.second_length.get());
  }
  std::sort(out.begin(), out.end());
  // Knots of the two curves that agree up to rounding are one line.
  out.erase(std::unique(out.begin(), out.end(), [](double a, double b) { return b - a < 1e-12; }), out.end());
  out.back() = 1;
  return out;
}

// ---- Normal

// The limit of Su x Sv on the way from the collapsed side inwards: to first order Su(v + e) = Su + e Suv.
Vector limit_normal(const Surface& s, Uv p) {
  const Rectangle r = detail::rectangle(s);
  const auto inward = [](Interval i, double t) {
    if (!i.is_bounded()) return std::isfinite(i.hi) && !std::isfinite(i.lo) ? -1.0 : 1.0;
    return t <= i.mid() ? 1.0 : -1.0;
  };
  const double step_u = inward(r.u, p.u) * (r.u.is_bounded() ? r.u.length() : 1);
  const double step_v = inward(r.v, p.v) * (r.v.is_bounded() ? r.v.length() : 1);
  const SurfaceJet j = jet(s, p);
  const double along_u = norm(j.du) * std::abs(step_u), along_v = norm(j.dv) * std::abs(step_v);
  const bool u_collapsed = !(along_u > 1e-7 * along_v), v_collapsed = !(along_v > 1e-7 * along_u);
  if (u_collapsed && !v_collapsed) {
    const Vector n = step_v * cross(j.duv, j.dv);
    if (norm(n) * std::abs(step_u) > 1e-7 * along_v * along_v / std::abs(step_v)) return normalized(n);
  }
  if (v_collapsed && !u_collapsed) {
    const Vector n = step_u * cross(j.du, j.duv);
    if (norm(n) * std::abs(step_v) > 1e-7 * along_u * along_u / std::abs(step_u)) return normalized(n);
  }
  // A step across the collapsed side where there is one, else both ways. Where poles repeat, a derivative vanishes along
  // a side that has a length: then a step in that derivative's own direction.
  const bool one = u_collapsed != v_collapsed;
  for (const bool own : {false, true}) {
    const double du_share = !one || u_collapsed == own ? step_u : 0, dv_share = !one || v_collapsed == own ? step_v : 0;
    for (const double part : {1e-7, 1e-5, 1e-3, 1e-2}) {
      Point ignored;
      Vector du, dv;
      jet1(s, {p.u + part * du_share, p.v + part * dv_share}, ignored, du, dv);
      const Vector n = cross(du, dv);
      const double reach_u = norm(du) * std::abs(step_u), reach_v = norm(dv) * std::abs(step_v);
      if (std::min(reach_u, reach_v) <= 1e-9 * std::max(reach_u, reach_v)) continue;  // rounding only
      if (is_finite(n) && norm(n) > 1e-12 * norm(du) * norm(dv) && norm(n) > 0) return normalized(n);
    }
  }
  return {};
}

Vector radial(const Frame& f, double u) { return std::cos(u) * f.x + std::sin(u) * f.y; }
double sign(double x) { return x < 0 ? -1 : 1; }

Vector normal_of(const Plane& s, const Surface&, Uv) { return s.frame.z; }
Vector normal_of(const Cylinder& s, const Surface&, Uv p) { return sign(s.radius) * radial(s.frame, p.u); }
Vector normal_of(const Cone& s, const Surface&, Uv p) {
  const double slope = std::tan(s.half_angle_rad), rho = s.radius + p.v * slope;
  const bool at_apex = std::abs(rho) <= 1e-12 * std::abs(s.radius);  // the nappe of positive radius goes on
  return (at_apex ? 1 : sign(rho)) *
         (std::cos(s.half_angle_rad) * radial(s.frame, p.u) - std::sin(s.half_angle_rad) * s.frame.z);
}
Vector normal_of(const Sphere& s, const Surface&, Uv p) {
  const bool at_pole = std::abs(std::abs(p.v) - pi / 2) <= 1e-12;
  return (at_pole ? 1 : sign(std::cos(p.v))) * (std::cos(p.v) * radial(s.frame, p.u) + std::sin(p.v) * s.frame.z);
}
Vector normal_of(const Torus& s, const Surface&, Uv p) {
  const double rho = s.major_radius + s.minor_radius * std::cos(p.v);
  return sign(rho) * sign(s.minor_radius) * (std::cos(p.v) * radial(s.frame, p.u) + std::sin(p.v) * s.frame.z);
}
template <class S>
Vector normal_of(const S&, const Surface& surface, Uv p) {
  Point ignored;
  Vector du, dv;
  jet1(surface, p, ignored, du, dv);
  const Vector n = cross(du, dv);
  const double size = norm(n), product = norm(du) * norm(dv);
  const Rectangle r = detail::rectangle(surface);
  // Near a pole one of the derivatives is short by rounding only; what is short is told by the size of the rectangle.
  const double along_u = norm(du) * (r.u.is_bounded() ? r.u.length() : 1);
  const double along_v = norm(dv) * (r.v.is_bounded() ? r.v.length() : 1);
  const bool regular = size > 1e-10 * product && std::min(along_u, along_v) > 1e-10 * std::max(along_u, along_v);
  return regular ? n / size : limit_normal(surface, p);
}

}  // namespace

namespace detail {

bool is_full_turn(Interval angle_rad) { return angle_rad.length() >= two_pi - 1e-9; }

bool is_periodic(const Curve& c) {
  const bool angular = std::holds_alternative<Circle>(c.shape) || std::holds_alternative<Ellipse>(c.shape);
  return angular && is_full_turn(range(c));
}

Rectangle rectangle(const Surface& s) {
  return std::visit([](const auto& shape) { return rectangle_of(shape); }, s.shape);
}

}  // namespace detail

SurfaceDomain domain(const Surface& s, double tolerance_mm) {
  return std::visit([&](const auto& shape) { return domain_of(shape, s, tolerance_mm); }, s.shape);
}

std::vector<double> breaks_u(const Surface& s) {
  if (const auto* n = std::get_if<NurbsSurface>(&s.shape)) return breaks_u(*n);
  if (const auto* e = std::get_if<Extrusion>(&s.shape))
    return e->directrix ? breaks(*e->directrix) : std::vector<double>{};
  if (const auto* r = std::get_if<Ruled>(&s.shape)) return ruled_breaks_u(*r);
  if (const auto* o = std::get_if<OffsetSurface>(&s.shape))
    return o->basis ? breaks_u(*o->basis) : std::vector<double>{};
  return finite_ends(detail::rectangle(s).u);
}
std::vector<double> breaks_v(const Surface& s) {
  if (const auto* n = std::get_if<NurbsSurface>(&s.shape)) return breaks_v(*n);
  if (const auto* r = std::get_if<Revolution>(&s.shape))
    return r->generatrix ? breaks(*r->generatrix) : std::vector<double>{};
  if (const auto* o = std::get_if<OffsetSurface>(&s.shape))
    return o->basis ? breaks_v(*o->basis) : std::vector<double>{};
  return finite_ends(detail::rectangle(s).v);
}

Vector normal(const Surface& s, Uv p) {
  return std::visit([&](const auto& shape) { return normal_of(shape, s, p); }, s.shape);
}

}  // namespace trimloop
