#pragma once
// Any record by its type number: the typed struct where there is one, else what the layout table makes of it, else its
// fields as text.

#include <variant>

#include "formats/iges/records/curves.h"
#include "formats/iges/records/structure.h"
#include "formats/iges/records/surfaces.h"
#include "formats/iges/records/table_record.h"
#include "formats/iges/records/trimming.h"

namespace trimloop::iges {

// A type that the standard does not have, macro text (306), or a record whose findings say why it could not be read.
struct RawRecord {
  std::vector<Field> fields;  // all parameters, trailing groups included
};

struct AnyRecord {
  std::variant<RawRecord, TableRecord, CircularArc, CompositeCurve, ConicArc, CopiousData, PlaneRecord, Line, ParametricSplineCurve,
               ParametricSplineSurface, PointRecord, RuledSurface, SurfaceOfRevolution, TabulatedCylinder, Direction,
               TransformationMatrix, RationalBSplineCurve, RationalBSplineSurface, OffsetCurve, OffsetSurface, Boundary,
               CurveOnSurface, BoundedSurface, TrimmedSurface, ManifoldSolid, PlaneSurface, CylindricalSurface,
               ConicalSurface, SphericalSurface, ToroidalSurface, SubfigureDefinition, ColourDefinition, Associativity,
               Property, SubfigureInstance, VertexList, EdgeList, LoopRecord, FaceRecord, ShellRecord>
      body;
  TrailingGroups groups;  // of typed records
  AsGiven as_given;       // of typed records

  template <class Record>
  const Record* as() const {
    return std::get_if<Record>(&body);
  }
  bool is_raw() const { return as<RawRecord>() != nullptr; }
};

bool has_struct(int type);           // there is a struct for this type
bool is_typed(int type, int form);   // there is a struct, or a row in the layout table

// Reads the record of a directory entry. What is wrong goes to `report`; a record that cannot be used comes back raw.
AnyRecord read_any(const File& file, const DirectoryEntry& entry, const Limits& limits, Report& report);
AnyRecord read_any(const File& file, const DirectoryEntry& entry, const Parameters& parameters, const Limits& limits,
                   Report& report);

// Every parameter after the entity type, one text each, trailing groups included. write_any(read_any(...)) gives the
// tokens of the file: same integers, strings and pointers, reals equal as doubles, empty and omitted fields as they
// were.
std::vector<std::string> write_any(const AnyRecord& record);

}  // namespace trimloop::iges
