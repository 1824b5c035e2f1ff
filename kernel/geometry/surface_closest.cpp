// Nearest points of surfaces. The elementary ones in closed form; elsewhere the smooth patches are visited in the order
// of a lower bound of their distance, samples find the valleys of each, and Newton's method, held inside the patch,
// finds their bottoms. As every patch counts its own sides, a nearest point on the boundary or on a crease is found
// like any other.

#include <array>

#include "kernel/geometry/detail.h"

namespace trimloop {
namespace {

using detail::Rectangle;

SurfaceFoot foot_at(const Surface& s, Point p, Uv uv) {
  const Point q = evaluate(s, uv);
  return {uv, q, distance(p, q)};
}
void keep_nearer(SurfaceFoot& best, const SurfaceFoot& other) {
  if (other.distance < best.distance) best = other;
}

// ---- Newton

// One variable of the descent: its limits, and whether it is held at one of them.
struct Axis {
  double lo, hi;
  bool free;
  // No step is longer: beside a pole the quadric sees a tiny circle and would send an angle round many times.
  double longest() const { return free ? 1 : std::isfinite(hi - lo) ? 0.3 * std::max(hi - lo, 0.0) : infinity; }
  double scale() const { return !free && std::isfinite(hi - lo) && hi > lo ? hi - lo : 1; }
  bool held(double t, double slope) const { return !free && ((t <= lo && slope >= 0) || (t >= hi && slope <= 0)); }
  double clamp(double t) const { return free ? t : Interval{lo, hi}.clamp(t); }
};

struct Step {
  double u = 0, v = 0;
  bool newton = false;  // by the full second derivatives: the next error is the square of this step
};

// Gradient and second derivatives of |S - p|^2 / 2, and the part of the latter that Gauss and Newton keep (J^T J).
struct Quadric {
  double gu, gv, uu, uv, vv, juu, juv, jvv;
  Quadric(const SurfaceJet& j, Point p) {
    const Vector r = j.point - p;
    gu = dot(j.du, r);
    gv = dot(j.dv, r);
    juu = dot(j.du, j.du);
    juv = dot(j.du, j.dv);
    jvv = dot(j.dv, j.dv);
    uu = juu + dot(j.duu, r);
    uv = juv + dot(j.duv, r);
    vv = jvv + dot(j.dvv, r);
  }
  // Bottom along one variable.
  static Step along_u(double g, double h, double j) {
    const bool newton = h > 0.01 * j;
    return {j > 0 ? -g / (newton ? h : j) : 0, 0, newton};
  }
  static Step along_v(double g, double h, double j) {
    const Step s = along_u(g, h, j);
    return {0, s.u, s.newton};
  }
  // Bottom of the full quadric where it is a bowl, else of the Gauss-Newton one, else along the longer derivative.
  Step both() const {
    const double det = uu * vv - uv * uv;
    if (uu > 0.01 * juu && vv > 0.01 * jvv && det > 1e-4 * uu * vv)
      return {(uv * gv - vv * gu) / det, (uv * gu - uu * gv) / det, true};
    const double jdet = juu * jvv - juv * juv;
    if (jdet > 1e-12 * juu * jvv) return {(juv * gv - jvv * gu) / jdet, (juv * gu - juu * gv) / jdet, false};
    return juu >= jvv ? along_u(gu, uu, juu) : along_v(gv, vv, jvv);
  }
};

Step bounded_step(const Quadric& q, Uv at, const Axis& u, const Axis& v) {
  const bool hold_u = u.held(at.u, q.gu), hold_v = v.held(at.v, q.gv);
  if (hold_u && hold_v) return {};
  if (hold_u) return Quadric::along_v(q.gv, q.vv, q.jvv);
  if (hold_v) return Quadric::along_u(q.gu, q.uu, q.juu);
  Step s = q.both();
  // Where the step leaves through one side, the other variable goes to the bottom along that side.
  const double du = u.clamp(at.u + s.u) - at.u, dv = v.clamp(at.v + s.v) - at.v;
  const bool out_u = du != s.u && std::abs(at.u + s.u - u.clamp(at.u + s.u)) > 0;
  const bool out_v = dv != s.v && std::abs(at.v + s.v - v.clamp(at.v + s.v)) > 0;
  if (out_u && !out_v) {
    const double slope = q.gv + (s.newton ? q.uv : q.juv) * du;
    s = {du, Quadric::along_v(slope, q.vv, q.jvv).v, false};
  } else if (out_v && !out_u) {
    const double slope = q.gu + (s.newton ? q.uv : q.juv) * dv;
    s = {Quadric::along_u(slope, q.uu, q.juu).u, dv, false};
  }
  return s;
}

// Where a step that ran out of a side comes in again on the other one, if the surface closes there.
bool reenter(const Surface& s, const Rectangle& r, Uv from, Uv& to) {
  const auto closes = [&](Uv a, Uv b) {
    Point p, q;
    Vector du, dv, ignored;
    jet1(s, a, p, du, dv);
    jet1(s, b, q, ignored, ignored);
    const double size =
        norm(du) * (r.u.is_bounded() ? r.u.length() : 0) + norm(dv) * (r.v.is_bounded() ? r.v.length() : 0);
    return distance(p, q) <= 1e-9 * size;
  };
  bool any = false;
  if (!r.free_u && r.u.is_bounded() && !r.u.contains(to.u) && closes({r.u.lo, from.v}, {r.u.hi, from.v})) {
    to.u = r.u.clamp(to.u < r.u.lo ? to.u + r.u.length() : to.u - r.u.length());
    any = true;
  }
  if (!r.free_v && r.v.is_bounded() && !r.v.contains(to.v) && closes({from.u, r.v.lo}, {from.u, r.v.hi})) {
    to.v = r.v.clamp(to.v < r.v.lo ? to.v + r.v.length() : to.v - r.v.length());
    any = true;
  }
  return any;
}

// Damped Newton, held in a rectangle. Each accepted point is no farther than the one before (but for rounding).
class Descent {
 public:
  Descent(const Surface& surface, Point target, Uv start, const Rectangle& rectangle)
      : s_(surface),
        p_(target),
        r_(rectangle),
        u_{r_.u.lo, r_.u.hi, r_.free_u},
        v_{r_.v.lo, r_.v.hi, r_.free_v},
        last_{r_.free_u ? infinity : std::nextafter(r_.u.hi, r_.u.lo),
              r_.free_v ? infinity : std::nextafter(r_.v.hi, r_.v.lo)} {
    foot_.uv = {u_.clamp(start.u), v_.clamp(start.v)};
    jet_ = one_sided(foot_.uv);
    foot_.point = jet_.point;
    foot_.distance = distance(p_, jet_.point);
  }
  // With `wrap` a surface that closes is entered again on its other side.
  SurfaceFoot run(int iterations, bool wrap) {
    for (int i = 0; i < iterations; ++i) {
      const Quadric q(jet_, p_);
      if (wrap && cross_seam(q)) continue;
      Step step = bounded_step(q, foot_.uv, u_, v_);
      step.u = std::clamp(step.u, -u_.longest(), u_.longest());
      step.v = std::clamp(step.v, -v_.longest(), v_.longest());
      if (!advance(step)) break;
    }
    return foot_;
  }

 private:
  // At an upper side the derivatives of this side of a crease are wanted.
  SurfaceJet one_sided(Uv at) const { return jet(s_, {std::min(at.u, last_.u), std::min(at.v, last_.v)}); }
  bool accept(Uv to, double allowed) {
    const SurfaceJet there = one_sided(to);
    const double d = distance(p_, there.point);
    if (!(d <= allowed)) return false;
    jet_ = there;
    foot_ = {to, there.point, d};
    return true;
  }
  bool cross_seam(const Quadric& q) {
    const Step step = q.both();
    Uv to{foot_.uv.u + step.u, foot_.uv.v + step.v};
    return reenter(s_, r_, foot_.uv, to) && accept({u_.clamp(to.u), v_.clamp(to.v)}, std::nextafter(foot_.distance, 0));
  }
  // False when this was the last step. The error of a full Newton step is about its square.
  bool advance(Step step) {
    for (int halving = 0; halving < 8; ++halving) {
      const Uv from = foot_.uv, to{u_.clamp(from.u + step.u), v_.clamp(from.v + step.v)};
      const double size = std::max(std::abs(to.u - from.u) / u_.scale(), std::abs(to.v - from.v) / v_.scale());
      if (!(size > 1e-15)) return false;
      const bool final = step.newton && size <= 1e-7;
      if (accept(to, final ? foot_.distance * (1 + 1e-14) : foot_.distance)) return !final && size > 1e-14;
      if (final) return false;
      step = {0.5 * step.u, 0.5 * step.v, false};
    }
    return false;
  }

  const Surface& s_;
  Point p_;
  Rectangle r_;
  Axis u_, v_;
  Uv last_;
  SurfaceJet jet_;
  SurfaceFoot foot_;
};

// At a pole the derivatives along the collapsed side vanish, and a descent would see only the one meridian it is on. A
// start there is moved to the best of some places about the pole, if one is better.
Uv off_pole(const Surface& s, Point p, Uv start, const Rectangle& r) {
  if (!r.u.is_bounded() || !r.v.is_bounded()) return start;
  const bool v_side = start.v <= r.v.lo || start.v >= r.v.hi, u_side = start.u <= r.u.lo || start.u >= r.u.hi;
  if (!u_side && !v_side) return start;
  SurfaceFoot best;
  best.uv = start;
  Vector du, dv;
  jet1(s, start, best.point, du, dv);
  best.distance = distance(p, best.point);
  const double along_u = norm(du) * r.u.length(), along_v = norm(dv) * r.v.length();
  const bool u_collapsed = v_side && along_u <= 1e-9 * along_v, v_collapsed = u_side && along_v <= 1e-9 * along_u;
  if (!u_collapsed && !v_collapsed) return start;
  for (int i = 0; i < 12; ++i)
    for (const double inwards : {0.001, 0.01, 0.05, 0.2}) {
      const double along = i / 12.0;
      keep_nearer(best, foot_at(s, p,
                                u_collapsed ? Uv{r.u.at(along), r.v.at(start.v <= r.v.lo ? inwards : 1 - inwards)}
                                            : Uv{r.u.at(start.u <= r.u.lo ? inwards : 1 - inwards), r.v.at(along)}));
    }
  return best.uv;
}

// ---- Search over patches

struct SearchPatch {
  double bound;  // of the distance, from below
  Interval u, v;
};

// Samples of a patch at the corners of nu x nv cells.
struct Grid {
  std::size_t rows, columns;
  std::vector<SurfaceFoot> at;
  Grid(const Surface& s, Point p, const SearchPatch& patch, int nu, int nv)
      : rows(static_cast<std::size_t>(nu) + 1), columns(static_cast<std::size_t>(nv) + 1) {
    at.reserve(rows * columns);
    for (int i = 0; i <= nu; ++i)
      for (int k = 0; k <= nv; ++k)
        at.push_back(foot_at(s, p, {patch.u.at(static_cast<double>(i) / nu), patch.v.at(static_cast<double>(k) / nv)}));
  }
  const SurfaceFoot& operator()(std::size_t i, std::size_t k) const { return at[i * columns + k]; }
  bool is_valley(std::size_t i, std::size_t k) const {
    for (std::size_t a = i == 0 ? 0 : i - 1; a <= std::min(i + 1, rows - 1); ++a)
      for (std::size_t b = k == 0 ? 0 : k - 1; b <= std::min(k + 1, columns - 1); ++b)
        if ((*this)(a, b).distance < (*this)(i, k).distance) return false;
    return true;
  }
};

// Where a descent may start, with an estimate from below of the distances around it.
struct Seed {
  double bound;
  Uv from;
};
void sort_and_cut(std::vector<Seed>& seeds, std::size_t most) {
  std::stable_sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) { return a.bound < b.bound; });
  if (seeds.size() > most) seeds.resize(most);
}

// A cell is taken for the ball about the mean of its corners, somewhat enlarged for its curvature.
Seed cell_seed(const Grid& grid, Point p, std::size_t i, std::size_t k) {
  const std::array<Point, 4> corners{grid(i, k).point, grid(i + 1, k).point, grid(i, k + 1).point,
                                     grid(i + 1, k + 1).point};
  const Point centre = midpoint(midpoint(corners[0], corners[3]), midpoint(corners[1], corners[2]));
  double radius = 0;
  for (const Point q : corners) radius = std::max(radius, distance(centre, q));
  return {distance(centre, p) - 1.25 * radius, 0.5 * (grid(i, k).uv + grid(i + 1, k + 1).uv)};
}
// A cell's side: of its points q, |q - p| >= (|a - p| + |b - p| - length) / 2.
Seed side_seed(const SurfaceFoot& a, const SurfaceFoot& b) {
  return {0.5 * (a.distance + b.distance - 1.25 * distance(a.point, b.point)), 0.5 * (a.uv + b.uv)};
}

// The valleys among the samples, then the cells, and the sides of cells on the patch's own sides, that can hold
// something nearer: a narrow valley may run between samples, and about a corner there may be one on either side.
void search_patch(const Surface& s, Point p, const SearchPatch& patch, int nu, int nv, SurfaceFoot& best) {
  const Grid grid(s, p, patch, nu, nv);
  std::vector<Seed> valleys, cells;
  for (std::size_t i = 0; i < grid.rows; ++i)
    for (std::size_t k = 0; k < grid.columns; ++k) {
      const SurfaceFoot& at = grid(i, k);
      const bool last_row = i + 1 == grid.rows, last_column = k + 1 == grid.columns;
      keep_nearer(best, at);
      if (grid.is_valley(i, k)) valleys.push_back({at.distance, at.uv});
      if (!last_row && !last_column) cells.push_back(cell_seed(grid, p, i, k));
      if (!last_row && (k == 0 || last_column)) cells.push_back(side_seed(at, grid(i + 1, k)));
      if (!last_column && (i == 0 || last_row)) cells.push_back(side_seed(at, grid(i, k + 1)));
    }
  sort_and_cut(valleys, 8);
  sort_and_cut(cells, 32);
  const Rectangle r{patch.u, patch.v};
  for (const Seed& valley : valleys) keep_nearer(best, Descent(s, p, valley.from, r).run(50, false));
  for (const Seed& cell : cells) {
    if (cell.bound >= best.distance) break;
    keep_nearer(best, Descent(s, p, cell.from, r).run(50, false));
  }
}

std::vector<double> cuts(std::vector<double> breaks, Interval part, double longest) {
  std::vector<double> out{part.lo};
  breaks.push_back(part.hi);
  for (double b : breaks) {
    b = std::min(b, part.hi);
    const double from = out.back();
    if (!(b > from)) continue;
    const int pieces = static_cast<int>(std::min(std::ceil((b - from) / longest), 64.0));
    for (int i = 1; i < pieces; ++i) out.push_back(from + (b - from) * i / pieces);
    out.push_back(b);
  }
  if (out.size() == 1) out.push_back(part.hi);
  return out;
}

// Lower bound of the distance by the poles of the patch that holds (u, v).
double pole_bound(const NurbsSurface& s, Point p, Uv middle) {
  const int ku = find_span(s.degree_u(), s.knots_u(), s.poles_u(), middle.u);
  const int kv = find_span(s.degree_v(), s.knots_v(), s.poles_v(), middle.v);
  Box box;
  for (int i = ku - s.degree_u(); i <= ku; ++i)
    for (int k = kv - s.degree_v(); k <= kv; ++k) {
      const Hpoint& h = s.pole(static_cast<std::size_t>(i), static_cast<std::size_t>(k));
      if (!(h.w > 0)) return 0;
      box.add(project(h));
    }
  return detail::distance(box, p);
}

SurfaceFoot search(const Surface& s, Point p, Interval u, Interval v) {
  const auto* nurbs = std::get_if<NurbsSurface>(&s.shape);
  const bool angle_u = std::holds_alternative<Revolution>(s.shape);
  const std::vector<double> at_u = cuts(breaks_u(s), u, angle_u ? pi / 2 : infinity),
                            at_v = cuts(breaks_v(s), v, infinity);
  const auto samples = [](int degree) { return degree == 1 ? 1 : std::min(degree + 1, 16); };
  int nu = nurbs ? samples(nurbs->degree_u()) : 6, nv = nurbs ? samples(nurbs->degree_v()) : 6;
  if (nurbs && nu == 1 && nv > 1) nu = 2;  // across a bilinear or ruled patch the distance may have two valleys
  if (nurbs && nv == 1 && nu > 1) nv = 2;
  std::vector<SearchPatch> patches;
  for (std::size_t i = 0; i + 1 < at_u.size(); ++i)
    for (std::size_t k = 0; k + 1 < at_v.size(); ++k) {
      const SearchPatch patch{0, {at_u[i], at_u[i + 1]}, {at_v[k], at_v[k + 1]}};
      patches.push_back(patch);
      if (nurbs) patches.back().bound = pole_bound(*nurbs, p, {patch.u.mid(), patch.v.mid()});
    }
  std::stable_sort(patches.begin(), patches.end(),
                   [](const SearchPatch& a, const SearchPatch& b) { return a.bound < b.bound; });
  SurfaceFoot best = foot_at(s, p, {u.lo, v.lo});
  for (const SearchPatch& patch : patches) {
    if (patch.bound >= best.distance) break;
    search_patch(s, p, patch, nu, nv, best);
  }
  return best;
}

// ---- Elementary surfaces

// Feet of the point on the whole surface; where an angle is not defined (on the axis, in the centre) it is that of
// `hint`. `v` is an angle on sphere and torus.
struct Elementary {
  std::array<Uv, 2> feet;
  int count = 0;
  bool u_is_angle = false, v_is_angle = false;
};

struct Meridian {  // the point in cylinder coordinates
  double angle, rho, h;
};
Meridian meridian(const Frame& f, Point p, double hint) {
  const Vector r = p - f.origin;
  const double x = dot(r, f.x), y = dot(r, f.y), rho = std::hypot(x, y);
  return {rho > 1e-14 * norm(r) ? std::atan2(y, x) : hint, rho, dot(r, f.z)};
}
double angle_or(double y, double x, double hint) { return x == 0 && y == 0 ? hint : std::atan2(y, x); }

Elementary feet_of(const Plane& s, Point p, Uv) {
  const Vector r = p - s.frame.origin;
  return {{Uv{dot(r, s.frame.x), dot(r, s.frame.y)}}, 1};
}
Elementary feet_of(const Cylinder& s, Point p, Uv hint) {
  const Meridian m = meridian(s.frame, p, hint.u);
  return {{Uv{s.radius < 0 ? m.angle + pi : m.angle, m.h}}, 1, true};
}
Elementary feet_of(const Cone& s, Point p, Uv hint) {  // on the near line through the apex, and on the opposite one
  const Meridian m = meridian(s.frame, p, hint.u);
  const double slope = std::tan(s.half_angle_rad), scale = 1 / (1 + slope * slope);
  return {{Uv{m.angle, ((m.rho - s.radius) * slope + m.h) * scale},
           Uv{m.angle + pi, ((-m.rho - s.radius) * slope + m.h) * scale}},
          2,
          true};
}
Elementary feet_of(const Sphere& s, Point p, Uv hint) {
  const Meridian m = meridian(s.frame, p, hint.u);
  if (s.radius < 0) return {{Uv{m.angle + pi, angle_or(-m.h, m.rho, hint.v)}}, 1, true, false};
  return {{Uv{m.angle, angle_or(m.h, m.rho, hint.v)}}, 1, true, false};
}
Elementary feet_of(const Torus& s, Point p, Uv hint) {
  const Meridian m = meridian(s.frame, p, hint.u);
  const double sign = s.minor_radius < 0 ? -1 : 1;
  return {{Uv{m.angle, angle_or(sign * m.h, sign * (m.rho - s.major_radius), hint.v)},
           Uv{m.angle + pi, angle_or(sign * m.h, sign * (-m.rho - s.major_radius), hint.v)}},
          2,
          true,
          true};
}

std::optional<Elementary> elementary_feet(const Surface& s, Point p, Uv hint) {
  if (const auto* plane = std::get_if<Plane>(&s.shape)) return feet_of(*plane, p, hint);
  if (const auto* cylinder = std::get_if<Cylinder>(&s.shape)) return feet_of(*cylinder, p, hint);
  if (const auto* cone = std::get_if<Cone>(&s.shape)) return feet_of(*cone, p, hint);
  if (const auto* sphere = std::get_if<Sphere>(&s.shape)) return feet_of(*sphere, p, hint);
  if (const auto* torus = std::get_if<Torus>(&s.shape)) return feet_of(*torus, p, hint);
  return {};
}

double nearest_turn(double angle, double hint) { return angle + two_pi * std::round((hint - angle) / two_pi); }

SurfaceFoot closest_elementary(const Surface& s, Point p, Interval u, Interval v) {
  const Elementary e = *elementary_feet(s, p, {u.is_bounded() ? u.lo : 0, v.is_bounded() ? v.lo : 0});
  SurfaceFoot best;
  bool inside = false;
  for (int i = 0; i < e.count; ++i) {
    Uv uv = e.feet[static_cast<std::size_t>(i)];
    if (e.u_is_angle) uv.u = detail::first_at_or_after(u.lo, uv.u);
    if (e.v_is_angle) uv.v = detail::first_at_or_after(v.lo, uv.v);
    if (!u.contains(uv.u) || !v.contains(uv.v)) continue;
    keep_nearer(best, foot_at(s, p, uv));
    inside = inside || i == 0;  // the first foot is the nearest point of the whole surface (of a cone: of its nappe)
  }
  if (inside && !std::holds_alternative<Cone>(s.shape)) return best;
  const auto along_side = [&](bool at_u, double fixed) {
    if (!std::isfinite(fixed)) return;
    const double t = closest_point(detail::elementary_isocurve(s, at_u, fixed, at_u ? v : u), p).t;
    keep_nearer(best, foot_at(s, p, at_u ? Uv{fixed, t} : Uv{t, fixed}));
  };
  for (const double fixed : {u.lo, u.hi}) along_side(true, fixed);
  for (const double fixed : {v.lo, v.hi}) along_side(false, fixed);
  return best;
}

SurfaceFoot near_elementary(const Surface& s, Point p, Uv start, const Elementary& e) {
  const Rectangle r = detail::rectangle(s);
  Interval v = r.v;
  if (const auto* cone = std::get_if<Cone>(&s.shape)) {  // stays on the nappe of the start
    const double apex = -cone->radius / std::tan(cone->half_angle_rad);
    if (std::isfinite(apex)) v = start.v < apex ? Interval{-infinity, apex} : Interval{apex, infinity};
  }
  SurfaceFoot best;
  for (int i = 0; i < e.count; ++i) {
    Uv uv = e.feet[static_cast<std::size_t>(i)];
    if (e.u_is_angle) uv.u = nearest_turn(uv.u, start.u);
    uv.v = e.v_is_angle ? nearest_turn(uv.v, start.v) : v.clamp(uv.v);
    keep_nearer(best, foot_at(s, p, uv));
  }
  return best;
}

// The part of an unbounded extrusion that can hold the nearest point: where p and the directrix lie along its
// direction.
Interval bounded_v(const Extrusion& e, Point p, Interval u, Interval v) {
  if (v.is_bounded() || !e.directrix) return v;
  const double length2 = dot(e.direction, e.direction);
  Interval reach{infinity, -infinity};
  const Box box = bounding_box(with_range(*e.directrix, u));
  for (int corner = 0; corner < 8 && length2 > 0 && !box.empty(); ++corner) {
    const Point q{corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y, corner & 4 ? box.hi.z : box.lo.z};
    const double at = dot(p - q, e.direction) / length2;
    reach = {std::min(reach.lo, at), std::max(reach.hi, at)};
  }
  if (!reach.is_bounded()) reach = {0, 0};
  return {v.clamp(reach.lo), v.clamp(reach.hi)};
}

}  // namespace

SurfaceFoot closest_point(const Surface& s, Point p, std::optional<Interval> u, std::optional<Interval> v) {
  const Rectangle r = detail::rectangle(s);
  const Interval in_u = u.value_or(r.u);
  Interval in_v = v.value_or(r.v);
  if (elementary_feet(s, p, {})) return closest_elementary(s, p, in_u, in_v);
  if (const auto* e = std::get_if<Extrusion>(&s.shape)) in_v = bounded_v(*e, p, in_u, in_v);
  if (!in_u.is_bounded() || !in_v.is_bounded()) return foot_at(s, p, {in_u.clamp(0), in_v.clamp(0)});
  return search(s, p, in_u, in_v);
}

SurfaceFoot closest_point_near(const Surface& s, Point p, Uv start) {
  if (const auto e = elementary_feet(s, p, start)) return near_elementary(s, p, start, *e);
  const Rectangle r = detail::rectangle(s);
  return Descent(s, p, off_pole(s, p, start, r), r).run(20, true);
}

}  // namespace trimloop
