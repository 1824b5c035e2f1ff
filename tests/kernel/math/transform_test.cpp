#include "kernel/math/transform.h"

#include <boost/test/unit_test.hpp>

using namespace trimloop;

namespace {

const Transform mirror_x = [] {
  Transform m;
  m.r[0][0] = -1;
  return m;
}();

Transform skewed() {
  Transform m;
  m.r = {{{1, 0.5, 0}, {0, 2, 0}, {0.25, 0, 3}}};
  m.t = {7, 8, 9};
  return m;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_translation_moves_points_and_leaves_directions) {
  const Transform m = Transform::translation({1, 2, 3});
  BOOST_TEST(distance(apply(m, Point{4, 5, 6}), {5, 7, 9}) == 0);
  BOOST_TEST(norm(apply(m, Vector{4, 5, 6}) - Vector{4, 5, 6}) == 0);
}

BOOST_AUTO_TEST_CASE(a_rotation_is_right_handed_and_keeps_its_axis) {
  const Transform quarter = Transform::rotation({0, 0, 0}, {0, 0, 5}, pi / 2);
  BOOST_TEST(distance(apply(quarter, Point{1, 0, 0}), {0, 1, 0}) < 1e-15);
  const Point on_axis{3, -2, 1};
  const Vector axis{1, 2, -2};
  const Transform m = Transform::rotation(on_axis, axis, 1.1);
  BOOST_TEST(distance(apply(m, on_axis + 4 * axis), on_axis + 4 * axis) < 1e-14);
  BOOST_TEST(std::abs(determinant(m) - 1) < 1e-15);
  BOOST_TEST(deviation_from_similarity(m) < 1e-15);
  // Three turns of a third are none.
  const Transform third = Transform::rotation(on_axis, axis, two_pi / 3), full = third * third * third;
  BOOST_TEST(distance(apply(full, Point{5, 6, 7}), {5, 6, 7}) < 1e-14);
  BOOST_TEST(is_identity(Transform::rotation(on_axis, {0, 0, 0}, 1)));  // no axis, no rotation
  BOOST_TEST(is_identity(Transform::rotation(on_axis, axis, 0)));
}

BOOST_AUTO_TEST_CASE(a_tiny_rotation_keeps_its_digits) {
  const Transform m = Transform::rotation({0, 0, 0}, {0, 0, 1}, 1e-9);
  BOOST_TEST(m.r[1][0] == 1e-9);
  BOOST_TEST(m.r[2][2] == 1);
}

BOOST_AUTO_TEST_CASE(a_product_applies_the_right_one_first) {
  const Transform a = skewed(), b = Transform::rotation({1, 0, 0}, {0, 1, 1}, 0.3);
  const Point p{2, -1, 4};
  const Vector v{2, -1, 4};
  BOOST_TEST(distance(apply(a * b, p), apply(a, apply(b, p))) < 1e-14);
  BOOST_TEST(norm(apply(a * b, v) - apply(a, apply(b, v))) < 1e-14);
  BOOST_TEST(std::abs(determinant(a * b) - 6) < 1e-14);
}

BOOST_AUTO_TEST_CASE(scale_and_similarity_are_told_apart_from_skew) {
  const Transform m = Transform::scale(-2.5);
  BOOST_TEST(std::abs(scale_factor(m) - 2.5) < 1e-15);
  BOOST_TEST(deviation_from_similarity(m) < 1e-15);
  BOOST_TEST(determinant(mirror_x) == -1);
  BOOST_TEST(deviation_from_similarity(mirror_x * Transform::scale(1e-8)) < 1e-14);
  Transform stretched = Transform::scale(1);
  stretched.r[2][2] = 8;  // scale factor 2: the worst entry of R^T R is 64, against 4
  BOOST_TEST(std::abs(deviation_from_similarity(stretched) - 15) < 1e-13);
  BOOST_TEST(deviation_from_similarity(Transform::scale(0)) == infinity);
  BOOST_TEST(deviation_from_similarity(Transform::scale(std::nan(""))) == infinity);
}

BOOST_AUTO_TEST_CASE(the_identity_is_recognised_exactly) {
  BOOST_TEST(is_identity({}));
  BOOST_TEST(is_identity(Transform::scale(1)));
  BOOST_TEST(!is_identity(Transform::scale(1 + 1e-15)));
  BOOST_TEST(!is_identity(Transform::translation({0, 1e-300, 0})));
  BOOST_TEST(!is_identity(mirror_x));
}
