// Newton's method for the distance to one Bezier piece, held in a rectangle.

#include "kernel/batch/access.h"
#include "kernel/batch/dispatch.h"
#include "kernel/closest/search.h"

namespace trimloop::closest {

namespace {

constexpr BatchOptions four_lanes{Arithmetic::SameBits, InstructionSet::Avx2};  // one point has no use for more

SurfaceJet jet_of(const Shape& shape, std::size_t piece, Uv uv) {
  double n[18];
  const auto at = [&](std::size_t group) { return Vector{n[3 * group], n[3 * group + 1], n[3 * group + 2]}; };
  if (shape.surface) {
    const std::size_t columns = shape.surface->spans_v().size();
    batch::kernels(four_lanes)
        .point[2](BatchAccess::patch(*shape.surface, piece / columns, piece % columns), uv.u, uv.v, n);
    return {to_point(at(0)), at(1), at(2), at(3), at(4), at(5)};
  }
  double* columns[batch::curve_columns];
  for (int i = 0; i < batch::curve_columns; ++i) columns[i] = n + i;
  batch::kernels(four_lanes).curve[2](BatchAccess::piece(*shape.curve, piece), &uv.u, 1, columns);
  return {to_point(at(0)), at(1), {}, at(2), {}, {}};
}

// Half the squared distance, its gradient and second derivatives.
struct Local {
  Foot foot;
  double gu, gv, uu, uv, vv, juu, juv, jvv;
  Local(const Shape& shape, std::size_t piece, Point p, Uv at) {
    const SurfaceJet j = jet_of(shape, piece, at);
    const Vector r = j.point - p;
    gu = dot(j.du, r);
    gv = dot(j.dv, r);
    juu = dot(j.du, j.du);
    juv = dot(j.du, j.dv);
    jvv = dot(j.dv, j.dv);
    uu = juu + dot(j.duu, r);
    uv = juv + dot(j.duv, r);
    vv = jvv + dot(j.dvv, r);
    foot = {at, j.point, dot(r, r), 2 * gu, 2 * gv, piece};
  }
};

bool held(double t, Interval limits, double slope) {
  return (t <= limits.lo && slope >= 0) || (t >= limits.hi && slope <= 0);
}
double along(double g, double h, double j) { return h > 0.01 * j ? -g / h : j > 0 ? -g / j : 0; }

Uv newton_step(const Local& l, bool hold_u, bool hold_v) {
  if (hold_u && hold_v) return {0, 0};
  if (hold_u) return {0, along(l.gv, l.vv, l.jvv)};
  if (hold_v) return {along(l.gu, l.uu, l.juu), 0};
  const double det = l.uu * l.vv - l.uv * l.uv, jdet = l.juu * l.jvv - l.juv * l.juv;
  if (l.uu > 0 && l.vv > 0 && det > 1e-4 * l.uu * l.vv)
    return {(l.uv * l.gv - l.vv * l.gu) / det, (l.uv * l.gu - l.uu * l.gv) / det};
  if (jdet > 1e-12 * l.juu * l.jvv) return {(l.juv * l.gv - l.jvv * l.gu) / jdet, (l.juv * l.gu - l.juu * l.gv) / jdet};
  return l.juu >= l.jvv ? Uv{along(l.gu, l.uu, l.juu), 0} : Uv{0, along(l.gv, l.vv, l.jvv)};
}

}  // namespace

Foot foot_at(const Shape& shape, std::size_t piece, Point p, Uv at) { return Local(shape, piece, p, at).foot; }

Foot descend(const Shape& shape, std::size_t piece, Interval u, Interval v, Point p, Uv start) {
  Local at(shape, piece, p, {u.clamp(start.u), v.clamp(start.v)});
  for (int iteration = 0; iteration < 40; ++iteration) {
    const Uv from = at.foot.uv;
    bool hold_u = held(from.u, u, at.gu), hold_v = held(from.v, v, at.gv);
    Uv step = newton_step(at, hold_u, hold_v);
    // A step that leaves through a side would only slide along it: the bottom along that side is nearer to the truth.
    const Uv to{u.clamp(from.u + step.u), v.clamp(from.v + step.v)};
    const bool cut_u = to.u != from.u + step.u && std::abs(step.u) > 1e-12 * u.length(),
               cut_v = to.v != from.v + step.v && std::abs(step.v) > 1e-12 * v.length();
    step = to - from;
    if (cut_u && !cut_v && !hold_v) step.v = along(at.gv + at.uv * step.u, at.vv, at.jvv);
    if (cut_v && !cut_u && !hold_u) step.u = along(at.gu + at.uv * step.v, at.uu, at.juu);
    bool moved = false;
    for (int halving = 0; halving < 30; ++halving, step = 0.5 * step) {
      const Uv next{u.clamp(from.u + step.u), v.clamp(from.v + step.v)};
      const bool small =
          std::abs(next.u - from.u) <= 1e-8 * u.length() && std::abs(next.v - from.v) <= 1e-8 * v.length();
      if (next.u == from.u && next.v == from.v) break;
      const Local trial(shape, piece, p, next);
      // So near to the bottom rounding decides what is nearer; the gradient knows better.
      const bool flatter = small && halving == 0 && trial.foot.squared <= at.foot.squared * (1 + 1e-14) &&
                           std::abs(trial.gu) + std::abs(trial.gv) < std::abs(at.gu) + std::abs(at.gv);
      if (trial.foot.squared < at.foot.squared || flatter) {
        at = trial;
        moved = true;
        break;
      }
      if (small) break;
    }
    if (!moved) break;
  }
  return at.foot;
}

}  // namespace trimloop::closest
