#pragma once
// A face in the making: rings of pieces in the cover of its sheet. Pieces become coedges, and nodes vertices, only when
// everything has been decided (make_face.cpp).

#include "kernel/heal/make_face.h"
#include "kernel/pcurve/sheet.h"

namespace trimloop::heal {

using pcurve::Pole;
using pcurve::Sheet;

struct Sample {
  double t;  // of the pcurve
  Uv uv;     // in the cover
};

// What will be one coedge. It runs, in loop direction, from t0 to t1 of its pcurve and from c0 to c1 of its 3D curve.
struct Piece {
  Curve2 pcurve;
  double t0 = 0, t1 = 1;
  Uv shift;                     // whole periods added to the pcurve
  CurvePtr curve;               // null: known by its pcurve only
  double c0 = 0, c1 = 1;
  std::vector<Uv> map;          // as Coedge::map
  double gap_mm = 0;            // measured max |C - S(P)|
  EdgeId existing;              // shared edge of the body, of which this is all or a part
  bool is_pole = false;
  int seam = -1;                // the two pieces of one seam have the same number
  int start = -1, end = -1;     // nodes
  int segment = -1;             // of the input, -1: supplied here
  SourceRefs source;
  std::vector<Sample> samples;  // from t0 to t1; enough to tell area and inside, not to measure
};

struct Node {
  Point point;
  VertexId existing;
};

struct Ring {
  std::vector<Piece> pieces;
  int loop = -1;                // of the input, -1: supplied here
  bool claimed_outer = false;
  bool is_joined = false;       // nodes are set, nothing is left to close
  bool is_part = false;         // of a loop that crossed itself
  int turns_u = 0, turns_v = 0; // whole periods between its end and its start
  double area = 0;              // signed, in parameter units; of no meaning for a ring that winds
  SourceRefs source;
};

// A segment on an edge of the body gets a curve of its own.
void detach(const Body&, const SharedEdges*, TrimSegment&);
std::string sentence(const StepRecord&);  // "gap of 0.13 mm closed in loop 1, segment 1"

struct Draft {
  const FaceInput& input;
  const Sheet& sheet;
  const Body& body;
  SharedEdges& shared;
  double tolerance_mm;          // below: no finding
  std::vector<StepRecord> steps{};
  std::vector<Ring> rings{};
  std::vector<Node> nodes{};
  int seams = 0;
  bool whole_u = false, whole_v = false;  // the natural boundary, closed along u or v and not cut open yet
  std::string failure{};        // not empty: the face failed, and why
  bool bounds_nothing = false;  // failed since its loops enclose no area

  void record(Step step, int loop, int segment, double before_mm, double after_mm, Point at, bool changes_shape) {
    steps.push_back({step, loop, segment, before_mm, after_mm, at, changes_shape});
    if (input.forbidden.contains(step) && failure.empty())
      failure = sentence(steps.back()) + ": needed, but not allowed";
  }
  int add_node(Point p, VertexId existing = {}) {
    nodes.push_back({p, existing});
    return static_cast<int>(nodes.size()) - 1;
  }
};

inline Uv uv_of(const Piece& p, double t) { return evaluate(p.pcurve, t) + p.shift; }
inline Uv first_uv(const Piece& p) { return p.samples.front().uv; }
inline Uv last_uv(const Piece& p) { return p.samples.back().uv; }

// Fills the samples; false when one of them is not finite.
bool take_samples(Piece&);
// A straight piece without 3D curve.
Piece straight_piece(Uv a, Uv b);
void move_by(Piece&, Uv shift);
void move_by(Ring&, Uv shift);
void turn_around(Piece&);
void turn_around(Ring&);
// The two parts of a piece before and after pcurve parameter t, both with the new node.
std::pair<Piece, Piece> split(const Piece&, double t, int node);
// Curve parameter that belongs to pcurve parameter t, and the other way round.
double curve_parameter(const Piece&, double t);
double pcurve_parameter(const Piece&, double c);

// How far, in mm, the pcurve goes beyond the border of the surface, and where.
double overshoot_mm(const Sheet&, const Piece&, Uv* where);

struct UvBox {
  Uv lo{infinity, infinity}, hi{-infinity, -infinity};
  void add(Uv p) {
    lo = {std::min(lo.u, p.u), std::min(lo.v, p.v)};
    hi = {std::max(hi.u, p.u), std::max(hi.v, p.v)};
  }
  bool contains(Uv p) const { return lo.u <= p.u && p.u <= hi.u && lo.v <= p.v && p.v <= hi.v; }
};
inline bool overlap(const UvBox& a, const UvBox& b) {
  return a.lo.u <= b.hi.u && b.lo.u <= a.hi.u && a.lo.v <= b.hi.v && b.lo.v <= a.hi.v;
}
UvBox box_of(const Ring&);
double area_of(const Ring&);         // by the samples

class RunTree;  // run_tree.h
// A ring drawn in another turn of the cover than the outer one goes to where it lies inside of that, if there is one.
void bring_together(const Sheet&, const RunTree& outer, Ring&);
// A straight piece along the border or a seam of the sheet, with its exact 3D curve where there is one.
Piece border_piece(const Sheet&, Uv a, Uv b);

// The stages, in the order in which make_face.cpp runs them. Each one may set Draft::failure.
void draw_segments(Draft&);            // segments.cpp: input -> rings of pieces with pcurves
void hold(Draft&, Piece&, int loop);   // hold.cpp: a pcurve beyond the border of the surface is drawn along it
void chain(Draft&, Ring&);             // chain.cpp: order and direction of the pieces of one ring
void close(Draft&, Ring&);             // close.cpp: same turn, no gaps, poles; sets turns_u, turns_v and the nodes
void uncross(Draft&);                  // uncross.cpp: rings that cross themselves become several that do not
void orient(Draft&);                   // orient.cpp: which side is inside; rings of one face lie together
void add_natural_boundary(Draft&);     // natural.cpp: as one or two more rings
void cut_open(Draft&);                 // cut.cpp: winding rings and rings over a seam become closed in parameter space
void part_loops(Draft&);               // part_loops.cpp: rings that cross each other become rings that do not

}  // namespace trimloop::heal
