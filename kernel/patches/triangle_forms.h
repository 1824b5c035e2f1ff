#pragma once
// The arithmetic of triangular Bézier patches over any scalar, so that tests can carry it out in rationals
// (not part of the public face). A Value is anything with + and Scalar * Value.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace trimloop::detail {

inline std::size_t triangle_index(int degree, int i, int k) {
  const auto m = static_cast<std::size_t>(degree - i);
  return m * (m + 1) / 2 + static_cast<std::size_t>(k);
}

// One step of bivariate de Casteljau: degree n to n - 1 at (a, b, c).
template <class Value, class Scalar>
std::vector<Value> triangle_step(const std::vector<Value>& poles, int degree, const std::array<Scalar, 3>& at) {
  std::vector<Value> out;
  for (int m = 0; m < degree; ++m) {  // rows of the result
    const int i = degree - 1 - m;
    for (int k = 0; k <= m; ++k)
      out.push_back(at[0] * poles[triangle_index(degree, i + 1, k)] + at[1] * poles[triangle_index(degree, i, k)] +
                    at[2] * poles[triangle_index(degree, i, k + 1)]);
  }
  return out;
}

// Degree + 1 of a Bézier row (seed 000 §1.3).
template <class Value, class Scalar>
std::vector<Value> row_elevated(const std::vector<Value>& row) {
  const std::size_t n = row.size();
  std::vector<Value> out{row.front()};
  for (std::size_t i = 1; i < n; ++i) {
    const Scalar share = Scalar(static_cast<int>(i)) / Scalar(static_cast<int>(n));
    out.push_back(share * row[i - 1] + Scalar(Scalar(1) - share) * row[i]);
  }
  out.push_back(row.back());
  return out;
}

// Poles (i, j) at i * (n + 1) + j of the patch with a = 1 - u, b = u (1 - v), c = u v: row i is the Bézier row of
// degree i raised to n.
template <class Value, class Scalar>
std::vector<Value> collapsed_poles(const std::vector<Value>& poles, int degree) {
  std::vector<Value> out;
  for (int m = 0; m <= degree; ++m) {
    std::vector<Value> row;
    for (int k = 0; k <= m; ++k) row.push_back(poles[triangle_index(degree, degree - m, k)]);
    while (row.size() < static_cast<std::size_t>(degree + 1)) row = row_elevated<Value, Scalar>(row);
    out.insert(out.end(), row.begin(), row.end());
  }
  return out;
}

// A patch of bidegree (m, m) times a bilinear function given at its corners 00, 01, 10, 11: bidegree (m + 1, m + 1).
template <class Value, class Scalar>
void add_product(std::vector<Value>& sum, const std::vector<Value>& patch, int m, const std::array<Scalar, 4>& corners) {
  const int n = m + 1;
  for (int i = 0; i <= m; ++i)
    for (int j = 0; j <= m; ++j)
      for (int di = 0; di < 2; ++di)
        for (int dj = 0; dj < 2; ++dj) {
          const Scalar& corner = corners[static_cast<std::size_t>(2 * di + dj)];
          if (corner == Scalar(0)) continue;
          const Scalar share = Scalar((di ? i + 1 : n - i) * (dj ? j + 1 : n - j)) / Scalar(n * n);
          Value& to = sum[static_cast<std::size_t>((i + di) * (n + 1) + j + dj)];
          to = to + Scalar(share * corner) * patch[static_cast<std::size_t>(i * (m + 1) + j)];
        }
}

// Poles of the patch over a bilinear domain quadrilateral with corners 00, 01, 10, 11 in barycentric coordinates
// (de Casteljau over polynomials instead of numbers).
template <class Value, class Scalar>
std::vector<Value> quad_poles(const std::vector<Value>& poles, int degree, const std::array<std::array<Scalar, 3>, 4>& corners) {
  std::array<std::array<Scalar, 4>, 3> weight;  // per barycentric coordinate: its value at the four corners
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t q = 0; q < 4; ++q) weight[c][q] = corners[q][c];
  std::vector<std::vector<Value>> level;
  for (const Value& pole : poles) level.push_back({pole});
  for (int d = degree; d > 0; --d) {
    const int m = degree - d;  // bidegree of the entries so far
    std::vector<std::vector<Value>> next;
    for (int row = 0; row < d; ++row) {
      const int i = d - 1 - row;
      for (int k = 0; k <= row; ++k) {
        std::vector<Value> sum(static_cast<std::size_t>((m + 2) * (m + 2)), Scalar(0) * poles[0]);
        add_product(sum, level[triangle_index(d, i + 1, k)], m, weight[0]);
        add_product(sum, level[triangle_index(d, i, k)], m, weight[1]);
        add_product(sum, level[triangle_index(d, i, k + 1)], m, weight[2]);
        next.push_back(std::move(sum));
      }
    }
    level = std::move(next);
  }
  return level[0];
}

// Domain corners of the three quadrilaterals, 00, 01, 10, 11.
template <class Scalar>
std::array<std::array<Scalar, 3>, 4> third_of_triangle(std::size_t which) {
  const Scalar half = Scalar(1) / Scalar(2), third = Scalar(1) / Scalar(3), none(0);
  std::array<std::array<Scalar, 3>, 4> q{};
  const std::size_t a = which, b = (which + 1) % 3, c = (which + 2) % 3;
  for (auto& corner : q) corner = {none, none, none};
  q[0][a] = Scalar(1);
  q[1][a] = half, q[1][c] = half;
  q[2][a] = half, q[2][b] = half;
  q[3] = {third, third, third};
  return q;
}

}  // namespace trimloop::detail
