#include "io/step/properties.h"

#include <cmath>

#include "kernel/check/measure.h"

namespace trimloop::io::step_export {

using step::Measure;

namespace {

struct Sums {
  double area = 0, volume = 0;
  Vector moment;
  bool solid = false;
};

Sums measure_part(const Part& part) {
  Sums sums;
  for (const Body& body : part.bodies) {
    for (std::uint32_t f = 0; f < body.faces.size(); ++f) sums.area += area(body, FaceId{f}).value;
    if (body.kind != BodyKind::Solid) continue;
    for (std::uint32_t s = 0; s < body.shells.size(); ++s) {
      const auto v = volume(body, ShellId{s});
      const auto c = centroid(body, ShellId{s});
      if (!v || !c) continue;
      sums.solid = true;
      sums.volume += v->value;
      sums.moment += v->value * to_vector(*c);
    }
  }
  return sums;
}

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

void write_properties(EntityWriter& w, const Part& part, double scale, InstanceId owner, const SharedContext& c) {
  const Sums sums = measure_part(part);
  const double mm = w.units.factor(), s = std::abs(scale);
  if (sums.area > 0) {
    const InstanceId item = w.out.add("MEASURE_REPRESENTATION_ITEM", "surface area measure",
                                      Measure{"AREA_MEASURE", sums.area * s * s / (mm * mm)}, power_of_length(w, c, 2));
    attach(w, "surface area", item, owner, c);
  }
  if (!sums.solid || !(sums.volume > 0)) return;
  const InstanceId item =
      w.out.add("MEASURE_REPRESENTATION_ITEM", "volume measure",
                Measure{"VOLUME_MEASURE", sums.volume * s * s * s / (mm * mm * mm)}, power_of_length(w, c, 3));
  attach(w, "volume", item, owner, c);
  const Vector centre = sums.moment * (scale / (sums.volume * mm));
  const InstanceId point = w.out.add("CARTESIAN_POINT", "centre point", std::array{centre.x, centre.y, centre.z});
  attach(w, "centroid", point, owner, c);
}

}  // namespace trimloop::io::step_export
