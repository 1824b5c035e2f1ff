// Seed 004 in rational arithmetic: joints, the B-spline inside, and subdivision by matrices, with no rounding anywhere.
#include <boost/multiprecision/cpp_int.hpp>
#include <boost/test/unit_test.hpp>

#include "kernel/splines/beta_spline.h"

using namespace trimloop;
using Rational = boost::multiprecision::cpp_rational;

namespace {

using Row = std::array<Rational, 4>;

struct Shape {
  Rational bias, tension;
};
const Shape shapes[] = {{1, 0}, {1, 5}, {Rational(3, 2), 0}, {5, 0}, {Rational(1, 7), 11}, {2, Rational(-1, 3)}};

Row at(const Matrix<Rational>& m, const Rational& t, int derivative) {
  Row row{};
  for (std::size_t r = 0; r < 4; ++r) {
    Rational sum = 0, power = 1;
    for (int k = derivative; k < 4; ++k) {
      Rational factor = 1;
      for (int j = 0; j < derivative; ++j) factor *= k - j;
      sum += factor * power * m(static_cast<std::size_t>(k), r);
      power *= t;
    }
    row[r] = sum;
  }
  return row;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(exact_beta_splines)

BOOST_AUTO_TEST_CASE(joints_meet_the_defining_conditions) {
  for (const Shape& s : shapes) {
    const auto m = beta_basis(s.bias, s.tension);
    const Row end = at(m, 1, 0), slope = at(m, 1, 1), bend = at(m, 1, 2);
    const Row begin = at(m, 0, 0), slope_after = at(m, 0, 1), bend_after = at(m, 0, 2);
    for (std::size_t point = 0; point < 5; ++point) {  // of the five that two neighbouring segments share
      const auto left = [&](const Row& row) { return point < 4 ? row[point] : Rational(0); };
      const auto right = [&](const Row& row) { return point > 0 ? row[point - 1] : Rational(0); };
      BOOST_TEST(left(end) == right(begin));
      BOOST_TEST(s.bias * left(slope) == right(slope_after));
      BOOST_TEST(s.bias * s.bias * left(bend) + s.tension * left(slope) == right(bend_after));
    }
    for (const Rational& t : {Rational(0), Rational(2, 7), Rational(1)}) {
      const Row b = at(m, t, 0);
      BOOST_TEST(b[0] + b[1] + b[2] + b[3] == 1);
    }
  }
}

BOOST_AUTO_TEST_CASE(bias_one_without_tension_is_the_uniform_cubic_b_spline) {
  const auto m = beta_basis<Rational>(1, 0);
  const int sixths[4][4] = {{1, 4, 1, 0}, {-3, 0, 3, 0}, {3, -6, 3, 0}, {-1, 3, -3, 1}};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) BOOST_TEST(m(i, j) == Rational(sixths[i][j], 6));
}

BOOST_AUTO_TEST_CASE(without_tension_it_is_the_b_spline_over_geometric_knots) {
  for (const Rational& bias : {Rational(1), Rational(3, 2), Rational(5), Rational(2, 3)}) {
    // Knots -3 .. 4 of a span of length 1 at [0, 1].
    std::vector<Rational> knots{0};
    Rational step = 1;
    for (int i = 0; i < 3; ++i) step /= bias, knots.insert(knots.begin(), knots.front() - step);
    step = 1;
    for (int i = 0; i < 4; ++i) knots.push_back(knots.back() + step), step *= bias;
    const auto m = beta_basis<Rational>(bias, 0);
    for (const Rational& t : {Rational(0), Rational(1, 3), Rational(4, 5), Rational(1)}) {
      std::vector<Rational> n(7, Rational(0));  // Cox and de Boor
      n[3] = 1;
      for (std::size_t d = 1; d <= 3; ++d)
        for (std::size_t i = 0; i + d < 7; ++i)
          n[i] = (t - knots[i]) / (knots[i + d] - knots[i]) * n[i] +
                 (knots[i + d + 1] - t) / (knots[i + d + 1] - knots[i + 1]) * n[i + 1];
      const Row b = at(m, t, 0);
      for (std::size_t r = 0; r < 4; ++r) BOOST_TEST(b[r] == n[r]);
    }
  }
}

BOOST_AUTO_TEST_CASE(subdivision_matrices_divide_the_basis) {
  for (const Shape& s : shapes) {
    const auto m = beta_basis(s.bias, s.tension);
    for (const Rational& c : {Rational(1, 2), Rational(1, 3), Rational(9, 10)}) {
      const auto [left, right] = subdivision_matrices(m, c);
      for (const Rational& t : {Rational(0), Rational(1, 5), Rational(1, 2), Rational(1)}) {
        const Row whole_left = at(m, c * t, 0), whole_right = at(m, c + (1 - c) * t, 0), b = at(m, t, 0);
        for (std::size_t j = 0; j < 4; ++j) {
          Rational l = 0, r = 0;
          for (std::size_t k = 0; k < 4; ++k) l += b[k] * left(k, j), r += b[k] * right(k, j);
          BOOST_TEST(l == whole_left[j]);
          BOOST_TEST(r == whole_right[j]);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(four_products_divide_the_seeds_net) {
  Matrix<Rational> z(4);  // heights of the seed's 4 x 4 net
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) z(i, j) = i % 2 == 0 ? 1 : 0;
  const Rational c(1, 2);
  for (const Shape& s : {Shape{1, 0}, Shape{1, 5}, Shape{Rational(3, 2), 0}}) {
    const auto m = beta_basis(s.bias, s.tension);
    const auto divided = subdivision_matrices(m, c);
    const auto value = [&](const Matrix<Rational>& net, const Rational& u, const Rational& v) {
      const Row bu = at(m, u, 0), bv = at(m, v, 0);
      Rational sum = 0;
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) sum += bu[i] * net(i, j) * bv[j];
      return sum;
    };
    for (const bool upper_u : {false, true}) {
      for (const bool upper_v : {false, true}) {
        const auto part = divided_net(upper_u ? divided.right : divided.left, z, upper_v ? divided.right : divided.left);
        for (const Rational& u : {Rational(0), Rational(1, 3), Rational(1)})
          for (const Rational& v : {Rational(1, 4), Rational(1)})
            BOOST_TEST(value(part, u, v) == value(z, (upper_u ? c : Rational(0)) + u * c, (upper_v ? c : Rational(0)) + v * c));
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
