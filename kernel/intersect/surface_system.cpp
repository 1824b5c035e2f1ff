// Newton's method and tangents for arcs of two patches.

#include "kernel/intersect/surface_cells.h"

namespace trimloop::detail {
namespace {

struct Linear {
  std::array<double, 3> value{};
  std::array<std::array<double, 4>, 3> slope{};
};

Linear linearised(const Bezier& a, const Bezier& b, const ArcSystem& system, const Parameters& x) {
  const BezierJet p = jet(a, x[0], x[1]), q = jet(b, x[2], x[3]);
  const Vector f = p.point - q.point;
  const std::array<Vector, 4> j{p.du, p.dv, -q.du, -q.dv};
  Linear out;
  if (!system.ridge) {
    out.value = {f.x, f.y, f.z};
    for (std::size_t c = 0; c < 4; ++c) out.slope[0][c] = j[c].x, out.slope[1][c] = j[c].y, out.slope[2][c] = j[c].z;
    return out;
  }
  const Vector n = cross(p.du, p.dv), m = cross(q.du, q.dv);
  const Vector nu = cross(p.duu, p.dv) + cross(p.du, p.duv), nv = cross(p.duv, p.dv) + cross(p.du, p.dvv);
  const Vector ms = cross(q.duu, q.dv) + cross(q.du, q.duv), mt = cross(q.duv, q.dv) + cross(q.du, q.dvv);
  // The third equation is scaled to the size of the others.
  const double scale = 1 / std::max(1e-300, norm(n) * norm(m)) * std::sqrt(std::max(norm(n), norm(m)));
  out.value = {dot(f, system.e1), dot(f, system.e2), scale * dot(cross(n, m), system.e2)};
  const std::array<Vector, 4> third{cross(nu, m), cross(nv, m), cross(n, ms), cross(n, mt)};
  for (std::size_t c = 0; c < 4; ++c) {
    out.slope[0][c] = dot(j[c], system.e1);
    out.slope[1][c] = dot(j[c], system.e2);
    out.slope[2][c] = scale * dot(third[c], system.e2);
  }
  return out;
}

double determinant(const Linear& l, int skip) {
  int c[3], n = 0;
  for (int i = 0; i < 4; ++i)
    if (i != skip) c[n++] = i;
  const auto& s = l.slope;
  return s[0][c[0]] * (s[1][c[1]] * s[2][c[2]] - s[1][c[2]] * s[2][c[1]]) -
         s[0][c[1]] * (s[1][c[0]] * s[2][c[2]] - s[1][c[2]] * s[2][c[0]]) +
         s[0][c[2]] * (s[1][c[0]] * s[2][c[1]] - s[1][c[1]] * s[2][c[0]]);
}

// Cramer's rule for the three unknowns other than k.
bool newton_step(const Linear& l, int k, Parameters& step) {
  const double det = determinant(l, k);
  if (det == 0 || !std::isfinite(det)) return false;
  int c[3], n = 0;
  for (int i = 0; i < 4; ++i)
    if (i != k) c[n++] = i;
  step[k] = 0;
  for (int i = 0; i < 3; ++i) {
    Linear replaced = l;
    for (int r = 0; r < 3; ++r) replaced.slope[r][c[i]] = -l.value[r];
    step[c[i]] = determinant(replaced, k) / det;
    if (!std::isfinite(step[c[i]])) return false;
  }
  return true;
}

}  // namespace

bool solve_on_arc(const Bezier& a, const Bezier& b, const ArcSystem& system, int k, Parameters& x) {
  double last = infinity;
  for (int iteration = 0; iteration < 30; ++iteration) {
    Parameters step{};
    if (!newton_step(linearised(a, b, system, x), k, step)) return false;
    double size = 0;
    for (int i = 0; i < 4; ++i) {
      step[i] = std::clamp(step[i], -0.25, 0.25);
      x[i] += step[i];
      size = std::max(size, std::abs(step[i]));
    }
    if (size < 1e-15 || (size < 1e-11 && size >= 0.5 * last)) return true;
    last = size;
  }
  return last < 1e-9;
}

bool arc_direction(const Bezier& a, const Bezier& b, const ArcSystem& system, const Parameters& x, Parameters& step,
                   Vector& tangent) {
  const Linear l = linearised(a, b, system, x);
  for (int k = 0; k < 4; ++k) step[k] = (k % 2 ? -1 : 1) * determinant(l, k);
  const BezierJet p = jet(a, x[0], x[1]);
  tangent = step[0] * p.du + step[1] * p.dv;
  const double size = norm(tangent);
  if (!(size > 0) || !std::isfinite(size)) return false;
  for (double& s : step) s /= size;
  tangent = tangent / size;
  return true;
}

}  // namespace trimloop::detail
