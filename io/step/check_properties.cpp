#include "io/step/check_properties.h"

#include <fmt/format.h>

#include <cmath>

#include "formats/step/rules.h"
#include "io/step/geometry.h"
#include "kernel/check/measure.h"

namespace trimloop::io::step_import {
namespace {

namespace sr = step::rules;

struct Measures {
  double area = 0, volume = 0;
  Vector moment;
  Box box;
  bool has_solid = false, complete = true;
};

Measures measure_part(const Part& part) {
  Measures out;
  for (const Body& body : part.bodies) {
    for (std::uint32_t f = 0; f < body.faces.size(); ++f) {
      out.complete = out.complete && body.faces[f].status != FaceStatus::Failed;
      out.area += area(body, FaceId{f}).value;
      out.box.add(bounding_box(body, FaceId{f}));
    }
    if (body.kind != BodyKind::Solid) continue;
    for (std::uint32_t s = 0; s < body.shells.size(); ++s) {
      const auto v = volume(body, ShellId{s});
      const auto c = centroid(body, ShellId{s});
      if (!v || !c) {
        out.complete = false;
        continue;
      }
      out.has_solid = true;
      out.volume += v->value;
      out.moment += v->value * to_vector(*c);
    }
  }
  return out;
}

// mm, mm2 or mm3 of a unit: derived from lengths, or by the context.
double factor_of(Context& context, const Record* unit, const Units& units, int power) {
  if (unit && context.is(*unit, Entity::DerivedUnit)) {
    step::Tape tape;
    step::Reader r(context.file, *unit, context.execution.limits, tape, context.report);
    if (r.at(Entity::DerivedUnit)) {
      double product = 1;
      bool good = false;
      for (const Ref ref : r.refs(0)) {
        const Record* element = context.find(ref);
        if (!element || !context.is(*element, Entity::DerivedUnitElement)) continue;
        step::Tape inner;
        step::Reader e(context.file, *element, context.execution.limits, inner, context.report);
        if (!e.at(Entity::DerivedUnitElement)) continue;
        const Record* base = context.find(e.ref(0));
        const double exponent = e.real(1);
        const auto mm = base && context.is(*base, Entity::NamedUnit) ? unit_value(context, *base, false) : std::nullopt;
        if (!mm) continue;
        product *= std::pow(*mm, exponent);
        good = exponent == power;
      }
      return good ? product : 0;
    }
  }
  if (unit && context.is(*unit, Entity::LengthUnit) && power != 1) return 0;
  return std::pow(units.mm, power);
}

class PropertyCheck {
 public:
  PropertyCheck(Context& context, const Model& model, const std::unordered_map<std::size_t, std::uint32_t>& part_of)
      : context_(context), model_(model), part_of_(part_of) {}

  void run() {
    for (const Record& i : context_.file.instances()) {
      if (!context_.is(i, Entity::PropertyDefinitionRepresentation) || context_.is(i, Entity::ShapeDefinitionRepresentation)) continue;
      if (!context_.execution.stop.stop_requested()) one(i);
    }
  }

 private:
  const Part* part_of(const Record& property) {
    const auto p = context_.read<step::PropertyRecord>(property);
    if (!p || p->name != "geometric validation property") return nullptr;
    const Record* owner = context_.find(p->definition);
    if (owner && context_.is(*owner, Entity::PropertyDefinition)) {
      const auto shape = context_.read<step::PropertyRecord>(*owner);
      owner = shape ? context_.find(shape->definition) : nullptr;
    }
    if (!owner || !context_.is(*owner, Entity::ProductDefinition)) return nullptr;
    const auto at = part_of_.find(context_.index(*owner));
    if (at == part_of_.end()) return nullptr;
    const Part& part = model_.parts[at->second];
    return part.instances.empty() && !part.bodies.empty() ? &part : nullptr;
  }

  const Measures& measures(const Part& part) {
    const auto [at, fresh] = measured_.try_emplace(&part);
    if (fresh) at->second = measure_part(part);
    return at->second;
  }

  void one(const Record& link) {
    const auto pair = context_.read<step::Pair>(link);
    const Record* property = pair ? context_.find(pair->first) : nullptr;
    const Record* representation = pair ? context_.find(pair->second) : nullptr;
    if (!property || !representation || !context_.is(*property, Entity::PropertyDefinition) ||
        !context_.is(*representation, Entity::Representation))
      return;
    const Part* part = part_of(*property);
    const auto rep = part ? context_.read<step::RepresentationRecord>(*representation) : std::nullopt;
    if (!rep) return;
    const Units& units = context_.units_of(context_.find(rep->context));
    for (const Ref ref : rep->items) {
      const Record* item = context_.find(ref);
      if (!item) continue;
      if (context_.is(*item, Entity::CartesianPoint)) {
        compare_centroid(*item, *part, units);
      } else if (context_.is(*item, Entity::MeasureRepresentationItem)) {
        const auto m = context_.read<step::MeasureRecord>(*item);
        if (m) compare(*item, *m, rep->name, *part, units);
      }
    }
  }

  void compare(const Record& item, const step::MeasureRecord& m, const std::string& name, const Part& part, const Units& units) {
    const bool is_volume = m.value.type == "VOLUME_MEASURE" || m.name.find("volume") != std::string::npos || name == "volume";
    const bool is_area = m.value.type == "AREA_MEASURE" || m.name.find("area") != std::string::npos || name.find("area") != std::string::npos;
    if (is_volume == is_area) return;
    if (m.value.kind != step::Select::Kind::Number || !(m.value.number > 0)) {
      context_.add(item, sr::property_positive, fmt::format("the stated {} is no positive number", is_volume ? "volume" : "area"), m.value.number, 0);
      return;
    }
    const double factor = factor_of(context_, context_.find(m.unit), units, is_volume ? 3 : 2);
    if (!(factor > 0)) {
      context_.add(item, sr::property_unit, fmt::format("the unit of the stated {} is not one of {}s", is_volume ? "volume" : "area", is_volume ? "volume" : "area"));
      return;
    }
    const Measures& ours = measures(part);
    if (is_volume && !ours.has_solid) return;
    const double stated = m.value.number * factor, found = is_volume ? ours.volume : ours.area;
    // A tenth of a percent is told, a percent is an error (recommended practice 4.6).
    const double off = std::abs(stated - found) / std::max(std::abs(found), 1e-300);
    if (!(off > 1e-3)) return;
    context_.add(item, is_volume ? sr::property_volume : sr::property_area, off > 1e-2 || !ours.complete ? Severity::Error : Severity::Warning,
                 fmt::format("the file states {:.9g}, the shape has {:.9g}: {:.3g} % apart", stated, found, 100 * off), stated, found);
  }

  void compare_centroid(const Record& item, const Part& part, const Units& units) {
    const Measures& ours = measures(part);
    if (!ours.has_solid || !(ours.volume > 0)) return;
    Geometry geometry(context_, units);
    const auto stated = geometry.point(item);
    if (!stated) return;
    const Point found = to_point(ours.moment / ours.volume);
    const double off = distance(*stated, found), allowed = 0.01 * ours.box.diagonal();
    if (!(off > allowed)) return;
    Diagnostic& d = context_.add(item, sr::property_centroid, "the stated centroid is not that of the shape", off, allowed);
    d.at = {found.x, found.y, found.z};
  }

  Context& context_;
  const Model& model_;
  const std::unordered_map<std::size_t, std::uint32_t>& part_of_;
  std::unordered_map<const Part*, Measures> measured_;
};

}  // namespace

void check_properties(Context& context, const Model& model, const std::unordered_map<std::size_t, std::uint32_t>& part_of) {
  PropertyCheck(context, model, part_of).run();
}

}  // namespace trimloop::io::step_import
