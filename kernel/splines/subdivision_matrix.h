#pragma once
// Subdivision matrices of any polynomial basis (seed 004 §3; Goldman and DeRose 1986). A basis of degree n is given by
// its matrix M in powers: B(t) = (1, t, ..., t^n) M. Then B(ct) = B(t) S_L and B(c + (1-c)t) = B(t) S_R with
// S_L = M^-1 D_c M and S_R = M^-1 T_c M, where D_c and T_c do the same for the powers. A polygon P (a column of points)
// is divided into S_L P and S_R P, a net into the four products S P S'.
// Scalar is double, or an exact type.

#include <cstddef>
#include <vector>

namespace trimloop {

template <class Scalar>
struct Matrix {  // square, by rows
  std::size_t size = 0;
  std::vector<Scalar> at;
  explicit Matrix(std::size_t n) : size(n), at(n * n, Scalar(0)) {}
  Scalar& operator()(std::size_t row, std::size_t column) { return at[row * size + column]; }
  const Scalar& operator()(std::size_t row, std::size_t column) const { return at[row * size + column]; }
};

template <class Scalar>
Matrix<Scalar> operator*(const Matrix<Scalar>& a, const Matrix<Scalar>& b) {
  Matrix<Scalar> c(a.size);
  for (std::size_t i = 0; i < a.size; ++i)
    for (std::size_t k = 0; k < a.size; ++k)
      for (std::size_t j = 0; j < a.size; ++j) c(i, j) = c(i, j) + a(i, k) * b(k, j);
  return c;
}

// X with A X = B, by elimination with the largest pivot; an empty matrix when A is singular.
template <class Scalar>
Matrix<Scalar> solve(Matrix<Scalar> a, Matrix<Scalar> b) {
  const std::size_t n = a.size;
  const auto size_of = [](const Scalar& x) { return x < Scalar(0) ? Scalar(-x) : x; };
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (size_of(a(pivot, k)) < size_of(a(i, k))) pivot = i;
    if (a(pivot, k) == Scalar(0)) return Matrix<Scalar>(0);
    for (std::size_t j = 0; j < n; ++j) {
      std::swap(a(k, j), a(pivot, j));
      std::swap(b(k, j), b(pivot, j));
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const Scalar factor = a(i, k) / a(k, k);
      for (std::size_t j = 0; j < n; ++j) {
        a(i, j) = a(i, j) - factor * a(k, j);
        b(i, j) = b(i, j) - factor * b(k, j);
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) b(i, j) = b(i, j) / a(i, i);
  return b;
}

template <class Scalar>
struct SubdivisionMatrices {
  Matrix<Scalar> left, right;  // empty when the functions are no basis
};

// c is the parameter at which [0, 1] is divided, 0 < c < 1.
template <class Scalar>
SubdivisionMatrices<Scalar> subdivision_matrices(const Matrix<Scalar>& basis, const Scalar& c) {
  const std::size_t n = basis.size;
  Matrix<Scalar> left(n), right(n);
  const Scalar rest = Scalar(1) - c;
  for (std::size_t j = 0; j < n; ++j) {
    // Column j holds the coefficients of (ct)^j and of (c + (1-c)t)^j.
    std::vector<Scalar> power{Scalar(1)};
    Scalar scale(1);
    for (std::size_t k = 0; k < j; ++k) {
      power.push_back(Scalar(0));
      for (std::size_t i = power.size(); i-- > 0;) power[i] = power[i] * c + (i > 0 ? Scalar(power[i - 1] * rest) : Scalar(0));
      scale = scale * c;
    }
    left(j, j) = scale;
    for (std::size_t i = 0; i <= j; ++i) right(i, j) = power[i];
  }
  return {solve(basis, left * basis), solve(basis, right * basis)};
}

// S_a P S_b' for one component of a net: P is (n+1) x (n+1), rows along the first parameter.
template <class Scalar>
Matrix<Scalar> divided_net(const Matrix<Scalar>& along_rows, const Matrix<Scalar>& net, const Matrix<Scalar>& along_columns) {
  Matrix<Scalar> transposed(along_columns.size);
  for (std::size_t i = 0; i < transposed.size; ++i)
    for (std::size_t j = 0; j < transposed.size; ++j) transposed(i, j) = along_columns(j, i);
  return along_rows * net * transposed;
}

}  // namespace trimloop
