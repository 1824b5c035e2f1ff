#pragma once
// A body prepared for questions: which of its faces are near, where a point lies in a face (not part of the public face).

#include "kernel/closest/loops.h"
#include "kernel/topology/parameter_box.h"

namespace trimloop::boolean {

enum class Where : std::uint8_t { Outside, Border, Inside };

struct Place {
  Where where = Where::Outside;
  Uv uv;                // in the face's turn; of a border point the surface's own
  EdgeId edge;          // Border: the edge it is on
  double t = 0;         // and its parameter
};

struct FaceOf {
  FaceId id;
  const Surface* surface = nullptr;
  Box box;
  ParameterBox uv;
  closest::Loops loops;
  std::vector<EdgeId> edges;                // each once, poles left out
  std::vector<VertexId> poles;
  double period_u = 0, period_v = 0;        // of surfaces that can be evaluated beyond their domain
  bool reversed = false;
};

struct EdgeOf {
  Curve curve;   // over the edge's range
  Box box;
  std::vector<std::uint32_t> faces;  // indices of Operand::faces
  bool used = false;
};

class Operand {
 public:
  // The body must outlive this. InvalidArgument for faces without loops, Unsupported for edges without a curve.
  static Result<Operand> make(const Body& body, double tolerance_mm);

  const Body& body() const { return *body_; }
  double tolerance() const { return tolerance_; }
  const std::vector<FaceOf>& faces() const { return faces_; }
  const std::vector<EdgeOf>& edges() const { return edges_; }  // by EdgeId

  Place locate(const FaceOf&, Point) const;
  // The parameter turned into the face's loops, if any turn lies inside.
  std::optional<Uv> inside(const FaceOf&, Uv) const;

 private:
  const Body* body_ = nullptr;
  double tolerance_ = 0;
  std::vector<FaceOf> faces_;
  std::vector<EdgeOf> edges_;
};

inline bool apart(const Box& a, const Box& b, double by) {
  return a.lo.x - by > b.hi.x || b.lo.x - by > a.hi.x || a.lo.y - by > b.hi.y || b.lo.y - by > a.hi.y ||
         a.lo.z - by > b.hi.z || b.lo.z - by > a.hi.z;
}
inline bool apart(const Box& a, Point p, double by) {
  Box b;
  b.add(p);
  return apart(a, b, by);
}
inline Box widened(Box b, double by) {
  const Vector d{by, by, by};
  return {b.lo - d, b.hi + d};
}

}  // namespace trimloop::boolean
