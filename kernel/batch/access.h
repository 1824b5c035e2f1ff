#pragma once
// What the kernels see of pieces (not part of the public face).

#include "kernel/batch/kernels.h"
#include "kernel/batch/pieces.h"

namespace trimloop {

// Above it powers of the local parameter cost digits, and Bernstein form is kept: with powers the error reached 7.8
// units (tests/kernel/batch) at degree 4 and 6.6 at degree 5.
constexpr int monomial_degree = 3;

struct BatchAccess {
  static batch::SpanTable table(const Spans& s) {
    return {s.breaks_.data(),
            s.first_.data(),
            static_cast<std::uint32_t>(s.size()),
            static_cast<std::uint32_t>(s.first_.size()),
            s.steps_,
            s.cells_per_unit_};
  }
  static batch::Span span(const Spans& s, std::size_t i) {
    return {s.breaks_[i], s.breaks_[i + 1], s.inverse_lengths_[i]};
  }
  static batch::Patch patch(const SurfacePieces& s, std::size_t a, std::size_t b) {
    const std::size_t count = static_cast<std::size_t>((s.degree_u_ + 1) * (s.degree_v_ + 1));
    const bool monomial = !s.monomial_.empty();
    const Hpoint* first = (monomial ? s.monomial_ : s.bezier_).data() + (a * s.spans_v_.size() + b) * count;
    return {&first->x, s.degree_u_, s.degree_v_, monomial, s.rational_, span(s.spans_u_, a), span(s.spans_v_, b)};
  }
  static batch::Piece piece(const CurvePieces& c, std::size_t i) {
    const std::size_t count = static_cast<std::size_t>(c.degree_) + 1;
    const bool monomial = !c.monomial_.empty();
    const Hpoint* first = (monomial ? c.monomial_ : c.bezier_).data() + i * count;
    return {&first->x, c.degree_, monomial, c.rational_, span(c.spans_, i)};
  }
};

}  // namespace trimloop
