#pragma once
// Affine map p -> R p + t, stored by rows.

#include <array>

#include "kernel/math/vec.h"

namespace trimloop {

struct Transform {
  std::array<std::array<double, 3>, 3> r{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vector t;

  static Transform translation(Vector v);
  static Transform scale(double s);
  static Transform rotation(Point on_axis, Vector axis, double angle_rad);
};

Point apply(const Transform&, Point);
Vector apply(const Transform&, Vector);            // directions: no translation
Transform operator*(const Transform& after, const Transform& before);
double determinant(const Transform&);
bool is_identity(const Transform&);
// How far R is from s times an orthonormal matrix: max |R^T R - s^2 I| / s^2 with s = cbrt(|det|).
double deviation_from_similarity(const Transform&);
double scale_factor(const Transform&);             // cbrt(|det|)

}  // namespace trimloop
