#include "kernel/patches/triangle_bezier.h"

#include <fmt/format.h>

#include "base/assert.h"
#include "kernel/nurbs/homogeneous.h"
#include "kernel/nurbs/knots.h"
#include "kernel/patches/triangle_forms.h"

namespace trimloop {

namespace {

constexpr int highest_degree = 32;

using At = std::array<double, 3>;

At at(Barycentric p) { return {p.a, p.b, p.c}; }

// The sums of a polynomial patch's weights are 1 but for rounding; they are meant to be 1.
void settle(const TriangleBezier& from, std::vector<Hpoint>& poles) {
  if (from.is_rational()) return;
  for (Hpoint& h : poles) h.w = 1;
}

NurbsSurface quad(const TriangleBezier& from, std::vector<Hpoint> poles) {
  settle(from, poles);
  const int degree = from.degree();
  const auto n = static_cast<std::size_t>(degree + 1);
  std::vector<double> knots(n, 0.0);
  knots.insert(knots.end(), n, 1.0);
  auto surface = NurbsSurface::from_homogeneous(degree, degree, knots, knots, std::move(poles));
  TRIMLOOP_ASSERT(surface.has_value(), "sums of finite poles make a patch");
  return *surface;
}

TriangleBezier made(const TriangleBezier& from, int degree, std::vector<Hpoint> poles) {
  settle(from, poles);
  auto patch = TriangleBezier::from_homogeneous(degree, std::move(poles));
  TRIMLOOP_ASSERT(patch.has_value(), "combinations of a patch's poles make a patch");
  return *patch;
}

}  // namespace

Result<TriangleBezier> TriangleBezier::from_homogeneous(int degree, std::vector<Hpoint> poles) {
  if (degree < 1 || degree > highest_degree)
    return fail(ErrorCode::InvalidArgument, fmt::format("degree {} is not in 1..{}", degree, highest_degree), degree,
                highest_degree);
  if (poles.size() != count(degree))
    return fail(ErrorCode::InvalidArgument, fmt::format("{} poles, degree {} has {}", poles.size(), degree, count(degree)),
                static_cast<double>(poles.size()), static_cast<double>(count(degree)));
  for (std::size_t i = 0; i < poles.size(); ++i)
    if (!is_finite(Point{poles[i].x, poles[i].y, poles[i].z}) || !std::isfinite(poles[i].w))
      return fail(ErrorCode::InvalidArgument, fmt::format("pole {} is not finite", i));
  TriangleBezier patch;
  patch.degree_ = degree;
  patch.rational_ = std::any_of(poles.begin(), poles.end(), [](const Hpoint& h) { return h.w != 1; });
  patch.poles_ = std::move(poles);
  return patch;
}

Result<TriangleBezier> TriangleBezier::from_cartesian(int degree, std::span<const Point> points,
                                                      std::span<const double> weights) {
  if (!weights.empty() && weights.size() != points.size())
    return fail(ErrorCode::InvalidArgument, fmt::format("{} weights for {} poles", weights.size(), points.size()));
  std::vector<Hpoint> poles;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double w = weights.empty() ? 1 : weights[i], factor = w == 0 ? 1 : w;  // a weight of 0: an ideal pole
    poles.push_back({factor * points[i].x, factor * points[i].y, factor * points[i].z, w});
  }
  return from_homogeneous(degree, std::move(poles));
}

Hpoint blossom(const TriangleBezier& patch, std::span<const Barycentric> arguments) {
  TRIMLOOP_ASSERT(arguments.size() == static_cast<std::size_t>(patch.degree()), "one argument per degree");
  std::vector<Hpoint> poles = patch.poles();
  int degree = patch.degree();
  for (const Barycentric& p : arguments) poles = detail::triangle_step(poles, degree--, at(p));
  return poles[0];
}

Point evaluate(const TriangleBezier& patch, Barycentric p) {
  return project(blossom(patch, std::vector<Barycentric>(static_cast<std::size_t>(patch.degree()), p)));
}

TriangleJet jet(const TriangleBezier& patch, Barycentric p) {
  std::vector<Hpoint> poles = patch.poles();
  const int n = patch.degree();
  for (int d = n; d > 1; --d) poles = detail::triangle_step(poles, d, at(p));
  // The last triangle is tangent (seed 001 §8.3.1): homogeneous derivatives are its sides times the degree.
  const Hpoint value = detail::triangle_step(poles, 1, at(p))[0];
  const Hpoint hb = static_cast<double>(n) * (poles[1] - poles[0]), hc = static_cast<double>(n) * (poles[2] - poles[0]);
  TriangleJet out;
  out.point = project(value);
  const Vector s = to_vector(out.point);
  out.db = (detail::xyz(hb) - hb.w * s) / value.w;
  out.dc = (detail::xyz(hc) - hc.w * s) / value.w;
  out.normal = normalized(cross(out.db, out.dc));
  return out;
}

TriangleBezier elevated(const TriangleBezier& patch) {
  const int n = patch.degree() + 1;
  std::vector<Hpoint> poles;
  for (int m = 0; m <= n; ++m) {
    const int i = n - m;
    for (int k = 0; k <= m; ++k) {
      const int j = m - k;
      Hpoint sum{0, 0, 0, 0};
      if (i > 0) sum = sum + (static_cast<double>(i) / n) * patch.pole(i - 1, j, k);
      if (j > 0) sum = sum + (static_cast<double>(j) / n) * patch.pole(i, j - 1, k);
      if (k > 0) sum = sum + (static_cast<double>(k) / n) * patch.pole(i, j, k - 1);
      poles.push_back(sum);
    }
  }
  return made(patch, n, std::move(poles));
}

TriangleBezier part(const TriangleBezier& patch, Barycentric a, Barycentric b, Barycentric c) {
  // Pole (i, j, k) is the polar form at i times a, j times b, k times c.
  const int n = patch.degree();
  std::vector<Hpoint> poles;
  for (int m = 0; m <= n; ++m) {
    for (int k = 0; k <= m; ++k) {
      std::vector<Barycentric> arguments(static_cast<std::size_t>(n - m), a);
      arguments.insert(arguments.end(), static_cast<std::size_t>(m - k), b);
      arguments.insert(arguments.end(), static_cast<std::size_t>(k), c);
      poles.push_back(blossom(patch, arguments));
    }
  }
  return made(patch, n, std::move(poles));
}

std::array<TriangleBezier, 3> split(const TriangleBezier& patch, Barycentric p) {
  const Barycentric a{1, 0, 0}, b{0, 1, 0}, c{0, 0, 1};
  return {part(patch, p, b, c), part(patch, a, p, c), part(patch, a, b, p)};
}

NurbsSurface to_collapsed_quad(const TriangleBezier& patch) {
  return quad(patch, detail::collapsed_poles<Hpoint, double>(patch.poles(), patch.degree()));
}

std::array<NurbsSurface, 3> to_three_quads(const TriangleBezier& patch) {
  const auto third = [&patch](std::size_t which) {
    return quad(patch, detail::quad_poles(patch.poles(), patch.degree(), detail::third_of_triangle<double>(which)));
  };
  return {third(0), third(1), third(2)};
}

TriangleJoint joint_along_bc(const TriangleBezier& first, const TriangleBezier& second, int samples) {
  TRIMLOOP_ASSERT(samples >= 2, "both ends are samples");
  TriangleJoint joint;
  for (int i = 0; i < samples; ++i) {
    const double t = static_cast<double>(i) / (samples - 1);
    const TriangleJet one = jet(first, {0, 1 - t, t}), two = jet(second, {0, t, 1 - t});
    joint.gap_mm = std::max(joint.gap_mm, distance(one.point, two.point));
    joint.angle_rad = std::max(joint.angle_rad, std::atan2(norm(cross(one.normal, two.normal)), dot(one.normal, two.normal)));
  }
  return joint;
}

}  // namespace trimloop
