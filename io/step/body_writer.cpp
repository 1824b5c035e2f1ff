#include "io/step/body_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "kernel/heal/lift.h"
#include "kernel/topology/parameter_box.h"

namespace trimloop::io::step_export {

using step::Derived;

namespace {

class BodyWriter {
 public:
  BodyWriter(EntityWriter& writer, const Body& body)
      : w_(writer), body_(body), vertices_(body.vertices.size()), edges_(body.edges.size()) {}

  WrittenBody run();

 private:
  InstanceId vertex(VertexId id);
  Result<InstanceId> edge(EdgeId id, const Face& face, const Coedge& coedge);
  Result<CurvePtr> space_curve(const Edge& edge, const Face& face, const Coedge& coedge);
  Result<InstanceId> loop(const Face& face, LoopId id, bool turned);
  Result<InstanceId> face(const Face& face, bool turned);
  InstanceId kept_face(FaceId id, bool turned);
  std::string name_of(AttributesId id) const { return id ? w_.model[id].name : std::string(); }
  std::vector<InstanceId> faces_of(const Shell& shell, bool turned);
  bool is_sound(const Shell& shell) const;
  void write_solid(const std::vector<const Shell*>& voids, const Shell& outer);
  void write_sheets(const std::vector<const Shell*>& shells);
  void write_wires();

  EntityWriter& w_;
  const Body& body_;
  WrittenBody out_;
  std::vector<InstanceId> vertices_, edges_;
};

InstanceId BodyWriter::vertex(VertexId id) {
  InstanceId& known = vertices_[id.index];
  if (!known) {
    const InstanceId at = w_.point(body_[id].point);
    known = w_.out.add("VERTEX_POINT", "", at);
  }
  return known;
}

Result<CurvePtr> BodyWriter::space_curve(const Edge& edge, const Face& face, const Coedge& coedge) {
  if (edge.curve) {
    const Interval own = range(*edge.curve);
    if (edge.range.lo == own.lo && edge.range.hi == own.hi) return edge.curve;
    return std::make_shared<const Curve>(with_range(*edge.curve, edge.range));
  }
  // Within a hundredth of what the model calls coincident.
  auto lifted = heal::lift(*face.surface, coedge.pcurve, edge.range, 0.01 * w_.model.resolution_mm);
  if (!lifted) return tl::unexpected(lifted.error());
  return lifted->curve;
}

Result<InstanceId> BodyWriter::edge(EdgeId id, const Face& face, const Coedge& coedge) {
  InstanceId& known = edges_[id.index];
  if (known) return known;
  const Edge& edge = body_[id];
  const auto curve = space_curve(edge, face, coedge);
  if (!curve) return tl::unexpected(curve.error());
  const InstanceId from = vertex(edge.start), to = vertex(edge.end);
  const auto geometry = write_curve(w_, **curve);
  if (!geometry) return tl::unexpected(geometry.error());
  known = w_.out.add("EDGE_CURVE", "", from, to, geometry->id, true);
  return known;
}

// A pole has no edge of its own in the file: the loop passes through its vertex. A loop that is nothing but poles is that
// vertex.
Result<InstanceId> BodyWriter::loop(const Face& face, LoopId id, bool turned) {
  const std::vector<Coedge>& coedges = body_[id].coedges;
  std::vector<InstanceId> uses;
  for (std::size_t k = 0; k < coedges.size(); ++k) {
    const Coedge& coedge = coedges[turned ? coedges.size() - 1 - k : k];
    if (body_[coedge.edge].is_pole) continue;
    const auto used = edge(coedge.edge, face, coedge);
    if (!used) return used;
    uses.push_back(w_.out.add("ORIENTED_EDGE", "", Derived{}, Derived{}, *used, coedge.reversed == turned));
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
    const Uv d = end_uv(body, c) - start_uv(body, c);
    size = {size.u + std::abs(d.u), size.v + std::abs(d.v)};
  }
  return std::abs(last.u - first.u) <= 1e-3 * size.u && std::abs(last.v - first.v) <= 1e-3 * size.v;
}

// Part 42 turns the loops of a face whose normal is not the surface's: counter-clockwise about the face's own.
Result<InstanceId> BodyWriter::face(const Face& face, bool turned) {
  const bool reversed = face.reversed != turned;
  const ParameterBox box = parameter_box(body_, face);
  std::vector<InstanceId> bounds;
  for (std::size_t i = 0; i < face.loops.size(); ++i) {
    const auto written = loop(face, face.loops[i], reversed);
    if (!written) return written;
    const bool outer = i == 0 && closes_in_plane(body_, body_[face.loops[0]]);
    bounds.push_back(w_.out.add(outer ? "FACE_OUTER_BOUND" : "FACE_BOUND", "", *written, true));
  }
  const auto surface = write_surface(w_, *face.surface, box.u, box.v);
  if (!surface) return tl::unexpected(surface.error());
  return w_.out.add("ADVANCED_FACE", name_of(face.attributes), bounds, surface->id, !reversed);
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
  return shell.closed && std::all_of(shell.faces.begin(), shell.faces.end(), [&](const Shell::Use& use) {
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
    if (!faces.empty()) written.push_back(w_.out.add(is_sound(*s) ? "CLOSED_SHELL" : "OPEN_SHELL", "", faces));
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
  const bool sound = body_.kind == BodyKind::Solid && !body_.shells.empty() &&
                     std::all_of(body_.shells.begin(), body_.shells.end(), [&](const Shell& s) { return is_sound(s); });
  for (const Shell& s : body_.shells) (sound ? s.is_void ? voids : outer : sheets).push_back(&s);
  if (body_.kind == BodyKind::Solid && !sound) {
    w_.lose(body_.source, "a solid whose shell is not closed: its faces are written as a sheet");
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
