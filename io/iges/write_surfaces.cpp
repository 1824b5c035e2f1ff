// Surfaces -> 128, 118, 120, 122 and 140 records, each with the affine map from our parameters to the record's.

#include <fmt/format.h>

#include "formats/iges/records/surfaces.h"
#include "io/iges/entity_writer.h"

namespace trimloop::io::iges_export {

namespace {

// (u, v) -> (a u + b, c v + d), or with the two exchanged afterwards.
Transform affine(double a, double b, double c, double d, bool exchange = false) {
  Transform t;
  t.r = {{{a, 0, 0}, {0, c, 0}, {0, 0, 1}}};
  t.t = {b, d, 0};
  if (exchange) {
    std::swap(t.r[0], t.r[1]);
    std::swap(t.t.x, t.t.y);
  }
  return t;
}

struct Writing {
  EntityWriter& writer;
  Interval u, v;
  bool flip, to_nurbs;
  Role role;
  AttributesId attributes;

  template <class Record>
  iges::Ref add(const Record& record, int form = 0) const {
    return writer.add(record, role, form, nullptr, attributes);
  }
};

iges::RationalBSplineSurface record_of(const NurbsSurface& s, const Units& units, const SurfaceDomain& d) {
  iges::RationalBSplineSurface out;
  out.upper_u = static_cast<int>(s.poles_u()) - 1;
  out.upper_v = static_cast<int>(s.poles_v()) - 1;
  out.degree_u = s.degree_u();
  out.degree_v = s.degree_v();
  out.closed_u = d.closed_u;
  out.closed_v = d.closed_v;
  out.polynomial = !s.is_rational();
  out.knots_u = s.knots_u();
  out.knots_v = s.knots_v();
  for (std::size_t j = 0; j < s.poles_v(); ++j) {
    for (std::size_t i = 0; i < s.poles_u(); ++i) {
      const Hpoint& h = s.pole(i, j);
      out.weights.push_back(h.w);
      out.points.push_back(units.point(h.w != 0 ? project(h) : Point{h.x, h.y, h.z}));
    }
  }
  out.u0 = s.range_u().lo;
  out.u1 = s.range_u().hi;
  out.v0 = s.range_v().lo;
  out.v1 = s.range_v().hi;
  return out;
}

WrittenSurface write_nurbs(const Writing& w, const NurbsSurface& s) {
  const NurbsSurface used = w.flip ? swapped(s) : s;
  return {w.add(record_of(used, w.writer.units, domain(Surface{used}))), affine(1, 0, 1, 0, w.flip), {}};
}

ParameterMap identity_over(Interval r) {
  ParameterMap map;
  map.own = map.nurbs = {r.lo, r.hi};
  map.pieces.resize(1);
  return map;
}

// A generatrix, directrix or rail as a record can hold it: the curve itself, or the NURBS it is equal to and how the
// parameter goes over to it.
struct Profile {
  Curve curve;
  std::optional<ParameterMap> bend;
};

Result<Profile> profile_of(const Curve& curve) {
  if (recorded_range(curve)) return Profile{curve, {}};
  auto nurbs = to_nurbs(curve);
  if (!nurbs) return tl::unexpected(nurbs.error());
  return Profile{Curve{std::move(nurbs->curve)}, std::move(nurbs->map)};
}

// 120 turns a generatrix about a line; its first parameter runs along the generatrix, its second is the angle, so its
// normal is opposite to that of our (angle, generatrix). The generatrix is turned round where that must not be.
Result<WrittenSurface> write_revolved(const Writing& w, Point origin, Vector axis, const Curve& given) {
  auto profile = profile_of(given);
  if (!profile) return tl::unexpected(profile.error());
  const Interval own = range(profile->curve);  // v of our surface, bent
  const bool turned = !w.flip;
  const Curve generatrix = turned ? reversed(profile->curve) : std::move(profile->curve);
  iges::SurfaceOfRevolution out;
  Line line;
  line.start = origin;
  line.end = origin + axis;
  out.axis = write_curve(w.writer, Curve{line}, Role::Child);
  out.generatrix = write_curve(w.writer, generatrix, Role::Child);
  if (!out.generatrix) return fail(ErrorCode::Unsupported, "its generatrix has no record");
  out.start_angle = w.u.lo;
  out.end_angle = std::min(w.u.hi, w.u.lo + 2 * pi);  // a loop may pass a little beyond the seam
  const Interval r = recorded_range(generatrix).value_or(own);
  const double a = (turned ? -1 : 1) * r.length() / own.length();
  WrittenSurface written{w.add(out), affine(1, 0, a, r.lo - a * (turned ? own.hi : own.lo), true), {}};
  if (profile->bend) written.bend = Bend{identity_over(w.u), std::move(*profile->bend)};
  return written;
}

Curve profile_line(Point a, Point b, Interval range_as) {
  // A line whose parameter is the profile parameter itself.
  Line line;
  line.start = a - range_as.lo / range_as.length() * (b - a);
  line.end = line.start + (b - a) / range_as.length();
  line.range = range_as;
  return Curve{line};
}

struct Dispatch {
  const Writing& w;
  const Surface& whole;

  Result<WrittenSurface> exact_nurbs() const {
    auto nurbs = trimloop::to_nurbs(whole, w.u, w.v);
    if (!nurbs) return tl::unexpected(nurbs.error());
    WrittenSurface out = write_nurbs(w, nurbs->surface);
    const auto is_affine = [](const ParameterMap& m) {
      return m.pieces.size() == 1 && m.pieces[0].kind == ParameterMap::Kind::Affine;
    };
    if (is_affine(nurbs->map_u) && is_affine(nurbs->map_v)) {
      const auto scale = [](const ParameterMap& m) { return (m.nurbs[1] - m.nurbs[0]) / (m.own[1] - m.own[0]); };
      const double a = scale(nurbs->map_u), c = scale(nurbs->map_v);
      out.map = out.map * affine(a, nurbs->map_u.nurbs[0] - a * nurbs->map_u.own[0], c,
                                 nurbs->map_v.nurbs[0] - c * nurbs->map_v.own[0]);
    } else {
      out.bend = Bend{std::move(nurbs->map_u), std::move(nurbs->map_v)};
    }
    return out;
  }
  Result<WrittenSurface> operator()(const NurbsSurface& s) const { return write_nurbs(w, s); }
  Result<WrittenSurface> operator()(const Plane&) const { return exact_nurbs(); }
  Result<WrittenSurface> operator()(const Cylinder& s) const {
    const auto at = [&](double v) { return s.frame.origin + s.radius * s.frame.x + v * s.frame.z; };
    return write_revolved(w, s.frame.origin, s.frame.z, profile_line(at(w.v.lo), at(w.v.hi), w.v));
  }
  Result<WrittenSurface> operator()(const Cone& s) const {
    const auto at = [&](double v) {
      return s.frame.origin + (s.radius + v * std::tan(s.half_angle_rad)) * s.frame.x + v * s.frame.z;
    };
    return write_revolved(w, s.frame.origin, s.frame.z, profile_line(at(w.v.lo), at(w.v.hi), w.v));
  }
  Result<WrittenSurface> operator()(const Sphere& s) const {
    return arc_profile(s.frame, s.frame.origin, s.radius);
  }
  Result<WrittenSurface> operator()(const Torus& s) const {
    return arc_profile(s.frame, s.frame.origin + s.major_radius * s.frame.x, s.minor_radius);
  }
  Result<WrittenSurface> arc_profile(const Frame& frame, Point centre, double radius) const {
    Circle arc;  // in the half plane of x and z: angle from x towards z
    arc.frame.origin = centre;
    arc.frame.x = frame.x;
    arc.frame.y = frame.z;
    arc.frame.z = cross(frame.x, frame.z);
    arc.radius = radius;
    arc.range = w.v;
    return write_revolved(w, frame.origin, frame.z, Curve{arc});
  }
  Result<WrittenSurface> operator()(const Revolution& s) const {
    return write_revolved(w, s.axis_origin, s.axis, *s.generatrix);
  }
  Result<WrittenSurface> operator()(const Extrusion& s) const {
    auto profile = profile_of(*s.directrix);
    if (!profile) return tl::unexpected(profile.error());
    const Interval r = range(profile->curve);
    const Curve directrix = w.flip ? reversed(profile->curve) : std::move(profile->curve);
    iges::TabulatedCylinder out;
    // The record's directrix lies at v = w.v.lo and its generatrix reaches w.v.hi.
    const auto moved = transformed(directrix, Transform::translation(w.v.lo * s.direction));
    if (!moved) return tl::unexpected(moved.error());
    out.directrix = write_curve(w.writer, *moved, Role::Child);
    if (!out.directrix) return fail(ErrorCode::Unsupported, "its directrix has no record");
    out.terminate_point = w.writer.units.point(start_point(*moved) + w.v.length() * s.direction);
    const double a = (w.flip ? -1 : 1) / r.length(), c = 1 / w.v.length();
    WrittenSurface written{w.add(out), affine(a, (w.flip ? r.hi : -r.lo) / r.length(), c, -w.v.lo * c), {}};
    if (profile->bend) written.bend = Bend{std::move(*profile->bend), identity_over(w.v)};
    return written;
  }
  Result<WrittenSurface> operator()(const Ruled& s) const {
    // Rulings join equal parameters, so rails that cannot keep theirs are written as one NURBS with the surface.
    const bool kept = s.equal_arc_length || (recorded_range(*s.first) && recorded_range(*s.second));
    if (!kept) return exact_nurbs();
    iges::RuledSurface out;
    out.first = write_curve(w.writer, w.flip ? reversed(*s.first) : *s.first, Role::Child);
    out.second = write_curve(w.writer, w.flip ? reversed(*s.second) : *s.second, Role::Child);
    if (!out.first || !out.second) return fail(ErrorCode::Unsupported, "one of its rails has no record");
    out.reverse_second = s.second_reversed;
    const iges::Ref ref = w.add(out, s.equal_arc_length ? 0 : 1);
    return WrittenSurface{ref, w.flip ? affine(-1, 1, 1, 0) : Transform{}, {}};
  }
  Result<WrittenSurface> operator()(const OffsetSurface& s) const {
    Writing basis_writing = w;
    basis_writing.role = Role::Child;
    const auto basis = std::visit(Dispatch{basis_writing, *s.basis}, s.basis->shape);
    if (!basis) return basis;
    const Vector n = normal(*s.basis, {w.u.mid(), w.v.mid()});
    const Vector towards = s.distance < 0 ? -n : n;
    iges::OffsetSurface out;
    out.indicator = {towards.x, towards.y, towards.z};
    out.distance = w.writer.units.length(std::abs(s.distance));
    out.basis = basis->ref;
    return WrittenSurface{w.add(out), basis->map, basis->bend};
  }
};

}  // namespace

Result<WrittenSurface> write_surface(EntityWriter& writer, const Surface& surface, Interval u, Interval v, bool flip,
                                     bool to_nurbs, Role role, AttributesId attributes) {
  const Writing writing{writer, u, v, flip, to_nurbs, role, attributes};
  const Dispatch dispatch{writing, surface};
  if (to_nurbs) {
    if (auto nurbs = dispatch.exact_nurbs()) {
      ++writer.statement.exact_surfaces;
      return nurbs;
    }
  }
  return std::visit(dispatch, surface.shape);
}

}  // namespace trimloop::io::iges_export
