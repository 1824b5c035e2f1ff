#include "kernel/pcurve/project.h"

#include "kernel/pcurve/fit_pcurve.h"

namespace trimloop {

Result<ProjectedCurve> project(const Curve& curve, Interval range, const Surface& surface,
                               const ProjectOptions& options) {
  if (!range.is_bounded() || !(range.lo < range.hi))
    return fail(ErrorCode::InvalidArgument, "a curve to be projected needs a bounded range with length");
  if (!(options.tolerance_mm > 0))
    return fail(ErrorCode::InvalidArgument, "the tolerance of a projection must be positive", options.tolerance_mm,
                0.0);
  const pcurve::Sheet sheet(surface, options.tolerance_mm);
  std::optional<pcurve::ParameterHint> hint;
  if (options.start) hint = pcurve::ParameterHint{range.lo, *options.start};
  DeviationOptions how;
  how.floor_mm = 0.1 * options.tolerance_mm;
  how.period_u = sheet.covers_u() ? 0 : sheet.period_u();
  how.period_v = sheet.covers_v() ? 0 : sheet.period_v();
  Result<ProjectedCurve> best = fail(ErrorCode::NoConvergence, "the curve could not be projected onto the surface");
  double fit = 0.25 * options.tolerance_mm;
  for (int attempt = 0; attempt < 4; ++attempt, fit *= 0.1) {
    auto fitted = pcurve::fit_pcurve(sheet, curve, range, hint, fit, options.tolerance_mm);
    if (!fitted) return best ? std::move(best) : tl::unexpected<Error>(fitted.error());
    const Deviation d = deviation(fitted->pcurve, fitted->range, surface, curve, range, how);
    const bool better = !best || d.bound_mm < best->deviation.bound_mm - 0.5 * options.tolerance_mm;
    if (better) best = ProjectedCurve{std::move(fitted->pcurve), fitted->range, d};
    // A finer fit does not help a curve that is off the surface.
    if (!better || best->deviation.bound_mm <= options.tolerance_mm) break;
  }
  return best;
}

}  // namespace trimloop
