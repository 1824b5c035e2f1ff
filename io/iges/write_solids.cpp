// Shells -> 186 and 514 with their faces (510), loops (508), edges (504) and vertices (502), each once.

#include <fmt/format.h>

#include <algorithm>

#include "formats/iges/records/trimming.h"
#include "io/iges/entity_writer.h"
#include "kernel/pcurve/lift.h"
#include "kernel/topology/parameter_box.h"

namespace trimloop::io::iges_export {

namespace {

// One 502 and one 504 hold all vertices and edges of the body; indices count from 1 in the order of first use.
class ShellWriter {
 public:
  ShellWriter(EntityWriter& writer, const Body& body, bool as_nurbs)
      : w_(writer), body_(body), as_nurbs_(as_nurbs), vertex_index_(body.vertices.size(), 0),
        edge_index_(body.edges.size(), 0) {}

  bool prepare();  // edges and vertices; false when one has no record
  iges::Ref shell(const Shell& shell, bool turned, Role role, AttributesId attributes);

 private:
  bool use_edge(const Face& face, const Coedge& coedge);
  std::int64_t use_vertex(VertexId id);
  iges::Ref face(const Face& face);
  iges::Ref loop(const Face& face, LoopId id, const WrittenSurface& surface);

  EntityWriter& w_;
  const Body& body_;
  bool as_nurbs_;
  std::vector<std::int64_t> vertex_index_, edge_index_;
  iges::VertexList vertices_;
  iges::EdgeList edges_;
  iges::Ref vertex_list_, edge_list_;
};

std::int64_t ShellWriter::use_vertex(VertexId id) {
  std::int64_t& index = vertex_index_[id.index];
  if (index == 0) {
    vertices_.points.push_back(w_.units.point(body_[id].point));
    index = static_cast<std::int64_t>(vertices_.points.size());
  }
  return index;
}

bool ShellWriter::use_edge(const Face& face, const Coedge& coedge) {
  std::int64_t& index = edge_index_[coedge.edge.index];
  if (index != 0) return true;
  const Edge& edge = body_[coedge.edge];
  Curve curve;
  if (edge.curve) {
    const Interval own = range(*edge.curve);
    const bool whole = edge.range.lo == own.lo && edge.range.hi == own.hi;
    curve = whole ? *edge.curve : with_range(*edge.curve, edge.range);
  } else {
    const auto lifted = pcurve::lift(*face.surface, coedge.pcurve, edge.range, 0.1 * w_.model.resolution_mm);
    if (!lifted) return false;
    curve = *lifted->curve;
  }
  if (as_nurbs_) {
    if (auto nurbs = to_nurbs(curve)) {
      curve = Curve{std::move(nurbs->curve)};
      ++w_.statement.exact_curves;
    }
  }
  iges::EdgeList::Item item;
  item.curve = write_curve(w_, curve, Role::Child);
  if (!item.curve) return false;
  item.start_index = use_vertex(edge.start);
  item.end_index = use_vertex(edge.end);
  edges_.edges.push_back(item);
  index = static_cast<std::int64_t>(edges_.edges.size());
  return true;
}

bool ShellWriter::prepare() {
  for (const Shell& shell : body_.shells) {
    for (const Shell::Use& use : shell.faces) {
      const Face& f = body_[use.face];
      if (f.status == FaceStatus::Failed || !f.surface) continue;
      for (const LoopId id : f.loops) {
        for (const Coedge& c : body_[id].coedges) {
          const Edge& e = body_[c.edge];
          if (e.is_pole) use_vertex(e.start);
          else if (!use_edge(f, c)) return false;
        }
      }
    }
  }
  if (vertices_.points.empty()) return false;
  vertex_list_ = w_.add(vertices_, Role::Child, 1);
  for (iges::EdgeList::Item& item : edges_.edges) item.start_list = item.end_list = vertex_list_;
  if (!edges_.edges.empty()) edge_list_ = w_.add(edges_, Role::Child, 1);
  return true;
}

iges::Ref ShellWriter::loop(const Face& face, LoopId id, const WrittenSurface& surface) {
  iges::LoopRecord record;
  for (const Coedge& coedge : body_[id].coedges) {
    const Edge& edge = body_[coedge.edge];
    iges::LoopRecord::Item item;
    item.is_vertex = edge.is_pole;
    item.list = edge.is_pole ? vertex_list_ : edge_list_;
    item.index = edge.is_pole ? vertex_index_[edge.start.index] : edge_index_[coedge.edge.index];
    item.agrees = !coedge.reversed;
    const auto flat = record_pcurve(w_, *face.surface, coedge, surface);
    if (flat) {
      const auto* line = std::get_if<Line>(&flat->shape);
      const bool iso = line && (line->start.x == line->end.x || line->start.y == line->end.y);
      if (const iges::Ref ref = write_pcurve(w_, *flat, as_nurbs_)) item.pcurves.push_back({iso, ref});
    }
    record.items.push_back(std::move(item));
  }
  return w_.add(record, Role::Child, 1);
}

iges::Ref ShellWriter::face(const Face& face) {
  const ParameterBox box = parameter_box(body_, face);
  const auto surface = write_surface(w_, *face.surface, box.u, box.v, false, as_nurbs_, Role::Child, {});
  if (!surface) {
    w_.losses.push_back(fmt::format("a face whose surface cannot be written: {}", surface.error().text));
    return {};
  }
  iges::FaceRecord record;
  record.surface = surface->ref;
  record.outer_first = true;
  for (const LoopId id : face.loops) record.loops.push_back(loop(face, id, *surface));
  return w_.add(record, Role::Child, 1, nullptr, face.attributes ? face.attributes : body_.attributes);
}

iges::Ref ShellWriter::shell(const Shell& shell, bool turned, Role role, AttributesId attributes) {
  iges::ShellRecord record;
  for (const Shell::Use& use : shell.faces) {
    const Face& f = body_[use.face];
    if (f.status == FaceStatus::Failed || !f.surface) {
      w_.losses.push_back(fmt::format("a face that could not be made sound: {}", f.reason));
      continue;
    }
    const iges::Ref ref = face(f);
    if (ref) record.faces.push_back({ref, (f.reversed != use.reversed) == turned});
  }
  if (record.faces.empty()) return {};
  const bool closed = (shell.closed || body_.kind == BodyKind::Solid) && record.faces.size() == shell.faces.size();
  return w_.add(record, role, closed ? 1 : 2, nullptr, attributes);
}

}  // namespace

bool write_shells(EntityWriter& writer, const Body& body, bool as_nurbs, Role role, std::vector<iges::Ref>& written) {
  ShellWriter shells(writer, body, as_nurbs);
  if (body.shells.empty() || !shells.prepare()) return false;
  // What its source calls a solid stays one, even where an edge of it is not used twice.
  const bool sound = body.kind == BodyKind::Solid &&
                     std::all_of(body.shells.begin(), body.shells.end(), [&](const Shell& s) {
                       return std::all_of(s.faces.begin(), s.faces.end(), [&](const Shell::Use& use) {
                                return body[use.face].status != FaceStatus::Failed && body[use.face].surface;
                              });
                     });
  if (body.kind == BodyKind::Solid && !sound) {
    writer.losses.push_back("a solid of which faces failed: the others are written as a shell");
  }
  if (!sound) {
    for (const Shell& s : body.shells) {
      if (const iges::Ref ref = shells.shell(s, false, role, body.attributes)) written.push_back(ref);
    }
    return true;
  }
  iges::ManifoldSolid solid;
  for (const Shell& s : body.shells) {
    if (!s.is_void && solid.shell) {
      writer.losses.push_back("a solid of several outer shells: the others are written as shells");
      if (const iges::Ref ref = shells.shell(s, false, role, body.attributes)) written.push_back(ref);
      continue;
    }
    // The shell of a void looks out of it, and is used the other way round (IGES 5.3 4.49).
    const iges::Ref ref = shells.shell(s, s.is_void, Role::Child, {});
    if (!ref) continue;
    if (s.is_void) solid.voids.push_back({ref, false});
    else solid.shell = ref;
  }
  if (solid.shell) written.push_back(writer.add(solid, role, 0, nullptr, body.attributes));
  return true;
}

}  // namespace trimloop::io::iges_export
