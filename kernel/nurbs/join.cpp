#include "kernel/nurbs/join.h"

#include <fmt/format.h>

#include "base/assert.h"
#include "kernel/nurbs/builder.h"
#include "kernel/nurbs/deviation.h"
#include "kernel/nurbs/hodograph.h"
#include "kernel/nurbs/homogeneous.h"
#include "kernel/nurbs/net.h"
#include "kernel/nurbs/periodic.h"
#include "kernel/nurbs/removal.h"

namespace trimloop {
namespace {

double angle_between(Vector a, Vector b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

// Curvature vector: the change of direction per length, a part of C'' across C'.
Vector curvature_vector(Vector d1, Vector d2) {
  const double s = dot(d1, d1);
  return s > 0 ? 1 / s * (d2 - dot(d1, d2) / s * d1) : Vector{};
}

Joint compare(const std::vector<Vector>& a, const std::vector<Vector>& b, const JointTolerances& limit) {
  Joint j;
  j.gap = norm(a[0] - b[0]);
  const double speed = std::max(norm(a[1]), norm(b[1]));
  j.at_rest = !(norm(a[1]) > limit.relative * speed) || !(norm(b[1]) > limit.relative * speed);
  if (!j.at_rest) {
    j.tangent_angle_rad = angle_between(a[1], b[1]);
    const Vector ka = curvature_vector(a[1], a[2]), kb = curvature_vector(b[1], b[2]);
    j.curvature = std::max(norm(ka), norm(kb));
    j.curvature_gap = norm(ka - kb);
  }
  j.opposed = j.tangent_angle_rad >= pi - limit.angle_rad;
  for (std::size_t k = 1; k < a.size(); ++k) j.derivative_gaps.push_back(norm(a[k] - b[k]));
  if (!(j.gap <= limit.length)) return j;
  j.parametric = 0;
  for (std::size_t k = 1; k < a.size(); ++k) {
    if (!(j.derivative_gaps[k - 1] <= limit.relative * std::max(norm(a[k]), norm(b[k])))) break;
    j.parametric = static_cast<int>(k);
  }
  j.geometric = 0;
  if (j.at_rest || !(j.tangent_angle_rad <= limit.angle_rad)) return j;
  j.geometric = 1;
  if (j.curvature_gap <= limit.relative * std::max(j.curvature, 1.0)) j.geometric = 2;
  return j;
}

// Least of |C'|^2 near t inside [lo, hi]: golden section, then compared with the mean speed.
double slowest(const NurbsCurve& c, double lo, double hi) {
  const auto speed = [&](double t) { return norm(jet(c, t).d1); };
  for (int i = 0; i < 90 && lo < hi; ++i) {
    const double a = lo + 0.381966011250105 * (hi - lo), b = lo + 0.618033988749895 * (hi - lo);
    if (speed(a) <= speed(b)) {
      hi = b;
    } else {
      lo = a;
    }
  }
  return 0.5 * (lo + hi);
}

void find_cusps(const NurbsCurve& c, const JointTolerances& limit, std::vector<double>& cusps) {
  constexpr int samples = 64;
  for (const NurbsCurve& piece : bezier_pieces(c)) {
    std::vector<double> speed;
    double mean = 0;
    for (int i = 0; i <= samples; ++i) {
      speed.push_back(norm(jet(piece, piece.range().at(i / double{samples})).d1));
      mean += speed.back() / (samples + 1);
    }
    for (std::size_t i = 1; i + 1 < speed.size(); ++i) {
      if (speed[i] > speed[i - 1] || speed[i] > speed[i + 1]) continue;
      const double t = slowest(piece, piece.range().at(static_cast<double>(i - 1) / samples),
                               piece.range().at(static_cast<double>(i + 1) / samples));
      if (norm(jet(piece, t).d1) <= limit.relative * mean && (cusps.empty() || t > cusps.back())) cusps.push_back(t);
    }
  }
}

detail::Net net(const NurbsSurface& s) { return {s.degree_u(), s.poles_v(), s.knots_u(), s.poles()}; }

// The net over a domain that begins `before` earlier and ends `after` later, outermost polynomials carried on.
detail::Net carried_on(const detail::Net& source, double before, double after) {
  // Only the outermost knots move: the polar form at them, which extrapolates.
  const detail::Net s = detail::part(source, source.domain());
  const std::size_t p = s.p(), w = s.width;
  detail::Net out = s;
  const auto polar_row = [&](std::size_t first_row, std::size_t k, std::size_t i,
                             const std::vector<double>& arguments) {
    std::vector<Hpoint> d(s.poles.begin() + static_cast<std::ptrdiff_t>(first_row * w),
                          s.poles.begin() + static_cast<std::ptrdiff_t>((first_row + p + 1) * w));
    for (std::size_t j = 1; j <= p; ++j)
      for (std::size_t r = p; r >= j; --r) {
        const double a = s.knots[k - p + r], b = s.knots[k + r + 1 - j], share = (arguments[j - 1] - a) / (b - a);
        for (std::size_t c = 0; c < w; ++c) d[r * w + c] = (1 - share) * d[(r - 1) * w + c] + share * d[r * w + c];
      }
    for (std::size_t c = 0; c < w; ++c) out.poles[i * w + c] = d[p * w + c];
  };
  if (before > 0) {
    for (std::size_t i = 0; i <= p; ++i) out.knots[i] = s.knots[0] - before;
    for (std::size_t i = 0; i < p; ++i)
      polar_row(0, p, i,
                {out.knots.begin() + static_cast<std::ptrdiff_t>(i + 1),
                 out.knots.begin() + static_cast<std::ptrdiff_t>(i + p + 1)});
  }
  if (after > 0) {
    const std::size_t rows = s.rows();
    for (std::size_t i = rows; i < rows + p + 1; ++i) out.knots[i] = s.knots[rows] + after;
    for (std::size_t i = rows - p; i < rows; ++i) {
      // Knots of both ends are in the arguments of a short spline; only the right end moves here.
      std::vector<double> arguments;
      for (std::size_t k = i + 1; k <= i + p; ++k) arguments.push_back(out.knots[k]);
      polar_row(rows - p - 1, rows - 1, i, arguments);
    }
  }
  return out;
}

}  // namespace

Joint joint(const NurbsCurve& before, const NurbsCurve& after, const JointTolerances& limit, int highest_order) {
  const int order = std::max(2, highest_order);
  return compare(derivatives(before, before.range().hi, order, Side::Left),
                 derivatives(after, after.range().lo, order, Side::Right), limit);
}

Continuity continuity(const NurbsCurve& c, const JointTolerances& limit) {
  Continuity out;
  out.parametric = c.degree();
  out.geometric = 2;
  const std::vector<double> at = breaks(c);
  for (std::size_t i = 1; i + 1 < at.size(); ++i) {
    const auto [first, last] = std::equal_range(c.knots().begin(), c.knots().end(), at[i]);
    const int order = std::max(2, c.degree());
    out.knots.push_back(
        {at[i], static_cast<int>(last - first),
         compare(derivatives(c, at[i], order, Side::Left), derivatives(c, at[i], order, Side::Right), limit)});
    out.parametric = std::min(out.parametric, out.knots.back().joint.parametric);
    out.geometric = std::min(out.geometric, out.knots.back().joint.geometric);
  }
  find_cusps(c, limit, out.cusps);
  return out;
}

SurfaceJoint joint_along_u(const NurbsSurface& a, const NurbsSurface& b, const JointTolerances& limit, int samples) {
  SurfaceJoint out;
  double curvature = 0;
  for (int i = 0; i < samples; ++i) {
    const double share = samples > 1 ? i / double(samples - 1) : 0.5;
    const Uv at_a{a.range_u().hi, a.range_v().at(share)}, at_b{b.range_u().lo, b.range_v().at(share)};
    const std::vector<Vector> x = derivatives(a, at_a, 2, Side::Left, Side::Right);
    const std::vector<Vector> y = derivatives(b, at_b, 2, Side::Right, Side::Right);
    out.gap = std::max(out.gap, norm(x[0] - y[0]));
    const Vector na = normalized(cross(x[3], x[1])), nb = normalized(cross(y[3], y[1]));
    out.normal_angle_rad = std::max(out.normal_angle_rad, angle_between(na, nb));
    // Normal curvature in the direction of the tangent plane across the side (perpendicular to S_v).
    const auto across = [](const std::vector<Vector>& d, Vector n) {
      const Vector along = normalized(d[1]), sideways = d[3] - dot(d[3], along) * along;
      const double v = norm(d[1]) > 0 ? -dot(d[3], along) / norm(d[1]) : 0, scale = dot(sideways, sideways);
      return scale > 0 ? dot(n, d[6] + 2 * v * d[4] + v * v * d[2]) / scale : 0.0;
    };
    const double ka = across(x, na), kb = across(y, nb);
    out.curvature_gap = std::max(out.curvature_gap, std::abs(ka - kb));
    curvature = std::max({curvature, std::abs(ka), std::abs(kb)});
  }
  if (out.gap <= limit.length) out.geometric = 0;
  if (out.geometric == 0 && out.normal_angle_rad <= limit.angle_rad) out.geometric = 1;
  if (out.geometric == 1 && out.curvature_gap <= limit.relative * std::max(curvature, 1.0)) out.geometric = 2;
  return out;
}

Result<Joined> join(const NurbsCurve& first, const NurbsCurve& second, double tolerance) {
  const int degree = std::max(first.degree(), second.degree());
  const NurbsCurve a = elevate(trimmed(first, first.range()), degree - first.degree());
  const NurbsCurve b = elevate(trimmed(second, second.range()), degree - second.degree());
  const Hpoint end = a.poles().back(), start = b.poles().front();
  if (end.w == 0 || start.w == 0) return fail(ErrorCode::Unsupported, "a curve ends at infinity");
  const double gap = distance(project(end), project(start));
  if (!(gap <= tolerance))
    return fail(ErrorCode::Degenerate, fmt::format("the curves end {} apart", gap), gap, tolerance);
  const double shift = a.range().hi - b.range().lo, scale = end.w / start.w;
  std::vector<double> knots(a.knots().begin(), a.knots().end() - 1);
  for (auto k = b.knots().begin() + degree + 1; k != b.knots().end(); ++k) knots.push_back(*k + shift);
  std::vector<Hpoint> poles = a.poles();
  poles.back() = end + 0.5 * (scale * start - end);
  for (std::size_t i = 1; i < b.poles().size(); ++i) poles.push_back(scale * b.poles()[i]);
  auto whole = NurbsCurve::from_homogeneous(degree, std::move(knots), std::move(poles));
  if (!whole) return tl::unexpected<Error>(whole.error());
  // The moved pole has the weight of one basis function: half of the gap at most, and rounding.
  const double rounding = 16 * (degree + 1) * std::numeric_limits<double>::epsilon() *
                          std::max(norm(to_vector(project(end))), norm(to_vector(project(start))));
  const double moved = gap > 0 ? 0.5 * gap + rounding : 0;
  KnotRemoval smooth = remove_knot(*whole, a.range().hi, degree - 1, tolerance - moved);
  return Joined{std::move(smooth.curve), smooth.removed, moved + smooth.error};
}

Result<NurbsCurve> extended(const NurbsCurve& c, End end, double by) {
  if (!(by > 0) || !std::isfinite(by))
    return fail(ErrorCode::InvalidArgument, "an extension is positive and finite", by, 0);
  const NurbsCurve whole = trimmed(c, c.range());
  detail::Net n = carried_on({c.degree(), 1, whole.knots(), whole.poles()}, end == End::Start ? by : 0,
                             end == End::Finish ? by : 0);
  return NurbsCurve::from_homogeneous(c.degree(), std::move(n.knots), std::move(n.poles));
}

Result<NurbsSurface> extended_u(const NurbsSurface& s, End end, double by) {
  if (!(by > 0) || !std::isfinite(by))
    return fail(ErrorCode::InvalidArgument, "an extension is positive and finite", by, 0);
  const NurbsSurface whole = trimmed(s, s.range_u(), s.range_v());
  detail::Net n = carried_on(net(whole), end == End::Start ? by : 0, end == End::Finish ? by : 0);
  return NurbsSurface::from_homogeneous(n.degree, s.degree_v(), std::move(n.knots), whole.knots_v(),
                                        std::move(n.poles));
}

Result<NurbsSurface> extended_v(const NurbsSurface& s, End end, double by) {
  auto out = extended_u(swapped(s), end, by);
  if (!out) return out;
  return swapped(*out);
}

}  // namespace trimloop
