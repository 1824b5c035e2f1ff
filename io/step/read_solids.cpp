// Faces, shells and solids.

#include <fmt/format.h>

#include <set>

#include "formats/step/records/geometry.h"
#include "formats/step/records/topology.h"
#include "formats/step/rules.h"
#include "io/rules.h"
#include "io/step/solids.h"
#include "kernel/check/measure.h"

namespace trimloop::io::step_import {

namespace sr = step::rules;

void BrepReader::solid(const Record& instance) {
  Visit visit(context_, instance);
  const auto r = visit ? context_.read<step::SolidRecord>(instance) : std::nullopt;
  if (!r) return;
  context_.consume(instance);
  const Record* outer = context_.resolve(instance, r->outer, Entity::ConnectedFaceSet);
  if (!outer) return;
  body_.kind = BodyKind::Solid;
  shell(*outer, false, false);
  for (const Ref ref : r->voids) {
    const Record* inner = context_.resolve(instance, ref, Entity::ConnectedFaceSet);
    if (!inner) continue;
    if (inner == outer) {
      context_.add(instance, sr::void_orientation, "a void is the outer shell; it is left out");
      continue;
    }
    const std::size_t before = body_.shells.size();
    shell(*inner, false, true);
    if (body_.shells.size() > before) turn_void(instance, ShellId{static_cast<std::uint32_t>(before)});
  }
}

// Some senders orient the shell of a void with the material inside, and turn it once more. A void takes away.
void BrepReader::turn_void(const Record& owner, ShellId id) {
  constexpr double sign_is_enough = 1e-3;
  const auto v = volume(body_, id, sign_is_enough);
  if (!v || v->value <= 0) return;
  context_.add(owner, sr::void_orientation, Severity::Warning, "a void is oriented as if it were material; it is turned", v->value, 0).unit = "mm3";
  for (Shell::Use& use : body_[id].faces) use.reversed = !use.reversed;
}

void BrepReader::shell(const Record& instance, bool turned, bool is_void) {
  Visit visit(context_, instance);
  if (!visit) return;
  context_.consume(instance);
  if (context_.is(instance, Entity::OrientedClosedShell) || context_.is(instance, Entity::OrientedOpenShell)) {
    const auto o = context_.read<step::Oriented>(instance);
    const Record* element = o ? context_.resolve(instance, o->element, Entity::ConnectedFaceSet) : nullptr;
    if (element) shell(*element, turned == o->orientation, is_void);
    return;
  }
  const auto r = context_.read<step::Members>(instance);
  if (!r) return;
  Shell shell;
  shell.is_void = is_void;
  shell.source.push_back(source_of(instance));
  std::set<std::size_t> listed;
  for (const Ref ref : r->items) {
    const Record* item = context_.resolve(instance, ref, Entity::Face);
    bool reversed = turned;
    for (int nested = 0; item && context_.is(*item, Entity::OrientedFace); ++nested) {
      const auto o = context_.read<step::Oriented>(*item);
      const Record* next = o ? context_.resolve(*item, o->element, Entity::Face) : nullptr;
      if (next == item || nested > 64) next = nullptr;
      if (o && !o->orientation) reversed = !reversed;
      item = next;
    }
    if (!item) continue;
    const std::size_t key = context_.index(*item);
    if (!listed.insert(key).second) {
      context_.add(instance, sr::shell_faces, fmt::format("face #{} is twice in the shell; one is used", item->id));
      continue;
    }
    const FaceId made = face(*item);
    if (!empty_.contains(made)) shell.faces.push_back({made, reversed});
  }
  if (shell.faces.empty()) {
    context_.add(instance, sr::shell_faces, "the shell has no face", 0, 1);
    return;
  }
  const ShellId id = body_.add(std::move(shell));
  heal::finish_shell(body_, id);
  if (context_.is(instance, Entity::ClosedShell) && !body_[id].closed)
    context_.add(instance, sr::closed_shell_edges, "the shell is said to be closed, but some edge is not used twice in opposite directions");
}

FaceId BrepReader::face(const Record& instance) {
  const std::size_t key = context_.index(instance);
  if (const auto known = faces_.find(key); known != faces_.end()) return known->second;
  if (context_.is_consumed(instance))
    context_.add(instance, rules::shared_face, "the face belongs to another body too; each gets a copy");
  step::FaceRecord record;
  context_.forget_text();
  auto input = face_input(instance, record);
  const std::string why = input ? std::string() : context_.last_text();
  const FaceId id = add(instance, std::move(input), attributes_(instance, record.name), why);
  faces_.emplace(key, id);
  return id;
}

namespace {

template <class Visit>
void each_corner(const Body& body, const heal::SharedEdges& shared, const heal::TrimLoop& loop, Visit visit) {
  for (const heal::TrimSegment& s : loop.segments) {
    const Edge e = shared.whole(body, s.edge);
    visit(body[s.curve_reversed ? e.end : e.start].point);
  }
}

}  // namespace

// Through the corners of a polygon, turned as they run (Newell).
std::optional<Plane> BrepReader::plane_through(const heal::TrimLoop& polygon) const {
  Vector n;
  std::optional<Point> first, last;
  each_corner(body_, shared_, polygon, [&](Point p) {
    if (!first) first = p;
    else n += cross(*last - *first, p - *first);
    last = p;
  });
  if (!(norm(n) > 0)) return std::nullopt;
  return Plane{make_frame(*first, n)};
}

double BrepReader::farthest_corner(const heal::TrimLoop& polygon, const Plane& plane) const {
  double off = 0;
  each_corner(body_, shared_, polygon, [&](Point p) { off = std::max(off, std::abs(dot(p - plane.frame.origin, plane.frame.z))); });
  return off;
}

template <class Visit>
void BrepReader::each_point(const std::vector<heal::TrimLoop>& loops, Visit visit) const {
  constexpr int samples = 8;
  for (const heal::TrimLoop& l : loops)
    for (const heal::TrimSegment& s : l.segments) {
      const Edge e = s.edge ? shared_.whole(body_, s.edge) : Edge{};
      const CurvePtr& curve = s.edge ? e.curve : s.curve;
      if (!curve) continue;
      const Interval r = s.edge ? e.range : range(*curve);
      for (int k = 0; k <= samples; ++k) visit(evaluate(*curve, r.at(k / double(samples))));
    }
}

// The part of an elementary surface that the edges lie on, where its record does not say.
void BrepReader::choose_part(const std::vector<heal::TrimLoop>& loops, PlacedSurface& placed) const {
  const double tolerance = geometry_.units().uncertainty_mm;
  if (const auto* torus = std::get_if<Torus>(&placed.surface->shape); torus && torus->minor_radius > torus->major_radius) {
    // It goes through itself. Where the major radius was negative each of its sheets looks away from the axis.
    double off_outer = 0, off_inner = 0;
    each_point(loops, [&](Point p) {
      const Vector d = p - torus->frame.origin;
      const double z = dot(d, torus->frame.z), rho = norm(d - z * torus->frame.z);
      off_outer = std::max(off_outer, std::abs(std::hypot(rho - torus->major_radius, z) - torus->minor_radius));
      off_inner = std::max(off_inner, std::abs(std::hypot(rho + torus->major_radius, z) - torus->minor_radius));
    });
    if (std::min(off_outer, off_inner) > tolerance || off_outer == off_inner) return;
    const bool outer = off_outer < off_inner;
    placed.flipped = placed.flipped != (placed.turned_inside && !outer);
    placed.surface = spindle_sheet(*torus, outer);
  } else if (const auto* cone = std::get_if<Cone>(&placed.surface->shape)) {
    // It goes on beyond its apex, ours ends there. Both parts look away from the axis.
    const double to_apex = -cone->radius / std::tan(cone->half_angle_rad), side = cone->half_angle_rad > 0 ? 1 : -1;
    double lowest = infinity, highest = -infinity;
    each_point(loops, [&](Point p) {
      const double beyond = side * (dot(p - cone->frame.origin, cone->frame.z) - to_apex);
      lowest = std::min(lowest, beyond), highest = std::max(highest, beyond);
    });
    if (!(lowest < -tolerance) || !(highest <= tolerance)) return;
    Cone other;
    other.frame = make_frame(cone->frame.origin + to_apex * cone->frame.z, -side * cone->frame.z, cone->frame.x);
    other.half_angle_rad = std::abs(cone->half_angle_rad);
    placed.surface = std::make_shared<const Surface>(Surface{other});
  }
}

// Its first bound is a POLY_LOOP.
bool BrepReader::is_polygon(const Record& face, const step::FaceRecord& record) {
  const Record* bound = record.bounds.empty() ? nullptr : context_.resolve(face, record.bounds.front(), Entity::FaceBound);
  const auto b = bound ? context_.read<step::FaceBound>(*bound) : std::nullopt;
  const Record* loop = b ? context_.find(b->loop) : nullptr;
  return loop && context_.is(*loop, Entity::PolyLoop);
}

std::optional<heal::FaceInput> BrepReader::face_input(const Record& instance, step::FaceRecord& record) {
  Visit visit(context_, instance);
  if (!visit) return std::nullopt;
  const Record* with_surface = &instance;
  if (context_.is(instance, Entity::Subface)) {
    step::Tape tape;
    step::Reader r(context_.file, instance, context_.execution.limits, tape, context_.report);
    const Ref parent = r.at(Entity::Subface) ? r.ref(0) : Ref{};
    with_surface = context_.resolve(instance, parent, Entity::FaceSurface);
    if (!with_surface) return std::nullopt;
  }
  auto own = context_.read<step::FaceRecord>(instance);
  if (!own) return std::nullopt;
  record = *own;
  if (with_surface != &instance) {
    const auto parent = context_.read<step::FaceRecord>(*with_surface);
    if (!parent) return std::nullopt;
    record.surface = parent->surface;
    record.same_sense = parent->same_sense;
  }
  heal::FaceInput input;
  input.brep_sense = true;
  input.tolerance_mm = geometry_.units().uncertainty_mm;
  input.shared = &shared_;
  input.source = {source_of(instance)};
  const Record* surface_instance = nullptr;
  std::optional<PlacedSurface> placed;
  if (record.surface) {
    surface_instance = context_.resolve(instance, record.surface, Entity::Surface);
    placed = surface_instance ? geometry_.surface(*surface_instance) : std::nullopt;
    if (!placed) return std::nullopt;
    input.source.push_back(source_of(*surface_instance, 1));
  } else {
    placed.emplace();  // FACE of a faceted B-rep: the plane of its polygon
  }
  std::size_t outer = 0;
  for (const Ref ref : record.bounds) {
    const Record* bound = context_.resolve(instance, ref, Entity::FaceBound);
    const auto b = bound ? context_.read<step::FaceBound>(*bound) : std::nullopt;
    const Record* loop_instance = b ? context_.find(b->loop) : nullptr;
    const bool is_loop = loop_instance && (context_.is(*loop_instance, Entity::Loop) || context_.is(*loop_instance, Entity::Path));
    if (b && !is_loop) context_.add(*bound, loop_instance ? sr::attribute_type : sr::reference_unresolved, fmt::format("#{} is no loop", b->loop.id));
    auto one = is_loop ? loop(instance, *loop_instance, b->orientation, surface_instance, *placed) : std::nullopt;
    if (!one) {
      if (context_.last_text().empty()) context_.add(instance, sr::face_bounds, fmt::format("bound #{} cannot be used", ref.id));
      return std::nullopt;  // without one of its borders the face would be something else
    }
    one->claimed_outer = b->is_outer;
    outer += b->is_outer;
    input.loops.push_back(std::move(*one));
  }
  if (outer > 1) context_.add(instance, sr::face_bounds, "the face has more than one outer bound; the largest counts", static_cast<double>(outer), 1);
  if (input.loops.empty()) context_.add(instance, sr::face_bounds, "the face has no bound; the natural border of its surface is taken", 0, 1);

  // 1. The plane of a polygon: where none is given, or one that the polygon does not lie in.
  replaced_plane_.clear();
  if (!placed->surface) {
    const auto plane = input.loops.empty() ? std::nullopt : plane_through(input.loops.front());
    if (!plane) {
      context_.add(instance, sr::aggregate_bounds, "the polygon of the face has no area");
      return std::nullopt;
    }
    placed->surface = std::make_shared<const Surface>(Surface{*plane});
  } else if (const auto* given = std::get_if<Plane>(&placed->surface->shape); given && !input.loops.empty() && is_polygon(instance, record)) {
    const double off = farthest_corner(input.loops.front(), *given), limit = 10 * input.tolerance_mm;
    const auto plane = off > limit ? plane_through(input.loops.front()) : std::nullopt;
    if (plane && farthest_corner(input.loops.front(), *plane) <= input.tolerance_mm) {
      replaced_plane_ = fmt::format("plane {:.3g} mm off the corners of the polygon replaced", off);
      context_.add(instance, rules::gap_edge_surface, Severity::Error, "the polygon does not lie in the plane of the face; the plane through its corners is taken",
                   off, input.tolerance_mm);
      placed->surface = std::make_shared<const Surface>(Surface{*plane});
      placed->flipped = !record.same_sense;  // the polygon runs about the normal of the face
    }
  }
  choose_part(input.loops, *placed);
  // 2. Swept surfaces without end: as much as the edges need.
  Box box;
  const bool unbounded = std::holds_alternative<Extrusion>(placed->surface->shape) || std::holds_alternative<Revolution>(placed->surface->shape) ||
                         std::holds_alternative<OffsetSurface>(placed->surface->shape);
  if (unbounded) {
    for (const auto& l : input.loops)
      for (const auto& s : l.segments)
        if (s.edge) {
          const Edge e = shared_.whole(body_, s.edge);
          for (int k = 0; k <= 8; ++k) box.add(evaluate(*e.curve, e.range.at(k / 8.0)));
        }
    if (!box.empty()) {
      const double room = 0.25 * box.diagonal();
      box.add(box.lo - Vector{room, room, room});
      box.add(box.hi + Vector{room, room, room});
    }
  }
  input.surface = unbounded ? bounded_for(placed->surface, box) : placed->surface;
  input.reversed = record.same_sense == placed->flipped;
  // Bounds run about the face's normal; ours about Su x Sv.
  if (input.reversed)
    for (heal::TrimLoop& l : input.loops) heal::turn(l);
  input.range_u = placed->range_u;
  input.range_v = placed->range_v;
  return input;
}

FaceId BrepReader::add(const Record& instance, std::optional<heal::FaceInput> input, AttributesId attributes, const std::string& why) {
  context_.consume(instance);
  if (!input) {
    Face failed;
    failed.status = FaceStatus::Failed;
    failed.reason = why.empty() ? "its record cannot be used" : why;
    failed.attributes = attributes;
    failed.source.push_back(source_of(instance));
    context_.add(instance, rules::unsupported, Severity::Error, "the face failed: " + failed.reason);
    return body_.add(std::move(failed));
  }
  input->attributes = attributes;
  const heal::FaceOutcome outcome = heal::add_face(body_, *input);
  report_healing(context_, instance, *input, outcome);
  if (outcome.bounds_nothing) empty_.insert(outcome.face);
  Face& face = body_[outcome.face];
  if (!replaced_plane_.empty() && face.status != FaceStatus::Failed) {
    face.status = FaceStatus::Healed;
    face.reason = face.reason.empty() ? replaced_plane_ : replaced_plane_ + "; " + face.reason;
  }
  if (face.status == FaceStatus::Failed)
    context_.add(instance, rules::unsupported, Severity::Error, "the face failed: " + face.reason);
  return outcome.face;
}

// A boundary curve of a CURVE_BOUNDED_SURFACE: composite curves on the surface.
bool BrepReader::boundary_loop(const Record& owner, Ref ref, const PlacedSurface&, heal::TrimLoop& out) {
  const Record* instance = context_.resolve(owner, ref, Entity::Curve);
  const CurvePtr c = instance ? geometry_.curve(*instance) : nullptr;
  if (!c || (!is_bounded(*c) && !is_closed_by_nature(*c))) return false;
  out.trust = heal::Trust::Model;
  out.claimed_outer = context_.is(*instance, Entity::OuterBoundaryCurve);
  out.source.push_back(source_of(*instance, 4));
  // Each piece by itself: a corner of the border, perhaps at a pole, lies between two of them.
  std::vector<CompositeCurve::Segment> pieces{{c, false}};
  while (!pieces.empty()) {
    const CompositeCurve::Segment piece = pieces.back();
    pieces.pop_back();
    if (const auto* composite = std::get_if<CompositeCurve>(&piece.curve->shape)) {
      const auto& inner = composite->segments;
      for (std::size_t k = 0; k < inner.size(); ++k) {  // last first: the stack turns them round
        const auto& next = inner[piece.reversed ? k : inner.size() - 1 - k];
        pieces.push_back({next.curve, next.reversed != piece.reversed});
      }
      continue;
    }
    heal::TrimSegment s;
    s.curve = piece.curve;
    s.curve_reversed = piece.reversed;
    s.source.push_back(source_of(*instance, 2));
    out.segments.push_back(std::move(s));
  }
  return true;
}

FaceId BrepReader::surface_face(const Record& instance) {
  const std::size_t key = context_.index(instance);
  if (const auto known = faces_.find(key); known != faces_.end()) return known->second;
  context_.forget_text();
  const auto placed = geometry_.surface(instance);
  std::optional<heal::FaceInput> input;
  if (placed) {
    input.emplace();
    input->surface = placed->surface;
    input->reversed = placed->flipped;
    input->range_u = placed->range_u;
    input->range_v = placed->range_v;
    input->tolerance_mm = geometry_.units().uncertainty_mm;
    input->source = {source_of(instance)};
    if (context_.is(instance, Entity::CurveBoundedSurface)) {
      const auto r = context_.read<step::CurveBounded>(instance);
      Box box;
      for (const Ref ref : r ? r->boundaries : std::vector<Ref>{}) {
        heal::TrimLoop one;
        if (!boundary_loop(instance, ref, *placed, one)) {
          if (context_.last_text().empty()) context_.add(instance, sr::face_bounds, fmt::format("boundary #{} cannot be used", ref.id));
          input.reset();
          break;
        }
        for (const heal::TrimSegment& s : one.segments) box.add(bounding_box(*s.curve));
        input->loops.push_back(std::move(one));
      }
      if (input) {
        PlacedSurface part = *placed;
        if (!part.range_u && !part.range_v) choose_part(input->loops, part);
        input->reversed = part.flipped;
        input->outer_is_domain = r && r->implicit_outer;
        input->surface = bounded_for(part.surface, box);
      }
    }
    if (input) {
      // Swept surfaces trimmed by parameters only.
      if (const auto* e = std::get_if<Extrusion>(&input->surface->shape); e && input->loops.empty() && input->range_u && input->range_v) {
        Extrusion cut = *e;
        cut.directrix = std::make_shared<const Curve>(with_range(*e->directrix, *input->range_u));
        cut.range_v = *input->range_v;
        input->surface = std::make_shared<const Surface>(Surface{std::move(cut)});
      }
      if (const auto* r = std::get_if<Revolution>(&input->surface->shape); r && input->loops.empty() && input->range_v) {
        Revolution cut = *r;
        cut.generatrix = std::make_shared<const Curve>(with_range(*r->generatrix, *input->range_v));
        if (input->range_u) cut.range_u = *input->range_u;
        input->surface = std::make_shared<const Surface>(Surface{std::move(cut)});
      }
    }
  }
  const std::string why = input ? std::string() : context_.last_text();
  const FaceId id = add(instance, std::move(input), attributes_(instance, {}), why);
  faces_.emplace(key, id);
  return id;
}

}  // namespace trimloop::io::step_import
