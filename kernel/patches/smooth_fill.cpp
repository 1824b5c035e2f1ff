// Four-sided patches around a centre whose tangent planes agree along every spoke. Along spoke S the two cross
// derivatives are A = alpha S' + N and B = alpha S' - N with alpha(u) = (1 - u) cos(2 pi / n), so that
// A + B = 2 alpha S' identically: the condition of G. Farin, Curves and Surfaces for CAGD, on G1 joints. At the centre the
// tangents are an affine image of a regular n-gon, which meets the condition there, and the twists solve
// w[i] + w[i-1] = 2 (alpha S')'(0); for even n that asks for second derivatives without an alternating part.

#include "kernel/patches/smooth_fill.h"

#include <fmt/format.h>

#include "kernel/nurbs/construct_surface.h"

namespace trimloop {

namespace {

// Half sides meet at the middle of each side with one derivative, or there is no tangent plane there.
constexpr double same_tangent = 1e-9;  // relative

NurbsCurve bezier(std::initializer_list<Vector> poles) {
  std::vector<Point> points;
  for (const Vector& v : poles) points.push_back(to_point(v));
  std::vector<double> knots(points.size(), 0.0);
  knots.insert(knots.end(), points.size(), 1.0);
  return *NurbsCurve::from_cartesian(static_cast<int>(points.size()) - 1, std::move(knots), points, {});
}

// The spoke out of the centre: degree 4 by S(0), S'(0), S''(0), S'(1), S(1); and its cross derivatives.
struct Spoke {
  Vector tangent, bend, outward;  // S'(0), S''(0), S'(1)
  Vector side;                    // of the side at its middle, along the side: N(1)
  Point middle;
  Vector across, across_slope;    // N(0), N'(0)
};

NurbsCurve curve_of(const Spoke& s, Vector centre) {
  const Vector p1 = centre + s.tangent / 4, p2 = s.bend / 12 + 2 * p1 - centre, p4 = to_vector(s.middle);
  return bezier({centre, p1, p2, p4 - s.outward / 4, p4});
}

// alpha S' + sign N, degree 4: alpha S' has the poles (1 - i / 4) D_i of the degree-3 hodograph D.
NurbsCurve cross_derivative(const Spoke& s, Vector centre, double cosine, double sign) {
  const NurbsCurve spoke = curve_of(s, centre);
  const Vector slope = s.side - s.across;  // N'(1)
  const NurbsCurve n = elevate(bezier({s.across, s.across + s.across_slope / 3, s.side - slope / 3, s.side}), 1);
  std::vector<Point> poles;
  for (std::size_t i = 0; i <= 4; ++i) {
    const Hpoint a = spoke.poles()[std::min<std::size_t>(i, 3)], b = spoke.poles()[std::min<std::size_t>(i, 3) + 1];
    const Vector d = i < 4 ? Vector{4 * (b.x - a.x), 4 * (b.y - a.y), 4 * (b.z - a.z)} : Vector{};
    poles.push_back(to_point(cosine * (1 - static_cast<double>(i) / 4) * d) + sign * to_vector(project(n.poles()[i])));
  }
  return *NurbsCurve::from_cartesian(4, {0, 0, 0, 0, 0, 1, 1, 1, 1, 1}, poles, {});
}

struct Corner {  // what the four curves of a patch and their cross derivatives have in common
  Vector at[3][3];  // [position, derivative at 0, position at 1] in u, then in v
};

// The Boolean sum: in each direction position and derivative at 0, position at 1, by 1 - t^2, t - t^2, t^2. `edges_u`
// run along u (position at v = 0, derivative across it, position at v = 1), `edges_v` along v.
Result<NurbsSurface> boolean_sum(const std::vector<NurbsCurve>& edges_u, const std::vector<NurbsCurve>& edges_v, const Corner& corner) {
  std::vector<NurbsCurve> all = edges_u;
  all.insert(all.end(), edges_v.begin(), edges_v.end());
  all.push_back(bezier({{1, 0, 0}, {1, 0.5, 0}, {0, 0, 1}}));  // the three functions as coordinates
  all = made_compatible(all);
  const NurbsCurve& blend = all[6];
  const std::size_t n = blend.poles().size();
  const auto pole = [&](std::size_t curve, std::size_t i) { return to_vector(project(all[curve].poles()[i])); };
  std::vector<Point> poles;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const Vector fu = pole(6, i), fv = pole(6, j);
      const double a[3] = {fu.x, fu.y, fu.z}, b[3] = {fv.x, fv.y, fv.z};
      Vector sum;
      for (std::size_t k = 0; k < 3; ++k) {
        sum += a[k] * pole(3 + k, j) + b[k] * pole(k, i);
        for (std::size_t l = 0; l < 3; ++l) sum = sum - a[k] * b[l] * corner.at[k][l];
      }
      poles.push_back(to_point(sum));
    }
  return NurbsSurface::from_cartesian(blend.degree(), blend.degree(), blend.knots(), blend.knots(), poles, {});
}

// Tangents at the centre: the first harmonic of the straight spokes. Bends: of the cubics from there to the sides, less
// their alternating part.
Result<void> set_centre(std::vector<Spoke>& spokes, Point centre) {
  const auto n = static_cast<double>(spokes.size());
  Vector x, y, alternating;
  for (std::size_t i = 0; i < spokes.size(); ++i) {
    const double angle = two_pi * static_cast<double>(i) / n;
    x += 2 / n * std::cos(angle) * spokes[i].outward;
    y += 2 / n * std::sin(angle) * spokes[i].outward;
  }
  if (!(norm(cross(x, y)) > 1e-9 * (dot(x, x) + dot(y, y))))
    return fail(ErrorCode::Degenerate, "the sides do not go around their middle: there is no tangent plane");
  for (std::size_t i = 0; i < spokes.size(); ++i) {
    const double angle = two_pi * static_cast<double>(i) / n;
    spokes[i].tangent = std::cos(angle) * x + std::sin(angle) * y;
    spokes[i].bend = 6 * (spokes[i].middle - centre) - 4 * spokes[i].tangent - 2 * spokes[i].outward;
    alternating += (i % 2 ? -1 / n : 1 / n) * spokes[i].bend;
  }
  for (std::size_t i = 0; i < spokes.size() && spokes.size() % 2 == 0; ++i)
    spokes[i].bend = spokes[i].bend - (i % 2 ? -1.0 : 1.0) * alternating;
  return {};
}

// Twists of the patches at the centre: w[i] of the patch between spokes i and i + 1. For even n the smallest of them.
std::vector<Vector> twists(const std::vector<Spoke>& spokes, double cosine) {
  const std::size_t n = spokes.size();
  std::vector<Vector> sum(n), w(n);
  for (std::size_t i = 0; i < n; ++i) sum[i] = 2 * cosine * (spokes[i].bend - spokes[i].tangent);
  Vector first;
  if (n % 2 == 1) {  // sum over the cycle with alternating signs, from spoke 0 on
    for (std::size_t i = 0; i < n; ++i) first += (i % 2 ? -0.5 : 0.5) * sum[i == 0 ? 0 : n - i];
  }
  w[0] = first;
  for (std::size_t i = 1; i < n; ++i) w[i] = sum[i] - w[i - 1];
  if (n % 2 == 0) {
    Vector mean;
    for (std::size_t i = 0; i < n; ++i) mean += (i % 2 ? -1.0 : 1.0) / static_cast<double>(n) * w[i];
    for (std::size_t i = 0; i < n; ++i) w[i] = w[i] - (i % 2 ? -1.0 : 1.0) * mean;
  }
  return w;
}

}  // namespace

Result<std::vector<NurbsSurface>> detail::smooth_patches(std::span<const std::pair<NurbsCurve, NurbsCurve>> halves, Point centre) {
  const std::size_t n = halves.size();
  const Vector middle = to_vector(centre);
  std::vector<Spoke> spokes(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Interval before = halves[i].first.range(), after = halves[i].second.range();
    const Vector in = before.length() * derivatives(halves[i].first, before.hi, 1)[1];
    const Vector out = after.length() * derivatives(halves[i].second, after.lo, 1)[1];
    if (!(norm(in) > 0) || norm(in - out) > same_tangent * norm(in))
      return fail(ErrorCode::Unsupported, fmt::format("side {} has a corner or rests in its middle: no tangent plane goes through it", i),
                  norm(in - out) / norm(in), same_tangent);
    spokes[i].middle = evaluate(halves[i].second, after.lo);
    spokes[i].side = 0.5 * (in + out);
    spokes[i].outward = spokes[i].middle - centre;
  }
  if (auto done = set_centre(spokes, centre); !done) return tl::unexpected(done.error());
  const double cosine = std::cos(two_pi / static_cast<double>(n));
  const std::vector<Vector> w = twists(spokes, cosine);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n, last = (i + n - 1) % n;
    spokes[i].across = 0.5 * (spokes[next].tangent - spokes[last].tangent);
    spokes[i].across_slope = 0.5 * (w[i] - w[last]);
  }
  std::vector<NurbsSurface> out;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    const Spoke &a = spokes[i], &b = spokes[next];
    const NurbsCurve far_v = reparametrized(halves[i].second, {0, 1}), far_u = reparametrized(reversed(halves[next].first), {0, 1});
    const Corner corner{{{middle, b.tangent, to_vector(b.middle)},
                         {a.tangent, w[i], -b.side},
                         {to_vector(a.middle), a.side, to_vector(evaluate(far_v, 1))}}};
    auto patch = boolean_sum({curve_of(a, middle), cross_derivative(a, middle, cosine, 1), far_u},
                             {curve_of(b, middle), cross_derivative(b, middle, cosine, -1), far_v}, corner);
    if (!patch) return tl::unexpected(patch.error());
    out.push_back(std::move(*patch));
  }
  return out;
}

}  // namespace trimloop
