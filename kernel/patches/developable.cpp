#include "kernel/patches/developable.h"

#include <fmt/format.h>

#include <optional>

#include "kernel/nurbs/construct_surface.h"
#include "kernel/nurbs/fit.h"

namespace trimloop {

namespace {

// Of unit vectors, so that the value is the sine-like measure of "not in one plane".
double out_of_plane(const NurbsCurve& a, double s, const NurbsCurve& b, double t) {
  const Vector ta = normalized(derivatives(a, s, 1)[1]), tb = normalized(derivatives(b, t, 1)[1]);
  return dot(cross(ta, tb), normalized(evaluate(b, t) - evaluate(a, s)));
}

// The partner of s on b at or after `from`, nearest to `wanted`; nothing when the determinant does not change sign.
std::optional<double> partner(const NurbsCurve& a, double s, const NurbsCurve& b, double from, double wanted) {
  constexpr int cells = 96;
  const Interval range{from, b.range().hi};
  std::optional<double> best;
  const auto offer = [&](double t) {
    if (!best || std::abs(t - wanted) < std::abs(*best - wanted)) best = t;
  };
  double before = out_of_plane(a, s, b, range.lo);
  if (std::abs(before) <= 1e-12) offer(range.lo);
  for (int i = 1; i <= cells && range.lo < range.hi; ++i) {
    double lo = range.at((i - 1.0) / cells), hi = range.at(static_cast<double>(i) / cells);
    const double after = out_of_plane(a, s, b, hi);
    if (std::abs(after) <= 1e-12) offer(hi);
    else if ((before < 0) != (after < 0) && std::abs(before) > 1e-12) {
      const bool rising = before < 0;
      for (int k = 0; k < 60; ++k) {
        const double mid = 0.5 * (lo + hi);
        ((out_of_plane(a, s, b, mid) < 0) == rising ? lo : hi) = mid;
      }
      offer(0.5 * (lo + hi));
    }
    before = after;
  }
  return best;
}

double distance_to(const NurbsCurve& c, Point p, double near, double reach) {
  double best = infinity;
  for (int i = -32; i <= 32; ++i) best = std::min(best, distance(p, evaluate(c, c.range().clamp(near + reach * i / 32))));
  return best;
}

}  // namespace

double ruling_twist(const NurbsSurface& s, int samples) {
  double twist = 0;
  for (int i = 0; i < samples; ++i) {
    const double u = s.range_u().at((i + 0.5) / samples);
    Vector normal[2];
    for (int end = 0; end < 2; ++end) {
      Point p;
      Vector su, sv;
      jet1(s, {u, end ? s.range_v().hi : s.range_v().lo}, p, su, sv);
      normal[end] = cross(su, sv);
    }
    const double angle = std::atan2(norm(cross(normal[0], normal[1])), dot(normal[0], normal[1]));
    twist = std::max(twist, std::min(angle, pi - angle));  // beyond the edge of regression the normal looks back
  }
  return twist;
}

Result<DevelopableStrip> developable_strip(const NurbsCurve& first, const NurbsCurve& second, int rulings) {
  if (rulings < 2) return fail(ErrorCode::InvalidArgument, fmt::format("{} rulings, at least 2 are needed", rulings), rulings, 2);
  std::vector<Point> a, b;
  std::vector<double> s, t;
  std::size_t unmatched = 0;
  for (int i = 0; i < rulings; ++i) {
    const double share = static_cast<double>(i) / (rulings - 1);
    s.push_back(first.range().at(share));
    const double from = t.empty() ? second.range().lo : t.back(), wanted = t.empty() ? second.range().lo : std::max(from, second.range().at(share));
    double found = i == 0 ? second.range().lo : i + 1 == rulings ? second.range().hi : wanted;
    if (i > 0 && i + 1 < rulings) {
      if (const auto p = partner(first, s.back(), second, from, wanted)) found = *p;
      else ++unmatched;
    }
    t.push_back(found);
    a.push_back(evaluate(first, s.back()));
    b.push_back(evaluate(second, found));
  }
  // Both sides over the first curve's own parameter, so that rulings join equal parameters.
  LeastSquares how;
  how.poles = a.size();
  how.degree = std::min(3, rulings - 1);
  for (const double x : s) how.parameters.push_back((x - s.front()) / (s.back() - s.front()));
  auto side_a = approximate(a, how);
  auto side_b = approximate(b, how);
  if (!side_a) return tl::unexpected(side_a.error());
  if (!side_b) return tl::unexpected(side_b.error());
  auto surface = ruled(side_a->curve, side_b->curve);
  if (!surface) return tl::unexpected(surface.error());
  DevelopableStrip out{std::move(*surface), 0, 0, unmatched};
  for (int i = 0; i + 1 < rulings; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double middle = 0.5 * (how.parameters[k] + how.parameters[k + 1]);
    out.curve_miss = std::max({out.curve_miss, distance_to(first, evaluate(side_a->curve, middle), 0.5 * (s[k] + s[k + 1]), s[k + 1] - s[k]),
                               distance_to(second, evaluate(side_b->curve, middle), 0.5 * (t[k] + t[k + 1]), t[k + 1] - t[k])});
  }
  out.twist_rad = ruling_twist(out.surface);
  return out;
}

}  // namespace trimloop
