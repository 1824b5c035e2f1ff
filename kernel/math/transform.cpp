#include "kernel/math/transform.h"

namespace trimloop {

Transform Transform::translation(Vector v) {
  Transform m;
  m.t = v;
  return m;
}

Transform Transform::scale(double s) {
  Transform m;
  for (std::size_t i = 0; i < 3; ++i) m.r[i][i] = s;
  return m;
}

// Rodrigues: R = cos I + (1 - cos) a a^T + sin [a]x, with 1 - cos = 2 sin^2(angle/2) so that small angles keep their
// digits.
Transform Transform::rotation(Point on_axis, Vector axis, double angle_rad) {
  const Vector a = normalized(axis);
  if (norm(a) == 0) return {};
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  const double half = std::sin(0.5 * angle_rad), k = 2 * half * half;
  Transform m;
  m.r = {{{c + k * a.x * a.x, k * a.x * a.y - s * a.z, k * a.x * a.z + s * a.y},
          {k * a.y * a.x + s * a.z, c + k * a.y * a.y, k * a.y * a.z - s * a.x},
          {k * a.z * a.x - s * a.y, k * a.z * a.y + s * a.x, c + k * a.z * a.z}}};
  m.t = on_axis - apply(m, on_axis);
  return m;
}

Vector apply(const Transform& m, Vector v) {
  return {m.r[0][0] * v.x + m.r[0][1] * v.y + m.r[0][2] * v.z, m.r[1][0] * v.x + m.r[1][1] * v.y + m.r[1][2] * v.z,
          m.r[2][0] * v.x + m.r[2][1] * v.y + m.r[2][2] * v.z};
}

Point apply(const Transform& m, Point p) { return to_point(apply(m, to_vector(p)) + m.t); }

Transform operator*(const Transform& after, const Transform& before) {
  Transform m;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      m.r[i][j] = after.r[i][0] * before.r[0][j] + after.r[i][1] * before.r[1][j] + after.r[i][2] * before.r[2][j];
  m.t = apply(after, before.t) + after.t;
  return m;
}

double determinant(const Transform& m) {
  const auto& r = m.r;
  return r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) - r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
         r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
}

bool is_identity(const Transform& m) { return m.r == Transform{}.r && m.t.x == 0 && m.t.y == 0 && m.t.z == 0; }

double deviation_from_similarity(const Transform& m) {
  const double s = scale_factor(m), square = s * s;
  if (!(square > 0)) return infinity;  // singular, or not a number
  double worst = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      double entry = i == j ? -square : 0;
      for (std::size_t k = 0; k < 3; ++k) entry += m.r[k][i] * m.r[k][j];
      worst = std::max(worst, std::abs(entry) / square);
    }
  return worst;
}

double scale_factor(const Transform& m) { return std::cbrt(std::abs(determinant(m))); }

}  // namespace trimloop
