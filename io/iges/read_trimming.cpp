#include "formats/iges/records/trimming.h"

#include "formats/iges/records/surfaces.h"
#include "formats/iges/rules.h"
#include "io/iges/curves.h"
#include "io/iges/healing_report.h"
#include "io/iges/placement.h"
#include "io/iges/surfaces.h"
#include "io/iges/trimming.h"
#include "io/rules.h"

namespace trimloop::io::iges_import {
namespace {

namespace igr = iges::rules;
using heal::TrimLoop;
using heal::TrimSegment;
using heal::Trust;

bool is_142(const DirectoryEntry& e) { return e.type == 142; }
bool is_141(const DirectoryEntry& e) { return e.type == 141; }

CurvePtr share(std::optional<Curve> curve) {
  return curve ? std::make_shared<const Curve>(std::move(*curve)) : nullptr;
}

// One segment of a loop: parameter curve (still in the file's numbers) and model curve, either may be missing.
std::optional<TrimSegment> segment(Context& context, const CurvePiece* flat, const CurvePiece* model,
                                   const Transform& outer) {
  TrimSegment out;
  if (model) {
    out.curve = moved(context, model_curve(context, *model), outer);
    if (out.curve && !is_bounded(*out.curve)) {
      context.add(igr::target_type, name_of(*model->entry) + " has no end and cannot bound a face");
      out.curve = nullptr;
    }
    out.source.push_back(source_of(*model->entry, 2));
  }
  if (flat) {
    if (auto curve = parameter_curve(context, *flat); curve && is_bounded(*curve)) out.pcurve = {std::move(*curve)};
    out.source.push_back(source_of(*flat->entry, 3));
  }
  if (!out.curve && !out.pcurve) return std::nullopt;
  return out;
}

Trust trust_of_142(int preference) {
  return preference == 1 ? Trust::Parameter : preference == 2 ? Trust::Model : Trust::Either;
}
Trust trust_of_141(int preference) {  // the other way round
  return preference == 1 ? Trust::Model : preference == 2 ? Trust::Parameter : Trust::Either;
}

// What a face's loops have in common.
struct Owner {
  const DirectoryEntry& face;
  const DirectoryEntry& surface_entry;
  const PlacedSurface& surface;
  Transform outer;   // matrix of the face entity itself
};

// A parameter-space piece that stays at one point of the surface, a pole: no model curve stands beside it.
bool stays_at_a_point(Context& context, const Owner& owner, const CurvePiece& flat) {
  const auto curve = parameter_curve(context, flat);
  if (!curve || !is_bounded(*curve)) return false;
  const Interval t = range(*curve);
  const auto at = [&](double s) {
    const Point p = evaluate(*curve, t.lo + s * t.length());
    return evaluate(*owner.surface.surface, apply(owner.surface.map, Uv{p.x, p.y}));
  };
  const Point first = at(0);
  for (const double s : {0.25, 0.5, 0.75, 1.0}) {
    if (!(distance(at(s), first) <= context.resolution_mm)) return false;
  }
  return true;
}

// The members of both curves side by side: paired when there are equally many, poles of the surface left aside; else
// each curve as a whole.
bool add_segments(Context& context, const Owner* owner, const DirectoryEntry* flat, const DirectoryEntry* model,
                  const Transform& outer, TrimLoop& loop) {
  std::vector<CurvePiece> flats, models;
  if (flat) flats = pieces(context, *flat, 1);
  if (model) models = pieces(context, *model, context.unit.scale);
  std::vector<bool> alone(flats.size(), false);
  if (!flats.empty() && !models.empty() && flats.size() != models.size()) {
    std::size_t paired = flats.size();
    for (std::size_t i = 0; owner && flats.size() > models.size() && i < flats.size(); ++i) {
      alone[i] = stays_at_a_point(context, *owner, flats[i]);
      paired -= alone[i];
    }
    if (paired != models.size()) {
      flats = {{flat, {}}};
      models = {{model, {}}};
      alone = {false};
    }
  }
  std::size_t next = 0;  // of the model pieces
  for (std::size_t i = 0; i < std::max(flats.size(), models.size()); ++i) {
    const bool has_model = next < models.size() && !(i < flats.size() && alone[i]);
    auto s = segment(context, i < flats.size() ? &flats[i] : nullptr, has_model ? &models[next++] : nullptr, outer);
    if (!s) return false;  // a border with a piece missing would bound something else
    loop.segments.push_back(std::move(*s));
  }
  return !loop.segments.empty();
}

std::optional<TrimLoop> loop_142(Context& context, const Owner& owner, const DirectoryEntry& entry) {
  Visit visit(context, entry);
  const auto* r = visit ? context.record<iges::CurveOnSurface>(entry) : nullptr;
  if (!r) return std::nullopt;
  context.state(entry).consumed = true;
  if (r->surface && r->surface.de != owner.surface_entry.de)
    context.add(igr::e142::surface_mismatch, "the curve names surface D" + std::to_string(r->surface.de) +
                                                 ", its owner " + name_of(owner.surface_entry) + "; the owner's is used");
  const DirectoryEntry* flat = context.resolve(r->pcurve, is_curve, "a parameter-space curve");
  const DirectoryEntry* model = context.resolve(r->curve, is_curve, "a model-space curve");
  if (flat && !owner.surface.has_parameters) {
    context.add(*flat, rules::ignored, "parameters of a plane (108) are not fixed by the standard: the curve is not used");
    flat = nullptr;
  }
  TrimLoop loop;
  loop.trust = trust_of_142(r->preference);
  loop.source.push_back(source_of(entry, 4));
  if (!add_segments(context, &owner, flat, model, owner.outer * model_placement(context, entry), loop)) {
    context.add(entry, igr::e142::both_null, "neither curve of this boundary can be used");
    return std::nullopt;
  }
  return loop;
}

// Parameter curves of one item of a 141, end to end, as one curve of the file's numbers.
std::optional<Curve2> item_pcurve(Context& context, const std::vector<Ref>& refs) {
  std::vector<CompositeCurve::Segment> segments;
  for (const Ref ref : refs) {
    const DirectoryEntry* e = context.resolve(ref, is_curve, "a parameter-space curve");
    CurvePtr curve = e ? share(parameter_curve(context, *e)) : nullptr;
    if (!curve || !is_bounded(*curve)) return std::nullopt;
    segments.push_back({std::move(curve), false});
  }
  if (segments.empty()) return std::nullopt;
  if (segments.size() == 1) return Curve2{*segments[0].curve};
  return Curve2{{make_composite(std::move(segments))}};
}

// Nothing: the boundary cannot be used. A loop without segments: it has none (N = 0) and bounds nothing.
std::optional<TrimLoop> loop_141(Context& context, const Owner& owner, const DirectoryEntry& entry) {
  Visit visit(context, entry);
  const auto* r = visit ? context.record<iges::Boundary>(entry) : nullptr;
  if (!r) return std::nullopt;
  context.state(entry).consumed = true;
  if (r->surface && r->surface.de != owner.surface_entry.de)
    context.add(igr::e143::surface, "the boundary names surface D" + std::to_string(r->surface.de) + ", its owner " +
                                        name_of(owner.surface_entry) + "; the owner's is used");
  TrimLoop loop;
  loop.trust = trust_of_141(r->preference);
  loop.source.push_back(source_of(entry, 4));
  const Transform outer = owner.outer * model_placement(context, entry);
  for (const auto& item : r->items) {
    TrimSegment s;
    if (const DirectoryEntry* e = context.resolve(item.curve, is_curve, "a model-space curve")) {
      s.curve = moved(context, model_curve(context, *e), outer);
      if (s.curve && !is_bounded(*s.curve)) s.curve = nullptr;
      s.curve_reversed = item.sense == 2;  // parameter curves run with the boundary whatever the sense
      s.source.push_back(source_of(*e, 2));
    }
    if (owner.surface.has_parameters) s.pcurve = item_pcurve(context, item.pcurves);
    for (const Ref ref : item.pcurves) s.source.push_back({static_cast<std::uint64_t>(std::abs(ref.de)), 3});
    if (!s.curve && !s.pcurve) {
      context.add(igr::e141::flags, "neither curve of an item of this boundary can be used");
      return std::nullopt;
    }
    loop.segments.push_back(std::move(s));
  }
  if (loop.segments.empty())
    context.add(igr::e141::chain, "the boundary has no curves; the natural border of the surface is taken", 0, 1);
  return loop;
}

// A 108's boundary: model curves alone.
std::optional<TrimLoop> loop_of_plane(Context& context, const DirectoryEntry& plane, Ref boundary, const Transform& outer) {
  const DirectoryEntry* curve =
      context.resolve(boundary, [](const DirectoryEntry& e) { return is_curve(e) || is_142(e); }, "a closed curve");
  TrimLoop loop;
  if (curve && is_142(*curve)) {  // seen in place of the curve itself
    const auto* r = context.record<iges::CurveOnSurface>(*curve);
    curve = r ? context.resolve(r->curve, is_curve, "a model-space curve") : nullptr;
  }
  if (!curve || !add_segments(context, nullptr, nullptr, curve, outer, loop)) {
    context.add(plane, igr::e108::bound_off_plane, "the boundary of the plane cannot be used");
    return std::nullopt;
  }
  loop.trust = Trust::Model;
  loop.source.push_back(source_of(*curve, 4));
  return loop;
}

heal::FaceInput input_for(Context& context, const DirectoryEntry& face, const DirectoryEntry& surface_entry,
                          const PlacedSurface& surface) {
  heal::FaceInput input;
  input.surface = surface.surface;
  input.reversed = surface.flipped();
  input.tolerance_mm = context.resolution_mm;
  input.source.push_back(source_of(face));
  if (&face != &surface_entry) input.source.push_back(source_of(surface_entry, 1));
  return input;
}

// The surface a face entity names, under that entity's own matrix.
std::optional<PlacedSurface> surface_of(Context& context, const DirectoryEntry& face, Ref ref,
                                        const DirectoryEntry*& surface_entry) {
  surface_entry = context.resolve(ref, is_surface, "a surface");
  if (!surface_entry) return std::nullopt;
  context.state(*surface_entry).consumed = true;
  const PlacedSurface* surface = model_surface(context, *surface_entry);
  return surface ? moved(context, *surface, model_placement(context, face)) : std::nullopt;
}

std::optional<heal::FaceInput> trimmed_surface(Context& context, const DirectoryEntry& entry) {
  const auto* r = context.record<iges::TrimmedSurface>(entry);
  if (!r) return std::nullopt;
  const DirectoryEntry* surface_entry = nullptr;
  const auto surface = surface_of(context, entry, r->surface, surface_entry);
  if (!surface) return std::nullopt;
  const Owner owner{entry, *surface_entry, *surface, model_placement(context, entry)};
  heal::FaceInput input = input_for(context, entry, *surface_entry, *surface);
  const DirectoryEntry* outer = context.resolve(r->outer, is_142, "a curve on the surface (142)");
  if (outer) {
    auto loop = loop_142(context, owner, *outer);
    if (!loop) return std::nullopt;  // without its border the face would be something else
    loop->claimed_outer = true;
    input.loops.push_back(std::move(*loop));
  } else if (r->outer) {
    return std::nullopt;
  }
  if (!outer && surface_entry->type == 108 && surface_entry->form == 1) {
    // What a bounded plane has for a domain is its own boundary.
    const auto* plane = context.record<iges::PlaneRecord>(*surface_entry);
    auto loop = plane ? loop_of_plane(context, *surface_entry, plane->boundary,
                                      owner.outer * model_placement(context, *surface_entry))
                      : std::nullopt;
    if (!loop) return std::nullopt;
    loop->claimed_outer = true;
    input.loops.push_back(std::move(*loop));
  }
  input.outer_is_domain = input.loops.empty();
  for (const Ref ref : r->inner) {
    const DirectoryEntry* inner = context.resolve(ref, is_142, "a curve on the surface (142)");
    if (!inner) continue;
    if (auto loop = loop_142(context, owner, *inner))
      input.loops.push_back(std::move(*loop));
    else
      context.add(igr::e144::nesting, "hole " + name_of(*inner) + " cannot be used; the face is made without it");
  }
  map_pcurves(context, entry, *surface, input.loops);
  return input;
}

std::optional<heal::FaceInput> bounded_surface(Context& context, const DirectoryEntry& entry) {
  const auto* r = context.record<iges::BoundedSurface>(entry);
  if (!r) return std::nullopt;
  const DirectoryEntry* surface_entry = nullptr;
  const auto surface = surface_of(context, entry, r->surface, surface_entry);
  if (!surface) return std::nullopt;
  const Owner owner{entry, *surface_entry, *surface, model_placement(context, entry)};
  heal::FaceInput input = input_for(context, entry, *surface_entry, *surface);
  for (const Ref ref : r->boundaries) {
    const DirectoryEntry* boundary = context.resolve(ref, is_141, "a boundary (141)");
    auto loop = boundary ? loop_141(context, owner, *boundary) : std::nullopt;
    if (!loop && ref == r->boundaries.front()) return std::nullopt;  // the outer one by practice
    if (!loop) {
      context.add(igr::e144::nesting, "boundary D" + std::to_string(ref.de) + " cannot be used; the face is made without it");
      continue;
    }
    loop->claimed_outer = input.loops.empty();
    if (!loop->segments.empty()) input.loops.push_back(std::move(*loop));
  }
  map_pcurves(context, entry, *surface, input.loops);
  return input;
}

std::optional<heal::FaceInput> bounded_plane(Context& context, const DirectoryEntry& entry,
                                             const std::vector<const DirectoryEntry*>& holes) {
  const auto* r = context.record<iges::PlaneRecord>(entry);
  const PlacedSurface* surface = r ? model_surface(context, entry) : nullptr;
  if (!surface) return std::nullopt;
  auto outer = loop_of_plane(context, entry, r->boundary, model_placement(context, entry));
  if (!outer) return std::nullopt;
  heal::FaceInput input = input_for(context, entry, entry, *surface);
  outer->claimed_outer = true;
  input.loops.push_back(std::move(*outer));
  for (const DirectoryEntry* hole : holes) {
    const auto* record = context.record<iges::PlaneRecord>(*hole);
    context.state(*hole).consumed = true;
    auto loop = record ? loop_of_plane(context, *hole, record->boundary, model_placement(context, *hole)) : std::nullopt;
    if (loop)
      input.loops.push_back(std::move(*loop));
    else
      context.add(igr::e144::nesting, "hole " + name_of(*hole) + " cannot be used; the face is made without it");
  }
  // Parameters near the face keep their digits: the frame starts at the border, not at the foot of the origin.
  if (const auto* plane = std::get_if<Plane>(&surface->surface->shape)) {
    Plane near = *plane;
    const Point p = start_point(*input.loops.front().segments.front().curve);
    near.frame.origin = p - dot(p - plane->frame.origin, plane->frame.z) * plane->frame.z;
    input.surface = std::make_shared<const Surface>(Surface{near});
  }
  return input;
}

// How far the ends of the pcurves, read by `map`, are from the ends of the model curves: largest over all segments.
double end_mismatch(const Surface& surface, const UvMap& map, const std::vector<TrimLoop>& loops, const Body* edges) {
  double worst = 0;
  for (const TrimLoop& loop : loops) {
    for (const TrimSegment& s : loop.segments) {
      const CurvePtr curve = s.curve ? s.curve : edges && s.edge ? (*edges)[s.edge].curve : nullptr;
      if (!s.pcurve || !curve || !is_bounded(*curve)) continue;
      const Interval t = range(*s.pcurve);
      const Point a = evaluate(surface, apply(map, evaluate(*s.pcurve, t.lo)));
      const Point b = evaluate(surface, apply(map, evaluate(*s.pcurve, t.hi)));
      const Point c = start_point(*curve), d = end_point(*curve);
      const double off = std::min(std::max(distance(a, c), distance(b, d)), std::max(distance(a, d), distance(b, c)));
      if (!(off <= worst)) worst = off;  // NaN counts as infinitely far
    }
  }
  return worst == worst ? worst : infinity;
}

}  // namespace

std::optional<heal::FaceInput> face_input(Context& context, const DirectoryEntry& entry,
                                          const std::vector<const DirectoryEntry*>& holes) {
  // A surface that is its own face visits itself while it is read.
  const PlacedSurface* surface = is_surface(entry) ? model_surface(context, entry) : nullptr;
  const bool bounded_by_others = entry.type == 144 || entry.type == 143 || (entry.type == 108 && entry.form != 0);
  if (!bounded_by_others)
    return surface ? std::optional(input_for(context, entry, entry, *surface)) : std::nullopt;
  Visit visit(context, entry);
  if (!visit) return std::nullopt;
  if (entry.type == 144) return trimmed_surface(context, entry);
  if (entry.type == 143) return bounded_surface(context, entry);
  return bounded_plane(context, entry, holes);
}

void map_pcurves(Context& context, const DirectoryEntry& face, const PlacedSurface& surface,
                 std::vector<heal::TrimLoop>& loops, const Body* edges) {
  UvMap map = surface.map;
  if (surface.second_map) {
    const double first = end_mismatch(*surface.surface, map, loops, edges);
    const double second = first > context.resolution_mm
                              ? end_mismatch(*surface.surface, *surface.second_map, loops, edges)
                              : infinity;
    if (second < first) {
      map = *surface.second_map;
      context.add(face, rules::ignored,
                  "angles of the parameter curves are read as radians, not as the degrees of the standard: that brings "
                  "them nearer to the model curves",
                  second, first);
    }
  }
  for (heal::TrimLoop& loop : loops) {
    for (heal::TrimSegment& s : loop.segments) {
      if (!s.pcurve) continue;
      auto curve = mapped(map, std::move(s.pcurve->curve));
      if (curve)
        s.pcurve = std::move(*curve);
      else
        s.pcurve.reset();
    }
  }
}

FaceId add_face(Context& context, Body& body, const DirectoryEntry& entry, std::optional<heal::FaceInput> input,
                AttributesId attributes) {
  context.state(entry).consumed = true;
  if (!input) {
    Face failed;
    failed.status = FaceStatus::Failed;
    failed.reason = context.last_text().empty() ? "its record cannot be used" : context.last_text();
    failed.attributes = attributes;
    failed.source.push_back(source_of(entry));
    context.add(entry, rules::unsupported, Severity::Error, "the face failed: " + failed.reason);
    return body.add(std::move(failed));
  }
  input->attributes = attributes;
  input->measure_areas = context.measure_healed;
  const heal::FaceOutcome outcome = heal::add_face(body, *input);
  const Face& face = body[outcome.face];
  report_healing(context, entry, *input, outcome, face);
  if (face.status == FaceStatus::Failed) {
    const bool endless = input->loops.empty() && !domain(*input->surface).is_bounded();
    context.add(entry, endless ? igr::e144::infinite_base : rules::unsupported, Severity::Error,
                "the face failed: " + face.reason);
  }
  return outcome.face;
}

}  // namespace trimloop::io::iges_import
