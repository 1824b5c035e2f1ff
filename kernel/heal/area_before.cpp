#include "kernel/heal/area_before.h"

#include <fmt/format.h>

#include "kernel/check/measure.h"
#include "kernel/heal/draft.h"

namespace trimloop::heal {
namespace {

bool has_both(const TrimSegment& s) { return s.pcurve && s.curve; }

}  // namespace

Result<double> area_before(const Body& body, const FaceInput& input, const std::vector<StepRecord>& steps) {
  FaceInput other = input;
  other.forbidden = {};
  for (TrimLoop& loop : other.loops)
    for (TrimSegment& s : loop.segments) detach(body, input.shared, s);
  for (const StepRecord& step : steps) {
    if (step.loop < 0 || step.segment < 0) continue;
    TrimSegment& s = other.loops[static_cast<std::size_t>(step.loop)].segments[static_cast<std::size_t>(step.segment)];
    if (!has_both(s)) continue;
    if (step.step == Step::CurveDropped) s.pcurve.reset();
    if (step.step == Step::PcurveReplaced) s.curve = nullptr;
  }
  Body alone;
  const FaceOutcome made = make_face(alone, other);
  const Face& face = alone[made.face];
  if (face.status == FaceStatus::Failed)
    return fail(ErrorCode::Degenerate, fmt::format("the curves not used bound no face: {}", face.reason));
  const Measured before = area(alone, made.face, area_accuracy);
  if (!(before.value > 0)) return fail(ErrorCode::Degenerate, "the curves not used enclose no area");
  return before.value;
}

}  // namespace trimloop::heal
