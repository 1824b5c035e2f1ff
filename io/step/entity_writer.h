#pragma once
// What every part of the STEP export shares: the Part 21 writer, file units, small geometry that is shared when equal,
// and the list of losses.

#include <optional>
#include <string>
#include <vector>

#include "formats/step/write.h"
#include "io/file_units.h"
#include "io/io.h"

namespace trimloop::io::step_export {

using step::InstanceId;

class EntityWriter {
 public:
  EntityWriter(const Model& from, Format source_format, const step::FileHeader& header, double mm_per_unit, bool as_nurbs)
      : model(from), units(mm_per_unit), to_nurbs(as_nurbs), out(header), source_format_(source_format) {}

  const Model& model;
  const FileUnits units;
  const bool to_nurbs;
  step::Writer out;
  std::vector<std::string> losses;
  NurbsStatement statement;

  InstanceId point(Point mm);            // CARTESIAN_POINT in file units
  InstanceId direction(Vector);          // DIRECTION as it stands
  InstanceId placement(const Frame&);    // AXIS2_PLACEMENT_3D, shared
  InstanceId axis(Point mm, Vector);     // AXIS1_PLACEMENT
  InstanceId vector(Vector unit, double magnitude);  // VECTOR
  InstanceId parametric_context();       // of pcurves, shared by all
  // "D171: a face ...": what has no home in the file.
  void lose(const SourceRefs& source, std::string_view what);

 private:
  Format source_format_;
  InstanceId parametric_context_;
};

// Own parameter t of a curve -> scale t + offset, the parameter of what was written.
struct ParameterShift {
  double scale = 1, offset = 0;
};
inline double apply(ParameterShift s, double t) { return s.scale * t + s.offset; }

struct WrittenCurve {
  InstanceId id;
  ParameterShift shift;
  Interval range{0, 0};  // what the curve's own range has become
  CurvePtr bent = nullptr;  // the spline that was written, where its parameter is not related by the shift
};
// Edge geometry and swept profiles: lines and conics whole, as the schemas want them there; splines over their range.
// Composites are joined into one spline.
Result<WrittenCurve> write_curve(EntityWriter&, const Curve&);
// The same for what is swept, where a part of a conic keeps its ends too.
Result<WrittenCurve> write_profile(EntityWriter&, const Curve&);
// A curve by itself, with its ends: TRIMMED_CURVE where the geometry alone has none, COMPOSITE_CURVE for composites.
// Unsupported for curves without end.
Result<InstanceId> write_bounded_curve(EntityWriter&, const Curve&);
// A curve in a parameter plane, already in the file's parameters.
InstanceId write_pcurve(EntityWriter&, const NurbsCurve&);

struct WrittenSurface {
  InstanceId id;
  UvMap map;           // own parameters -> those of what was written
  bool elementary = false;
  bool bent = false;   // under --to-nurbs they are bent instead: no map, pcurves do not carry over
  bool turned() const { return map.uu * map.vv - map.uv * map.vu < 0; }  // its normal is opposite to Su x Sv
};
// `u`, `v`: the rectangle that the face needs. Without --to-nurbs only revolutions depend on it.
Result<WrittenSurface> write_surface(EntityWriter&, const Surface&, Interval u, Interval v);

}  // namespace trimloop::io::step_export
