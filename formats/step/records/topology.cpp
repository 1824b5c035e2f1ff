#include "formats/step/records/topology.h"

namespace trimloop::step {

VertexPoint VertexPoint::read(Reader& r) {
  VertexPoint v;
  if (r.at(Entity::VertexPoint)) v.point = r.ref(0);
  return v;
}

EdgeCurve EdgeCurve::read(Reader& r) {
  EdgeCurve e;
  if (!r.at(Entity::Edge)) return e;
  e.start = r.ref(0);
  e.end = r.ref(1);
  if (!r.at(Entity::EdgeCurve)) return e;
  e.curve = r.ref(0);
  e.same_sense = r.boolean(1, true);
  return e;
}

Oriented Oriented::read(Reader& r) {
  Oriented o;
  const Entity e = r.is(Entity::OrientedEdge)          ? Entity::OrientedEdge
                   : r.is(Entity::OrientedFace)        ? Entity::OrientedFace
                   : r.is(Entity::OrientedClosedShell) ? Entity::OrientedClosedShell
                                                       : Entity::OrientedOpenShell;
  if (!r.at(e)) return o;
  o.element = r.ref(0);
  o.orientation = r.boolean(1, true);
  return o;
}

LoopRecord LoopRecord::read(Reader& r) {
  LoopRecord l;
  if (r.is(Entity::Path)) {
    if (r.at(Entity::Path)) l.items = r.refs(0);
  } else if (r.is(Entity::PolyLoop)) {
    if (r.at(Entity::PolyLoop)) l.items = r.refs(0);
  } else if (r.at(Entity::VertexLoop)) {
    l.items.push_back(r.ref(0));
  }
  return l;
}

FaceBound FaceBound::read(Reader& r) {
  FaceBound b;
  if (!r.at(Entity::FaceBound)) return b;
  b.loop = r.ref(0);
  b.orientation = r.boolean(1, true);
  b.is_outer = r.is(Entity::FaceOuterBound);
  return b;
}

FaceRecord FaceRecord::read(Reader& r) {
  FaceRecord f;
  if (r.at(Entity::RepresentationItem, true)) f.name = r.text(0);
  if (!r.at(Entity::Face)) return f;
  f.bounds = r.refs(0);
  if (!r.is(Entity::FaceSurface) || !r.at(Entity::FaceSurface)) return f;
  f.surface = r.ref(0);
  f.same_sense = r.boolean(1, true);
  return f;
}

Members Members::read(Reader& r) {
  Members m;
  if (r.at(Entity::RepresentationItem, true)) m.name = r.text(0);
  for (const Entity e : {Entity::ConnectedFaceSet, Entity::ShellBasedSurfaceModel, Entity::FaceBasedSurfaceModel, Entity::GeometricSet,
                         Entity::ShellBasedWireframeModel, Entity::EdgeBasedWireframeModel, Entity::ConnectedEdgeSet, Entity::WireShell}) {
    if (r.is(e) && r.at(e)) {
      m.items = r.refs(0);
      break;
    }
  }
  return m;
}

SolidRecord SolidRecord::read(Reader& r) {
  SolidRecord s;
  if (r.at(Entity::RepresentationItem, true)) s.name = r.text(0);
  if (!r.at(Entity::ManifoldSolidBrep)) return s;
  s.outer = r.ref(0);
  if (r.is(Entity::BrepWithVoids) && r.at(Entity::BrepWithVoids)) s.voids = r.refs(0);
  return s;
}

}  // namespace trimloop::step
