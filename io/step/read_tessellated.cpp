#include <fmt/format.h>

#include <cstring>

#include "formats/step/records/tessellated.h"
#include "formats/step/rules.h"
#include "io/rules.h"
#include "io/step/tessellation.h"

namespace trimloop::io::step_import {

namespace sr = step::rules;

namespace {

constexpr std::uint32_t unused = 0xffffffffu;

std::vector<std::array<int, 3>> triangles_of(const step::Triangulation& t, std::size_t& bad_rows) {
  std::vector<std::array<int, 3>> out;
  for (const auto& row : t.triangles) {
    if (row.size() == 3) out.push_back({row[0], row[1], row[2]});
    else ++bad_rows;
  }
  for (const auto& strip : t.strips) {
    bad_rows += strip.size() < 3;
    for (std::size_t i = 2; i < strip.size(); ++i) {  // every second triangle is wound the other way
      const auto [a, b] = i % 2 == 0 ? std::pair(strip[i - 2], strip[i - 1]) : std::pair(strip[i - 1], strip[i - 2]);
      // A point given twice in a row turns the strip; the triangle is none.
      if (a != b && b != strip[i] && strip[i] != a) out.push_back({a, b, strip[i]});
    }
  }
  for (const auto& fan : t.fans) {
    bad_rows += fan.size() < 3;
    for (std::size_t i = 2; i < fan.size(); ++i) out.push_back({fan[0], fan[i - 1], fan[i]});
  }
  return out;
}

bool is_face(const Context& context, const Record& i) {
  return context.is(i, Entity::TriangulatedFace) || context.is(i, Entity::ComplexTriangulatedFace) ||
         context.is(i, Entity::TriangulatedSurfaceSet) || context.is(i, Entity::ComplexTriangulatedSurfaceSet);
}

}  // namespace

std::size_t MeshReader::SamePlace::operator()(const Point& p) const {
  std::size_t h = 0;
  for (const double c : {p.x, p.y, p.z}) {
    const double value = c == 0 ? 0 : c;  // both zeros are one place
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    h = (h ^ bits) * 0x9e3779b97f4a7c15ull;
    h ^= h >> 32;
  }
  return h;
}

MeshReader::Coordinates* MeshReader::coordinates(const Record& owner, Ref ref) {
  const Record* instance = context_.resolve(owner, ref, Entity::CoordinatesList);
  if (!instance) return nullptr;
  const auto [at, fresh] = lists_.try_emplace(context_.index(*instance));
  Coordinates& list = at->second;
  if (fresh) {
    context_.consume(*instance);
    const double mm = geometry_.mm();
    if (const auto r = context_.read<step::CoordinatesList>(*instance)) {
      list.points.reserve(r->points.size());
      for (const auto& p : r->points) list.points.push_back({p[0] * mm, p[1] * mm, p[2] * mm});
      list.in_mesh.assign(list.points.size(), unused);
    }
  }
  return &list;
}

std::uint32_t MeshReader::point(Coordinates& from, std::size_t index) {
  std::uint32_t& known = from.in_mesh[index];
  if (known == unused) {
    const auto [at, fresh] = places_.try_emplace(from.points[index], static_cast<std::uint32_t>(mesh_.points.size()));
    if (fresh) mesh_.points.push_back(from.points[index]);
    known = at->second;
  }
  return known;
}

Attributes MeshReader::attributes(const Record& item, const std::string& name, const Attributes& owner) const {
  Attributes own = styles_.of(item);
  own.name = name == "NONE" ? std::string() : name;
  return under(owner, own);
}

std::optional<Transform> MeshReader::moved_by(const Record& item) {
  if (!context_.is(item, Entity::RepositionedTessellatedItem)) return std::nullopt;
  step::Tape tape;
  step::Reader r(context_.file, item, context_.execution.limits, tape, context_.report);
  const Ref location = r.at(Entity::RepositionedTessellatedItem) ? r.ref(0) : Ref{};
  const Record* placement = location ? context_.resolve(item, location, Entity::Axis2Placement3d) : nullptr;
  return placement ? geometry_.transform(*placement) : std::nullopt;
}

void MeshReader::add_face(const Record& item, const Attributes& owner) {
  context_.consume(item);
  const auto r = context_.read<step::Triangulation>(item);
  Coordinates* list = r ? coordinates(item, r->coordinates) : nullptr;
  if (!list || list->points.empty()) {
    if (list) context_.add(item, sr::tessellated, "the face has no coordinates; it is left out");
    return;
  }
  const std::size_t points = list->points.size();
  const bool same = r->pnindex.empty();
  const std::size_t locals = same ? points : r->pnindex.size();
  if (r->pnmax < 0 || static_cast<std::size_t>(r->pnmax) != locals)
    context_.add(item, sr::tessellated, Severity::Warning, fmt::format("{} points are announced, {} are given", r->pnmax, locals));
  std::size_t normals = r->normals.size();
  if (normals > 1 && normals != locals) {
    context_.add(item, sr::tessellated, fmt::format("{} normals for {} points; they are not used", normals, locals),
                 static_cast<double>(normals), static_cast<double>(locals));
    normals = 0;
  }
  MeshFace face;
  std::vector<std::uint32_t> vertex(locals, unused);
  std::size_t outside = 0, needles = 0, bad_rows = 0;
  for (const auto& corners : triangles_of(*r, bad_rows)) {
    std::array<std::uint32_t, 3> triangle{};
    bool good = true;
    for (std::size_t k = 0; k < 3 && good; ++k) {
      const int local = corners[k];
      good = local >= 1 && static_cast<std::size_t>(local) <= locals;
      if (!good) break;
      const std::size_t at = static_cast<std::size_t>(local) - 1;
      const int global = same ? local : r->pnindex[at];
      good = global >= 1 && static_cast<std::size_t>(global) <= points;
      if (!good) break;
      if (vertex[at] == unused) {
        vertex[at] = static_cast<std::uint32_t>(face.vertices.size());
        Vector n;
        if (normals > 0) {
          const auto& given = r->normals[normals == 1 ? 0 : at];
          n = normalized(Vector{given[0], given[1], given[2]});
        }
        face.vertices.push_back({point(*list, static_cast<std::size_t>(global) - 1), is_finite(n) ? n : Vector{}});
      }
      triangle[k] = vertex[at];
    }
    if (!good) {
      ++outside;
      continue;
    }
    const auto place = [&](std::size_t k) { return face.vertices[triangle[k]].point; };
    if (place(0) == place(1) || place(1) == place(2) || place(2) == place(0)) ++needles;
    else face.triangles.push_back(triangle);
  }
  if (outside > 0)
    context_.add(item, sr::tessellated, fmt::format("{} triangles name points outside the list; they are left out", outside),
                 static_cast<double>(outside), 0);
  if (needles > 0)
    context_.add(item, sr::tessellated, Severity::Warning, fmt::format("{} triangles have two corners in one place; they are left out", needles),
                 static_cast<double>(needles), 0);
  if (bad_rows > 0)
    context_.add(item, sr::tessellated, fmt::format("{} triangles, strips or fans do not have as many points as they need", bad_rows),
                 static_cast<double>(bad_rows), 0);
  if (face.triangles.empty()) {
    context_.add(item, sr::tessellated, Severity::Warning, "the face has no triangle");
    return;
  }
  face.attributes = model_.add(attributes(item, r->name, owner));
  face.source.push_back(source_of(item));
  if (r->link) face.source.push_back({r->link.id, stands_for_role});
  mesh_.faces.push_back(std::move(face));
}

void MeshReader::add_line(const Record& item, const Attributes& owner) {
  context_.consume(item);
  const auto r = context_.read<step::TessellatedLines>(item);
  Coordinates* list = r ? coordinates(item, r->coordinates) : nullptr;
  if (!list) return;
  for (const auto& strip : r->strips) {
    MeshLine line;
    for (const int i : strip)
      if (i >= 1 && static_cast<std::size_t>(i) <= list->points.size()) line.points.push_back(point(*list, static_cast<std::size_t>(i) - 1));
    if (line.points.size() < strip.size())
      context_.add(item, sr::tessellated, fmt::format("{} points of the line are outside the list", strip.size() - line.points.size()),
                   static_cast<double>(strip.size() - line.points.size()), 0);
    if (line.points.size() < 2) continue;
    line.attributes = model_.add(attributes(item, r->name, owner));
    line.source.push_back(source_of(item));
    if (r->link) line.source.push_back({r->link.id, stands_for_role});
    mesh_.lines.push_back(std::move(line));
  }
}

void MeshReader::add_item(const Record& item, const Attributes& owner) {
  if (is_face(context_, item)) return add_face(item, owner);
  if (context_.is(item, Entity::TessellatedEdge)) return add_line(item, owner);
  if (context_.is(item, Entity::TessellatedVertex)) return context_.consume(item);  // a corner that its faces have too
  context_.add(item, rules::unsupported, fmt::format("{} is not read as part of a mesh", context_.file.keyword(item).name));
  context_.consume(item);
}

std::optional<PolygonMesh> MeshReader::mesh(const Record& item) {
  Visit visit(context_, item);
  if (!visit) return std::nullopt;
  context_.consume(item);
  mesh_ = {};
  mesh_.source.push_back(source_of(item));
  lists_.clear();
  places_.clear();
  Attributes whole;
  if (is_face(context_, item) || context_.is(item, Entity::TessellatedEdge)) {
    add_item(item, {});
    if (!mesh_.faces.empty()) whole = model_[mesh_.faces.front().attributes];
  } else {
    const auto r = context_.read<step::TessellatedGroup>(item);
    if (!r) return std::nullopt;
    whole = attributes(item, r->name, {});
    if (context_.is(item, Entity::TessellatedSolid)) mesh_.kind = BodyKind::Solid;
    if (context_.is(item, Entity::TessellatedWire)) mesh_.kind = BodyKind::Wire;
    if (r->link) mesh_.source.push_back({r->link.id, stands_for_role});
    if (r->items.empty()) context_.add(item, sr::tessellated, Severity::Warning, "the tessellated shape has no items");
    const Attributes around = [&] {
      Attributes a = whole;
      a.name.clear();
      return a;
    }();
    for (const Ref ref : r->items) {
      const Record* member = context_.resolve(item, ref, Entity::TessellatedItem);
      if (member) add_item(*member, around);
    }
  }
  if (mesh_.faces.empty() && mesh_.lines.empty()) return std::nullopt;  // said where
  if (const auto t = moved_by(item))
    for (Point& p : mesh_.points) p = apply(*t, p);
  mesh_.attributes = model_.add(whole);
  if (mesh_.kind == BodyKind::Solid)
    if (const std::size_t open = open_sides(mesh_))
      context_.add(item, sr::closed_shell_edges, fmt::format("the tessellated solid is not closed: {} sides of triangles have no partner", open),
                   static_cast<double>(open), 0);
  return std::move(mesh_);
}

void MeshReader::lines(Part& part, const Record& item) {
  mesh_ = {};
  lists_.clear();
  places_.clear();
  const auto to = moved_by(item).value_or(Transform{});
  const bool is_points = context_.is(item, Entity::TessellatedPointSet);
  const auto r = is_points ? context_.read<step::TessellatedLines>(item) : std::nullopt;
  if (is_points) {
    context_.consume(item);
    Coordinates* list = r ? coordinates(item, r->coordinates) : nullptr;
    const AttributesId id = model_.add(attributes(item, r ? r->name : std::string(), {}));
    std::size_t outside = 0;
    for (const auto& strip : r && list ? r->strips : std::vector<std::vector<int>>{})
      for (const int i : strip) {
        if (i >= 1 && static_cast<std::size_t>(i) <= list->points.size())
          part.points.push_back({apply(to, list->points[static_cast<std::size_t>(i) - 1]), id, {source_of(item)}});
        else
          ++outside;
      }
    if (outside > 0)
      context_.add(item, sr::tessellated, fmt::format("{} points are outside the list", outside), static_cast<double>(outside), 0);
    return;
  }
  add_line(item, {});
  for (const MeshLine& line : mesh_.lines) {
    Polyline polyline;
    for (const std::uint32_t p : line.points) polyline.points.push_back(apply(to, mesh_.points[p]));
    part.curves.push_back({Curve{std::move(polyline)}, line.attributes, line.source});
  }
}

void link_meshes(Model& model) {
  const auto named = [](const SourceRefs& source, std::uint8_t role) -> std::optional<std::uint64_t> {
    for (const SourceRef& s : source)
      if (s.role == role) return s.id;
    return std::nullopt;
  };
  for (Part& part : model.parts) {
    if (part.meshes.empty()) continue;
    struct Place {
      BodyIndex body;
      FaceId face;
    };
    std::unordered_map<std::uint64_t, Place> places;
    for (std::uint32_t b = 0; b < part.bodies.size(); ++b) {
      const Body& body = part.bodies[b];
      for (std::uint32_t f = 0; f < body.faces.size(); ++f)
        if (const auto id = named(body.faces[f].source, 0)) places.try_emplace(*id, Place{BodyIndex{b}, FaceId{f}});
      for (const Shell& shell : body.shells)
        if (const auto id = named(shell.source, 0)) places.try_emplace(*id, Place{BodyIndex{b}, {}});
      if (const auto id = named(body.source, 0)) places.try_emplace(*id, Place{BodyIndex{b}, {}});
    }
    const auto find = [&](const SourceRefs& source) {
      const auto id = named(source, stands_for_role);
      const auto at = id ? places.find(*id) : places.end();
      return at == places.end() ? Place{} : at->second;
    };
    for (PolygonMesh& mesh : part.meshes) {
      mesh.stands_for = find(mesh.source).body;
      // Without a word of the whole, its faces may agree on a body.
      if (!mesh.stands_for && !mesh.faces.empty()) {
        const BodyIndex first = find(mesh.faces.front().source).body;
        const bool agreed = std::all_of(mesh.faces.begin(), mesh.faces.end(),
                                        [&](const MeshFace& f) { return find(f.source).body == first; });
        if (agreed) mesh.stands_for = first;
      }
      for (MeshFace& face : mesh.faces) {
        const Place at = find(face.source);
        if (mesh.stands_for && at.body == mesh.stands_for) face.stands_for = at.face;
      }
    }
  }
}

}  // namespace trimloop::io::step_import
