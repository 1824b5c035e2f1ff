#include "kernel/nurbs/construct_surface.h"

#include <fmt/format.h>

#include "kernel/math/transform.h"
#include "kernel/nurbs/construct_conic.h"
#include "kernel/nurbs/homogeneous.h"

namespace trimloop {
namespace {

const std::vector<double> unit_knots{0, 0, 1, 1};

NurbsCurve active(const NurbsCurve& c) { return trimmed(c, c.range()); }

// Two rows along v = 0 and v = 1 over the knots of a curve.
Result<NurbsSurface> between(const NurbsCurve& at, const std::vector<Hpoint>& lo, const std::vector<Hpoint>& hi) {
  std::vector<Hpoint> poles;
  for (std::size_t i = 0; i < lo.size(); ++i) poles.push_back(lo[i]), poles.push_back(hi[i]);
  return NurbsSurface::from_homogeneous(at.degree(), 1, at.knots(), unit_knots, std::move(poles));
}

Result<void> check_finite(Vector v, const char* what) {
  if (is_finite(v)) return {};
  return fail(ErrorCode::InvalidArgument, fmt::format("{} is not finite: ({}, {}, {})", what, v.x, v.y, v.z));
}

// One pole per pair of poles, u from the first.
template <class F>
Result<NurbsSurface> product(const NurbsCurve& a, const NurbsCurve& b, F pole) {
  std::vector<Hpoint> poles;
  for (const Hpoint& p : a.poles())
    for (const Hpoint& q : b.poles()) poles.push_back(pole(p, q));
  return NurbsSurface::from_homogeneous(a.degree(), b.degree(), a.knots(), b.knots(), std::move(poles));
}

// `t` replaced by the nearest of `knots` within the tolerance.
double snapped(double t, const std::vector<double>& knots, double within) {
  const auto next = std::lower_bound(knots.begin(), knots.end(), t);
  double best = t, least = within;
  for (const auto k : {next, next == knots.begin() ? next : next - 1})
    if (k != knots.end() && std::abs(*k - t) <= least) best = *k, least = std::abs(*k - t);
  return best;
}

std::vector<double> missing(const std::vector<double>& has, const std::vector<double>& wanted) {
  std::vector<double> out;
  std::set_difference(wanted.begin(), wanted.end(), has.begin(), has.end(), std::back_inserter(out));
  return out;
}

}  // namespace

Result<NurbsSurface> bilinear(Point p00, Point p10, Point p01, Point p11) {
  const std::vector<Point> points{p00, p01, p10, p11};
  return NurbsSurface::from_cartesian(1, 1, unit_knots, unit_knots, points, {});
}

Result<NurbsSurface> extruded(const NurbsCurve& curve, Vector direction) {
  if (auto ok = check_finite(direction, "the direction"); !ok) return tl::unexpected<Error>(ok.error());
  const NurbsCurve c = active(curve);
  return between(c, c.poles(), transformed(c, Transform::translation(direction)).poles());
}

std::vector<NurbsCurve> made_compatible(std::span<const NurbsCurve> curves, double same_knot) {
  std::vector<NurbsCurve> out;
  if (curves.empty()) return out;
  int degree = 1;
  for (const NurbsCurve& c : curves) degree = std::max(degree, c.degree());
  const Interval range = curves[0].range();
  std::vector<double> all;  // the union so far
  for (const NurbsCurve& given : curves) {
    NurbsCurve c = active(given);
    if (c.range().lo != range.lo || c.range().hi != range.hi) c = reparametrized(c, range);
    c = elevate(c, degree - c.degree());
    std::vector<double> knots = c.knots();
    for (double& t : knots) t = snapped(t, all, same_knot * range.length());
    if (auto moved = NurbsCurve::from_homogeneous(degree, std::move(knots), c.poles())) c = std::move(*moved);
    std::vector<double> joined;
    std::set_union(all.begin(), all.end(), c.knots().begin(), c.knots().end(), std::back_inserter(joined));
    all = std::move(joined);
    out.push_back(std::move(c));
  }
  for (NurbsCurve& c : out) c = refine(c, missing(c.knots(), all));
  return out;
}

Result<NurbsSurface> ruled(const NurbsCurve& a, const NurbsCurve& b) {
  const std::vector<NurbsCurve> sides = made_compatible(std::vector<NurbsCurve>{a, b});
  return between(sides[0], sides[0].poles(), sides[1].poles());
}

Result<NurbsSurface> cone(const NurbsCurve& curve, Hpoint apex) {
  const NurbsCurve c = active(curve);
  std::vector<Hpoint> tip;
  for (const Hpoint& h : c.poles()) tip.push_back(h.w * apex);
  return between(c, c.poles(), tip);
}

Result<NurbsSurface> translational(const NurbsCurve& a, const NurbsCurve& b) {
  const NurbsCurve c = active(a), d = active(b);
  const Point start = evaluate(d, d.range().lo);
  if (!is_finite(start)) return fail(ErrorCode::Degenerate, "the path starts at infinity");
  const Vector o = to_vector(start);
  return product(c, d, [&](const Hpoint& p, const Hpoint& q) {
    const Vector v = q.w * detail::xyz(p) + p.w * (detail::xyz(q) - q.w * o);
    return Hpoint{v.x, v.y, v.z, p.w * q.w};
  });
}

Result<NurbsSurface> revolved(const NurbsCurve& generatrix, Point on_axis, Vector axis, Interval angle) {
  const Vector z = normalized(axis);
  if (!(norm(z) > 0)) return fail(ErrorCode::Degenerate, "a surface of revolution needs an axis", norm(axis), 0);
  // The unit circle's own arc: each pole (c, s, w) turns a homogeneous pole linearly.
  const auto turn = circle_arc(Frame{}, 1, angle);
  if (!turn) return tl::unexpected<Error>(turn.error());
  const NurbsCurve c = active(generatrix);
  const Vector origin = to_vector(on_axis);
  return product(*turn, c, [&](const Hpoint& a, const Hpoint& h) {
    const Vector arm = detail::xyz(h) - h.w * origin, along = dot(arm, z) * z, radial = arm - along;
    const Vector v = a.x * radial + a.y * cross(z, radial) + a.w * (along + h.w * origin);
    return Hpoint{v.x, v.y, v.z, a.w * h.w};
  });
}

Result<NurbsSurface> swung(const NurbsCurve& profile, const NurbsCurve& trajectory, double factor) {
  if (!std::isfinite(factor)) return fail(ErrorCode::InvalidArgument, "the factor is not finite", factor);
  return product(active(profile), active(trajectory), [&](const Hpoint& p, const Hpoint& t) {
    return Hpoint{factor * p.x * t.x, factor * p.x * t.y, p.z * t.w, p.w * t.w};
  });
}

}  // namespace trimloop
