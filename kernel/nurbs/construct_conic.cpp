#include "kernel/nurbs/construct_conic.h"

#include <fmt/format.h>

#include <array>

#include "kernel/nurbs/builder.h"

namespace trimloop {
namespace {

struct Planar {  // premultiplied, in the plane of a frame, of the unit circle
  double x, y, w;
};

Result<NurbsCurve> on_frame(const Frame& f, double radius, int degree, std::vector<double> knots,
                            std::span<const Planar> poles) {
  if (!std::isfinite(radius) || radius == 0)
    return fail(ErrorCode::InvalidArgument, fmt::format("a circle has a radius, not {}", radius), radius);
  std::vector<Hpoint> out;
  for (const Planar& p : poles) {
    const Vector v = radius * (p.x * f.x + p.y * f.y) + p.w * to_vector(f.origin);
    out.push_back({v.x, v.y, v.z, p.w});
  }
  return NurbsCurve::from_homogeneous(degree, std::move(knots), std::move(out));
}

std::vector<double> bezier_knots(int degree) {
  std::vector<double> knots(static_cast<std::size_t>(degree) + 1, 0.0);
  knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, 1.0);
  return knots;
}

bool is_single_quadratic(const NurbsCurve& c) { return c.degree() == 2 && bezier_pieces(c).size() == 1; }

}  // namespace

Result<NurbsCurve> circle_arc(const Frame& frame, double radius, Interval angle) {
  const double turn = angle.length();
  if (!(turn > 0) || !(turn <= two_pi * (1 + 1e-15)))
    return fail(ErrorCode::InvalidArgument, fmt::format("an arc spans a full turn at most, not {} rad", turn), turn,
                two_pi);
  const int pieces = std::clamp(static_cast<int>(std::ceil(turn / (0.5 * pi) - 1e-12)), 1, 4);
  const double step = turn / pieces, w = std::cos(0.5 * step);
  std::vector<Planar> poles;
  std::vector<double> knots{0};
  const bool whole = std::abs(turn - two_pi) <= 1e-15 * two_pi;
  for (int i = 0; i <= 2 * pieces; ++i) {
    const double at = angle.lo + 0.5 * i * step;
    // The pole between two ends lies at 1 / w along its angle: premultiplied it is on the unit circle again.
    poles.push_back(whole && i == 2 * pieces ? poles.front() : Planar{std::cos(at), std::sin(at), i % 2 ? w : 1});
    if (i % 2 == 0) knots.insert(knots.end(), 2, 0.5 * i);
  }
  knots.push_back(pieces);
  return on_frame(frame, radius, 2, std::move(knots), poles);
}

Result<NurbsCurve> rational_quarter_circle(const Frame& frame, double radius) {
  constexpr std::array<Planar, 3> poles{{{1, 0, 1}, {1, 1, 1}, {0, 2, 2}}};
  return on_frame(frame, radius, 2, bezier_knots(2), poles);
}

Result<NurbsCurve> quintic_circle(const Frame& frame, double radius) {
  constexpr std::array<Planar, 6> poles{{{5, 0, 5}, {1, 4, 1}, {-3, 2, 1}, {-3, -2, 1}, {1, -4, 1}, {5, 0, 5}}};
  return on_frame(frame, radius, 5, bezier_knots(5), poles);
}

Result<NurbsCurve> quartic_circle(const Frame& frame, double radius) {
  constexpr std::array<Planar, 5> poles{{{3, 0, 3}, {0, 3, 0}, {-3, 0, 1}, {0, -3, 0}, {3, 0, 3}}};
  return on_frame(frame, radius, 4, bezier_knots(4), poles);
}

Result<NurbsCurve> ideal_half_circle(const Frame& frame, double radius) {
  constexpr std::array<Planar, 3> poles{{{1, 0, 1}, {0, 1, 0}, {-1, 0, 1}}};
  return on_frame(frame, radius, 2, bezier_knots(2), poles);
}

// In the plane's own coordinates: p - p0 = a (p1 - p0) + b (p2 - p0) with the barycentrics of p in the triangle. On the
// conic with weights 1, w, 1 they satisfy  c1^2 = 4 w^2 c0 c2  with c1 = a, c2 = b, c0 = 1 - a - b.
Result<NurbsCurve> one_conic_arc(Point p0, Vector t0, Point p2, Vector t2, Point p) {
  const Vector chord = p2 - p0, normal = cross(t0, t2);
  const double scale = norm(chord), sine = norm(normal) / (norm(t0) * norm(t2));
  if (!(scale > 0) || !(norm(t0) > 0) || !(norm(t2) > 0))
    return fail(ErrorCode::Degenerate, "a conic arc needs two ends and two tangents");
  const auto arc = [&](Hpoint middle) {
    return NurbsCurve::from_homogeneous(2, bezier_knots(2), {{p0.x, p0.y, p0.z, 1}, middle, {p2.x, p2.y, p2.z, 1}});
  };
  if (sine < 1e-12) {
    // Parallel tangents: p - p0 = b chord + a t0 with a = 2 t (1 - t) / ((1-t)^2 + t^2) s and s the length of the ideal
    // pole.
    const Vector along = normalized(t0), arm = p - p0, off = chord - dot(chord, along) * along;
    const double b = dot(arm, off) / dot(off, off);
    if (!(dot(off, off) > 0) || !(b > 0 && b < 1))
      return fail(ErrorCode::Degenerate, "no conic goes through the point", b);
    const double t = std::sqrt(b) / (std::sqrt(1 - b) + std::sqrt(b));
    const double a = dot(arm - b * chord, along), s = a * ((1 - t) * (1 - t) + t * t) / (2 * t * (1 - t));
    if (norm(arm - b * chord - a * along) > 1e-9 * scale)
      return fail(ErrorCode::Degenerate, "the data lie in no plane");
    return arc({s * along.x, s * along.y, s * along.z, 0});
  }
  // Intersection of the tangents.
  const double k = dot(cross(chord, t2), normal) / dot(normal, normal);
  const Point p1 = p0 + k * t0;
  const Vector e = p1 - p0, arm = p - p0, n = cross(e, chord);
  const double area = dot(n, n);
  if (!(area > 1e-24 * scale * scale * dot(e, e))) return fail(ErrorCode::Degenerate, "a tangent runs along the chord");
  const double c1 = dot(cross(arm, chord), n) / area, c2 = dot(cross(e, arm), n) / area, c0 = 1 - c1 - c2;
  const double off_plane = std::abs(dot(arm, normalized(n))) + std::abs(dot(t2, normalized(n))) / norm(t2) * scale;
  if (off_plane > 1e-9 * scale) return fail(ErrorCode::Degenerate, "the data lie in no plane", off_plane, 1e-9 * scale);
  if (!(c0 * c2 > 0))
    return fail(ErrorCode::Degenerate, "no conic with these tangents goes through the point", c0 * c2, 0);
  const double w = c1 / (2 * std::sqrt(c0 * c2)) * (c0 > 0 ? 1 : -1);
  return arc({w * p1.x, w * p1.y, w * p1.z, w});
}

Result<NurbsCurve> open_conic(Point p0, Vector t0, Point p2, Vector t2, Point p) {
  auto whole = one_conic_arc(p0, t0, p2, t2, p);
  if (!whole) return whole;
  const double w = whole->poles()[1].w;
  if (!(w > -1)) return fail(ErrorCode::Degenerate, "the arc would run through infinity", w, -1);
  // A piece of an ellipse with weights 1, cos(h), 1 turns by 2 h; half of it has cos(h / 2). Up to 90 degrees as in
  // A7.3.
  const double half = w < 1 ? std::acos(std::max(w, -1.0)) : 0;
  const int pieces = w >= 1 ? 1 : half <= 0.25 * pi * (1 + 1e-9) ? 1 : half <= 0.5 * pi ? 2 : 4;
  NurbsCurve out = *whole;
  for (int count = 1; count < pieces; count *= 2) {
    std::vector<double> middle;
    const std::vector<double> at = breaks(out);
    for (std::size_t i = 0; i + 1 < at.size(); ++i) middle.insert(middle.end(), 2, 0.5 * (at[i] + at[i + 1]));
    out = refine(out, middle);
  }
  return out;
}

Result<ConicShape> conic_class(const NurbsCurve& c, double relative) {
  if (!is_single_quadratic(c)) return fail(ErrorCode::Unsupported, "only one quadratic Bezier curve has a conic class");
  const NurbsCurve b = bezier_pieces(c).front();
  const Hpoint &a = b.poles()[0], &m = b.poles()[1], &e = b.poles()[2];
  if (a.w * e.w == 0) return fail(ErrorCode::Unsupported, "an end of the curve lies at infinity");
  const Point p0 = project(a), p2 = project(e);
  const Vector chord = p2 - p0, arm = m.w != 0 ? project(m) - p0 : Vector{m.x, m.y, m.z};
  ConicShape out;
  out.shape_factor = m.w * m.w / (a.w * e.w);
  if (norm(cross(chord, arm)) <= relative * norm(chord) * std::max(norm(arm), norm(chord))) return out;
  const double excess = out.shape_factor - 1;
  out.kind = std::abs(excess) <= relative ? ConicClass::Parabola
             : excess < 0                 ? ConicClass::Ellipse
                                          : ConicClass::Hyperbola;
  return out;
}

Result<NurbsCurve> complementary_arc(const NurbsCurve& c) {
  if (!is_single_quadratic(c)) return fail(ErrorCode::Unsupported, "only one quadratic Bezier curve has a complement");
  const NurbsCurve b = bezier_pieces(c).front();
  std::vector<Hpoint> poles = b.poles();
  poles[1] = -1.0 * poles[1];
  return NurbsCurve::from_homogeneous(2, b.knots(), std::move(poles));
}

}  // namespace trimloop
