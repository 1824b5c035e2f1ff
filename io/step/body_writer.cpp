#include "io/step/body_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "io/step/edge_plan.h"
#include "io/step/joined_loops.h"
#include "kernel/pcurve/lift.h"
#include "kernel/topology/parameter_box.h"

namespace trimloop::io::step_export {

using step::Derived;

namespace {

class BodyWriter {
 public:
  BodyWriter(EntityWriter& writer, const Body& body)
      : w_(writer), body_(body), plan_(plan_edges(writer, body)), vertices_(body.vertices.size()), edges_(body.edges.size()),
        surfaces_(body.faces.size()) {
    for (const Face& f : body.faces) loops_.push_back(joined_loops(body, f));
    place_vertices();
  }

  WrittenBody run();

 private:
  InstanceId vertex(VertexId id);
  Result<InstanceId> edge(EdgeId id);
  void place_vertices();
  Result<CurvePtr> space_curve(const Edge& edge, const std::vector<EdgeUse>& uses);
  std::vector<InstanceId> pcurves(EdgeId id, const Curve& edge_curve, Interval range, bool& seam);
  const Result<WrittenSurface>& surface(const Face& face);
  Result<InstanceId> loop(const std::vector<const Coedge*>& coedges, bool turned);
  Result<InstanceId> face(const Face& face, bool turned);
  InstanceId kept_face(FaceId id, bool turned);
  std::string name_of(AttributesId id) const { return id ? w_.model[id].name : std::string(); }
  std::vector<InstanceId> faces_of(const Shell& shell, bool turned);
  bool is_sound(const Shell& shell) const;  // no face of it failed
  void write_solid(const std::vector<const Shell*>& voids, const Shell& outer);
  void write_sheets(const std::vector<const Shell*>& shells);
  void write_wires();

  EntityWriter& w_;
  const Body& body_;
  const EdgePlan plan_;
  WrittenBody out_;
  std::vector<InstanceId> vertices_, edges_;
  std::vector<Point> places_;  // of each vertex
  std::vector<std::optional<Result<WrittenSurface>>> surfaces_;  // of each face
  std::vector<JoinedLoops> loops_;                               // of each face
  std::map<const Surface*, WrittenSurface> shared_surfaces_;
  std::size_t second_borders_ = 0;  // edges whose model and parameter curve are not the same
  double worst_second_mm_ = 0;
};

// A vertex is where its file put it, but for one that is off all the edges that end at it while these meet: receivers cut
// edges at their vertices.
void BodyWriter::place_vertices() {
  std::vector<Box> ends(body_.vertices.size());
  for (const Edge& e : body_.edges) {
    if (e.is_pole || !e.curve) continue;
    ends[plan_.vertex(e.start).index].add(evaluate(*e.curve, e.range.lo));
    ends[plan_.vertex(e.end).index].add(evaluate(*e.curve, e.range.hi));
  }
  places_.reserve(ends.size());
  for (std::size_t v = 0; v < ends.size(); ++v) {
    const Point own = body_.vertices[v].point;
    const bool together = !ends[v].empty() && ends[v].diagonal() <= w_.model.resolution_mm;
    const Point met = together ? midpoint(ends[v].lo, ends[v].hi) : own;
    places_.push_back(distance(met, own) > w_.model.resolution_mm ? met : own);
  }
}

InstanceId BodyWriter::vertex(VertexId id) {
  id = plan_.vertex(id);
  InstanceId& known = vertices_[id.index];
  if (!known) {
    const InstanceId at = w_.point(places_[id.index]);
    known = w_.out.add("VERTEX_POINT", "", at);
  }
  return known;
}

const Result<WrittenSurface>& BodyWriter::surface(const Face& face) {
  std::optional<Result<WrittenSurface>>& known = surfaces_[static_cast<std::size_t>(&face - body_.faces.data())];
  if (known) return *known;
  const bool may_share = !w_.to_nurbs && !std::holds_alternative<Revolution>(face.surface->shape);
  const auto shared = shared_surfaces_.find(face.surface.get());
  if (may_share && shared != shared_surfaces_.end()) return known.emplace(shared->second);
  const ParameterBox box = parameter_box(body_, face);
  known = write_surface(w_, *face.surface, box.u, box.v);
  if (may_share && *known) shared_surfaces_.emplace(face.surface.get(), **known);
  return *known;
}

// Faces lie between their edges as the file draws these. Where the one face of an edge has its border elsewhere, farther
// than areas can bear, that border is the edge.
Result<CurvePtr> BodyWriter::space_curve(const Edge& edge, const std::vector<EdgeUse>& uses) {
  const EdgeUse& use = uses.front();
  const ParameterBox box = parameter_box(body_, *use.face);
  const double size = bounding_box(*use.face->surface, box.u, box.v).diagonal();
  constexpr double bearable = 1e-6;
  if (edge.curve && (uses.size() > 1 || !(use.coedge->gap_mm > bearable * size))) {
    const Interval own = range(*edge.curve);
    if (edge.range.lo == own.lo && edge.range.hi == own.hi) return edge.curve;
    return std::make_shared<const Curve>(with_range(*edge.curve, edge.range));
  }
  // Within 2e-10 of the face's size, so that the shape is the same; what is too wild for that, as near as it goes.
  double tolerance = 2e-10 * size;
  const Interval own = edge.curve ? use.coedge->pcurve_range : edge.range;  // descending where it runs against the edge
  const Interval over{std::min(own.lo, own.hi), std::max(own.lo, own.hi)};
  auto lifted = pcurve::lift(*use.face->surface, use.coedge->pcurve, over, tolerance);
  for (int k = 0; k < 4 && !lifted && lifted.error().code == ErrorCode::NoConvergence; ++k) {
    lifted = pcurve::lift(*use.face->surface, use.coedge->pcurve, over, tolerance *= 100);
  }
  if (!lifted) return tl::unexpected(lifted.error());
  if (lifted->deviation_mm > std::max(w_.model.resolution_mm, 1e-9 * size)) {
    w_.lose(use.face->source, fmt::format("an edge known only in parameter space: within {:.3g} mm", lifted->deviation_mm));
  }
  if (edge.curve) {
    ++second_borders_;
    worst_second_mm_ = std::max(worst_second_mm_, use.coedge->gap_mm);
  }
  return own.lo <= own.hi ? lifted->curve : std::make_shared<const Curve>(reversed(*lifted->curve));
}

// Receivers find the trimming of elementary surfaces by closed forms; on the others a search may go astray, at seams and
// poles above all.
bool wants_pcurve(const Surface& s) {
  return std::holds_alternative<NurbsSurface>(s.shape) || std::holds_alternative<Revolution>(s.shape) ||
         std::holds_alternative<Extrusion>(s.shape) || std::holds_alternative<Ruled>(s.shape) ||
         std::holds_alternative<OffsetSurface>(s.shape);
}

// PCURVEs of an edge, each over the parameters of the written model curve.
std::vector<InstanceId> BodyWriter::pcurves(EdgeId id, const Curve& edge_curve, Interval range, bool& seam) {
  std::vector<InstanceId> out;
  std::vector<const Face*> faces;
  for (const EdgeUse& use : plan_.uses[id.index]) {
    if (!wants_pcurve(*use.face->surface) || use.face->status == FaceStatus::Failed) continue;
    // Across a seam the pieces do not meet in the parameter plane; receivers take the model curves then.
    if (loops_[static_cast<std::size_t>(use.face - body_.faces.data())].crosses_seam) continue;
    const auto& s = surface(*use.face);
    if (!s || s->bent || s->elementary) continue;
    const std::optional<NurbsCurve> own = pcurve_along(body_, use, edge_curve, range, w_.model.resolution_mm);
    if (!own) continue;
    const UvMap& m = s->map;
    Transform map;
    map.r = {{{m.uu, m.uv, 0}, {m.vu, m.vv, 0}, {0, 0, 1}}};
    map.t = {m.u0, m.v0, 0};
    const InstanceId flat = write_pcurve(w_, is_identity(map) ? *own : transformed(*own, map));
    const InstanceId context = w_.parametric_context();
    const InstanceId representation = w_.out.add("DEFINITIONAL_REPRESENTATION", "", std::array{flat}, context);
    out.push_back(w_.out.add("PCURVE", "", s->id, representation));
    seam = seam || std::find(faces.begin(), faces.end(), use.face) != faces.end();
    faces.push_back(use.face);
  }
  return out;
}

Result<InstanceId> BodyWriter::edge(EdgeId id) {
  InstanceId& known = edges_[id.index];
  if (known) return known;
  const Edge& edge = body_[id];
  const auto curve = space_curve(edge, plan_.uses[id.index]);
  if (!curve) return tl::unexpected(curve.error());
  const InstanceId from = vertex(edge.start), to = vertex(edge.end);
  const auto geometry = write_curve(w_, **curve);
  if (!geometry) return tl::unexpected(geometry.error());
  InstanceId written = geometry->id;
  bool seam = false;
  const std::vector<InstanceId> flat = pcurves(id, geometry->bent ? *geometry->bent : **curve, geometry->range, seam);
  if (!flat.empty()) {
    seam = seam && flat.size() == 2;
    if (seam || flat.size() <= 2) {
      written = w_.out.add(seam ? "SEAM_CURVE" : "SURFACE_CURVE", "", geometry->id, flat, step::Enumeration{"CURVE_3D"});
    }
  }
  known = w_.out.add("EDGE_CURVE", "", from, to, written, true);
  return known;
}

// A pole has no edge of its own in the file: the loop passes through its vertex. A loop that is nothing but poles is that
// vertex.
Result<InstanceId> BodyWriter::loop(const std::vector<const Coedge*>& coedges, bool turned) {
  std::vector<InstanceId> uses;
  for (std::size_t k = 0; k < coedges.size(); ++k) {
    const Coedge& coedge = *coedges[turned ? coedges.size() - 1 - k : k];
    if (body_[coedge.edge].is_pole || plan_.left_out[coedge.edge.index]) continue;
    const EdgePlan::Twin& twin = plan_.twins[coedge.edge.index];
    const auto used = edge(twin.edge);
    if (!used) return used;
    const bool forward = (coedge.reversed == turned) != twin.reversed;
    uses.push_back(w_.out.add("ORIENTED_EDGE", "", Derived{}, Derived{}, *used, forward));
  }
  if (!uses.empty()) return w_.out.add("EDGE_LOOP", "", uses);
  if (coedges.empty()) return fail(ErrorCode::Degenerate, "a loop without edges");
  return w_.out.add("VERTEX_LOOP", "", vertex(body_[coedges.front()->edge].start));
}

// A loop that comes back to where it began in the parameter plane bounds something there; one that goes once round a
// periodic surface does not.
bool closes_in_plane(const Body& body, const Loop& loop) {
  if (loop.coedges.empty()) return false;
  const Uv first = start_uv(body, loop.coedges.front()), last = end_uv(body, loop.coedges.back());
  Uv size{1e-300, 1e-300};
  for (const Coedge& c : loop.coedges) {
    Uv before = start_uv(body, c);
    for (const double s : {0.25, 0.5, 0.75, 1.0}) {
      const Interval r = body[c.edge].range;
      const Uv here = uv_at(body, c, c.reversed ? r.at(1 - s) : r.at(s)), d = here - before;
      size = {size.u + std::abs(d.u), size.v + std::abs(d.v)};
      before = here;
    }
  }
  return std::abs(last.u - first.u) <= 1e-3 * size.u && std::abs(last.v - first.v) <= 1e-3 * size.v;
}

// Part 42 turns the loops of a face whose normal is not the surface's: counter-clockwise about the face's own.
Result<InstanceId> BodyWriter::face(const Face& face, bool turned) {
  const bool reversed = face.reversed != turned;
  const auto& surface = this->surface(face);
  if (!surface) return tl::unexpected(surface.error());
  std::vector<InstanceId> bounds;
  const JoinedLoops& loops = loops_[static_cast<std::size_t>(&face - body_.faces.data())];
  for (std::size_t i = 0; i < loops.loops.size(); ++i) {
    const auto written = loop(loops.loops[i], reversed);
    if (!written) return written;
    const bool outer = i == 0 && closes_in_plane(body_, body_[face.loops[0]]);
    bounds.push_back(w_.out.add(outer ? "FACE_OUTER_BOUND" : "FACE_BOUND", "", *written, true));
  }
  return w_.out.add("ADVANCED_FACE", name_of(face.attributes), bounds, surface->id, reversed == surface->turned());
}

InstanceId BodyWriter::kept_face(FaceId id, bool turned) {
  const Face& f = body_[id];
  if (f.status == FaceStatus::Failed || !f.surface || f.loops.empty()) {
    w_.lose(f.source, fmt::format("a face that could not be made sound: {}", f.reason));
    return {};
  }
  const auto written = face(f, turned);
  if (!written) {
    w_.lose(f.source, fmt::format("a face: {}", written.error().text));
    return {};
  }
  out_.faces.push_back({*written, id});
  return *written;
}

std::vector<InstanceId> BodyWriter::faces_of(const Shell& shell, bool turned) {
  std::vector<InstanceId> faces;
  for (const Shell::Use& use : shell.faces) {
    if (const InstanceId id = kept_face(use.face, use.reversed != turned)) faces.push_back(id);
  }
  return faces;
}

bool BodyWriter::is_sound(const Shell& shell) const {
  return std::all_of(shell.faces.begin(), shell.faces.end(), [&](const Shell::Use& use) {
           return body_[use.face].status != FaceStatus::Failed && body_[use.face].surface;
         });
}

void BodyWriter::write_solid(const std::vector<const Shell*>& voids, const Shell& outer) {
  const std::string name = name_of(body_.attributes);
  const InstanceId shell = w_.out.add("CLOSED_SHELL", "", faces_of(outer, false));
  out_.shells.push_back({shell, ShellId{static_cast<std::uint32_t>(&outer - body_.shells.data())}});
  if (voids.empty()) {
    out_.solids.push_back(w_.out.add("MANIFOLD_SOLID_BREP", name, shell));
    return;
  }
  // The shell of a void is written looking out of it and used the other way round.
  std::vector<InstanceId> inner;
  for (const Shell* v : voids) {
    const InstanceId closed = w_.out.add("CLOSED_SHELL", "", faces_of(*v, true));
    out_.shells.push_back({closed, ShellId{static_cast<std::uint32_t>(v - body_.shells.data())}});
    inner.push_back(w_.out.add("ORIENTED_CLOSED_SHELL", "", Derived{}, closed, false));
  }
  out_.solids.push_back(w_.out.add("BREP_WITH_VOIDS", name, shell, inner));
}

void BodyWriter::write_sheets(const std::vector<const Shell*>& shells) {
  std::vector<InstanceId> written;
  std::vector<bool> in_shell(body_.faces.size(), false);
  for (const Shell& s : body_.shells) {
    for (const Shell::Use& use : s.faces) in_shell[use.face.index] = true;
  }
  for (const Shell* s : shells) {
    const std::vector<InstanceId> faces = faces_of(*s, false);
    if (faces.empty()) continue;
    written.push_back(w_.out.add(s->closed && is_sound(*s) ? "CLOSED_SHELL" : "OPEN_SHELL", "", faces));
    out_.shells.push_back({written.back(), ShellId{static_cast<std::uint32_t>(s - body_.shells.data())}});
  }
  // Unsewn faces are no shell together: one each.
  for (std::uint32_t f = 0; f < body_.faces.size(); ++f) {
    if (in_shell[f]) continue;
    if (const InstanceId id = kept_face(FaceId{f}, false)) {
      written.push_back(w_.out.add("OPEN_SHELL", "", std::vector{id}));
      out_.shells.push_back({written.back(), {}});
    }
  }
  if (written.empty()) return;
  out_.surfaces.push_back(w_.out.add("SHELL_BASED_SURFACE_MODEL", name_of(body_.attributes), written));
}

void BodyWriter::write_wires() {
  for (const Edge& edge : body_.edges) {
    if (edge.is_pole || !edge.curve) continue;
    const auto curve = write_bounded_curve(w_, with_range(*edge.curve, edge.range));
    if (curve) out_.curves.push_back(*curve);
    else w_.lose(edge.source, fmt::format("a wire edge: {}", curve.error().text));
  }
}

WrittenBody BodyWriter::run() {
  if (body_.kind == BodyKind::Wire) {
    write_wires();
    return std::move(out_);
  }
  std::vector<const Shell*> outer, voids, sheets;
  // What its source calls a solid stays one, even where an edge of it is not used twice.
  const bool sound = body_.kind == BodyKind::Solid && !body_.shells.empty() &&
                     std::all_of(body_.shells.begin(), body_.shells.end(), [&](const Shell& s) { return is_sound(s); });
  for (const Shell& s : body_.shells) (sound ? s.is_void ? voids : outer : sheets).push_back(&s);
  if (body_.kind == BodyKind::Solid && !sound) {
    w_.lose(body_.source, "a solid of which faces failed: the others are written as a sheet");
  }
  // Which void lies in which of several outer shells is not known here: bodies of the import have one.
  if (outer.empty()) std::swap(outer, voids);
  for (std::size_t i = 0; i < outer.size(); ++i) write_solid(i == 0 ? voids : std::vector<const Shell*>{}, *outer[i]);
  write_sheets(sheets);
  if (second_borders_ > 0) {
    w_.lose(body_.source, fmt::format("the model curves of {} edges whose parameter curves are kept: within {:.3g} mm of these",
                                      second_borders_, worst_second_mm_));
  }
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    const EdgeId twin = plan_.twins[e].edge;
    if (const InstanceId used = edges_[twin ? twin.index : e]) out_.edges.push_back({used, EdgeId{e}});
  }
  return std::move(out_);
}

}  // namespace

WrittenBody write_body(EntityWriter& writer, const Body& body) { return BodyWriter(writer, body).run(); }

}  // namespace trimloop::io::step_export
