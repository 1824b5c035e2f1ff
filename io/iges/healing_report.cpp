#include "io/iges/healing_report.h"

#include <fmt/format.h>

#include "formats/iges/rules.h"
#include "io/rules.h"

namespace trimloop::io::iges_import {
namespace {

namespace igr = iges::rules;
using heal::Step;
using heal::StepRecord;
using heal::Trust;

// All steps of one kind in one loop.
struct Group {
  Step step;
  int loop;
  std::size_t count = 0;
  double before = 0, after = 0;  // largest
  Point at;                      // of the largest `before`
  bool changes_shape = false;
};

std::vector<Group> grouped(const std::vector<StepRecord>& steps) {
  std::vector<Group> out;
  for (const StepRecord& s : steps) {
    auto g = std::find_if(out.begin(), out.end(), [&](const Group& o) { return o.step == s.step && o.loop == s.loop; });
    if (g == out.end()) g = out.insert(out.end(), Group{s.step, s.loop, 0, 0, 0, s.at, false});
    ++g->count;
    if (s.before_mm > g->before) g->before = s.before_mm, g->at = s.at;
    g->after = std::max(g->after, s.after_mm);
    g->changes_shape = g->changes_shape || s.changes_shape;
  }
  return out;
}

// The entity a loop comes from: 142, 141, 508, or the boundary curve of a plane.
const DirectoryEntry& loop_entry(const Context& context, const DirectoryEntry& face, const heal::FaceInput& input,
                                 int loop) {
  if (loop < 0 || static_cast<std::size_t>(loop) >= input.loops.size()) return face;
  const SourceRefs& source = input.loops[static_cast<std::size_t>(loop)].source;
  const DirectoryEntry* e = source.empty() ? nullptr : context.file.find(Ref{static_cast<std::int32_t>(source[0].id)});
  return e ? *e : face;
}

const Rule& deviation_rule(int type) {
  return type == 141 ? igr::e141::pcurve_deviation : type == 508 ? igr::e508::pcurves : igr::e142::deviation;
}

struct Words {
  const Rule* rule;
  Severity severity;
  std::string text;
  double measured = not_measured;
};

// Rule, weight and sentence for a kind of step in a loop of an entity of type `type`.
Words words(const Group& g, int type, const heal::FaceInput& input, Trust trust) {
  const bool brep = type == 508;
  const double tol = input.tolerance_mm;
  const Severity by_size = g.before > 10 * tol ? Severity::Error : Severity::Warning;
  const char* stated = trust == Trust::Either ? " (the file states no preference)" : " (as the file prefers)";
  switch (g.step) {
    case Step::PcurveFitted:
      return {&rules::gap_edge_surface, g.after > tol ? Severity::Warning : Severity::Info,
              "no usable parameter-space curve is given; it is fitted to the model curve", g.after};
    case Step::CurveDropped:
      return {&deviation_rule(type), by_size,
              std::string("parameter curve and model curve disagree; the parameter curve is used") + stated, g.before};
    case Step::PcurveReplaced:
      return {&deviation_rule(type), by_size,
              std::string("parameter curve and model curve disagree; the model curve is used") + stated, g.before};
    case Step::SegmentReversed:
      return {brep ? &igr::e508::head_to_tail : type == 141 ? &igr::e141::chain : &igr::e142::direction,
              Severity::Warning, "a curve fits only when it is turned; it is", g.before};
    case Step::SegmentsReordered:
      return {brep ? &igr::e508::head_to_tail : type == 141 ? &igr::e141::chain : &igr::e102::gap, Severity::Warning,
              "the curves form a loop only in another order; they are put in it", g.before};
    case Step::GapClosed:
      return {brep ? &rules::gap_in_loop : &igr::e144::loop_open, by_size, "curves of the loop do not meet; the gap is closed",
              g.before};
    case Step::SeamInserted:
      return {brep ? &rules::seam : &igr::e144::seam, brep ? Severity::Info : Severity::Warning,
              "the loop goes round a closed surface without an edge along its seam; one is put there"};
    case Step::PoleInserted:
      return {&rules::pole, Severity::Info, "the loop passes a pole of the surface; the edge of no length is supplied"};
    case Step::LoopReoriented:
      return {brep ? &rules::inconsistent_face_normal : &igr::e144::orientation, Severity::Warning,
              "the loop runs the wrong way round; it is turned"};
    case Step::OuterAdded:
      return {&igr::e144::nesting, input.outer_is_domain ? Severity::Info : Severity::Warning,
              input.outer_is_domain ? "the natural border of the surface is the outer boundary, as the file asks"
                                    : "no loop can be the outer boundary; the natural border of the surface is"};
    case Step::LoopDropped:
      return {&rules::misplaced_loop, Severity::Warning, "the loop encloses no area and bounds nothing; it is dropped",
              g.before};
    case Step::Clamped:
      return {&igr::e142::outside_domain, by_size, "the parameter curve leaves the surface; it is held at the border",
              g.before};
    case Step::DuplicateRemoved:
      return {&igr::e102::repeated_member, Severity::Warning, "a curve of the loop is repeated; one copy is used"};
    case Step::Misplaced:
      return {brep ? &rules::misplaced_loop : &igr::e144::nesting, Severity::Warning,
              "the loop lies outside the outer one; it bounds a part of its own", g.before};
    case Step::LoopSplit:
      return {brep ? &rules::intersecting_loops : &igr::e144::loops_cross, by_size,
              "the loop crosses itself; it is taken apart at the crossing, and what is inside is decided by parity. Size of the "
              "smaller part",
              g.before};
    case Step::LoopsParted:
      return {brep ? &rules::intersecting_loops : &igr::e144::loops_cross, Severity::Error,
              "loops cross each other; what lies inside more outer loops than holes is kept. Size of what falls away", g.before};
    case Step::SearchEnded:
      return {brep ? &rules::intersecting_loops : &igr::e144::loops_cross, Severity::Info,
              "the loop is too crowded to look for all its crossings; what is inside is decided by parity"};
    case Step::SelfTouching:
      return {brep ? &rules::intersecting_loops : &igr::e144::loops_cross, g.changes_shape ? Severity::Error : Severity::Warning,
              "loops touch, or one is given twice; what is inside is decided by parity", g.before};
  }
  return {&rules::ignored, Severity::Info, "healed"};
}

// Area before and after, for each healed face. A thousandth is what a person would see.
void report_areas(Context& context, const DirectoryEntry& entry, const Face& face, double after_mm2) {
  if (face.status != FaceStatus::Healed || after_mm2 < 0) return;
  constexpr double visible = 1e-3;
  const double before = face.area_before_mm2, change = std::abs(after_mm2 - before);
  if (!(before >= 0)) {
    context.add(entry, rules::healed_face, Severity::Info,
                fmt::format("the face was healed; area {:.9g} mm2 after ({})", after_mm2, face.reason));
    return;
  }
  context.add(entry, rules::healed_face, change > visible * after_mm2 ? Severity::Warning : Severity::Info,
              fmt::format("the face was healed; area {:.9g} mm2 before, {:.9g} mm2 after", before, after_mm2), after_mm2,
              before);
}

}  // namespace

void report_healing(Context& context, const DirectoryEntry& face, const heal::FaceInput& input,
                    const heal::FaceOutcome& outcome, const Face& made) {
  if (outcome.steps.empty()) return;
  Visit visit(context, face);
  report_areas(context, face, made, outcome.area_after_mm2);
  for (const Group& g : grouped(outcome.steps)) {
    // The natural border has its seams and poles from us: nothing is wrong with the file.
    const bool supplied = g.loop < 0 && (g.step == Step::SeamInserted || g.step == Step::PoleInserted);
    if (supplied && (input.loops.empty() || input.outer_is_domain)) continue;
    // Parameters of the other hand (120) turn every loop round: that is our map, not a fault of the file.
    if (g.step == Step::LoopReoriented && input.reversed) continue;
    const DirectoryEntry& entry = loop_entry(context, face, input, g.loop);
    if (g.step == Step::LoopReoriented && is_curve(entry)) continue;  // the border of a 108 has no prescribed direction
    const Trust trust = g.loop >= 0 && static_cast<std::size_t>(g.loop) < input.loops.size()
                            ? input.loops[static_cast<std::size_t>(g.loop)].trust
                            : Trust::Either;
    Words w = words(g, entry.type, input, trust);
    if (g.count > 1) w.text += " (" + std::to_string(g.count) + " places)";
    const bool has_measure = w.measured == w.measured;
    Diagnostic& d = context.add(entry, *w.rule, w.severity, std::move(w.text), w.measured,
                                has_measure ? input.tolerance_mm : not_measured);
    if (has_measure) d.unit = "mm";
    if (is_finite(g.at)) d.at = {g.at.x, g.at.y, g.at.z};
  }
}

}  // namespace trimloop::io::iges_import
