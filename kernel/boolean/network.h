#pragma once
// The common network of two bodies: their edges cut where they meet the other's faces, the curves along which their faces
// meet, and what of it lies in each face (not part of the public face).

#include <array>
#include <map>

#include "kernel/boolean/operand.h"

namespace trimloop::boolean {

using NodeIndex = std::uint32_t;
using SegmentIndex = std::uint32_t;
constexpr std::uint32_t none = 0xffffffffu;

struct Segment {
  CurvePtr curve;
  Interval range;
  NodeIndex start = none, end = none;
  std::array<bool, 2> is_edge{};  // a piece of an edge of that operand
  bool meets = false;             // lies in both operands' faces
  SourceRefs source;
};

// A segment in the parameter plane of a face; without a segment it is (a part of) a pole.
struct Use {
  SegmentIndex segment = none;
  NodeIndex pole = none;
  bool reversed = false;  // of a border: the loop runs against the segment
  Curve2 pcurve;
  Interval range;         // of the pcurve at the segment's range.lo and range.hi; of a pole along the loop
  std::vector<Uv> map;    // as in Coedge
  double gap_mm = 0;
};

struct FaceNet {
  std::vector<Use> border, inner;        // one side each; both sides
  std::vector<std::uint32_t> coincident;  // faces of the other operand on the same surface
};

struct Network {
  std::vector<Point> nodes;
  std::vector<Segment> segments;
  std::array<std::vector<FaceNet>, 2> faces;
  double bound_mm = 0;  // no curve of the network is farther from the faces that it lies in
};

// Unsupported (with the reason) where the intersections cannot be decided.
Result<Network> make_network(const std::array<const Operand*, 2>&);

// The parameter curve of a curve that lies in the surface.
Result<Use> image(const Curve& curve, Interval range, const Surface& surface, double tolerance_mm);
Curve2 shifted(const Curve2&, Uv by);

}  // namespace trimloop::boolean
