#include "formats/iges/records/trimming.h"
#include "formats/iges/rules.h"
#include "io/iges/curves.h"
#include "io/iges/placement.h"
#include "io/iges/solids.h"
#include "io/iges/surfaces.h"
#include "io/iges/trimming.h"
#include "io/rules.h"

namespace trimloop::io::iges_import {
namespace {

namespace igr = iges::rules;

bool is_514(const DirectoryEntry& e) { return e.type == 514; }
bool is_510(const DirectoryEntry& e) { return e.type == 510; }
bool is_508(const DirectoryEntry& e) { return e.type == 508; }
bool is_504(const DirectoryEntry& e) { return e.type == 504; }
bool is_502(const DirectoryEntry& e) { return e.type == 502; }

// Parameters of the two ends on a line without ends of its own.
Interval on_line(const Line& line, Point start, Point end) {
  const Vector d = line.end - line.start;
  return {dot(start - line.start, d) / dot(d, d), dot(end - line.start, d) / dot(d, d)};
}

}  // namespace

void BrepReader::solid(const DirectoryEntry& entry) {
  Visit visit(context_, entry);
  const auto* r = visit ? context_.record<iges::ManifoldSolid>(entry) : nullptr;
  if (!r) return;
  outer_ = model_placement(context_, entry);
  const DirectoryEntry* outer = context_.resolve(r->shell, is_514, "a shell (514)");
  if (!outer) return;
  context_.state(entry).consumed = true;
  body_.kind = BodyKind::Solid;
  shell(*outer, !r->agrees, false);
  for (const auto& v : r->voids) {
    const DirectoryEntry* inner = context_.resolve(v.shell, is_514, "a shell (514)");
    if (inner && inner != outer) shell(*inner, !v.agrees, true);  // the outer shell again: IG-E186-03
  }
}

void BrepReader::shell(const DirectoryEntry& entry, bool turned, bool is_void) {
  Visit visit(context_, entry);
  const auto* r = visit ? context_.record<iges::ShellRecord>(entry) : nullptr;
  if (!r) return;
  context_.state(entry).consumed = true;
  const Transform around = outer_;
  outer_ = outer_ * model_placement(context_, entry);
  Shell shell;
  shell.is_void = is_void;
  shell.source.push_back(source_of(entry));
  for (const auto& item : r->faces) {
    const DirectoryEntry* e = context_.resolve(item.face, is_510, "a face (510)");
    if (!e) continue;
    const bool again = std::any_of(shell.faces.begin(), shell.faces.end(), [&](const Shell::Use& use) {
      const auto known = faces_.find(e->de);
      return known != faces_.end() && known->second == use.face;
    });
    if (again) continue;  // IG-E514-01
    shell.faces.push_back({face(*e), item.agrees == turned});
  }
  outer_ = around;
  if (shell.faces.empty()) return;
  const ShellId id = body_.add(std::move(shell));
  heal::finish_shell(body_, id);
  if (entry.form == 1 && !body_[id].closed)
    context_.add(entry, igr::e514::closure, Severity::Warning,
                 "the shell is said to be closed, but some edge is not used twice in opposite directions");
}

FaceId BrepReader::face(const DirectoryEntry& entry) {
  if (const auto known = faces_.find(entry.de); known != faces_.end()) return known->second;
  if (context_.state(entry).consumed)
    context_.add(entry, rules::shared_face, "the face belongs to another body too; each gets a copy");
  const FaceId id = add_face(context_, body_, entry, face_input(entry), attributes_(entry));
  faces_.emplace(entry.de, id);
  return id;
}

std::optional<heal::FaceInput> BrepReader::face_input(const DirectoryEntry& entry) {
  Visit visit(context_, entry);
  const auto* r = visit ? context_.record<iges::FaceRecord>(entry) : nullptr;
  if (!r) return std::nullopt;
  const DirectoryEntry* surface_entry = context_.resolve(r->surface, is_surface, "a surface");
  if (!surface_entry) return std::nullopt;
  context_.state(*surface_entry).consumed = true;
  const PlacedSurface* basis = model_surface(context_, *surface_entry);
  const auto surface = basis ? moved(context_, *basis, outer_) : std::nullopt;
  if (!surface) return std::nullopt;

  heal::FaceInput input;
  input.surface = surface->surface;
  input.reversed = surface->flipped();
  input.brep_sense = true;
  input.shared = &shared_;
  input.tolerance_mm = context_.resolution_mm;
  input.source = {source_of(entry), source_of(*surface_entry, 1)};
  for (const Ref ref : r->loops) {
    const DirectoryEntry* e = context_.resolve(ref, is_508, "a loop (508)");
    auto one = e ? loop(*e, *surface) : std::nullopt;
    if (!one) {
      context_.add(entry, igr::e510::face, "loop D" + std::to_string(ref.de) + " cannot be used");
      return std::nullopt;
    }
    one->claimed_outer = r->outer_first && input.loops.empty();
    input.loops.push_back(std::move(*one));
  }
  map_pcurves(context_, entry, *surface, input.loops, &body_);
  if (input.reversed) {
    for (heal::TrimLoop& l : input.loops) heal::turn(l);
  }
  return input;
}

std::optional<heal::TrimLoop> BrepReader::loop(const DirectoryEntry& entry, const PlacedSurface& surface) {
  Visit visit(context_, entry);
  const auto* r = visit ? context_.record<iges::LoopRecord>(entry) : nullptr;
  if (!r) return std::nullopt;
  heal::TrimLoop out;
  out.trust = heal::Trust::Model;  // "the edge's curve is the truth" of a boundary representation
  out.source.push_back(source_of(entry, 4));
  VertexId lone;
  for (const auto& item : r->items) {
    if (item.is_vertex) {  // between edges it marks a pole, which healing finds by itself
      lone = vertex(item.list, item.index);
      continue;
    }
    heal::TrimSegment s;
    s.edge = edge(item.list, item.index);
    s.curve_reversed = !item.agrees;
    std::vector<CompositeCurve::Segment> flats;
    for (const auto& p : item.pcurves) {
      const DirectoryEntry* e = context_.resolve(p.curve, is_curve, "a parameter-space curve");
      auto curve = e && surface.has_parameters ? parameter_curve(context_, *e) : std::nullopt;
      if (!curve || !is_bounded(*curve)) continue;
      s.source.push_back(source_of(*e, 3));
      flats.push_back({std::make_shared<const Curve>(std::move(*curve)), false});
    }
    if (flats.size() == 1) s.pcurve = Curve2{*flats[0].curve};
    if (flats.size() > 1) s.pcurve = Curve2{{make_composite(std::move(flats))}};
    if (!s.edge && !s.pcurve) {
      context_.add(igr::e508::use, "an edge of the loop (list D" + std::to_string(item.list.de) + ", entry " +
                                       std::to_string(item.index) + ") cannot be used");
      return std::nullopt;
    }
    out.segments.push_back(std::move(s));
  }
  if (out.segments.empty()) {
    if (!lone) {
      context_.add(igr::e508::use, "the loop has no edge and no vertex", 0, 1);
      return std::nullopt;
    }
    out.pole = body_[lone].point;
  }
  return out;
}

EdgeId BrepReader::edge(Ref list, std::int64_t index) {
  const auto [at, fresh] = edges_.try_emplace(Key{list.de, index});
  if (fresh) at->second = make_edge(list, index);
  return at->second;
}

EdgeId BrepReader::make_edge(Ref list, std::int64_t index) {
  const DirectoryEntry* entry = context_.resolve(list, is_504, "an edge list (504)");
  if (!entry) return {};
  const auto* r = context_.record<iges::EdgeList>(*entry);
  if (!r) return {};
  Visit visit(context_, *entry);
  if (!visit) return {};
  if (index < 1 || static_cast<std::size_t>(index) > r->edges.size()) {
    context_.add(igr::e508::use, "edge " + std::to_string(index) + " is not in the list", static_cast<double>(index),
                 static_cast<double>(r->edges.size()));
    return {};
  }
  const auto& item = r->edges[static_cast<std::size_t>(index - 1)];
  const DirectoryEntry* curve_entry = context_.resolve(item.curve, is_curve, "a curve");
  CurvePtr curve = curve_entry ? moved(context_, model_curve(context_, *curve_entry), outer_) : nullptr;
  const VertexId start = vertex(item.start_list, item.start_index), end = vertex(item.end_list, item.end_index);
  if (!curve || !start || !end) return {};
  const Point a = body_[start].point, b = body_[end].point;
  if (const auto* line = std::get_if<Line>(&curve->shape); line && !is_bounded(*curve)) {
    const Interval part = on_line(*line, a, b);
    curve = std::make_shared<const Curve>(
        Curve{part.lo < part.hi ? Line{line->start, line->end, part} : Line{a, b, {0, 1}}});
  }
  if (!is_bounded(*curve)) return {};

  double gap = std::max(distance(start_point(*curve), a), distance(end_point(*curve), b));
  const double turned = std::max(distance(start_point(*curve), b), distance(end_point(*curve), a));
  if (gap > context_.resolution_mm && turned < gap && turned <= context_.resolution_mm) {
    context_.add(igr::e504::end_gap, Severity::Warning,
                 "edge " + std::to_string(index) + ": the curve runs from its end vertex to its start; it is turned", gap,
                 context_.resolution_mm);
    curve = std::make_shared<const Curve>(reversed(*curve));
    gap = turned;
  }
  if (gap > context_.resolution_mm) {
    Diagnostic& d = context_.add(igr::e504::end_gap, gap > 10 * context_.resolution_mm ? Severity::Error : Severity::Warning,
                                 "edge " + std::to_string(index) + ": the curve ends beside its vertex", gap,
                                 context_.resolution_mm);
    d.at = {a.x, a.y, a.z};
  }
  body_[start].gap_mm = std::max(body_[start].gap_mm, distance(start_point(*curve), a));
  body_[end].gap_mm = std::max(body_[end].gap_mm, distance(end_point(*curve), b));
  Edge edge;
  edge.range = range(*curve);
  edge.curve = std::move(curve);
  edge.start = start;
  edge.end = end;
  edge.source = {source_of(*entry), source_of(*curve_entry, 2)};
  return body_.add(std::move(edge));
}

VertexId BrepReader::vertex(Ref list, std::int64_t index) {
  const auto [at, fresh] = vertices_.try_emplace(Key{list.de, index});
  if (!fresh) return at->second;
  const DirectoryEntry* entry = context_.resolve(list, is_502, "a vertex list (502)");
  const auto* r = entry ? context_.record<iges::VertexList>(*entry) : nullptr;
  if (!r) return {};
  if (index < 1 || static_cast<std::size_t>(index) > r->points.size()) {
    context_.add(igr::e504::indices, "vertex " + std::to_string(index) + " is not in list " + name_of(*entry),
                 static_cast<double>(index), static_cast<double>(r->points.size()));
    return {};
  }
  const iges::Xyz& p = r->points[static_cast<std::size_t>(index - 1)];
  const double mm = context_.unit.scale;
  const Transform t = outer_ * model_placement(context_, *entry);
  at->second = body_.add(Vertex{apply(t, Point{p.x * mm, p.y * mm, p.z * mm}), 0});
  return at->second;
}

}  // namespace trimloop::io::iges_import
