#include "kernel/geometry/variable_offset.h"

#include <algorithm>

namespace trimloop {

Result<SpaceApproximation> variable_offset(const Curve& basis, const std::function<double(double)>& distance, Vector side,
                                           const std::vector<double>& law_breaks, double tolerance_mm) {
  const Interval r = range(basis);
  if (!r.is_bounded() || !(r.lo < r.hi) || norm(side) == 0)
    return fail(ErrorCode::Degenerate, "an offset needs a bounded curve and a side to go to");
  const auto point = [&](double t) {
    const CurveJet j = jet(basis, t);
    return j.point + distance(t) * normalized(cross(side, j.d1));
  };
  if (std::holds_alternative<Line>(basis.shape)) {
    const double a = distance(r.lo), b = distance(r.hi);
    const double size = std::abs(a) + std::abs(b);
    bool affine = true;
    for (const double f : {0.25, 0.5, 0.75})
      affine = affine && std::abs(distance(r.at(f)) - (a + f * (b - a))) <= 4e-16 * size;
    if (affine) {  // Line's ends are at t = 0 and 1 whatever its range
      const Point p = point(r.lo), q = point(r.hi);
      const Vector step = (q - p) / r.length();
      const Point start = p - r.lo * step;
      return SpaceApproximation{Curve{Line{r.lo == 0 ? p : start, r.hi == 1 ? q : start + step, r}}, 0};
    }
  }
  std::vector<double> cuts = breaks(basis);
  for (const double t : law_breaks)
    if (t > r.lo && t < r.hi) cuts.push_back(t);
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return approximate_in_space(point, cuts, tolerance_mm);
}

}  // namespace trimloop
