#pragma once
// Curve and point entities -> kernel curves.

#include "io/iges/context.h"

namespace trimloop::io::iges_import {

// In model space: mm, own 124 applied. Null after a finding. Read once, then shared.
CurvePtr model_curve(Context& context, const DirectoryEntry& entry);

// The same numbers as a curve in a surface's parameter space: nothing scaled, z left out.
std::optional<Curve> parameter_curve(Context& context, const DirectoryEntry& entry);

// What a curve consists of, in order: the leaves of a composite (102, nested ones too, points left out), or the curve
// itself. `outer` is the placement of the composites around the piece.
struct CurvePiece {
  const DirectoryEntry* entry = nullptr;
  Transform outer;
};
std::vector<CurvePiece> pieces(Context& context, const DirectoryEntry& entry, double length_scale);
CurvePtr model_curve(Context& context, const CurvePiece& piece);
std::optional<Curve> parameter_curve(Context& context, const CurvePiece& piece);

// Points of 116 and of 106 forms 1-3, in model space.
std::vector<Point> model_points(Context& context, const DirectoryEntry& entry);

// A copy of `curve` moved by `t`; null after a finding. Does nothing for the identity.
CurvePtr moved(Context& context, CurvePtr curve, const Transform& t);

}  // namespace trimloop::io::iges_import
