#include "kernel/geometry/surface_descent.h"

namespace trimloop {
namespace {

using detail::Rectangle;

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

}  // namespace

namespace detail {

SurfaceFoot descend(const Surface& s, Point p, Uv start, const Rectangle& r, int iterations, bool wrap) {
  return Descent(s, p, start, r).run(iterations, wrap);
}

// At a pole the derivatives along the collapsed side vanish, and a descent would see only the one meridian it is on. A
// start there is moved to the best of some places about the pole, if one is better.
Uv off_singular_side(const Surface& s, Point p, Uv start, const Rectangle& r) {
  if (!r.u.is_bounded() || !r.v.is_bounded()) return start;
  const bool u_side = start.u <= r.u.lo || start.u >= r.u.hi, v_side = start.v <= r.v.lo || start.v >= r.v.hi;
  if (!u_side && !v_side) return start;
  SurfaceFoot best;
  best.uv = start;
  Vector du, dv;
  jet1(s, start, best.point, du, dv);
  best.distance = distance(p, best.point);
  const double along_u = norm(du) * r.u.length(), along_v = norm(dv) * r.v.length();
  const bool no_du = along_u <= 1e-3 * along_v, no_dv = along_v <= 1e-3 * along_u;  // or nearly: rows differ a little
  if (!no_du && !no_dv) return start;
  for (const double inwards : {0.001, 0.01, 0.05, 0.2}) {
    const double u = r.u.at(start.u <= r.u.lo ? inwards : 1 - inwards),
                 v = r.v.at(start.v <= r.v.lo ? inwards : 1 - inwards);
    if (no_du && u_side) keep_nearer(best, foot_at(s, p, {u, start.v}));
    if (no_dv && v_side) keep_nearer(best, foot_at(s, p, {start.u, v}));
    for (int i = 0; i < 12; ++i) {
      if (no_du && v_side) keep_nearer(best, foot_at(s, p, {r.u.at(i / 12.0), v}));
      if (no_dv && u_side) keep_nearer(best, foot_at(s, p, {u, r.v.at(i / 12.0)}));
    }
  }
  return best.uv;
}

}  // namespace detail

}  // namespace trimloop
