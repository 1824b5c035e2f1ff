#include "io/step/body_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "kernel/geometry/approximate.h"
#include "kernel/pcurve/lift.h"
#include "kernel/topology/parameter_box.h"

namespace trimloop::io::step_export {

using step::Derived;

namespace {

class BodyWriter {
 public:
  BodyWriter(EntityWriter& writer, const Body& body)
      : w_(writer), body_(body), vertices_(body.vertices.size()), edges_(body.edges.size()), uses_(body.edges.size()), left_out_(body.edges.size(), false),
        surfaces_(body.faces.size()) {
    for (const Face& f : body.faces) {
      for (const LoopId id : f.loops) {
        for (const Coedge& c : body[id].coedges) uses_[c.edge.index].push_back({&f, &c});
      }
    }
    for (std::uint32_t e = 0; e < body.edges.size(); ++e) twins_.push_back({EdgeId{e}, false});
    for (std::uint32_t v = 0; v < body.vertices.size(); ++v) same_vertex_.push_back(VertexId{v});
    for (const Face& f : body.faces) join_seams(f);
    for (const Face& f : body.faces) close_slivers(f);
  }

  WrittenBody run();

 private:
  InstanceId vertex(VertexId id);
  struct Use {  // of an edge
    const Face* face;
    const Coedge* coedge;
    bool flipped = false;  // the coedge's own edge runs against the one it is written with
  };
  struct Twin {  // the edge that is written for an edge
    EdgeId edge;
    bool reversed = false;
  };
  void join_seams(const Face& face);
  void close_slivers(const Face& face);
  VertexId root(VertexId id) const {
    while (same_vertex_[id.index] != id) id = same_vertex_[id.index];
    return id;
  }
  bool try_join(const Face& face, const Coedge& a, const Coedge& b);
  Result<InstanceId> edge(EdgeId id);
  Result<CurvePtr> space_curve(const Edge& edge, const Use& use);
  std::vector<InstanceId> pcurves(EdgeId id, const Curve& edge_curve, Interval range, bool& seam);
  bool needs_pcurve(const Face& face);
  std::optional<NurbsCurve> refitted(const Use& use, const Curve& curve, Interval range) const;
  bool runs_along(const NurbsCurve& pcurve, Interval range, const Curve& curve, const Surface& surface) const;
  const Result<WrittenSurface>& surface(const Face& face);
  Result<InstanceId> loop(LoopId id, bool turned);
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
  WrittenBody out_;
  std::vector<InstanceId> vertices_, edges_;
  std::vector<std::vector<Use>> uses_;  // of each edge
  std::vector<Twin> twins_;
  std::vector<bool> left_out_;  // edges
  std::vector<VertexId> same_vertex_;  // joined ones lead to the one that is written
  std::vector<std::optional<Result<WrittenSurface>>> surfaces_;  // of each face
  std::map<const Surface*, WrittenSurface> shared_surfaces_;
};

// A seam that came as two edges, up and down, is one edge to the file: receivers look for it.
bool BodyWriter::try_join(const Face& face, const Coedge& a, const Coedge& b) {
  const Edge &p = body_[a.edge], &q = body_[b.edge];
  if (!p.curve || !q.curve) return false;
  const double tolerance = 2 * w_.model.resolution_mm;
  const auto at = [&](VertexId v) { return body_[v].point; };
  if (distance(at(p.start), evaluate(*p.curve, p.range.mid())) < 10 * tolerance) return false;  // too short to tell
  if (distance(at(start_vertex(body_, a)), at(end_vertex(body_, b))) > tolerance) return false;
  if (distance(at(end_vertex(body_, a)), at(start_vertex(body_, b))) > tolerance) return false;
  for (const double s : {0.25, 0.5, 0.75}) {
    const Point on = evaluate(*p.curve, p.range.at(s));
    if (closest_point(with_range(*q.curve, q.range), on).distance > tolerance) return false;
  }
  const bool against = a.reversed == b.reversed;  // the coedges run against each other
  twins_[b.edge.index] = {a.edge, against};
  uses_[a.edge.index].push_back({&face, &b, against});
  same_vertex_[root(q.start).index] = root(against ? p.end : p.start);
  same_vertex_[root(q.end).index] = root(against ? p.start : p.end);
  return true;
}

void BodyWriter::join_seams(const Face& face) {
  if (face.status == FaceStatus::Failed || !face.surface) return;
  const SurfaceDomain d = domain(*face.surface, w_.model.resolution_mm);
  if (!d.closed_u && !d.closed_v && d.period_u == 0 && d.period_v == 0) return;
  std::vector<const Coedge*> alone;
  for (const LoopId id : face.loops) {
    for (const Coedge& c : body_[id].coedges) {
      if (!body_[c.edge].is_pole && uses_[c.edge.index].size() == 1) alone.push_back(&c);
    }
  }
  constexpr std::size_t most = 2000;  // pairs are tried
  if (alone.size() > most) return;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    for (std::size_t j = i + 1; j < alone.size(); ++j) {
      if (uses_[alone[i]->edge.index].size() != 1) break;
      if (twins_[alone[j]->edge.index].edge != alone[j]->edge || uses_[alone[j]->edge.index].size() != 1) continue;
      try_join(face, *alone[i], *alone[j]);
    }
  }
}

// A straight step that healing put into a gap of the file and that is of no size: an edge of it makes receivers part the
// face in two. Its two vertices are written as one, and the gap stays what it was.
void BodyWriter::close_slivers(const Face& face) {
  if (face.status == FaceStatus::Failed) return;
  for (const LoopId id : face.loops) {
    const auto chord = [&](const Coedge& c) { return distance(body_[body_[c.edge].start].point, body_[body_[c.edge].end].point); };
    Box box;
    for (const Coedge& c : body_[id].coedges) box.add(body_[body_[c.edge].start].point);
    for (const Coedge& c : body_[id].coedges) {
      const Edge& e = body_[c.edge];
      constexpr double share = 1e-3;
      const bool supplied = e.source.empty() && !e.curve && !e.is_pole && uses_[c.edge.index].size() == 1;
      if (!supplied || !(chord(c) <= share * box.diagonal()) || body_[id].coedges.size() < 3) continue;
      left_out_[c.edge.index] = true;
      same_vertex_[root(e.end).index] = root(e.start);
    }
  }
}

InstanceId BodyWriter::vertex(VertexId id) {
  id = root(id);
  InstanceId& known = vertices_[id.index];
  if (!known) {
    const InstanceId at = w_.point(body_[id].point);
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

Result<CurvePtr> BodyWriter::space_curve(const Edge& edge, const Use& use) {
  if (edge.curve) {
    const Interval own = range(*edge.curve);
    if (edge.range.lo == own.lo && edge.range.hi == own.hi) return edge.curve;
    return std::make_shared<const Curve>(with_range(*edge.curve, edge.range));
  }
  // Within a hundredth of what the model calls coincident, but no nearer than 2e-10 of the size; what is too wild for
  // that, as near as it goes.
  const ParameterBox box = parameter_box(body_, *use.face);
  const double size = bounding_box(*use.face->surface, box.u, box.v).diagonal();
  double tolerance = std::max(0.01 * w_.model.resolution_mm, 2e-10 * size);
  auto lifted = pcurve::lift(*use.face->surface, use.coedge->pcurve, edge.range, tolerance);
  for (int k = 0; k < 4 && !lifted && lifted.error().code == ErrorCode::NoConvergence; ++k) {
    lifted = pcurve::lift(*use.face->surface, use.coedge->pcurve, edge.range, tolerance *= 100);
  }
  if (!lifted) return tl::unexpected(lifted.error());
  if (lifted->deviation_mm > std::max(w_.model.resolution_mm, 1e-9 * size)) {
    w_.lose(use.face->source, fmt::format("an edge known only in parameter space: within {:.3g} mm", lifted->deviation_mm));
  }
  return lifted->curve;
}

// Receivers find the trimming of elementary surfaces by closed forms; on the others a search may go astray, at seams and
// poles above all.
bool wants_pcurve(const Surface& s) {
  return std::holds_alternative<NurbsSurface>(s.shape) || std::holds_alternative<Revolution>(s.shape) ||
         std::holds_alternative<Extrusion>(s.shape) || std::holds_alternative<Ruled>(s.shape) ||
         std::holds_alternative<OffsetSurface>(s.shape);
}

// Where a surface closes, the model curve does not say on which side of the seam it runs.
bool BodyWriter::needs_pcurve(const Face& face) {
  const SurfaceDomain d = domain(*face.surface, w_.model.resolution_mm);
  return d.closed_u || d.closed_v || d.period_u > 0 || d.period_v > 0;
}

// Receivers take a pcurve to have the parameter of the model curve.
bool BodyWriter::runs_along(const NurbsCurve& pcurve, Interval range, const Curve& curve, const Surface& surface) const {
  const Interval own = trimloop::range(curve);
  for (const double s : {0.0, 0.043, 0.17, 0.29, 0.41, 0.53, 0.67, 0.79, 0.91, 1.0}) {  // where symmetry helps nobody
    const Point flat = evaluate(pcurve, range.at(s));
    if (distance(evaluate(surface, {flat.x, flat.y}), evaluate(curve, own.at(s))) > w_.model.resolution_mm) return false;
  }
  return true;
}

// The pcurve in the direction of the edge, over the parameters of its written model curve.
std::optional<NurbsCurve> pcurve_over(const Coedge& coedge, bool flipped, Interval range) {
  Interval r = coedge.pcurve_range;
  const bool backwards = (r.lo > r.hi) != flipped;
  if (r.lo > r.hi) std::swap(r.lo, r.hi);
  const Curve part = with_range(coedge.pcurve.curve, r);
  const auto nurbs = trimloop::to_nurbs(backwards ? reversed(part) : part);
  if (!nurbs) return std::nullopt;
  const Interval whole = nurbs->curve.domain(), used = nurbs->curve.range();
  const NurbsCurve cut = whole.lo == used.lo && whole.hi == used.hi ? nurbs->curve : trimmed(nurbs->curve, used);
  return reparametrized(cut, range);
}

// A pcurve whose parameter is another (an arc as a spline, a curve fitted by length) again, over that of the model curve.
std::optional<NurbsCurve> BodyWriter::refitted(const Use& use, const Curve& curve, Interval range) const {
  const Coedge& c = *use.coedge;
  const Interval own = trimloop::range(curve), of_edge = body_[c.edge].range;
  const auto at = [&](double t) {  // `curve` runs as it was written, up to an affine change
    const double s = (t - range.lo) / range.length(), guess = of_edge.at(use.flipped ? 1 - s : s);
    return closest_point_near(*use.face->surface, evaluate(curve, own.at(s)), uv_at(body_, c, guess)).uv;
  };
  std::vector<double> stops;
  for (const double b : breaks(curve)) stops.push_back(range.lo + (b - own.lo) / own.length() * range.length());
  constexpr std::size_t most = 200;  // smooth pieces: each costs searches on the surface
  if (stops.size() < 2 || stops.size() > most) return std::nullopt;
  stops.front() = range.lo;
  stops.back() = range.hi;
  const ParameterBox box = parameter_box(body_, *use.face);
  constexpr double relative = 1e-10;
  auto fitted = approximate(at, stops, relative * std::max(box.u.length(), box.v.length()), 1024);
  if (!fitted) return std::nullopt;
  return std::get<NurbsCurve>(fitted->curve.curve.shape);
}

// PCURVEs of an edge, each over the parameters of the written model curve.
std::vector<InstanceId> BodyWriter::pcurves(EdgeId id, const Curve& edge_curve, Interval range, bool& seam) {
  std::vector<InstanceId> out;
  std::vector<const Face*> faces;
  for (const Use& use : uses_[id.index]) {
    if (!wants_pcurve(*use.face->surface) || use.face->status == FaceStatus::Failed) continue;
    const auto& s = surface(*use.face);
    if (!s || s->bent || s->elementary) continue;
    auto own = pcurve_over(*use.coedge, use.flipped, range);
    if (own && !runs_along(*own, range, edge_curve, *use.face->surface)) {
      auto along = refitted(use, edge_curve, range);
      if (along && runs_along(*along, range, edge_curve, *use.face->surface)) own = std::move(along);
      else if (!needs_pcurve(*use.face)) own.reset();
    }
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
  const auto curve = space_curve(edge, uses_[id.index].front());
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
Result<InstanceId> BodyWriter::loop(LoopId id, bool turned) {
  const std::vector<Coedge>& coedges = body_[id].coedges;
  std::vector<InstanceId> uses;
  for (std::size_t k = 0; k < coedges.size(); ++k) {
    const Coedge& coedge = coedges[turned ? coedges.size() - 1 - k : k];
    if (body_[coedge.edge].is_pole || left_out_[coedge.edge.index]) continue;
    const Twin& twin = twins_[coedge.edge.index];
    const auto used = edge(twin.edge);
    if (!used) return used;
    const bool forward = (coedge.reversed == turned) != twin.reversed;
    uses.push_back(w_.out.add("ORIENTED_EDGE", "", Derived{}, Derived{}, *used, forward));
  }
  if (!uses.empty()) return w_.out.add("EDGE_LOOP", "", uses);
  if (coedges.empty()) return fail(ErrorCode::Degenerate, "a loop without edges");
  return w_.out.add("VERTEX_LOOP", "", vertex(body_[coedges.front().edge].start));
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
  for (std::size_t i = 0; i < face.loops.size(); ++i) {
    const auto written = loop(face.loops[i], reversed);
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
  if (voids.empty()) {
    out_.solids.push_back(w_.out.add("MANIFOLD_SOLID_BREP", name, shell));
    return;
  }
  // The shell of a void is written looking out of it and used the other way round.
  std::vector<InstanceId> inner;
  for (const Shell* v : voids) {
    const InstanceId closed = w_.out.add("CLOSED_SHELL", "", faces_of(*v, true));
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
    if (!faces.empty()) written.push_back(w_.out.add(s->closed && is_sound(*s) ? "CLOSED_SHELL" : "OPEN_SHELL", "", faces));
  }
  // Unsewn faces are no shell together: one each.
  for (std::uint32_t f = 0; f < body_.faces.size(); ++f) {
    if (in_shell[f]) continue;
    if (const InstanceId id = kept_face(FaceId{f}, false)) {
      written.push_back(w_.out.add("OPEN_SHELL", "", std::vector{id}));
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
  return std::move(out_);
}

}  // namespace

WrittenBody write_body(EntityWriter& writer, const Body& body) { return BodyWriter(writer, body).run(); }

}  // namespace trimloop::io::step_export
