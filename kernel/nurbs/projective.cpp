#include "kernel/nurbs/projective.h"

#include <fmt/format.h>

namespace trimloop {
namespace {

Result<std::vector<Hpoint>> mapped(const std::vector<Hpoint>& poles, const Projective& map) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      if (!std::isfinite(map.m[i][j]))
        return fail(ErrorCode::InvalidArgument, fmt::format("entry ({}, {}) of the map is not finite", i, j),
                    map.m[i][j]);
  std::vector<Hpoint> out;
  out.reserve(poles.size());
  bool finite = false;
  for (const Hpoint& h : poles) {
    out.push_back(apply(map, h));
    finite = finite || out.back().w != 0;
  }
  if (!finite) return fail(ErrorCode::Degenerate, "the map takes all of the shape to infinity");
  return out;
}

}  // namespace

Hpoint apply(const Projective& map, const Hpoint& h) {
  const auto row = [&](std::size_t i) {
    const auto& m = map.m[i];
    return m[0] * h.x + m[1] * h.y + m[2] * h.z + m[3] * h.w;
  };
  return {row(0), row(1), row(2), row(3)};
}

Point apply(const Projective& map, Point p) { return project(apply(map, Hpoint{p.x, p.y, p.z, 1})); }

Projective operator*(const Projective& after, const Projective& before) {
  Projective out;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      out.m[i][j] = 0;
      for (std::size_t k = 0; k < 4; ++k) out.m[i][j] += after.m[i][k] * before.m[k][j];
    }
  return out;
}

// p -> eye + (p - eye) h / (n . (eye - p)) with h = n . (eye - on_plane), written without division.
Result<Projective> perspective(Point eye, Point on_plane, Vector normal) {
  const Vector n = normalized(normal);
  const double h = dot(n, eye - on_plane);
  if (!(std::abs(h) > 0)) return fail(ErrorCode::Degenerate, "the eye lies in the plane of projection", h, 0);
  const std::array<double, 3> e{eye.x, eye.y, eye.z}, k{n.x, n.y, n.z};
  const double far = dot(n, to_vector(eye));
  Projective out;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) out.m[i][j] = (i == j ? h : 0) - e[i] * k[j];
    out.m[i][3] = e[i] * (far - h);
  }
  out.m[3] = {-k[0], -k[1], -k[2], far};
  return out;
}

Result<NurbsCurve> transformed(const NurbsCurve& c, const Projective& map) {
  auto poles = mapped(c.poles(), map);
  if (!poles) return tl::unexpected<Error>(poles.error());
  return NurbsCurve::from_homogeneous(c.degree(), c.knots(), std::move(*poles), c.range());
}

Result<NurbsSurface> transformed(const NurbsSurface& s, const Projective& map) {
  auto poles = mapped(s.poles(), map);
  if (!poles) return tl::unexpected<Error>(poles.error());
  return NurbsSurface::from_homogeneous(s.degree_u(), s.degree_v(), s.knots_u(), s.knots_v(), std::move(*poles),
                                        s.range_u(), s.range_v());
}

}  // namespace trimloop
