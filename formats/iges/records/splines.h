#pragma once
// What 126 and 128 have in common: order, knots, ranges and weights of one direction.

#include <span>

#include "formats/iges/records/record.h"
#include "formats/iges/rules.h"

namespace trimloop::iges {

// The rules of one of the two types.
struct SplineRules {
  const Rule &order, &knot_count, &ascending, &empty_span, &multiplicity, &range, &weight;
};
inline constexpr SplineRules curve_rules{
    rules::e126::order,           rules::e126::knot_count,   rules::e126::knots_not_ascending,
    rules::e126::degenerate_span, rules::e126::multiplicity, rules::e126::range,
    rules::e126::weight};
inline constexpr SplineRules surface_rules{
    rules::e128::order, rules::e128::knot_count,   rules::e128::knots_not_ascending,
    rules::e128::range, rules::e128::multiplicity, rules::e128::range,
    rules::e128::weight};

struct Order {
  std::size_t poles = 0, knots = 0;  // K + 1, K + M + 2; both 0 when K and M make no spline
};

// `parameter` is the place of K. Needs K >= M >= 1; more knots than parameters left are a fault, before any allocation.
Order read_order(TokenReader& in, const SplineRules& rules, std::size_t parameter, int upper_index, int degree);

// One direction of a spline that has been read.
struct KnotRow {
  const char* name;  // "T"; knots are indexed from -degree
  std::span<const double> knots;
  int degree;
  std::size_t parameter;        // of the first knot
  double from, to;              // the stated range
  std::size_t range_parameter;  // of `from`

  double domain_start() const { return knots[static_cast<std::size_t>(degree)]; }
  double domain_end() const { return knots[knots.size() - 1 - static_cast<std::size_t>(degree)]; }
  // The end knots repeat and the range is the whole domain: the end poles are the ends of the curve.
  bool ends_are_poles() const;
};

void check_knots(const KnotRow& row, const SplineRules& rules, TokenReader& in);
void check_weights(std::span<const double> weights, std::size_t parameter, const SplineRules& rules, TokenReader& in);
bool all_equal(std::span<const double> weights);  // within 1e-12 of the first

// Largest distance in a coordinate between points of `points` at first, first + step, ... (`count` of them).
double extent(std::span<const Xyz> points, std::size_t first, std::size_t step, std::size_t count);
double size_of(std::span<const Xyz> points);
double distance(const Xyz& a, const Xyz& b);

// Distance at which points of this record count as one: the file's resolution, or a part of `size` where the record is
// in parameter space or the file states none.
double coincidence(const TokenReader& in, double size);

}  // namespace trimloop::iges
