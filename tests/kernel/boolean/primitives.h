#pragma once
// Primitives at random places, for ourselves and for others (tests/oracle/booleans.cpp).

#include <random>

#include "kernel/solids/primitives.h"

namespace trimloop::test {

enum class PrimitiveKind { Block, Cylinder, Cone, Sphere, Torus, Ellipsoid };

struct Primitive {
  PrimitiveKind kind = PrimitiveKind::Block;
  Frame frame;
  double a = 1, b = 1, c = 1;  // sides; radius, height; radii and height; radius; radii; semi-axes
};

inline Primitive random_primitive(std::mt19937& bits) {
  const auto between = [&](double lo, double hi) { return lo + (hi - lo) * (static_cast<double>(bits()) / 4294967296.0); };
  const auto vector = [&] {
    const double x = between(-1, 1), y = between(-1, 1), z = between(-1, 1);
    return Vector{x, y, z};
  };
  Primitive out;
  const Vector origin = vector(), axis = vector(), x = vector();
  out.frame = make_frame(to_point(origin), axis, x);
  const double a = between(0.5, 2), b = between(0.5, 2), c = between(0.5, 2);
  out.kind = static_cast<PrimitiveKind>(bits() % 6);
  switch (out.kind) {
    case PrimitiveKind::Block: out.a = a, out.b = b, out.c = c; break;
    case PrimitiveKind::Cylinder: out.a = 0.6 * a, out.b = b; break;
    case PrimitiveKind::Cone: out.a = 0.7 * a, out.b = a > 1 ? 0 : 0.5 * b, out.c = c; break;
    case PrimitiveKind::Sphere: out.a = 0.7 * a; break;
    case PrimitiveKind::Torus: out.a = 0.7 * std::max(a, b) + 0.1, out.b = 0.4 * std::min(a, b); break;
    case PrimitiveKind::Ellipsoid: out.a = 0.7 * a, out.b = 0.7 * b, out.c = 0.7 * c; break;
  }
  return out;
}

inline Result<Body> body_of(const Primitive& p) {
  switch (p.kind) {
    case PrimitiveKind::Block: return make_block(p.frame, p.a, p.b, p.c);
    case PrimitiveKind::Cylinder: return make_cylinder(p.frame, p.a, p.b);
    case PrimitiveKind::Cone: return make_cone(p.frame, p.a, p.b, p.c);
    case PrimitiveKind::Sphere: return make_sphere(p.frame, p.a);
    case PrimitiveKind::Torus: return make_torus(p.frame, p.a, p.b);
    default: return make_ellipsoid(p.frame, p.a, p.b, p.c);
  }
}

}  // namespace trimloop::test
