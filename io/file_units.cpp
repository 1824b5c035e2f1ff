#include "io/file_units.h"

#include <cmath>

#include "base/number.h"

namespace trimloop::io {

namespace {

// Of the doubles within two steps of `guess`, the shortest decimal that `reads_back`; `guess` when none does.
template <class ReadsBack>
double shortest_near(double guess, ReadsBack reads_back) {
  double candidate = guess;
  for (int k = 0; k < 2; ++k) candidate = std::nextafter(candidate, -infinity);
  double best = guess;
  std::size_t best_length = step_real(best).size() + (reads_back(best) ? 0 : 100);
  for (int k = 0; k < 5; ++k, candidate = std::nextafter(candidate, infinity)) {
    if (!reads_back(candidate)) continue;
    const std::size_t size = step_real(candidate).size();
    if (size < best_length) best = candidate, best_length = size;
  }
  return best;
}

}  // namespace

double FileUnits::length(double mm) const {
  if (factor_ == 1 || mm == 0 || !std::isfinite(mm)) return mm;
  // The value it came from, if it came from a file of this unit, is within two steps of the quotient.
  return shortest_near(mm / factor_, [&](double d) { return d * factor_ == mm; });
}

double percent_of(double part) {
  return shortest_near(100 * part, [&](double d) { return d / 100 == part; });
}

}  // namespace trimloop::io
