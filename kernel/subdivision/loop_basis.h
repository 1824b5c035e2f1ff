#pragma once
// Quartic box spline over a regular triangle of Loop's scheme, in Bernstein form (not part of the public face). The
// polynomials in barycentric coordinates are those of Stam 1998 (Evaluation of Loop subdivision surfaces, appendix A);
// tests prove in rationals that they sum to one and refine into themselves.
//
//          1---2
//         . . . .        corners 4, 7, 8 of the face
//        3---4---5       carry the coordinates u, v, w
//       . . . . . .
//      6---7---8---9
//       . . . . . .
//       10--11--12

#include <array>
#include <cstddef>

#include "kernel/patches/triangle_forms.h"

namespace trimloop::subdivision::detail {

struct LoopTerm {
  int control;    // 1..12
  int u, v, w;    // exponents, sum 4
  int factor;     // in twelfths
};

inline constexpr LoopTerm loop_terms[] = {
    {1, 4, 0, 0, 1},  {1, 3, 1, 0, 2},
    {2, 4, 0, 0, 1},  {2, 3, 0, 1, 2},
    {3, 4, 0, 0, 1},  {3, 3, 0, 1, 2},  {3, 3, 1, 0, 6},  {3, 2, 1, 1, 6},  {3, 2, 2, 0, 12}, {3, 1, 2, 1, 6},
    {3, 1, 3, 0, 6},  {3, 0, 3, 1, 2},  {3, 0, 4, 0, 1},
    {4, 4, 0, 0, 6},  {4, 3, 0, 1, 24}, {4, 2, 0, 2, 24}, {4, 1, 0, 3, 8},  {4, 0, 0, 4, 1},  {4, 3, 1, 0, 24},
    {4, 2, 1, 1, 60}, {4, 1, 1, 2, 36}, {4, 0, 1, 3, 6},  {4, 2, 2, 0, 24}, {4, 1, 2, 1, 36}, {4, 0, 2, 2, 12},
    {4, 1, 3, 0, 8},  {4, 0, 3, 1, 6},  {4, 0, 4, 0, 1},
    {5, 4, 0, 0, 1},  {5, 3, 0, 1, 6},  {5, 2, 0, 2, 12}, {5, 1, 0, 3, 6},  {5, 0, 0, 4, 1},  {5, 3, 1, 0, 2},
    {5, 2, 1, 1, 6},  {5, 1, 1, 2, 6},  {5, 0, 1, 3, 2},
    {6, 1, 3, 0, 2},  {6, 0, 4, 0, 1},
    {7, 4, 0, 0, 1},  {7, 3, 0, 1, 6},  {7, 2, 0, 2, 12}, {7, 1, 0, 3, 6},  {7, 0, 0, 4, 1},  {7, 3, 1, 0, 8},
    {7, 2, 1, 1, 36}, {7, 1, 1, 2, 36}, {7, 0, 1, 3, 8},  {7, 2, 2, 0, 24}, {7, 1, 2, 1, 60}, {7, 0, 2, 2, 24},
    {7, 1, 3, 0, 24}, {7, 0, 3, 1, 24}, {7, 0, 4, 0, 6},
    {8, 4, 0, 0, 1},  {8, 3, 0, 1, 8},  {8, 2, 0, 2, 24}, {8, 1, 0, 3, 24}, {8, 0, 0, 4, 6},  {8, 3, 1, 0, 6},
    {8, 2, 1, 1, 36}, {8, 1, 1, 2, 60}, {8, 0, 1, 3, 24}, {8, 2, 2, 0, 12}, {8, 1, 2, 1, 36}, {8, 0, 2, 2, 24},
    {8, 1, 3, 0, 6},  {8, 0, 3, 1, 8},  {8, 0, 4, 0, 1},
    {9, 1, 0, 3, 2},  {9, 0, 0, 4, 1},
    {10, 0, 3, 1, 2}, {10, 0, 4, 0, 1},
    {11, 1, 0, 3, 2}, {11, 0, 0, 4, 1}, {11, 1, 1, 2, 6}, {11, 0, 1, 3, 6}, {11, 1, 2, 1, 6}, {11, 0, 2, 2, 12},
    {11, 1, 3, 0, 2}, {11, 0, 3, 1, 6}, {11, 0, 4, 0, 1},
    {12, 0, 0, 4, 1}, {12, 0, 1, 3, 2}};

// Row k: pole k of the quartic triangle (TriangleBezier's order) as a combination of the twelve control points.
template <class Scalar>
std::array<std::array<Scalar, 12>, 15> loop_bezier() {
  std::array<std::array<Scalar, 12>, 15> rows;
  for (auto& row : rows) row.fill(Scalar(0));
  constexpr int factorial[] = {1, 1, 2, 6, 24};
  for (const LoopTerm& t : loop_terms) {
    const int count = 24 / (factorial[t.u] * factorial[t.v] * factorial[t.w]);
    rows[trimloop::detail::triangle_index(4, t.u, t.w)][static_cast<std::size_t>(t.control - 1)] = Scalar(t.factor) / Scalar(12 * count);
  }
  return rows;
}

}  // namespace trimloop::subdivision::detail
