#pragma once
// From a surface and trimming curves as a file has them to a face of a Body, every change measured and listed.
// This is where the loops of interchange data are made sound: missing pcurves fitted, contradictions decided,
// gaps closed, seams and poles supplied, loops oriented. It never gives up silently.

#include <optional>
#include <string>
#include <vector>

#include "kernel/heal/shared_edges.h"
#include "kernel/topology/body.h"

namespace trimloop::heal {

enum class Trust : std::uint8_t { Either, Parameter, Model };  // which copy the file prefers when the two disagree

struct TrimSegment {
  std::optional<Curve2> pcurve;   // parameter-space curve, already in the surface's own parameters
  CurvePtr curve;                 // model-space curve, mm; null when missing
  bool pcurve_reversed = false;   // the segment runs against the curve
  bool curve_reversed = false;
  EdgeId edge;                    // an edge the body already has (B-rep); then `curve` is ignored
  SourceRefs source;
};

struct TrimLoop {
  std::vector<TrimSegment> segments;  // in loop order
  Trust trust = Trust::Either;
  bool claimed_outer = false;         // what the file says; decided by area
  std::optional<Point> pole;          // a loop that is a single vertex (STEP VERTEX_LOOP, 508 with one vertex)
  SourceRefs source;
};

// The same loop the other way round. Bounds of 510 and STEP run about the face's normal, ours about Su x Sv: a reader
// turns those of reversed faces.
void turn(TrimLoop&);

enum class Step : std::uint8_t {
  PcurveFitted,         // no pcurve given; made by projection. before: - ; after: max distance to the surface curve
  CurveDropped,         // 3D copy not used: it contradicts the trusted pcurve by `before`
  PcurveReplaced,       // pcurve contradicts the trusted 3D curve by `before`; refitted, now `after`
  SegmentReversed,      // chain fits only backwards
  SegmentsReordered,    // chain fits only in another order
  GapClosed,            // before: gap in mm
  SeamInserted,         // loop cut along a seam of a closed surface
  PoleInserted,         // degenerate side supplied
  LoopReoriented,       // outer clockwise or hole counter-clockwise
  OuterAdded,           // natural boundary added
  LoopDropped,          // zero-area loop (before: area) - it bounds nothing
  Clamped,              // pcurve left the domain by `before` (in mm along the surface) and was held at its border
  DuplicateRemoved,     // repeated segment
  SelfTouching,         // loops touch, or one is given twice; parity decides what is inside
  Misplaced,            // a loop that is no outer one lies outside the others; it bounds a part of its own
  LoopSplit,            // a loop that crosses itself, taken apart at the crossing; before: size in mm of the part named
  SearchEnded,          // a limit ended the search for crossings of the loop; what is inside is decided by parity
  LoopsParted           // loops that cross each other, strung together anew; before: size in mm of a part that fell away
};
std::string_view to_string(Step);

// Kinds of step that healing may not take.
struct StepSet {
  std::uint32_t bits = 0;
  constexpr bool contains(Step s) const { return (bits >> static_cast<unsigned>(s)) & 1u; }
  constexpr StepSet with(Step s) const { return {bits | 1u << static_cast<unsigned>(s)}; }
};

struct FaceInput {
  SurfacePtr surface;
  std::vector<TrimLoop> loops;        // empty: the natural boundary of the surface's domain
  bool outer_is_domain = false;       // loops are holes in the natural boundary (144 with N1 = 0)
  std::optional<Interval> range_u, range_v;  // natural boundary when the surface is unbounded
  bool reversed = false;
  bool brep_sense = false;            // loop orientation of the input is reliable (186/STEP) and decides the inside
  double tolerance_mm = 1e-3;         // the file's resolution: smaller gaps are closed without a finding
  SharedEdges* shared = nullptr;      // one for all faces of a body whose loops name its edges; null: this face is the last to do so
  StepSet forbidden;                  // a face that needs one of these fails and says which
  bool measure_areas = false;         // of a healed face, before and after: costs the face once more and two quadratures
  AttributesId attributes;
  SourceRefs source;
};


struct StepRecord {
  Step step;
  int loop = -1, segment = -1;
  double before_mm = 0, after_mm = 0;   // deviations as the step's comment says; 0 where nothing moves
  Point at;
  bool changes_shape = false;   // beyond tolerance: makes the face Healed instead of Ok
};

// What a face was made from, and how: Face::repair, where it failed or anything given was replaced. Enough to make it again
// in another way, to draw it, or to go back to what the file has.
struct Repair {
  std::vector<TrimLoop> loops;      // as given; shared edges as curves of their own
  std::vector<StepRecord> steps;
  bool outer_is_domain = false, brep_sense = false;
  double tolerance_mm = 0;
};

struct FaceOutcome {
  FaceId face;                  // always valid: failed faces are in the body too
  std::vector<StepRecord> steps;
  bool bounds_nothing = false;  // failed since its loops enclose no area: neighbours close without it
  double area_after_mm2 = -1;   // of a healed face, if asked for; beside Face::area_before_mm2
};

// Adds the face, its loops, edges and vertices to `body`. Cost: a few surface evaluations per trimming sample. A healed
// face is measured before and after if `input` asks for it (area_before.h); where the area before cannot be said,
// Face::reason says why.
FaceOutcome add_face(Body& body, const FaceInput& input);
// The same without measuring.
FaceOutcome make_face(Body& body, const FaceInput& input);
constexpr double area_accuracy = 1e-6;  // relative, of the areas before and after

// After all faces of a shell have been added: sets Shell::closed, turns void shells.
void finish_shell(Body& body, ShellId shell);

}  // namespace trimloop::heal
