#include "io/step/check_properties.h"

#include <fmt/format.h>

#include <cmath>

#include "formats/step/rules.h"
#include "io/step/geometry.h"
#include "kernel/check/measure.h"
#include "kernel/check/part_mass.h"

namespace trimloop::io::step_import {
namespace {

namespace sr = step::rules;

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
      : context_(context), model_(model), part_of_(part_of), masses_(model) {}

  void run() {
    find_shapes();
    for (const Record& i : context_.file.instances()) {
      if (!context_.is(i, Entity::PropertyDefinitionRepresentation) || context_.is(i, Entity::ShapeDefinitionRepresentation)) continue;
      if (!context_.execution.stop.stop_requested()) one(i);
    }
  }

 private:
  // What the aspects of a shape consist of, as far as these are faces and bodies of the model.
  void find_shapes() {
    for (const Part& part : model_.parts)
      for (const Body& body : part.bodies) {
        if (!body.source.empty()) bodies_.try_emplace(body.source.front().id, &body);
        for (const Face& f : body.faces)
          if (!f.source.empty()) faces_.try_emplace(f.source.front().id, std::pair(&body, FaceId{static_cast<std::uint32_t>(&f - body.faces.data())}));
      }
    for (const Record& i : context_.file.instances()) {
      if (!context_.is(i, Entity::GeometricItemSpecificUsage)) continue;
      step::Tape tape;
      step::Reader r(context_.file, i, context_.execution.limits, tape, context_.report);
      if (!r.at(Entity::GeometricItemSpecificUsage) || r.count() < 5) continue;
      const Record* aspect = context_.find(r.select(2).ref);
      if (aspect) items_[context_.index(*aspect)].push_back(r.select(4).ref.id);
    }
  }

  // Nothing where it speaks of what the model does not have as a whole.
  std::optional<PartMass> mass_of_aspect(const Record& aspect) {
    const auto items = items_.find(context_.index(aspect));
    if (items == items_.end()) return std::nullopt;
    PartMass sum;
    for (const std::uint64_t id : items->second) {
      if (const auto face = faces_.find(id); face != faces_.end()) {
        const auto [body, f] = face->second;
        sum.complete = sum.complete && (*body)[f].status != FaceStatus::Failed;
        sum.area_mm2 += area(*body, f).value;
      } else if (const auto body = bodies_.find(id); body != bodies_.end() && items->second.size() == 1) {
        return mass_of(*body->second);
      } else {
        return std::nullopt;
      }
    }
    return sum;
  }

  // What a property is of: a part with all that is placed in it, or an aspect of a shape.
  std::optional<PartMass> mass_of_owner(const Record& property) {
    const auto p = context_.read<step::PropertyRecord>(property);
    if (!p || p->name != "geometric validation property") return std::nullopt;
    const Record* owner = context_.find(p->definition);
    if (owner && context_.is(*owner, Entity::PropertyDefinition)) {
      const auto shape = context_.read<step::PropertyRecord>(*owner);
      owner = shape ? context_.find(shape->definition) : nullptr;
    }
    // Aspects are of many kinds: datum features, groups, tolerance zones. What has items of its own is one.
    if (owner && items_.count(context_.index(*owner))) return mass_of_aspect(*owner);
    if (!owner || !context_.is(*owner, Entity::ProductDefinition)) return std::nullopt;
    const auto at = part_of_.find(context_.index(*owner));
    if (at == part_of_.end()) return std::nullopt;
    const PartMass& mass = masses_.of(at->second);
    return mass.area_mm2 > 0 || mass.has_solid ? std::optional(mass) : std::nullopt;
  }

  void one(const Record& link) {
    const auto pair = context_.read<step::Pair>(link);
    const Record* property = pair ? context_.find(pair->first) : nullptr;
    const Record* representation = pair ? context_.find(pair->second) : nullptr;
    if (!property || !representation || !context_.is(*property, Entity::PropertyDefinition) ||
        !context_.is(*representation, Entity::Representation))
      return;
    const auto mass = mass_of_owner(*property);
    const auto rep = mass ? context_.read<step::RepresentationRecord>(*representation) : std::nullopt;
    if (!rep) return;
    const Units& units = context_.units_of(context_.find(rep->context));
    for (const Ref ref : rep->items) {
      const Record* item = context_.find(ref);
      if (!item) continue;
      if (context_.is(*item, Entity::CartesianPoint)) {
        if (is_centre_of_volume(*item)) compare_centroid(*item, *mass, units);
      } else if (context_.is(*item, Entity::MeasureRepresentationItem)) {
        const auto m = context_.read<step::MeasureRecord>(*item);
        if (m) compare(*item, *m, rep->name, *mass, units);
      }
    }
  }

  // Points of curves, of surfaces, of free points, and corners of boxes are told apart by their names (practice 4.6).
  bool is_centre_of_volume(const Record& point) {
    step::Tape tape;
    step::Reader r(context_.file, point, context_.execution.limits, tape, context_.report);
    if (!r.at(Entity::RepresentationItem, true)) return false;
    const std::string name = r.text(0);
    for (const char* other : {"curve", "surface", "points", "bounding", "corner", "facet", "vertex", "edge"})
      if (name.find(other) != std::string::npos) return false;
    return true;
  }

  void compare(const Record& item, const step::MeasureRecord& m, const std::string& name, const PartMass& ours, const Units& units) {
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
    if (is_volume && !ours.has_solid) return;
    const double stated = m.value.number * factor, found = is_volume ? ours.volume_mm3 : ours.area_mm2;
    // A tenth of a percent is told, a percent is an error (recommended practice 4.6).
    const double off = std::abs(stated - found) / std::max(std::abs(found), 1e-300);
    if (!(off > 1e-3)) return;
    context_.add(item, is_volume ? sr::property_volume : sr::property_area, off > 1e-2 || !ours.complete ? Severity::Error : Severity::Warning,
                 fmt::format("the file states {:.9g}, the shape has {:.9g}: {:.3g} % apart", stated, found, 100 * off), stated, found);
  }

  void compare_centroid(const Record& item, const PartMass& ours, const Units& units) {
    if (!ours.has_solid || !(ours.volume_mm3 > 0)) return;
    Geometry geometry(context_, units);
    const auto stated = geometry.point(item);
    if (!stated) return;
    const Point found = to_point(ours.moment_mm4 / ours.volume_mm3);
    const double off = distance(*stated, found), allowed = 0.01 * ours.box.diagonal();
    if (!(off > allowed)) return;
    Diagnostic& d = context_.add(item, sr::property_centroid, "the stated centroid is not that of the shape", off, allowed);
    d.at = {found.x, found.y, found.z};
  }

  Context& context_;
  const Model& model_;
  const std::unordered_map<std::size_t, std::uint32_t>& part_of_;
  PartMasses masses_;
  std::unordered_map<std::uint64_t, const Body*> bodies_;                        // by their numbers in the file
  std::unordered_map<std::uint64_t, std::pair<const Body*, FaceId>> faces_;
  std::unordered_map<std::size_t, std::vector<std::uint64_t>> items_;            // of aspects
};

}  // namespace

void check_properties(Context& context, const Model& model, const std::unordered_map<std::size_t, std::uint32_t>& part_of) {
  PropertyCheck(context, model, part_of).run();
}

}  // namespace trimloop::io::step_import
