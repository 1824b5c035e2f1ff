#pragma once
// Body: boundary representation as plain arrays with typed handles.
//
//   Shell -> Face -> Loop -> Coedge -> Edge -> Vertex
//
// A coedge is one use of an edge by a face, with its curve in that face's parameter space (pcurve). An edge carries
// any number of coedges (two in a closed shell, one on a border; more is data, not an error).
// Outer loops run counter-clockwise, holes clockwise, about Su x Sv; Face::reversed turns the face's outward normal.
// A pole is a coedge whose edge has no 3D curve. A seam is an edge with two coedges of one face.
// A face that failed keeps its surface and its reason and has no loops: it is counted, never dropped.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/handle.h"
#include "kernel/geometry/surface.h"

namespace trimloop {

namespace heal {
struct Repair;  // kernel/heal/make_face.h
}

using VertexId = Handle<struct VertexTag>;
using EdgeId = Handle<struct EdgeTag>;
using LoopId = Handle<struct LoopTag>;
using FaceId = Handle<struct FaceTag>;
using ShellId = Handle<struct ShellTag>;
using AttributesId = Handle<struct AttributesTag>;  // into Model::attributes

// Opaque identity of what an object was made from; only `io` knows that it means "D171" or "#42".
struct SourceRef {
  std::uint64_t id = 0;
  std::uint8_t role = 0;  // 0 the object itself, 1 its surface, 2 its curve, 3 its pcurve, 4 its loop, 5 what a mesh stands for, 6 what lists a part's shape
};
using SourceRefs = std::vector<SourceRef>;

struct Vertex {
  Point point;
  double gap_mm = 0;  // largest distance of an edge end from `point`
};

struct Edge {
  CurvePtr curve;         // null: a pole, or an edge known only through its pcurve (then exactly one coedge)
  Interval range;         // of `curve`; without one, of the coedge's pcurve
  VertexId start, end;
  bool is_pole = false;   // all of it is the vertex `start`
  SourceRefs source;
};

struct Coedge {
  EdgeId edge;
  bool reversed = false;      // runs from edge.end to edge.start
  Curve2 pcurve;
  Interval pcurve_range;      // parameter of `pcurve` at edge.range.lo and edge.range.hi (lo > hi: runs backwards)
  // Monotone piecewise-linear map, edge parameter -> pcurve parameter; empty: affine from edge.range to pcurve_range.
  std::vector<Uv> map;        // .u edge parameter, .v pcurve parameter
  double gap_mm = 0;          // measured max |C(t) - S(P(map(t)))|
};

struct Loop {
  std::vector<Coedge> coedges;  // head to tail
  SourceRefs source;
};

enum class FaceStatus : std::uint8_t { Ok, Healed, Failed };

struct Face {
  SurfacePtr surface;
  bool reversed = false;
  std::vector<LoopId> loops;        // an outer one first; only a failed face has none
  FaceStatus status = FaceStatus::Ok;
  std::string reason;               // healed: what was done; failed: why
  double area_before_mm2 = -1;      // healed faces: area as the file has it, where that can be said (else < 0)
  // Of a face that is not ok: the loops as they were given and each step taken. In millimetres of the part, before any
  // placement that is baked in (transform_body.h).
  std::shared_ptr<const heal::Repair> repair;
  AttributesId attributes;
  SourceRefs source;
};

struct Shell {
  struct Use {
    FaceId face;
    bool reversed = false;
  };
  std::vector<Use> faces;
  bool closed = false;      // every edge used exactly twice, in opposite senses
  bool is_void = false;     // inner boundary of a solid
  SourceRefs source;
};

enum class BodyKind : std::uint8_t { Solid, Sheet, Wire };

struct Body {
  BodyKind kind = BodyKind::Sheet;
  std::vector<Vertex> vertices;
  std::vector<Edge> edges;
  std::vector<Loop> loops;
  std::vector<Face> faces;
  std::vector<Shell> shells;   // faces in no shell are unsewn
  AttributesId attributes;
  SourceRefs source;

  VertexId add(Vertex v);
  EdgeId add(Edge e);
  LoopId add(Loop l);
  FaceId add(Face f);
  ShellId add(Shell s);
  const Vertex& operator[](VertexId id) const { return vertices[id.index]; }
  Vertex& operator[](VertexId id) { return vertices[id.index]; }
  const Edge& operator[](EdgeId id) const { return edges[id.index]; }
  Edge& operator[](EdgeId id) { return edges[id.index]; }
  const Loop& operator[](LoopId id) const { return loops[id.index]; }
  Loop& operator[](LoopId id) { return loops[id.index]; }
  const Face& operator[](FaceId id) const { return faces[id.index]; }
  Face& operator[](FaceId id) { return faces[id.index]; }
  const Shell& operator[](ShellId id) const { return shells[id.index]; }
  Shell& operator[](ShellId id) { return shells[id.index]; }
};

double pcurve_parameter(const Coedge&, const Edge&, double edge_parameter);
double edge_parameter(const Coedge&, const Edge&, double pcurve_parameter);
Uv uv_at(const Body&, const Coedge&, double edge_parameter);
// Ends of the coedge in loop direction.
Uv start_uv(const Body&, const Coedge&);
Uv end_uv(const Body&, const Coedge&);
VertexId start_vertex(const Body&, const Coedge&);
VertexId end_vertex(const Body&, const Coedge&);
// Point of an edge: on its 3D curve, or on S(pcurve) of its coedge, or its vertex for a pole.
Point point_at(const Body&, const Face&, const Coedge&, double edge_parameter);
// Every structural promise above, as sentences about what is broken; empty when all hold. Used by tests and fuzzers.
std::vector<std::string> broken_promises(const Body&, double tolerance_mm);

}  // namespace trimloop
