// Every surface type over a rectangle as an exact rational B-spline surface (The NURBS Book, 8.2 - 8.5).

#include "kernel/geometry/conic_arcs.h"
#include "kernel/geometry/detail.h"
#include "kernel/nurbs/binomial.h"
#include "kernel/nurbs/construct_surface.h"

namespace trimloop {
namespace {

using Kind = ParameterMap::Kind;

ParameterMap identity(Interval r) { return {{r.lo, r.hi}, {r.lo, r.hi}, {ParameterMap::Piece{}}}; }
std::vector<double> linear_knots(Interval r) { return {r.lo, r.lo, r.hi, r.hi}; }
Hpoint homogeneous(Vector premultiplied, double w) { return {premultiplied.x, premultiplied.y, premultiplied.z, w}; }

Result<ToNurbsSurface> packed(Result<NurbsSurface> surface, ParameterMap u, ParameterMap v, double deviation = 0) {
  if (!surface) return tl::unexpected<Error>(surface.error());
  return ToNurbsSurface{std::move(*surface), std::move(u), std::move(v), deviation};
}

Result<ToNurbsSurface> convert(const Plane& s, Interval u, Interval v) {
  std::vector<Hpoint> poles;
  for (const double a : {u.lo, u.hi})
    for (const double b : {v.lo, v.hi}) poles.push_back(homogeneous(to_vector(evaluate(Surface{s}, {a, b})), 1));
  return packed(NurbsSurface::from_homogeneous(1, 1, linear_knots(u), linear_knots(v), std::move(poles)), identity(u),
                identity(v));
}

// ---- Turned about an axis by circular arcs along u

// A profile pole in cylinder coordinates, premultiplied: w rho along the radial direction, w h along the axis.
struct ProfilePole {
  double rho, h, w;
};
std::vector<Hpoint> turn(const Frame& f, const detail::Arcs& arcs, const std::vector<ProfilePole>& profile) {
  std::vector<Hpoint> poles;
  poles.reserve(arcs.poles.size() * profile.size());
  for (const detail::ArcPole& a : arcs.poles)
    for (const ProfilePole& p : profile) {
      const Vector radial = a.c * f.x + a.s * f.y;
      poles.push_back(homogeneous(p.rho * radial + a.w * (p.h * f.z + p.w * to_vector(f.origin)), a.w * p.w));
    }
  return poles;
}

template <class Straight>  // cylinder, cone
Result<ToNurbsSurface> turn_line(const Straight& s, double radius_lo, double radius_hi, Interval u, Interval v) {
  const detail::Arcs arcs = detail::circular_arcs(u);
  std::vector<Hpoint> poles = turn(s.frame, arcs, {{radius_lo, v.lo, 1}, {radius_hi, v.hi, 1}});
  return packed(NurbsSurface::from_homogeneous(2, 1, arcs.knots(), linear_knots(v), std::move(poles)),
                arcs.map(Kind::HalfAngle), identity(v));
}
Result<ToNurbsSurface> convert(const Cylinder& s, Interval u, Interval v) {
  return turn_line(s, s.radius, s.radius, u, v);
}
Result<ToNurbsSurface> convert(const Cone& s, Interval u, Interval v) {
  const double slope = std::tan(s.half_angle_rad);
  return turn_line(s, s.radius + v.lo * slope, s.radius + v.hi * slope, u, v);
}

Result<ToNurbsSurface> turn_circle(const Frame& f, double centre, double radius, Interval u, Interval v) {
  const detail::Arcs along = detail::circular_arcs(u), profile = detail::circular_arcs(v);
  std::vector<ProfilePole> profile_poles;
  for (const detail::ArcPole& p : profile.poles)
    profile_poles.push_back({centre * p.w + radius * p.c, radius * p.s, p.w});
  return packed(NurbsSurface::from_homogeneous(2, 2, along.knots(), profile.knots(), turn(f, along, profile_poles)),
                along.map(Kind::HalfAngle), profile.map(Kind::HalfAngle));
}
Result<ToNurbsSurface> convert(const Sphere& s, Interval u, Interval v) {
  return turn_circle(s.frame, 0, s.radius, u, v);
}
Result<ToNurbsSurface> convert(const Torus& s, Interval u, Interval v) {
  return turn_circle(s.frame, s.major_radius, s.minor_radius, u, v);
}

// Each pole of the generatrix is turned by the arcs: c (radial part) + s (axis x radial part) + w (the rest), which is
// linear in the homogeneous pole, so weights of any sign will do.
Result<ToNurbsSurface> convert(const Revolution& s, Interval u, Interval v) {
  if (!s.generatrix) return fail(ErrorCode::InvalidArgument, "a surface of revolution without a generatrix");
  const Result<ToNurbsCurve> generatrix = to_nurbs(with_range(*s.generatrix, v));
  if (!generatrix) return tl::unexpected<Error>(generatrix.error());
  const NurbsCurve& c = generatrix->curve;
  const detail::Arcs arcs = detail::circular_arcs(u);
  std::vector<Hpoint> poles;
  poles.reserve(arcs.poles.size() * c.poles().size());
  const Vector origin = to_vector(s.axis_origin);
  for (const detail::ArcPole& a : arcs.poles)
    for (const Hpoint& h : c.poles()) {
      const Vector arm = Vector{h.x, h.y, h.z} - h.w * origin;
      const Vector along = dot(arm, s.axis) * s.axis, radial = arm - along;
      const Vector turned = a.c * radial + a.s * cross(s.axis, radial) + a.w * along;
      poles.push_back(homogeneous(turned + a.w * h.w * origin, a.w * h.w));
    }
  return packed(NurbsSurface::from_homogeneous(2, c.degree(), arcs.knots(), c.knots(), std::move(poles), {}, c.range()),
                arcs.map(Kind::HalfAngle), generatrix->map, generatrix->deviation);
}

// ---- Straight along v

// Surface between two rows of poles over the same knots and weights.
Result<NurbsSurface> between(const NurbsCurve& lo, const NurbsCurve& hi, Interval range_u, Interval v) {
  std::vector<Hpoint> poles;
  poles.reserve(2 * lo.poles().size());
  for (std::size_t i = 0; i < lo.poles().size(); ++i) {
    poles.push_back(lo.poles()[i]);
    poles.push_back(hi.poles()[i]);
  }
  return NurbsSurface::from_homogeneous(lo.degree(), 1, lo.knots(), linear_knots(v), std::move(poles), range_u);
}

Result<ToNurbsSurface> convert(const Extrusion& s, Interval u, Interval v) {
  if (!s.directrix) return fail(ErrorCode::InvalidArgument, "an extrusion without a directrix");
  const Result<ToNurbsCurve> directrix = to_nurbs(with_range(*s.directrix, u));
  if (!directrix) return tl::unexpected<Error>(directrix.error());
  const NurbsCurve& c = directrix->curve;
  const NurbsCurve lo = transformed(c, Transform::translation(v.lo * s.direction));
  const NurbsCurve hi = transformed(c, Transform::translation(v.hi * s.direction));
  return packed(between(lo, hi, c.range(), v), directrix->map, identity(v), directrix->deviation);
}

// ---- Ruled

// One of the two curves over [0, 1], clamped, with its map.
Result<ToNurbsCurve> ruled_side(const CurvePtr& curve, bool reverse) {
  if (!curve) return fail(ErrorCode::InvalidArgument, "a ruled surface needs two curves");
  Result<ToNurbsCurve> out = to_nurbs(Curve{make_composite({{curve, reverse}})});
  if (!out) return out;
  for (std::vector<double>* at : {&out->map.own, &out->map.nurbs}) {
    const double length = at->back();
    for (double& t : *at) t /= length;
    at->back() = 1;
  }
  out->curve = reparametrized(trimmed(out->curve, out->curve.range()), {0, 1});
  return out;
}

bool is_affine(const ParameterMap& m) {
  return std::all_of(m.pieces.begin(), m.pieces.end(), [](ParameterMap::Piece p) { return p.kind == Kind::Affine; });
}
// Whether points of equal parameter of the two curves are points of equal NURBS parameter.
bool agree(const ParameterMap& a, const ParameterMap& b) {
  if (is_affine(a) && is_affine(b)) return true;
  if (a.pieces.size() != b.pieces.size()) return false;
  for (std::size_t i = 0; i < a.pieces.size(); ++i) {
    if (a.pieces[i].kind != b.pieces[i].kind) return false;
    if (std::abs(a.pieces[i].half_span - b.pieces[i].half_span) > 1e-14 * a.pieces[i].half_span) return false;
    if (std::abs(a.own[i] - b.own[i]) > 1e-14) return false;
  }
  return true;
}

bool same_weights(const NurbsCurve& a, const NurbsCurve& b) {
  for (std::size_t i = 0; i < a.poles().size(); ++i)
    if (std::abs(a.poles()[i].w - b.poles()[i].w) > 1e-15 * std::abs(a.poles()[i].w)) return false;
  return true;
}

// Both curves over the product of their weights, piece by piece.
struct Pair {
  NurbsCurve first, second;
};
Result<Pair> over_common_weight(const NurbsCurve& a, const NurbsCurve& b) {
  const int p = a.degree();
  if (2 * p > 64) return fail(ErrorCode::Limit, "the product of the weights has too high a degree", 2 * p, 64);
  const std::vector<NurbsCurve> pieces_a = bezier_pieces(a), pieces_b = bezier_pieces(b);
  const auto weighted = [](const NurbsCurve& c, const NurbsCurve& by) {
    return detail::bezier_product(by.poles(), c.poles(), [](const Hpoint& w, const Hpoint& h) { return w.w * h; });
  };
  std::vector<double> knots(1, 0.0);
  std::vector<Hpoint> first, second;
  for (std::size_t piece = 0; piece < pieces_a.size(); ++piece) {
    knots.insert(knots.end(), static_cast<std::size_t>(2 * p), pieces_a[piece].range().lo);
    const auto one = weighted(pieces_a[piece], pieces_b[piece]), two = weighted(pieces_b[piece], pieces_a[piece]);
    const std::ptrdiff_t shared = piece == 0 ? 0 : 1;  // the pole at the joint is there already
    first.insert(first.end(), one.begin() + shared, one.end());
    second.insert(second.end(), two.begin() + shared, two.end());
  }
  knots.insert(knots.end(), static_cast<std::size_t>(2 * p) + 1, 1.0);
  for (std::size_t i = 0; i < first.size(); ++i) second[i].w = first[i].w;  // equal but for rounding
  const Result<NurbsCurve> c = NurbsCurve::from_homogeneous(2 * p, knots, std::move(first));
  const Result<NurbsCurve> d = NurbsCurve::from_homogeneous(2 * p, std::move(knots), std::move(second));
  if (!c || !d) return tl::unexpected<Error>(c ? d.error() : c.error());
  return Pair{*c, *d};
}

// The two curves over the same degree, knots and weights.
Result<Pair> compatible(const NurbsCurve& a, const NurbsCurve& b) {
  constexpr double same_knot = 1e-14;  // of the range: two knots that differ by rounding only
  const std::vector<NurbsCurve> both = made_compatible(std::vector<NurbsCurve>{a, b}, same_knot);
  if (!same_weights(both[0], both[1])) return over_common_weight(both[0], both[1]);
  return Pair{both[0], both[1]};
}

// Row at v: (1 - v) a + v b.
Result<NurbsCurve> row(const Pair& sides, double v) {
  std::vector<Hpoint> poles;
  poles.reserve(sides.first.poles().size());
  for (std::size_t i = 0; i < sides.first.poles().size(); ++i) {
    const Hpoint a = sides.first.poles()[i];
    Hpoint mixed = (1 - v) * a + v * sides.second.poles()[i];
    mixed.w = a.w;
    poles.push_back(mixed);
  }
  return NurbsCurve::from_homogeneous(sides.first.degree(), sides.first.knots(), std::move(poles));
}

bool length_is_parameter(const CurvePtr& c) {
  return c && (std::holds_alternative<Line>(c->shape) || std::holds_alternative<Circle>(c->shape));
}

Result<ToNurbsSurface> convert(const Ruled& s, Interval u, Interval v) {
  if (s.equal_arc_length && !(length_is_parameter(s.first) && length_is_parameter(s.second)))
    return fail(ErrorCode::Unsupported,
                "a ruled surface over arc lengths is no rational spline; it has to be approximated");
  const Result<ToNurbsCurve> a = ruled_side(s.first, false), b = ruled_side(s.second, s.second_reversed);
  if (!a || !b) return tl::unexpected<Error>(a ? b.error() : a.error());
  if (!agree(a->map, b->map))
    return fail(ErrorCode::Unsupported,
                "the curves of the ruled surface are not matched by rational functions; it has to be approximated");
  const Result<Pair> sides = compatible(a->curve, b->curve);
  if (!sides) return tl::unexpected<Error>(sides.error());
  const Result<NurbsCurve> lo = row(*sides, v.lo), hi = row(*sides, v.hi);
  if (!lo || !hi) return tl::unexpected<Error>(lo ? hi.error() : lo.error());
  ParameterMap map = is_affine(a->map) ? identity({0, 1}) : a->map;
  const Interval unit{0, 1};
  const Interval part{map_to_nurbs(map, unit.clamp(u.lo)), map_to_nurbs(map, unit.clamp(u.hi))};
  return packed(between(*lo, *hi, part, v), std::move(map), identity(v), std::max(a->deviation, b->deviation));
}

// ---- Others

Result<ToNurbsSurface> convert(const OffsetSurface&, Interval, Interval) {
  return fail(ErrorCode::Unsupported, "an offset surface is no rational spline; it has to be approximated");
}
Result<ToNurbsSurface> convert(const NurbsSurface& s, Interval u, Interval v) {
  const Interval in_u{s.domain_u().clamp(u.lo), s.domain_u().clamp(u.hi)},
      in_v{s.domain_v().clamp(v.lo), s.domain_v().clamp(v.hi)};
  return packed(
      NurbsSurface::from_homogeneous(s.degree_u(), s.degree_v(), s.knots_u(), s.knots_v(), s.poles(), in_u, in_v),
      identity(in_u), identity(in_v));
}

}  // namespace

Result<ToNurbsSurface> to_nurbs(const Surface& s, Interval u, Interval v) {
  if (!u.is_bounded() || !v.is_bounded() || !(u.lo < u.hi) || !(v.lo < v.hi))
    return fail(ErrorCode::InvalidArgument, "a spline surface needs a bounded rectangle with area");
  return std::visit([&](const auto& shape) { return convert(shape, u, v); }, s.shape);
}

}  // namespace trimloop
