#pragma once
// Knot vectors of STEP splines: distinct knots with multiplicities, or implied by the kind of spline.

#include "formats/step/records/geometry.h"
#include "io/step/context.h"

namespace trimloop::io::step_import {

// The full vector (poles + degree + 1), or nothing after a finding under `sums` or SP-G03.
std::optional<std::vector<double>> full_knots(Context& context, const Record& spline, int degree, std::size_t poles,
                                              step::KnotForm form, const std::vector<int>& multiplicities,
                                              const std::vector<double>& distinct, const Rule& sums);

// More than degree + 1 knots at an end keep poles away from the curve: how many of them at either end have no effect.
// Said as a warning (SP-G01 or SP-G02) when there are any; the knots are cut down.
struct UnusedPoles {
  std::size_t front = 0, back = 0;
};
UnusedPoles drop_excess(Context& context, const Record& spline, int degree, std::vector<double>& knots, const Rule& sums);

// False after a finding (SP-G04) when a weight is not finite and positive.
bool check_weights(Context& context, const Record& spline, const std::vector<double>& weights);

}  // namespace trimloop::io::step_import
