#include "io/step/properties.h"

#include <cmath>


namespace trimloop::io::step_export {

using step::Measure;

namespace {

// The length unit to a power.
InstanceId power_of_length(EntityWriter& w, const SharedContext& c, double exponent) {
  const InstanceId element = w.out.add_shared("DERIVED_UNIT_ELEMENT", c.length_unit, exponent);
  return w.out.add_shared("DERIVED_UNIT", std::array{element});
}

void attach(EntityWriter& w, const char* what, InstanceId item, InstanceId owner, const SharedContext& c) {
  const InstanceId property = w.out.add("PROPERTY_DEFINITION", "geometric validation property", what, owner);
  const InstanceId representation = w.out.add("REPRESENTATION", what, std::array{item}, c.geometric);
  w.out.add("PROPERTY_DEFINITION_REPRESENTATION", property, representation);
}

}  // namespace

void write_properties(EntityWriter& w, const PartMass& sums, double scale, InstanceId owner, const SharedContext& c) {
  const double mm = w.units.factor(), s = std::abs(scale);
  if (sums.area_mm2 > 0) {
    const InstanceId item = w.out.add("MEASURE_REPRESENTATION_ITEM", "surface area measure",
                                      Measure{"AREA_MEASURE", sums.area_mm2 * s * s / (mm * mm)}, power_of_length(w, c, 2));
    attach(w, "surface area", item, owner, c);
  }
  if (!sums.has_solid || !(sums.volume_mm3 > 0)) return;
  const InstanceId item =
      w.out.add("MEASURE_REPRESENTATION_ITEM", "volume measure",
                Measure{"VOLUME_MEASURE", sums.volume_mm3 * s * s * s / (mm * mm * mm)}, power_of_length(w, c, 3));
  attach(w, "volume", item, owner, c);
  const Vector centre = sums.moment_mm4 * (scale / (sums.volume_mm3 * mm));
  const InstanceId point = w.out.add("CARTESIAN_POINT", "centre point", std::array{centre.x, centre.y, centre.z});
  attach(w, "centroid", point, owner, c);
}

}  // namespace trimloop::io::step_export
