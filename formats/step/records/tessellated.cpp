#include "formats/step/records/tessellated.h"

#include <fmt/format.h>

#include "formats/step/rules.h"

namespace trimloop::step {
namespace {

std::vector<std::array<double, 3>> triples(Reader& r, int i) {
  std::vector<std::array<double, 3>> out;
  if (!r.is_set(i)) return out;
  for (const std::vector<double>& row : r.real_rows(i)) {
    if (row.size() != 3) {
      r.add(rules::aggregate_bounds, fmt::format("{} numbers where three are expected", row.size()), i);
      r.fail();
      return {};
    }
    out.push_back({row[0], row[1], row[2]});
  }
  return out;
}

template <class T>
T optional_list(Reader& r, int i, T (Reader::*take)(int)) {
  return r.is_set(i) ? (r.*take)(i) : T{};
}

}  // namespace

CoordinatesList CoordinatesList::read(Reader& r) {
  CoordinatesList c;
  if (!r.at(Entity::CoordinatesList)) return c;
  const std::int64_t stated = r.integer(0);
  c.points = triples(r, 1);
  if (r.ok() && stated != static_cast<std::int64_t>(c.points.size()))
    r.add(rules::tessellated, fmt::format("the list says that it has {} points; it has {}", stated, c.points.size()), 0);
  return c;
}

Triangulation Triangulation::read(Reader& r) {
  Triangulation t;
  if (r.at(Entity::RepresentationItem, true)) t.name = r.text(0);
  const bool is_face = r.is(Entity::TessellatedFace);
  if (!r.at(is_face ? Entity::TessellatedFace : Entity::TessellatedSurfaceSet)) return t;
  t.coordinates = r.ref(0);
  t.pnmax = r.integer(1);
  t.normals = triples(r, 2);
  if (is_face) t.link = r.optional_ref(3);
  const bool is_complex = r.is(Entity::ComplexTriangulatedFace) || r.is(Entity::ComplexTriangulatedSurfaceSet);
  const Entity own = is_face ? (is_complex ? Entity::ComplexTriangulatedFace : Entity::TriangulatedFace)
                             : (is_complex ? Entity::ComplexTriangulatedSurfaceSet : Entity::TriangulatedSurfaceSet);
  if (!r.ok() || !r.at(own)) return t;
  t.pnindex = optional_list(r, 0, &Reader::integers);
  if (is_complex) {
    t.strips = optional_list(r, 1, &Reader::integer_rows);
    t.fans = optional_list(r, 2, &Reader::integer_rows);
  } else {
    t.triangles = r.integer_rows(1);
  }
  return t;
}

TessellatedGroup TessellatedGroup::read(Reader& r) {
  TessellatedGroup g;
  if (r.at(Entity::RepresentationItem, true)) g.name = r.text(0);
  for (const Entity e : {Entity::TessellatedSolid, Entity::TessellatedShell, Entity::TessellatedWire, Entity::TessellatedGeometricSet}) {
    if (!r.is(e)) continue;
    if (!r.at(e)) return g;
    g.items = r.refs(0);
    if (e != Entity::TessellatedGeometricSet) g.link = r.optional_ref(1);
    return g;
  }
  r.fail();
  return g;
}

TessellatedLines TessellatedLines::read(Reader& r) {
  TessellatedLines l;
  if (r.at(Entity::RepresentationItem, true)) l.name = r.text(0);
  if (r.is(Entity::TessellatedEdge)) {
    if (!r.at(Entity::TessellatedEdge)) return l;
    l.coordinates = r.ref(0);
    l.link = r.optional_ref(1);
    l.strips.push_back(r.integers(2));
  } else if (r.is(Entity::TessellatedPointSet)) {
    if (!r.at(Entity::TessellatedPointSet)) return l;
    l.coordinates = r.ref(0);
    l.strips.push_back(r.integers(1));
  } else if (r.at(Entity::TessellatedCurveSet)) {
    l.coordinates = r.ref(0);
    l.strips = r.integer_rows(1);
  }
  return l;
}

}  // namespace trimloop::step
