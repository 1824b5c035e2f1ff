#pragma once
// Many points of one curve or surface at once. Source of the method: "Direct evaluation of NURBS curves and surfaces",
// Computer-Aided Design 73 (2016), for the shifted power form; vectors and sorting are our own.
//
// Accuracy: position within about 4 units of eps (max |w P| + |S| max |w|) / |w| up to degree 5 (up to degree 3
// in monomial form about the middle of the span), 2 (degree + 1) units above (both in Bernstein form);
// tests/kernel/batch measures it. The bits of a point do not depend on how many others are asked for, nor in which
// order, nor on the function used: grid, scattered or single. With Arithmetic::SameBits they are those of every
// processor, too.

#include <array>

#include "kernel/batch/pieces.h"

namespace trimloop {

enum class Arithmetic : std::uint8_t {
  SameBits,  // no fused multiply-add
  Fast       // with it, where the processor has it
};
enum class InstructionSet : std::uint8_t { Baseline, Avx2, Avx512 };
InstructionSet best_instruction_set();  // of the processor this runs on

struct BatchOptions {
  Arithmetic arithmetic = Arithmetic::SameBits;
  InstructionSet at_most = InstructionSet::Avx512;  // the best that the processor has is taken
};

// Where results go: one column of numbers for each coordinate. Columns of derivatives may be null from the first or
// the second derivatives on; they are not computed then.
struct SurfaceColumns {
  std::array<double*, 3> point{}, du{}, dv{}, duu{}, duv{}, dvv{};
};
struct CurveColumns {
  std::array<double*, 3> point{}, d1{}, d2{};
};

// Parameters are clamped to the range; NaN gives NaN. Spans u and v have the same size; result k is that of (u[k],
// v[k]). Points in any order: blocks of them are sorted by patch unless they already come in runs.
void evaluate(const SurfacePieces&, std::span<const double> u, std::span<const double> v, const SurfaceColumns&,
              BatchOptions = {});
// All pairs: result j * u.size() + i is that of (u[i], v[j]). Fastest when u ascends and many of u share a span.
void evaluate_grid(const SurfacePieces&, std::span<const double> u, std::span<const double> v, const SurfaceColumns&,
                   BatchOptions = {});
// The same a few rows at a time, for results that are used while they are in the cache.
class SurfaceGrid {
 public:
  SurfaceGrid(const SurfacePieces&, std::span<const double> u, std::span<const double> v, BatchOptions = {});
  // Those of v[first] .. v[first + count - 1]; result 0 is that of (u[0], v[first]). The pieces must still be there.
  void rows(std::size_t first, std::size_t count, const SurfaceColumns&) const;

 private:
  struct Axis {
    std::vector<std::uint32_t> span;
    std::vector<double> local;
    std::vector<std::size_t> runs;  // where runs of one span begin, and the end
  };
  Axis located(const Spans&, std::span<const double>) const;
  const SurfacePieces* pieces_;
  BatchOptions options_;
  Axis u_, v_;
};
void evaluate(const CurvePieces&, std::span<const double> t, const CurveColumns&, BatchOptions = {});

// One point, with the same bits as above.
Point evaluate(const SurfacePieces&, Uv);
void jet1(const SurfacePieces&, Uv, Point& point, Vector& du, Vector& dv);
SurfaceJet jet(const SurfacePieces&, Uv);
CurveJet jet(const CurvePieces&, double t);

}  // namespace trimloop
