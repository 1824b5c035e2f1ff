#include "io/step/entity_writer.h"

namespace trimloop::io::step_export {

InstanceId EntityWriter::point(Point mm) {
  const Point p = units.point(mm);
  return out.add_shared("CARTESIAN_POINT", "", std::array{p.x, p.y, p.z});
}

InstanceId EntityWriter::direction(Vector d) { return out.add_shared("DIRECTION", "", std::array{d.x, d.y, d.z}); }

InstanceId EntityWriter::placement(const Frame& f) {
  const InstanceId origin = point(f.origin), z = direction(f.z), x = direction(f.x);
  return out.add_shared("AXIS2_PLACEMENT_3D", "", origin, z, x);
}

InstanceId EntityWriter::axis(Point mm, Vector d) {
  const InstanceId origin = point(mm), z = direction(d);
  return out.add_shared("AXIS1_PLACEMENT", "", origin, z);
}

InstanceId EntityWriter::vector(Vector unit, double magnitude) {
  const InstanceId d = direction(unit);
  return out.add_shared("VECTOR", "", d, magnitude);
}

InstanceId EntityWriter::parametric_context() {
  if (!parametric_context_) {
    parametric_context_ = out.add_complex({step::partial("GEOMETRIC_REPRESENTATION_CONTEXT", 2),
                                           step::partial("PARAMETRIC_REPRESENTATION_CONTEXT"),
                                           step::partial("REPRESENTATION_CONTEXT", "", "2D")});
  }
  return parametric_context_;
}

void EntityWriter::lose(const SourceRefs& source, std::string_view what) {
  std::string text = source.empty() ? "" : source_name(source_format_, source.front()) + ": ";
  losses.push_back(text += what);
}

}  // namespace trimloop::io::step_export
