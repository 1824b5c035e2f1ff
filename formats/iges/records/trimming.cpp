#include "formats/iges/records/trimming.h"

#include <fmt/format.h>

#include "formats/iges/records/checks.h"
#include "formats/iges/rules.h"

namespace trimloop::iges {

// 141 Boundary (IGES 5.3 4.31): TYPE, PREF, SPTR, N, then N times CRVPT, SENSE, K, PSCPT(1..K)
Boundary Boundary::read(TokenReader& in) {
  Boundary r;
  r.boundary_type = in.small_integer();
  r.preference = in.small_integer();
  r.surface = in.ref();
  r.items.resize(in.count(3));
  for (Item& item : r.items) {
    item.curve = in.ref();
    item.sense = in.small_integer();
    item.pcurves = in.refs(in.count(1));
  }
  return checked(std::move(r), in);
}

void Boundary::write(TokenWriter& out) const {
  out.integer(boundary_type);
  out.integer(preference);
  out.ref(surface);
  out.count(items.size());
  for (const Item& item : items) {
    out.ref(item.curve);
    out.integer(item.sense);
    out.count(item.pcurves.size());
    out.refs(item.pcurves);
  }
}

// 142 Curve on a Parametric Surface (4.32): CRTN, SPTR, BPTR (parameter space), CPTR (model space), PREF
CurveOnSurface CurveOnSurface::read(TokenReader& in) {
  CurveOnSurface r;
  r.creation = in.small_integer_or(0);
  r.surface = in.ref();
  r.pcurve = in.ref();
  r.curve = in.ref();
  r.preference = in.small_integer_or(0);
  return checked(r, in);
}

void CurveOnSurface::write(TokenWriter& out) const {
  out.integer(creation);
  out.ref(surface);
  out.ref(pcurve);
  out.ref(curve);
  out.integer(preference);
}

// 143 Bounded Surface (4.33): TYPE, SPTR, N, BDPT(1..N)
BoundedSurface BoundedSurface::read(TokenReader& in) {
  BoundedSurface r;
  r.representation = in.small_integer();
  r.surface = in.ref();
  r.boundaries = in.refs(in.count(1));
  return checked(std::move(r), in);
}

void BoundedSurface::write(TokenWriter& out) const {
  out.integer(representation);
  out.ref(surface);
  out.count(boundaries.size());
  out.refs(boundaries);
}

// 144 Trimmed Parametric Surface (4.34): PTS, N1, N2, PTO, PTI(1..N2)
TrimmedSurface TrimmedSurface::read(TokenReader& in) {
  TrimmedSurface r;
  r.surface = in.ref();
  r.outer_given = in.logical();
  const std::size_t holes = in.count(1);
  r.outer = in.ref();
  if (in.room(holes)) r.inner = in.refs(holes);
  return checked(std::move(r), in);
}

void TrimmedSurface::write(TokenWriter& out) const {
  out.ref(surface);
  out.logical(outer_given);
  out.count(inner.size());
  out.ref(outer);
  out.refs(inner);
}

// 186 Manifold Solid B-Rep Object (4.49): SHELL, SOF, N, then N times VOID, VOF
ManifoldSolid ManifoldSolid::read(TokenReader& in) {
  ManifoldSolid r;
  r.shell = in.ref();
  r.agrees = in.logical();
  r.voids.resize(in.count(2));
  for (Void& item : r.voids) {
    item.shell = in.ref();
    item.agrees = in.logical();
  }
  return checked(std::move(r), in);
}

void ManifoldSolid::write(TokenWriter& out) const {
  out.ref(shell);
  out.logical(agrees);
  out.count(voids.size());
  for (const Void& item : voids) {
    out.ref(item.shell);
    out.logical(item.agrees);
  }
}

// 502 Vertex List (4.143): N, then N times X, Y, Z
VertexList VertexList::read(TokenReader& in) {
  VertexList r;
  r.points.resize(in.count(3));
  for (Xyz& point : r.points) point = in.xyz();
  return checked(std::move(r), in);
}

void VertexList::write(TokenWriter& out) const {
  out.count(points.size());
  for (const Xyz& point : points) out.xyz(point);
}

// 504 Edge List (4.144): N, then N times CURV, SVP, SV, TVP, TV
EdgeList EdgeList::read(TokenReader& in) {
  EdgeList r;
  r.edges.resize(in.count(5));
  for (Item& item : r.edges) {
    item.curve = in.ref();
    item.start_list = in.ref();
    item.start_index = in.integer();
    item.end_list = in.ref();
    item.end_index = in.integer();
  }
  return checked(std::move(r), in);
}

void EdgeList::write(TokenWriter& out) const {
  out.count(edges.size());
  for (const Item& item : edges) {
    out.ref(item.curve);
    out.ref(item.start_list);
    out.integer(item.start_index);
    out.ref(item.end_list);
    out.integer(item.end_index);
  }
}

// 508 Loop (4.145): N, then N times TYPE, EDGE, NDX, OF, K and K times ISOP, CURV
LoopRecord LoopRecord::read(TokenReader& in) {
  LoopRecord r;
  r.items.resize(in.count(5));
  for (Item& item : r.items) {
    const std::int64_t kind = in.integer();
    if (kind != 0 && kind != 1)
      in.fault(rules::e508::use, fmt::format("an edge use of type {}, it is 0 (edge) or 1 (vertex)", kind), static_cast<double>(kind), 1);
    item.is_vertex = kind == 1;
    item.list = in.ref();
    item.index = in.integer();
    item.agrees = in.logical();
    item.pcurves.resize(in.count(2));
    for (Pcurve& pcurve : item.pcurves) {
      pcurve.isoparametric = in.logical();
      pcurve.curve = in.ref();
    }
  }
  return checked(std::move(r), in);
}

void LoopRecord::write(TokenWriter& out) const {
  out.count(items.size());
  for (const Item& item : items) {
    out.logical(item.is_vertex);
    out.ref(item.list);
    out.integer(item.index);
    out.logical(item.agrees);
    out.count(item.pcurves.size());
    for (const Pcurve& pcurve : item.pcurves) {
      out.logical(pcurve.isoparametric);
      out.ref(pcurve.curve);
    }
  }
}

// 510 Face (4.146): SURF, N, OF, LOOP(1..N)
FaceRecord FaceRecord::read(TokenReader& in) {
  FaceRecord r;
  r.surface = in.ref();
  const std::size_t loops = in.count(1);
  r.outer_first = in.logical();
  if (in.room(loops)) r.loops = in.refs(loops);
  return checked(std::move(r), in);
}

void FaceRecord::write(TokenWriter& out) const {
  out.ref(surface);
  out.count(loops.size());
  out.logical(outer_first);
  out.refs(loops);
}

// 514 Shell (4.147): N, then N times FACE, OF
ShellRecord ShellRecord::read(TokenReader& in) {
  ShellRecord r;
  r.faces.resize(in.count(2));
  for (Item& item : r.faces) {
    item.face = in.ref();
    item.agrees = in.logical();
  }
  return checked(std::move(r), in);
}

void ShellRecord::write(TokenWriter& out) const {
  out.count(faces.size());
  for (const Item& item : faces) {
    out.ref(item.face);
    out.logical(item.agrees);
  }
}

}  // namespace trimloop::iges
