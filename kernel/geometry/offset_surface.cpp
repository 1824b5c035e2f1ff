// Offsets of surfaces.

#include <fmt/format.h>

#include "kernel/geometry/offset.h"
#include "kernel/geometry/recognize.h"
#include "kernel/nurbs/bernstein_net.h"
#include "kernel/nurbs/hodograph.h"

namespace trimloop {
namespace {

using detail::Bernstein2;
using detail::BernsteinVector;

// The offset surface where it is of the same type; the normal is Su x Sv. Nothing for other types.
Result<std::optional<Surface>> elementary(const Surface& s, double d) {
  const auto radius = [&](double r) -> Result<double> {
    if (r > 1e-12 * std::abs(d)) return r;
    return fail(ErrorCode::Degenerate, fmt::format("the offset leaves a radius of {}", r), r, 0);
  };
  if (const auto* p = std::get_if<Plane>(&s.shape)) {
    Plane o = *p;
    o.frame.origin = o.frame.origin + d * cross(o.frame.x, o.frame.y);
    return Surface{o};
  }
  if (const auto* c = std::get_if<Cylinder>(&s.shape)) {
    const auto r = radius(c->radius + d);
    if (!r) return tl::unexpected<Error>(r.error());
    return Surface{Cylinder{c->frame, *r}};
  }
  if (const auto* c = std::get_if<Cone>(&s.shape)) {
    // The normal is (cos u, sin u) cos a - z sin a: along it the line (radius + v tan a, v) moves to a parallel one.
    // The parameter v stays when the origin moves down the axis.
    const double ca = std::cos(c->half_angle_rad), sa = std::sin(c->half_angle_rad);
    Cone o = *c;
    o.frame.origin = o.frame.origin - d * sa * o.frame.z;
    o.radius = c->radius + d * ca;
    return Surface{o};
  }
  if (const auto* b = std::get_if<Sphere>(&s.shape)) {
    const auto r = radius(b->radius + d);
    if (!r) return tl::unexpected<Error>(r.error());
    return Surface{Sphere{b->frame, *r}};
  }
  if (const auto* t = std::get_if<Torus>(&s.shape)) {
    const auto r = radius(t->minor_radius + d);
    if (!r) return tl::unexpected<Error>(r.error());
    return Surface{Torus{t->frame, t->major_radius, *r}};
  }
  return std::optional<Surface>();
}

// The unit normal and its first derivatives, from second derivatives of the surface.
struct OffsetJet {
  Point point;
  Vector du, dv, duv;
};
OffsetJet offset_jet(const NurbsSurface& s, Uv at, double d, Vector& normal) {
  const SurfaceJet j = jet(Surface{OffsetSurface{std::make_shared<const Surface>(Surface{s}), d}}, at);
  normal = cross(jet(s, at).du, jet(s, at).dv);
  return {j.point, j.du, j.dv, j.duv};
}

// Bicubic Hermite data at the corners of a rectangle, as a Bezier patch.
std::vector<Hpoint> hermite(const NurbsSurface& s, double d, bool& sound) {
  const Interval u = s.range_u(), v = s.range_v();
  std::vector<Hpoint> poles(16);
  for (const int i : {0, 1})
    for (const int k : {0, 1}) {
      Vector normal;
      const OffsetJet j = offset_jet(s, {i ? u.hi : u.lo, k ? v.hi : v.lo}, d, normal);
      sound = sound && norm(normal) > 0 && is_finite(j.point) && is_finite(j.du) && is_finite(j.dv);
      const Vector twist = is_finite(j.duv) ? j.duv : Vector{};
      const double x = (i ? -1 : 1) * u.length() / 3, y = (k ? -1 : 1) * v.length() / 3;
      for (const int a : {0, 1})
        for (const int b : {0, 1}) {
          const Point p = j.point + (a * x * j.du + b * y * j.dv + a * b * x * y * twist);
          poles[static_cast<std::size_t>((i ? 3 - a : a) * 4 + (k ? 3 - b : b))] = {p.x, p.y, p.z, 1};
        }
    }
  return poles;
}

// Bound on |B - (S + d N)| over one Bezier patch.
double bound_of(const NurbsSurface& s, const std::vector<Hpoint>& fit, double d) {
  const std::size_t p = static_cast<std::size_t>(s.degree_u()), q = static_cast<std::size_t>(s.degree_v());
  const Point origin = project(s.poles().front());
  const auto coordinate = [](auto value, std::size_t rows, std::size_t columns) {
    Bernstein2 out = detail::constant(0, rows, columns);
    for (std::size_t i = 0; i < out.c.size(); ++i) out.c[i] = value(i);
    return out;
  };
  const auto vector = [&](const std::vector<Hpoint>& h, std::size_t rows, std::size_t columns) {
    return BernsteinVector{coordinate([&](std::size_t i) { return h[i].x - h[i].w * origin.x; }, rows, columns),
                           coordinate([&](std::size_t i) { return h[i].y - h[i].w * origin.y; }, rows, columns),
                           coordinate([&](std::size_t i) { return h[i].z - h[i].w * origin.z; }, rows, columns)};
  };
  const BernsteinVector a = vector(s.poles(), p, q), b = vector(fit, 3, 3);
  // Polynomial surfaces keep low degrees.
  const Bernstein2 w =
      s.is_rational() ? coordinate([&](std::size_t i) { return s.poles()[i].w; }, p, q) : detail::constant(1);
  const BernsteinVector x = w * b - a;
  const auto slope = [&](auto derivative) {
    const BernsteinVector da{derivative(a.x), derivative(a.y), derivative(a.z)};
    return s.is_rational() ? w * da - derivative(w) * a : da;  // along Su, Sv: times w^2
  };
  const BernsteinVector hu = slope(detail::derivative_u), hv = slope(detail::derivative_v);
  const BernsteinVector normal = cross(hu, hv);
  const double least = w.lowest(), area2 = dot(normal, normal).lowest();
  if (!(least > 0) || !(area2 > 0)) return infinity;
  const double square = (dot(x, x) - d * d * (w * w)).largest() / (least * least);
  const double along_u = dot(x, hu).largest() / least, along_v = dot(x, hv).largest() / least;
  const double g11 = dot(hu, hu).highest(), g22 = dot(hv, hv).highest(), g12 = dot(hu, hv).largest();
  const double along =
      std::sqrt((along_u * along_u * g22 + 2 * along_u * along_v * g12 + along_v * along_v * g11) / area2);
  const double inner = d * d - square - along * along;
  if (!(inner > 0)) return infinity;
  const Uv corner{s.range_u().lo, s.range_v().lo};
  const SurfaceJet j = jet(s, corner);
  if (!(dot(project(fit.front()) - j.point, d * cross(j.du, j.dv)) > 0)) return infinity;
  const double across = std::max(std::sqrt(d * d + square) - std::abs(d), std::abs(d) - std::sqrt(inner));
  const double size = a.x.largest() + a.y.largest() + a.z.largest() + std::abs(d);
  return std::hypot(across, along) +
         64 * static_cast<double>(p + q + 8) * std::numeric_limits<double>::epsilon() * size / least;
}

// Whether the normal jumps across a line of full multiplicity, looked at in many places along it.
bool has_crease_u(const NurbsSurface& s) {
  const Interval range = s.range_u();
  for (const double u : breaks_u(s)) {
    const auto [first, last] = std::equal_range(s.knots_u().begin(), s.knots_u().end(), u);
    if (!(range.lo < u && u < range.hi) || last - first < s.degree_u()) continue;
    const std::vector<double> v = breaks_v(s);
    for (std::size_t k = 0; k + 1 < v.size(); ++k)
      for (int i = 0; i <= 2 * s.degree_v(); ++i) {
        const Uv at{u, Interval{v[k], v[k + 1]}.at(i / (2.0 * s.degree_v()))};
        const auto normal_of = [&](Side side) {
          const std::vector<Vector> d = derivatives(s, at, 1, side, Side::Right);
          return normalized(cross(d[2], d[1]));
        };
        if (norm(normal_of(Side::Left) - normal_of(Side::Right)) > 1e-9) return true;
      }
  }
  return false;
}

std::vector<double> full_knots(const std::vector<double>& at) {
  std::vector<double> knots{at.front()};
  for (const double t : at) knots.insert(knots.end(), 3, t);
  knots.push_back(at.back());
  return knots;
}

// A grid of patches, refined by whole rows and columns where a bound is too large: patches meet in their Hermite data.
Result<SurfaceOffset> freeform(const NurbsSurface& s, double d, double tolerance, int most_patches) {
  std::vector<double> u = breaks_u(s), v = breaks_v(s);
  double worst = infinity;
  for (int round = 0; round < 24; ++round) {
    const std::size_t rows = u.size() - 1, columns = v.size() - 1;
    if (rows * columns > static_cast<std::size_t>(most_patches)) break;
    std::vector<Hpoint> poles((3 * rows + 1) * (3 * columns + 1));
    std::vector<double> of_row(rows, 0.0), of_column(columns, 0.0);
    worst = 0;
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t k = 0; k < columns; ++k) {
        const NurbsSurface patch = trimmed(s, {u[i], u[i + 1]}, {v[k], v[k + 1]});
        bool sound = true;
        const std::vector<Hpoint> fit = hermite(patch, d, sound);
        const double bound = sound ? bound_of(patch, fit, d) : infinity;
        worst = std::max(worst, bound);
        of_row[i] = std::max(of_row[i], bound), of_column[k] = std::max(of_column[k], bound);
        for (std::size_t a = 0; a < 4; ++a)
          for (std::size_t b = 0; b < 4; ++b) poles[(3 * i + a) * (3 * columns + 1) + 3 * k + b] = fit[4 * a + b];
      }
    if (worst <= tolerance) {
      auto out = NurbsSurface::from_homogeneous(3, 3, full_knots(u), full_knots(v), std::move(poles));
      if (!out) return tl::unexpected<Error>(out.error());
      return SurfaceOffset{Surface{std::move(*out)}, worst};
    }
    const auto halve = [&](std::vector<double>& at, const std::vector<double>& bound) {
      std::vector<double> next{at[0]};
      for (std::size_t i = 0; i + 1 < at.size(); ++i) {
        const double mid = 0.5 * (at[i] + at[i + 1]);
        if (bound[i] > tolerance && at[i] < mid && mid < at[i + 1]) next.push_back(mid);
        next.push_back(at[i + 1]);
      }
      at = std::move(next);
    };
    halve(u, of_row);
    halve(v, of_column);
  }
  return fail(ErrorCode::NoConvergence,
              "the offset needs too many patches: the surface may have a pole or a cusp inside", worst, tolerance);
}

}  // namespace

Result<SurfaceOffset> offset(const Surface& s, Interval u, Interval v, double d, double tolerance, int most_patches) {
  if (!std::isfinite(d)) return fail(ErrorCode::InvalidArgument, "the distance is not finite", d);
  if (d == 0) return SurfaceOffset{s, 0};
  const auto exact = elementary(s, d);
  if (!exact) return tl::unexpected<Error>(exact.error());
  if (*exact) return SurfaceOffset{**exact, 0};
  if (!(tolerance > 0)) return fail(ErrorCode::InvalidArgument, "a tolerance is positive", tolerance, 0);
  const auto spline = to_nurbs(s, u, v);
  if (!spline) return tl::unexpected<Error>(spline.error());
  const NurbsSurface& n = spline->surface;
  if (const auto found = recognize(n)) {
    const Uv mid{n.range_u().mid(), n.range_v().mid()};
    const bool same_side = dot(normal(Surface{n}, mid), normal(found->surface, map_to_analytic(*found, mid))) > 0;
    const auto moved = elementary(found->surface, same_side ? d : -d);
    if (!moved) return tl::unexpected<Error>(moved.error());
    if (*moved) return SurfaceOffset{**moved, 0};
  }
  if (has_crease_u(n) || has_crease_u(swapped(n)))
    return fail(ErrorCode::Unsupported, "the surface has a crease inside: offset the smooth parts");
  return freeform(n, d, tolerance, most_patches);
}

}  // namespace trimloop
