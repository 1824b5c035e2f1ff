#pragma once
// Regularized Boolean operations on solids: union, intersection, difference as boundary representations.
//
// Faces keep their surfaces; their new edges are the curves where surfaces meet: lines and conics in closed form between
// elementary surfaces wherever these have them, else splines that are proven to lie within `bound_mm` of both surfaces
// (kernel/intersect). Edges are shared by construction, none is sewn by nearness. Faces that coincide (one plane, one
// axis and radius) are part of the answer: coplanar faces unite, touching ones vanish. What is decided by a sign that
// cannot be told (surfaces that nearly coincide, curves closer together than the tolerance) is not answered: an error
// says what was not decided.
//
// C. M. Hoffmann, "Geometric and Solid Modeling" (1989), ch. 3; A. A. G. Requicha, H. B. Voelcker, "Boolean operations
// in solid modeling: boundary evaluation and merging algorithms", Proc. IEEE 73 (1985).

#include "kernel/topology/body.h"

namespace trimloop {

enum class BooleanOperation : std::uint8_t { Union, Intersection, Difference };

struct BooleanOptions {
  // What is not farther apart is one point or one surface; 0: 1e-9 of the operands' size, or twice the largest gap at
  // their vertices and edges if that is more.
  double tolerance_mm = 0;
};

struct BooleanResult {
  std::vector<Body> bodies;  // solids, each one piece with its voids; none when nothing is left
  double tolerance_mm = 0;   // in force
  double bound_mm = 0;       // no new edge is farther from the faces that it bounds
};

// Of all the solids of `a` (which do not overlap one another) with those of `b`. Faces keep attributes and sources. A face
// that the operation does not cut comes out as it was; one that closes on itself may be cut at its seam only if it is a
// spline. InvalidArgument: an operand is not a closed solid; Unsupported or Degenerate: not decided, and why.
Result<BooleanResult> combine(const std::vector<Body>& a, const std::vector<Body>& b, BooleanOperation,
                              const BooleanOptions& = {});
Result<BooleanResult> combine(const Body& a, const Body& b, BooleanOperation, const BooleanOptions& = {});

// Which of the solids the point lies in, or on within the tolerance (then the nearest one); nothing when it lies in none or
// that is not decided.
std::optional<std::size_t> solid_at(const std::vector<Body>& solids, Point p, double tolerance_mm);

// ---- Open bodies

enum class TrimSide : std::uint8_t { Both, Outside, Inside };

// The faces of `sheet` cut along `tool`: all pieces, or those on one side of it. Inside is behind the tool's faces (against
// their outward normals): by a ray if the tool is a closed solid; if it is open, by the side on which a piece leaves its
// cut, and for faces that are not cut by the tool's nearest face. Curves of the tool that end inside a face do not cut it.
// Pieces stay joined at the edges that they share; cut edges are border edges.
Result<BooleanResult> trim(const Body& sheet, const Body& tool, TrimSide keep, const BooleanOptions& = {});

}  // namespace trimloop
