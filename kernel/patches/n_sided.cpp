#include "kernel/patches/n_sided.h"

#include <fmt/format.h>

#include "kernel/nurbs/construct_blend.h"
#include "kernel/patches/smooth_fill.h"

namespace trimloop {

namespace {

NurbsCurve spoke(Point from, Point centre, Vector normal) {
  const Vector in = centre - from;
  const Vector flat = in - dot(in, normal) * normal;
  return *NurbsCurve::from_cartesian(3, {0, 0, 0, 0, 1, 1, 1, 1}, std::vector{from, from + in / 3, centre - flat / 3, centre}, {});
}

NurbsCurve unit_range(const NurbsCurve& c) { return reparametrized(c, {0, 1}); }

Vector normal_at(const NurbsSurface& s, Uv uv) {
  Point p;
  Vector u, v;
  jet1(s, uv, p, u, v);
  return normalized(cross(u, v));
}

Point start_of(const NurbsCurve& c) { return evaluate(c, c.range().lo); }

// (u, v) -> (1 - u, 1 - v).
NurbsSurface turned_half(const NurbsSurface& s) { return swapped(reversed_u(swapped(reversed_u(s)))); }

using Halves = std::vector<std::pair<NurbsCurve, NurbsCurve>>;

Result<void> fill_by_position(const Halves& halves, double tolerance, NSidedFill& out) {
  const std::size_t n = halves.size();
  Vector area{};
  for (std::size_t i = 0; i < n; ++i)
    area += cross(start_of(halves[i].second) - out.centre, start_of(halves[(i + 1) % n].second) - out.centre);
  const Vector normal = normalized(area);
  for (std::size_t i = 0; i < n; ++i) {
    // Corner at (0,0); v along the second half of side i backwards, u along the first half of side i + 1.
    const NurbsCurve v_side = unit_range(reversed(halves[i].second)), u_side = unit_range(halves[(i + 1) % n].first);
    const Point from_v = evaluate(v_side, 1), from_u = evaluate(u_side, 1);
    auto patch = coons(u_side, spoke(from_v, out.centre, normal), v_side, spoke(from_u, out.centre, normal), tolerance);
    if (!patch) return tl::unexpected(patch.error());
    out.boundary_miss = std::max(out.boundary_miss, patch->largest_miss);
    out.patches.push_back(std::move(patch->surface));
  }
  return {};
}

}  // namespace

Result<NSidedFill> n_sided_fill(std::span<const NurbsCurve> sides, double tolerance, FillContinuity continuity) {
  const std::size_t n = sides.size();
  if (n < 3) return fail(ErrorCode::InvalidArgument, fmt::format("{} sides, at least 3 are needed", n), static_cast<double>(n), 3);
  NSidedFill out;
  Halves halves;
  Vector sum{};
  for (std::size_t i = 0; i < n; ++i) {
    if (sides[i].is_rational()) return fail(ErrorCode::Unsupported, fmt::format("side {} is rational", i));
    const Interval r = sides[i].range(), next = sides[(i + 1) % n].range();
    const double gap = distance(evaluate(sides[i], r.hi), evaluate(sides[(i + 1) % n], next.lo));
    if (!(gap <= tolerance))
      return fail(ErrorCode::Degenerate, fmt::format("sides {} and {} are {:.6g} apart", i, (i + 1) % n, gap), gap, tolerance);
    out.boundary_miss = std::max(out.boundary_miss, gap);
    halves.push_back(split(sides[i], r.mid()));
    sum += to_vector(evaluate(sides[i], r.mid())) / static_cast<double>(n);
  }
  out.centre = to_point(sum);
  if (continuity == FillContinuity::Tangent) {
    auto patches = detail::smooth_patches(halves, out.centre);
    if (!patches) return tl::unexpected(patches.error());
    for (const NurbsSurface& p : *patches) out.patches.push_back(turned_half(p));
  } else if (auto done = fill_by_position(halves, tolerance, out); !done) {
    return tl::unexpected(done.error());
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (int k = 0; k <= 32; ++k) {
      const double t = k / 32.0;  // patch i has the spoke of side i + 1 at u = 1, patch i + 1 has it at v = 1
      const Vector a = normal_at(out.patches[i], {1, t}), b = normal_at(out.patches[(i + 1) % n], {t, 1});
      out.spoke_angle_rad = std::max(out.spoke_angle_rad, std::atan2(norm(cross(a, b)), dot(a, b)));
    }
  }
  return out;
}

}  // namespace trimloop
