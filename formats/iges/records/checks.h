#pragma once
// What one record can answer about itself: each `read` ends with the check of its struct. Sloppy but usable data get a
// remark, impossible data a fault. Questions that need a second record or geometry belong to the importer.

#include "formats/iges/records/curves.h"
#include "formats/iges/records/structure.h"
#include "formats/iges/records/surfaces.h"
#include "formats/iges/records/table_record.h"
#include "formats/iges/records/trimming.h"

namespace trimloop::iges {

void check(const CircularArc&, TokenReader&);
void check(const CompositeCurve&, TokenReader&);
void check(const ConicArc&, TokenReader&);
void check(const CopiousData&, TokenReader&);
void check(const Line&, TokenReader&);
void check(const ParametricSplineCurve&, TokenReader&);
void check(const PointRecord&, TokenReader&);
void check(const Direction&, TokenReader&);
void check(const TransformationMatrix&, TokenReader&);
void check(const RationalBSplineCurve&, TokenReader&);

void check(const PlaneRecord&, TokenReader&);
void check(const ParametricSplineSurface&, TokenReader&);
void check(const RuledSurface&, TokenReader&);
void check(const SurfaceOfRevolution&, TokenReader&);
void check(const TabulatedCylinder&, TokenReader&);
void check(const RationalBSplineSurface&, TokenReader&);
void check(const OffsetCurve&, TokenReader&);
void check(const OffsetSurface&, TokenReader&);
void check(const PlaneSurface&, TokenReader&);
void check(const CylindricalSurface&, TokenReader&);
void check(const ConicalSurface&, TokenReader&);
void check(const SphericalSurface&, TokenReader&);
void check(const ToroidalSurface&, TokenReader&);

void check(const Boundary&, TokenReader&);
void check(const CurveOnSurface&, TokenReader&);
void check(const BoundedSurface&, TokenReader&);
void check(const TrimmedSurface&, TokenReader&);
void check(const ManifoldSolid&, TokenReader&);
void check(const VertexList&, TokenReader&);
void check(const EdgeList&, TokenReader&);
void check(const LoopRecord&, TokenReader&);
void check(const FaceRecord&, TokenReader&);
void check(const ShellRecord&, TokenReader&);

void check(const SubfigureDefinition&, TokenReader&);
void check(const ColourDefinition&, TokenReader&);
void check(const Associativity&, TokenReader&);
void check(const Property&, TokenReader&);
void check(const SubfigureInstance&, TokenReader&);

void check(const TableRecord&, TokenReader&);

// `record`, checked when it could be read. How every `read` ends.
template <class Record>
Record checked(Record record, TokenReader& in) {
  if (in.ok()) check(record, in);
  return record;
}

}  // namespace trimloop::iges
