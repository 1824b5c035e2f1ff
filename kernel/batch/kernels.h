#pragma once
// The innermost loops of batch evaluation and the choice among their builds (not part of the public face). One source,
// kernels.inc, is built for each instruction set; neither Eigen nor std containers appear in it, so that no inline
// function of those leaks code into the rest of the program that this processor may not run.
//
// A patch is a polynomial piece in homogeneous form over local parameters x, y in [-1, 1]. Coefficient (i, j), i along
// u, of component c = x, y, z, w is at [(j (p + 1) + i) 4 + c]: of x^i y^j in monomial form, else of the Bernstein
// polynomials. All loops take the operations on one number in the same order, so that a point has the same bits
// whichever loop and, without FMA, whichever instruction set it comes from.

#include <cstddef>
#include <cstdint>

namespace trimloop::batch {

struct Span {  // x = ((t - lo) - (hi - t)) / (hi - lo)
  double lo, hi, inverse_length;
};

struct Patch {
  const double* coefficients;
  int degree_u, degree_v;
  bool monomial, rational;
  Span u, v;
};

struct Piece {  // of a curve
  const double* coefficients;
  int degree;
  bool monomial, rational;
  Span t;
};

// The spans of one knot vector: breaks[0 .. spans], and infinity behind. Cell c of `cells` equal ones begins in span
// first[c], and at most `steps` more spans begin in any cell.
struct SpanTable {
  const double* breaks;
  const std::uint32_t* first;
  std::uint32_t spans, cells, steps;
  double cells_per_unit;
};

// Columns: point x, y, z; du; dv; duu; duv; dvv, each of three; of a curve point, d1, d2. Unused ones are not touched.
constexpr int surface_columns = 18, curve_columns = 9;

struct Kernels {
  std::size_t lanes;  // points of a step
  // The spans of n parameters, which are clamped to the domain.
  void (*locate)(const SpanTable&, const double* t, std::size_t n, std::uint32_t* span);
  // How many of the n points, from the first on, have u in [u.lo, u.hi) and v in [v.lo, v.hi).
  std::size_t (*prefix)(Span u, Span v, const double* pu, const double* pv, std::size_t n);
  // n points of one patch, whose parameters are clamped to it. Index 0, 1, 2: the highest derivative.
  void (*points[3])(const Patch&, const double* u, const double* v, std::size_t n, double* const* columns);
  // n points of one patch that share v, by their local parameters.
  void (*row[3])(const Patch&, double y, const double* x, std::size_t n, double* const* columns);
  // One point, to numbers[0], [1] ... in the order of the columns.
  void (*point[3])(const Patch&, double u, double v, double* numbers);
  void (*curve[3])(const Piece&, const double* t, std::size_t n, double* const* columns);
};

extern const Kernels baseline_kernels;
extern const Kernels avx2_kernels, avx2_fma_kernels;      // where the compiler's target is x86-64
extern const Kernels avx512_kernels, avx512_fma_kernels;  // likewise

}  // namespace trimloop::batch
