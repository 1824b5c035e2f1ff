// What healing did to a face, as findings: one for each kind of step in each loop, with the largest measure.

#include <fmt/format.h>

#include "formats/step/rules.h"
#include "io/rules.h"
#include "io/step/solids.h"

namespace trimloop::io::step_import {
namespace {

namespace sr = step::rules;
using heal::Step;
using heal::StepRecord;

struct Group {
  Step step;
  int loop;
  std::size_t count = 0;
  double before = 0, after = 0;
  Point at;
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

struct Words {
  const Rule* rule = nullptr;  // null: nothing is wrong with the file
  Severity severity = Severity::Info;
  std::string text;
  double measured = not_measured;
};

Words words(const Group& g, const heal::FaceInput& input) {
  const double tol = input.tolerance_mm;
  const Severity by_size = g.before > 10 * tol ? Severity::Error : Severity::Warning;
  switch (g.step) {
    case Step::PcurveFitted:  // STEP does not ask for parameter curves
      if (!(g.after > tol)) return {};
      return {&rules::gap_edge_surface, Severity::Warning, "an edge does not lie on the surface of the face", g.after};
    case Step::CurveDropped:
      return {&sr::surface_curve, by_size, "parameter curve and curve in space disagree; the parameter curve is used", g.before};
    case Step::PcurveReplaced:
      return {&sr::surface_curve, Severity::Info, "parameter curve and curve in space disagree; the curve in space is used", g.before};
    case Step::SegmentReversed:
      return {&sr::path_chain, Severity::Warning, "an edge fits into the loop only when it is turned; it is", g.before};
    case Step::SegmentsReordered:
      return {&sr::path_chain, Severity::Warning, "the edges form a loop only in another order; they are put in it", g.before};
    case Step::GapClosed: return {&rules::gap_in_loop, by_size, "edges of the loop do not meet; the gap is closed", g.before};
    case Step::SeamInserted: return {&rules::seam, Severity::Info, "the loop goes round a closed surface without an edge along its seam; one is put there"};
    case Step::PoleInserted: return {&rules::pole, Severity::Info, "the loop passes a pole of the surface; the edge of no length is supplied"};
    case Step::LoopReoriented:
      return {&rules::inconsistent_face_normal, Severity::Warning, "the loop runs the wrong way round; it is turned"};
    case Step::OuterAdded:
      return {&sr::face_bounds, Severity::Info, "no loop is the outer boundary; the natural border of the surface is"};
    case Step::LoopDropped: return {&rules::misplaced_loop, Severity::Warning, "the loop encloses no area and bounds nothing; it is dropped", g.before};
    case Step::Clamped: return {&rules::gap_edge_surface, by_size, "an edge leaves the surface; it is held at the border", g.before};
    case Step::DuplicateRemoved: return {&sr::path_chain, Severity::Info, "an edge of the loop has no length or is repeated; it is left out"};
    case Step::Misplaced:
      return {&rules::misplaced_loop, Severity::Warning, "the loop lies outside the outer one; it bounds a part of its own", g.before};
    case Step::LoopSplit:
      return {&rules::intersecting_loops, by_size,
              "the loop crosses itself; it is taken apart at the crossing, and what is inside is decided by parity. Size of the smaller part",
              g.before};
    case Step::LoopsParted:
      return {&rules::intersecting_loops, Severity::Error,
              "loops cross each other; what lies inside more outer loops than holes is kept. Size of what falls away", g.before};
    case Step::SearchEnded:
      return {&rules::intersecting_loops, Severity::Info, "the loop is too crowded to look for all its crossings; what is inside is decided by parity"};
    case Step::SelfTouching:
      return {&rules::intersecting_loops, g.changes_shape ? Severity::Error : Severity::Warning,
              "loops touch, or one is given twice; what is inside is decided by parity", g.before};
  }
  return {};
}

}  // namespace

void report_healing(Context& context, const Record& face, const heal::FaceInput& input, const heal::FaceOutcome& outcome) {
  for (const Group& g : grouped(outcome.steps)) {
    const bool supplied = g.loop < 0 && (g.step == Step::SeamInserted || g.step == Step::PoleInserted);
    if (supplied && (input.loops.empty() || input.outer_is_domain)) continue;
    Words w = words(g, input);
    if (!w.rule) continue;
    if (g.count > 1) w.text += fmt::format(" ({} places)", g.count);
    const bool has_measure = w.measured == w.measured;
    Diagnostic& d = context.add(face, *w.rule, w.severity, std::move(w.text), w.measured, has_measure ? input.tolerance_mm : not_measured);
    if (has_measure) d.unit = "mm";
    if (is_finite(g.at)) d.at = {g.at.x, g.at.y, g.at.z};
    const SourceRefs* source = g.loop >= 0 && static_cast<std::size_t>(g.loop) < input.loops.size() ? &input.loops[static_cast<std::size_t>(g.loop)].source : nullptr;
    if (source && !source->empty()) d.path.push_back(fmt::format("#{}", source->front().id));
  }
}

}  // namespace trimloop::io::step_import
