// Triangular Bézier patches as quadrilaterals: the difference is identically zero (seed 001 §8.3).
#include <boost/multiprecision/cpp_int.hpp>
#include <boost/test/unit_test.hpp>
#include <random>

#include "kernel/patches/triangle_forms.h"
#include "kernel/subdivision/loop_basis.h"

using namespace trimloop;
using Rational = boost::multiprecision::cpp_rational;

namespace {

std::vector<Rational> random_poles(int degree, unsigned seed) {
  std::mt19937 engine(seed);
  std::vector<Rational> poles;
  for (int i = 0; i < (degree + 1) * (degree + 2) / 2; ++i)
    poles.push_back(Rational(static_cast<int>(engine() % 2001) - 1000, static_cast<int>(engine() % 63 + 1)));
  return poles;
}

Rational triangle_value(std::vector<Rational> poles, int degree, const std::array<Rational, 3>& at) {
  for (int d = degree; d > 0; --d) poles = detail::triangle_step(poles, d, at);
  return poles[0];
}

Rational square_value(const std::vector<Rational>& poles, int n, const Rational& u, const Rational& v) {
  const auto row_value = [n](std::vector<Rational> row, const Rational& t) {
    for (int d = n; d > 0; --d)
      for (int i = 0; i < d; ++i) row[static_cast<std::size_t>(i)] += t * (row[static_cast<std::size_t>(i + 1)] - row[static_cast<std::size_t>(i)]);
    return row[0];
  };
  std::vector<Rational> column;
  for (int i = 0; i <= n; ++i)
    column.push_back(row_value({poles.begin() + i * (n + 1), poles.begin() + (i + 1) * (n + 1)}, v));
  return row_value(column, u);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(exact_triangle_patches)

BOOST_AUTO_TEST_CASE(collapsed_and_three_quads_equal_the_patch_identically) {
  for (int n = 1; n <= 8; ++n) {
    const auto poles = random_poles(n, static_cast<unsigned>(n));
    const auto collapsed = detail::collapsed_poles<Rational, Rational>(poles, n);
    std::array<std::vector<Rational>, 3> thirds;
    for (std::size_t k = 0; k < 3; ++k) thirds[k] = detail::quad_poles(poles, n, detail::third_of_triangle<Rational>(k));
    // Both sides are polynomials of degree n in u and in v: equal at (n+1)^2 points of a grid, they are equal.
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) {
        const Rational u(i, n), v(j, n);
        BOOST_TEST(square_value(collapsed, n, u, v) == triangle_value(poles, n, {1 - u, u * (1 - v), u * v}));
        for (std::size_t k = 0; k < 3; ++k) {
          const auto corners = detail::third_of_triangle<Rational>(k);
          std::array<Rational, 3> at;
          for (std::size_t c = 0; c < 3; ++c)
            at[c] = (1 - u) * ((1 - v) * corners[0][c] + v * corners[1][c]) + u * ((1 - v) * corners[2][c] + v * corners[3][c]);
          BOOST_TEST(square_value(thirds[k], n, u, v) == triangle_value(poles, n, at));
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(loops_box_spline_sums_to_one_and_reproduces_the_plane) {
  const auto rows = subdivision::detail::loop_bezier<Rational>();
  // The twelve points in the triangular lattice: (1,0) to the right, (0,1) down to the right; corner 4 at the origin.
  const int place[12][2] = {{0, -1}, {1, -1}, {-1, 0}, {0, 0}, {1, 0}, {-2, 1}, {-1, 1}, {0, 1}, {1, 1}, {-2, 2}, {-1, 2}, {0, 2}};
  for (std::size_t k = 0; k < 15; ++k) {
    Rational sum = 0, x = 0, y = 0;
    for (std::size_t i = 0; i < 12; ++i) sum += rows[k][i], x += rows[k][i] * place[i][0], y += rows[k][i] * place[i][1];
    BOOST_TEST(sum == 1);
    // Linear precision: pole (i, j, l) of a quartic lies at (4 i + 7 j + 8 l) / 4.
    int m = 0, l = static_cast<int>(k);
    while (l > m) l -= ++m;
    const int j = m - l;
    BOOST_TEST(x == Rational(-j, 4));
    BOOST_TEST(y == Rational(j + l, 4));
  }
}

BOOST_AUTO_TEST_SUITE_END()
