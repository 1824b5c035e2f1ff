// Surfaces moved by affine maps, with what happens to their parameters.
//
// A similarity keeps every type. A mirror would make the frame of a turned surface left-handed, so its y axis is turned
// over and u runs the other way: u' = 2 pi - u, which maps the domain onto itself. Lengths among the parameters (plane,
// cylinder, cone) are scaled.

#include "kernel/geometry/detail.h"

namespace trimloop {
namespace {

struct Moved {
  Surface surface;
  UvMap map;
};

tl::unexpected<Error> uneven(const char* what) {
  return fail(ErrorCode::Unsupported, std::string(what) + " cannot be scaled unevenly; as a NURBS surface it can");
}

// x, y span the plane of the parameters: u' = |Rx| u + (Ry . x') v, v' = (Ry . y') v.
Result<Moved> moved(const Plane& s, const Transform& m, bool) {
  const Vector x = apply(m, s.frame.x), y = apply(m, s.frame.y);
  const Vector unit = normalized(x), across = y - dot(y, unit) * unit;
  if (!(norm(x) > 0) || !(norm(across) > 1e-14 * norm(y)))
    return fail(ErrorCode::Degenerate, "the transformation collapses the plane");
  const Vector y1 = normalized(across);
  UvMap map;
  map.uu = norm(x);
  map.uv = dot(y, unit);
  map.vv = norm(across);
  return Moved{{Plane{{apply(m, s.frame.origin), unit, y1, cross(unit, y1)}}}, map};
}

// Frame and parameter map of a turned surface under a similarity; `v_scale` for a v that is a length.
struct Turned {
  Frame frame;
  UvMap map;
};
Turned turned(const Frame& f, const Transform& m, double v_scale) {
  const double side = determinant(m) < 0 ? -1 : 1;
  Turned out;
  out.frame = make_frame(apply(m, f.origin), apply(m, f.z), apply(m, f.x));
  if (side < 0) {
    out.map.uu = -1;
    out.map.u0 = two_pi;
  }
  out.map.vv = v_scale;
  return out;
}

// Unevenly scaled, a cylinder is the extrusion of an ellipse along what was its axis.
Result<Moved> moved(const Cylinder& s, const Transform& m, bool similar) {
  const double scale = scale_factor(m);
  if (similar) {
    const Turned t = turned(s.frame, m, scale);
    return Moved{{Cylinder{t.frame, s.radius * scale}}, t.map};
  }
  Result<Curve> section = transformed(Curve{Circle{s.frame, s.radius}}, m);
  if (!section) return tl::unexpected<Error>(section.error());
  UvMap map;
  map.u0 = range(*section).lo;
  return Moved{
      {Extrusion{std::make_shared<const Curve>(std::move(*section)), apply(m, s.frame.z), {-infinity, infinity}}}, map};
}
Result<Moved> moved(const Cone& s, const Transform& m, bool similar) {
  if (!similar) return uneven("a cone");
  const double scale = scale_factor(m);
  const Turned t = turned(s.frame, m, scale);
  return Moved{{Cone{t.frame, s.radius * scale, s.half_angle_rad}}, t.map};
}
Result<Moved> moved(const Sphere& s, const Transform& m, bool similar) {
  if (!similar) return uneven("a sphere");
  const Turned t = turned(s.frame, m, 1);
  return Moved{{Sphere{t.frame, s.radius * scale_factor(m)}}, t.map};
}
Result<Moved> moved(const Torus& s, const Transform& m, bool similar) {
  if (!similar) return uneven("a torus");
  const double scale = scale_factor(m);
  const Turned t = turned(s.frame, m, 1);
  return Moved{{Torus{t.frame, s.major_radius * scale, s.minor_radius * scale}}, t.map};
}

// A mirror turns rotations round; the opposite axis keeps u.
Result<Moved> moved(const Revolution& s, const Transform& m, bool similar) {
  if (!similar) return uneven("a surface of revolution");
  if (!s.generatrix) return Moved{{s}, {}};
  Result<Curve> generatrix = transformed(*s.generatrix, m);
  if (!generatrix) return tl::unexpected<Error>(generatrix.error());
  const double side = determinant(m) < 0 ? -1 : 1;
  return Moved{{Revolution{apply(m, s.axis_origin), side * normalized(apply(m, s.axis)),
                           std::make_shared<const Curve>(std::move(*generatrix)), s.range_u}},
               {}};
}
Result<Moved> moved(const Extrusion& s, const Transform& m, bool) {
  if (!s.directrix) return Moved{{s}, {}};
  Result<Curve> directrix = transformed(*s.directrix, m);
  if (!directrix) return tl::unexpected<Error>(directrix.error());
  UvMap map;  // a conic may begin at another parameter
  if (is_bounded(*s.directrix)) map.u0 = range(*directrix).lo - range(*s.directrix).lo;
  return Moved{{Extrusion{std::make_shared<const Curve>(std::move(*directrix)), apply(m, s.direction), s.range_v}},
               map};
}
Result<Moved> moved(const Ruled& s, const Transform& m, bool similar) {
  if (!similar && s.equal_arc_length) return uneven("a ruled surface over arc lengths");
  if (!s.first || !s.second) return Moved{{s}, {}};
  Result<Curve> first = transformed(*s.first, m), second = transformed(*s.second, m);
  if (!first) return tl::unexpected<Error>(first.error());
  if (!second) return tl::unexpected<Error>(second.error());
  return Moved{{make_ruled(std::make_shared<const Curve>(std::move(*first)),
                           std::make_shared<const Curve>(std::move(*second)), s.second_reversed, s.equal_arc_length)},
               {}};
}
// The normal turns over once when the map of space mirrors, and once more when the map of parameters does.
Result<Moved> moved(const OffsetSurface& s, const Transform& m, bool similar) {
  if (!similar) return uneven("an offset surface");
  if (!s.basis) return Moved{{s}, {}};
  Result<Surface> basis = transformed(*s.basis, m);
  if (!basis) return tl::unexpected<Error>(basis.error());
  const UvMap map = parameter_map(*s.basis, m);
  const double side = (determinant(m) < 0) != (map.uu * map.vv - map.uv * map.vu < 0) ? -1 : 1;
  return Moved{{OffsetSurface{std::make_shared<const Surface>(std::move(*basis)), side * s.distance * scale_factor(m)}},
               map};
}
Result<Moved> moved(const NurbsSurface& s, const Transform& m, bool) { return Moved{{transformed(s, m)}, {}}; }

Result<Moved> moved(const Surface& s, const Transform& m) {
  if (is_identity(m)) return Moved{s, {}};
  if (!std::isfinite(determinant(m)) || !is_finite(m.t))
    return fail(ErrorCode::InvalidArgument, "the transformation has entries that are not finite");
  return std::visit([&](const auto& shape) { return moved(shape, m, detail::is_similarity(m)); }, s.shape);
}

}  // namespace

Result<Surface> transformed(const Surface& s, const Transform& m) {
  Result<Moved> out = moved(s, m);
  if (!out) return tl::unexpected<Error>(std::move(out.error()));
  return std::move(out->surface);
}

UvMap parameter_map(const Surface& s, const Transform& m) {
  const Result<Moved> out = moved(s, m);
  return out ? out->map : UvMap{};
}

Uv apply(const UvMap& m, Uv p) { return {m.uu * p.u + m.uv * p.v + m.u0, m.vu * p.u + m.vv * p.v + m.v0}; }

}  // namespace trimloop
