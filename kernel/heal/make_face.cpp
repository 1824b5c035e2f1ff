#include "kernel/heal/make_face.h"

#include <fmt/format.h>

#include <tuple>

#include "base/assert.h"
#include "kernel/check/measure.h"
#include "kernel/heal/area_before.h"
#include "kernel/heal/draft.h"

namespace trimloop::heal {
namespace {

Curve2 moved(Curve2 c, Uv by) {
  if (by.u == 0 && by.v == 0) return c;
  auto result = transformed(c.curve, Transform::translation({by.u, by.v, 0}));
  TRIMLOOP_ASSERT(result.has_value(), "a translation applies to every curve");
  return {std::move(*result)};
}

// Writes a finished draft into the body.
class Writer {
 public:
  Writer(Body& body, Draft& draft) : body_(body), draft_(draft) {}

  std::vector<LoopId> write() {
    vertices_.resize(draft_.nodes.size());
    for (Ring& ring : draft_.rings) cut_shared(ring);
    seams_.resize(static_cast<std::size_t>(draft_.seams));
    std::vector<LoopId> loops;
    for (Ring& ring : draft_.rings) {
      Loop loop;
      loop.source = std::move(ring.source);
      loop.coedges.reserve(ring.pieces.size());
      for (Piece& p : ring.pieces) loop.coedges.push_back(coedge(p));
      loops.push_back(body_.add(std::move(loop)));
      for (const Piece& p : ring.pieces)
        if (p.existing) draft_.shared.use(p.existing, loops.back());
    }
    return loops;
  }

 private:
  // Pieces of shared edges end where parts of these end: the edges are cut at the pieces' ends, then the pieces wherever the
  // edges are cut already.
  void cut_shared(Ring& ring) {
    std::vector<Piece> pieces;
    for (Piece& p : ring.pieces) {
      if (!p.existing) {
        pieces.push_back(std::move(p));
        continue;
      }
      cut_at(p, p.c0, p.start);
      cut_at(p, p.c1, p.end);
      cut_at_parts(std::move(p), pieces);
    }
    ring.pieces = std::move(pieces);
  }

  // What lies within rounding is one place.
  double same_parameter(const Piece& p, double c) const {
    const double speed = norm(jet(*p.curve, c).d1), length = draft_.shared.whole(body_, p.existing).range.length();
    const double rounding_mm = 1e-3 * draft_.tolerance_mm;
    return std::clamp(speed > 0 ? rounding_mm / speed : 0.0, 1e-12 * length, 1e-6 * length);
  }

  void cut_at(const Piece& p, double c, int node) {
    const std::optional<VertexId> there = draft_.shared.vertex_at(body_, p.existing, c, same_parameter(p, c));
    VertexId& id = vertices_[static_cast<std::size_t>(node)];
    if (!there) {
      draft_.shared.cut(body_, p.existing, c, vertex(node));
    } else if (!id && !draft_.nodes[static_cast<std::size_t>(node)].existing) {
      id = *there;
    } else if (vertex(node) != *there) {
      unite(*there, vertex(node));
    }
  }

  // Two vertices that turn out to be one place.
  void unite(VertexId from, VertexId to) {
    body_[to].gap_mm = std::max(body_[to].gap_mm, body_[from].gap_mm + distance(body_[from].point, body_[to].point));
    for (Edge& e : body_.edges) {
      if (e.start == from) e.start = to;
      if (e.end == from) e.end = to;
    }
    for (VertexId& id : vertices_)
      if (id == from) id = to;
    for (Node& n : draft_.nodes)
      if (n.existing == from) n.existing = to;
  }

  void cut_at_parts(Piece p, std::vector<Piece>& out) {
    std::vector<EdgeId> parts = draft_.shared.parts(p.existing);
    if (p.c0 > p.c1) std::reverse(parts.begin(), parts.end());
    std::vector<EdgeId> mine;  // in loop direction
    for (const EdgeId part : parts) {
      const double middle = body_[part].range.mid();
      if (std::min(p.c0, p.c1) < middle && middle < std::max(p.c0, p.c1)) mine.push_back(part);
    }
    for (std::size_t k = 0; k < mine.size(); ++k) {
      const Edge& part = body_[mine[k]];
      const bool along = p.c0 < p.c1, is_last = k + 1 == mine.size();
      Piece rest;
      if (!is_last) {
        const VertexId end = along ? part.end : part.start;
        const int node = draft_.add_node(body_[end].point, end);
        vertices_.push_back(end);
        std::tie(p, rest) = split(p, pcurve_parameter(p, along ? part.range.hi : part.range.lo), node);
      }
      p.existing = mine[k];
      out.push_back(std::move(p));
      p = std::move(rest);
    }
  }

  VertexId vertex(int node) {
    VertexId& id = vertices_[static_cast<std::size_t>(node)];
    const Node& n = draft_.nodes[static_cast<std::size_t>(node)];
    if (!id) id = n.existing ? n.existing : body_.add(Vertex{n.point, 0});
    return id;
  }

  // An end of an edge as this face sees it lies off its vertex by so much.
  void widen(VertexId id, Point end) {
    Vertex& v = body_[id];
    v.gap_mm = std::max(v.gap_mm, distance(v.point, end));
  }

  Coedge coedge(Piece& p) {
    Coedge c;
    c.gap_mm = p.gap_mm;
    c.map = std::move(p.map);
    EdgeId* shared = p.seam >= 0 && p.curve ? &seams_[static_cast<std::size_t>(p.seam)] : nullptr;
    // The edge runs as its curve does, or as its pcurve.
    c.reversed = p.curve ? p.c0 > p.c1 : p.t0 > p.t1;
    if (c.reversed) turn_around(p);
    c.pcurve_range = {p.t0, p.t1};
    c.edge = p.existing ? p.existing : shared && *shared ? *shared : add_edge(p);
    if (shared) *shared = c.edge;
    c.pcurve = moved(std::move(p.pcurve), p.shift);
    return c;
  }

  EdgeId add_edge(Piece& p) {
    Edge e;
    e.curve = p.curve;
    e.range = p.curve ? Interval{p.c0, p.c1} : Interval{p.t0, p.t1};
    e.is_pole = p.is_pole;
    e.start = vertex(p.start);
    e.end = vertex(p.end);
    e.source = std::move(p.source);
    widen(e.start, p.curve ? evaluate(*p.curve, p.c0) : draft_.sheet.point(uv_of(p, p.t0)));
    widen(e.end, p.curve ? evaluate(*p.curve, p.c1) : draft_.sheet.point(uv_of(p, p.t1)));
    return body_.add(std::move(e));
  }

  Body& body_;
  Draft& draft_;
  std::vector<VertexId> vertices_;
  std::vector<EdgeId> seams_;
};

// The largest changes first, three of them.
std::string reason_of(const std::vector<StepRecord>& steps) {
  std::vector<const StepRecord*> changes;
  for (const StepRecord& s : steps)
    if (s.changes_shape) changes.push_back(&s);
  std::stable_sort(changes.begin(), changes.end(), [](const StepRecord* a, const StepRecord* b) {
    return std::max(a->before_mm, a->after_mm) > std::max(b->before_mm, b->after_mm);
  });
  constexpr std::size_t told = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(told, changes.size()); ++i) {
    if (i > 0) text.append("; ");
    text.append(sentence(*changes[i]));
  }
  if (changes.size() > told) text += fmt::format("; and {} more", changes.size() - told);
  return text;
}

// Squares of lengths must be numbers.
void check_reach(Draft& draft) {
  constexpr double farthest_mm = 1e150;
  for (const Node& n : draft.nodes) {
    const double reach = std::max({std::abs(n.point.x), std::abs(n.point.y), std::abs(n.point.z)});
    if (reach <= farthest_mm) continue;
    draft.failure = fmt::format("its border reaches {:.3g} mm, where lengths and areas are no numbers any more", reach);
    return;
  }
}

// What the outer rings enclose and the holes take away must not be the same.
void check_inside(Draft& draft) {
  double inside = 0, all = 0;
  for (const Ring& ring : draft.rings) {
    const double area = area_of(ring);
    inside += area, all += std::abs(area);
  }
  constexpr double rounding = 1e-12;
  if (inside > rounding * all) return;
  draft.failure = "its loops leave nothing of the surface between them";
  draft.bounds_nothing = true;
}

void run_stages(Draft& draft) {
  const auto failed = [&] { return !draft.failure.empty(); };
  draw_segments(draft);
  if (failed()) return;
  for (Ring& ring : draft.rings) {
    chain(draft, ring);
    close(draft, ring);
  }
  if (failed()) return;
  uncross(draft);
  if (failed()) return;
  const bool outer_added = draft.input.outer_is_domain && !draft.rings.empty();
  if (outer_added || draft.rings.empty()) add_natural_boundary(draft);
  if (failed()) return;
  check_reach(draft);
  if (failed()) return;
  orient(draft);
  if (failed()) return;
  cut_open(draft);
  if (failed()) return;
  part_loops(draft);
  if (!failed()) check_inside(draft);
}

// The input without the parameter curves that were preferred to contradicting model curves; nothing if there were none.
std::optional<FaceInput> by_model_curves(const FaceInput& input, const std::vector<StepRecord>& steps) {
  std::optional<FaceInput> other;
  for (const StepRecord& s : steps) {
    if (s.step != Step::CurveDropped) continue;
    if (!other) other = input;
    other->loops[static_cast<std::size_t>(s.loop)].segments[static_cast<std::size_t>(s.segment)].pcurve.reset();
  }
  return other;
}

// Edges of the body become curves of their own, so that the loops stand without it.
std::vector<TrimLoop> detached(const Body& body, const SharedEdges* shared, std::vector<TrimLoop> loops) {
  for (TrimLoop& loop : loops)
    for (TrimSegment& s : loop.segments) detach(body, shared, s);
  return loops;
}

// Something that was given is not in the face as it was; elsewhere something was added, or only its direction turned.
bool replaces(const StepRecord& s) {
  switch (s.step) {
    case Step::CurveDropped:
    case Step::PcurveReplaced:
    case Step::SegmentReversed:
    case Step::SegmentsReordered:
    case Step::GapClosed:
    case Step::LoopDropped:
    case Step::Clamped:
    case Step::DuplicateRemoved:
    case Step::LoopSplit:
    case Step::LoopsParted: return true;
    case Step::PcurveFitted:
    case Step::SeamInserted:
    case Step::PoleInserted:
    case Step::LoopReoriented:
    case Step::OuterAdded:
    case Step::SelfTouching:
    case Step::Misplaced:
    case Step::SearchEnded: return false;
  }
  return true;
}

bool names_edges(const FaceInput& input) {
  return std::any_of(input.loops.begin(), input.loops.end(), [](const TrimLoop& loop) {
    return std::any_of(loop.segments.begin(), loop.segments.end(), [](const TrimSegment& s) { return static_cast<bool>(s.edge); });
  });
}

void remember(const Body& body, const FaceInput& input, const std::vector<StepRecord>& steps, Face& face) {
  if (face.status == FaceStatus::Ok && std::none_of(steps.begin(), steps.end(), replaces)) return;
  face.repair = std::make_shared<const Repair>(
      Repair{detached(body, input.shared, input.loops), steps, input.outer_is_domain, input.brep_sense, input.tolerance_mm});
}

}  // namespace

std::string sentence(const StepRecord& s) {
  std::string where;
  if (s.loop >= 0) where = fmt::format(" in loop {}", s.loop + 1);
  if (s.segment >= 0) where += fmt::format(", segment {}", s.segment + 1);
  switch (s.step) {
    case Step::PcurveFitted:
      return fmt::format("parameter curve fitted within {:.3g} mm{}", s.after_mm, where);
    case Step::CurveDropped:
      return fmt::format("model curve {:.3g} mm off the parameter curve left out{}", s.before_mm, where);
    case Step::PcurveReplaced:
      return fmt::format("parameter curve {:.3g} mm off the model curve replaced{}", s.before_mm, where);
    case Step::SegmentReversed: return fmt::format("segment turned around{}", where);
    case Step::SegmentsReordered: return fmt::format("segments put in order{}", where);
    case Step::GapClosed: return fmt::format("gap of {:.3g} mm closed{}", s.before_mm, where);
    case Step::SeamInserted: return fmt::format("seam inserted{}", where);
    case Step::PoleInserted: return fmt::format("pole inserted{}", where);
    case Step::LoopReoriented: return fmt::format("loop turned around{}", where);
    case Step::OuterAdded: return "natural boundary added";
    case Step::LoopDropped: return fmt::format("loop without area left out{}", where);
    case Step::Clamped:
      return fmt::format("parameter curve {:.3g} mm outside the surface held at its border{}", s.before_mm, where);
    case Step::DuplicateRemoved: return fmt::format("repeated segment left out{}", where);
    case Step::SelfTouching: return fmt::format("loops touch{}", where);
    case Step::LoopSplit: return fmt::format("loop that crosses itself taken apart{}, a part of {:.3g} mm", where, s.before_mm);
    case Step::LoopsParted: return fmt::format("loops that cross each other strung together anew{}, a part of {:.3g} mm falls away", where, s.before_mm);
    case Step::SearchEnded: return fmt::format("search for crossings ended at its limit{}", where);
    case Step::Misplaced: return fmt::format("loop outside the outer one{}", where);
  }
  return {};
}

void detach(const Body& body, const SharedEdges* shared, TrimSegment& s) {
  if (!s.edge) return;
  s.curve = nullptr;
  if (s.edge.index < body.edges.size() && body[s.edge].curve) {
    const Edge e = shared ? shared->whole(body, s.edge) : body[s.edge];
    s.curve = std::make_shared<const Curve>(with_range(*e.curve, e.range));
  }
  s.edge = EdgeId{};
}

void turn(TrimLoop& loop) {
  std::reverse(loop.segments.begin(), loop.segments.end());
  for (TrimSegment& s : loop.segments) {
    s.curve_reversed = !s.curve_reversed;
    s.pcurve_reversed = !s.pcurve_reversed;
  }
}

std::string_view to_string(Step step) {
  switch (step) {
    case Step::PcurveFitted: return "pcurve-fitted";
    case Step::CurveDropped: return "curve-dropped";
    case Step::PcurveReplaced: return "pcurve-replaced";
    case Step::SegmentReversed: return "segment-reversed";
    case Step::SegmentsReordered: return "segments-reordered";
    case Step::GapClosed: return "gap-closed";
    case Step::SeamInserted: return "seam-inserted";
    case Step::PoleInserted: return "pole-inserted";
    case Step::LoopReoriented: return "loop-reoriented";
    case Step::OuterAdded: return "outer-added";
    case Step::LoopDropped: return "loop-dropped";
    case Step::Clamped: return "clamped";
    case Step::DuplicateRemoved: return "duplicate-removed";
    case Step::SelfTouching: return "self-touching";
    case Step::Misplaced: return "misplaced";
    case Step::LoopSplit: return "loop-split";
    case Step::SearchEnded: return "search-ended";
    case Step::LoopsParted: return "loops-parted";
  }
  return "unknown";
}

FaceOutcome make_face(Body& body, const FaceInput& input) {
  Face face;
  face.surface = input.surface;
  face.reversed = input.reversed;
  face.attributes = input.attributes;
  face.source = input.source;
  FaceOutcome outcome;
  const auto fail_with = [&](std::string reason) {
    face.status = FaceStatus::Failed;
    face.reason = std::move(reason);
    if (input.surface) remember(body, input, outcome.steps, face);
    outcome.face = body.add(std::move(face));
    return outcome;
  };
  if (!input.surface) return fail_with("there is no surface");

  constexpr double finest_mm = 1e-6;  // rounding of coordinates read from text
  const double tolerance = input.tolerance_mm > finest_mm ? input.tolerance_mm : finest_mm;
  const Sheet sheet(*input.surface, tolerance);
  SharedEdges alone;
  if (!input.shared && names_edges(input)) alone.use_all(body);
  SharedEdges& shared = input.shared ? *input.shared : alone;
  Draft draft{input, sheet, body, shared, tolerance};
  run_stages(draft);
  outcome.steps = std::move(draft.steps);
  // Where the copies contradict and one bounds no face, the other may.
  std::optional<FaceInput> other;
  if (!draft.failure.empty() && !input.forbidden.contains(Step::PcurveReplaced)) other = by_model_curves(input, outcome.steps);
  if (other) {
    Draft second{*other, sheet, body, shared, tolerance};
    run_stages(second);
    if (second.failure.empty()) {
      std::erase_if(outcome.steps, [](const StepRecord& s) { return s.step != Step::CurveDropped; });
      for (StepRecord& s : outcome.steps) s.step = Step::PcurveReplaced, s.changes_shape = true;
      outcome.steps.insert(outcome.steps.end(), second.steps.begin(), second.steps.end());
      face.loops = Writer(body, second).write();
    }
  }
  if (face.loops.empty()) {
    outcome.bounds_nothing = draft.bounds_nothing;
    if (!draft.failure.empty()) return fail_with(std::move(draft.failure));
    face.loops = Writer(body, draft).write();
  }
  face.reason = reason_of(outcome.steps);
  face.status = face.reason.empty() ? FaceStatus::Ok : FaceStatus::Healed;
  remember(body, input, outcome.steps, face);
  outcome.face = body.add(std::move(face));
  return outcome;
}

FaceOutcome add_face(Body& body, const FaceInput& input) {
  FaceOutcome outcome = make_face(body, input);
  Face& face = body[outcome.face];
  if (face.status != FaceStatus::Healed || !input.measure_areas) return outcome;
  outcome.area_after_mm2 = area(body, outcome.face, area_accuracy).value;
  const Result<double> before = area_before(body, input, outcome.steps);
  if (before) face.area_before_mm2 = *before;
  else face.reason += fmt::format("; its area before cannot be said: {}", before.error().text);
  return outcome;
}

}  // namespace trimloop::heal
