#include "io/step/styles.h"

#include <fmt/format.h>

namespace trimloop::io::step_export {

using step::Enumeration;
using step::Measure;

InstanceId StyleWriter::style(const Colour& c, Styled kind) {
  step::Writer& out = w_.out;
  const InstanceId colour = out.add_shared("COLOUR_RGB", "", c.r, c.g, c.b);
  if (kind == Styled::Surface) {
    const InstanceId fill_colour = out.add_shared("FILL_AREA_STYLE_COLOUR", "", colour);
    const InstanceId fill = out.add_shared("FILL_AREA_STYLE", "", std::array{fill_colour});
    const InstanceId area = out.add_shared("SURFACE_STYLE_FILL_AREA", fill);
    const InstanceId side = out.add_shared("SURFACE_SIDE_STYLE", "", std::array{area});
    const InstanceId usage = out.add_shared("SURFACE_STYLE_USAGE", Enumeration{"BOTH"}, side);
    return out.add_shared("PRESENTATION_STYLE_ASSIGNMENT", std::array{usage});
  }
  if (kind == Styled::Curve) {
    const InstanceId font = out.add_shared("DRAUGHTING_PRE_DEFINED_CURVE_FONT", "continuous");
    const InstanceId style = out.add_shared("CURVE_STYLE", "", font, Measure{"POSITIVE_LENGTH_MEASURE", 0.1}, colour);
    return out.add_shared("PRESENTATION_STYLE_ASSIGNMENT", std::array{style});
  }
  const InstanceId marker = out.add_shared("POINT_STYLE", "", step::TypedEnumeration{"MARKER_TYPE", "DOT"},
                                           Measure{"POSITIVE_LENGTH_MEASURE", 0.1}, colour);
  return out.add_shared("PRESENTATION_STYLE_ASSIGNMENT", std::array{marker});
}

InstanceId StyleWriter::style_of(const Attributes& a, Styled kind) {
  return a.colour ? style(*a.colour, kind)
                  : w_.out.add_shared("PRESENTATION_STYLE_ASSIGNMENT", std::array{step::TypedEnumeration{"NULL_STYLE", "NULL"}});
}

void StyleWriter::add(InstanceId item, AttributesId attributes, Styled kind) {
  if (!item || !attributes) return;
  const Attributes& a = w_.model[attributes];
  if (a.layer != 0) layers_[a.layer].push_back(item);
  if (!a.colour && a.visible) return;
  const InstanceId assigned = style_of(a, kind);
  styled_.push_back(w_.out.add("STYLED_ITEM", "color", std::array{assigned}, item));
  base_.try_emplace(item.number, styled_.back());
  if (!a.visible) invisible_.push_back(styled_.back());
}

// ISO 10303-46: the style of an item in a context overrides one that it has everywhere, if only that of nothing said.
void StyleWriter::add_at(InstanceId relation, InstanceId item, AttributesId attributes, Styled kind) {
  const Attributes& a = w_.model[attributes];
  InstanceId& base = base_[item.number];
  if (!base) {
    const InstanceId nothing = style_of({}, kind);
    base = w_.out.add("STYLED_ITEM", "", std::array{nothing}, item);
    styled_.push_back(base);
  }
  const InstanceId assigned = style_of(a, kind);
  overriding_.push_back(w_.out.add("CONTEXT_DEPENDENT_OVER_RIDING_STYLED_ITEM", "", std::array{assigned}, item, base, std::array{relation}));
  if (a.layer != 0) layers_[a.layer].push_back(overriding_.back());
  if (!a.visible) invisible_.push_back(overriding_.back());
}

void StyleWriter::finish(InstanceId geometric_context) {
  if (!styled_.empty()) {
    w_.out.add("MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION", "", styled_, geometric_context);
  }
  // Apart from the others: OpenCASCADE 7.6 takes one that stands among them for the style of its item everywhere.
  if (!overriding_.empty()) w_.out.add("REPRESENTATION", "styles of occurrences", overriding_, geometric_context);
  if (!invisible_.empty()) w_.out.add("INVISIBILITY", invisible_);
  for (const auto& [layer, items] : layers_) {
    const auto at = static_cast<std::size_t>(layer) - 1;
    const auto& names = w_.model.layer_names;
    const bool named = layer > 0 && at < names.size() && !names[at].empty();
    w_.out.add("PRESENTATION_LAYER_ASSIGNMENT", named ? names[at] : fmt::format("{}", layer), "", items);
  }
}

}  // namespace trimloop::io::step_export
