#include "io/step/read_styles.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/number.h"
#include "formats/step/rules.h"
#include "io/rules.h"

namespace trimloop::io::step_import {
namespace {

namespace sr = step::rules;

// DRAUGHTING_PRE_DEFINED_COLOUR. ISO 10303-46 and -202.
std::optional<Colour> named_colour(std::string_view name) {
  constexpr std::pair<std::string_view, Colour> table[] = {
      {"red", {1, 0, 0}},  {"green", {0, 1, 0}},   {"blue", {0, 0, 1}},  {"yellow", {1, 1, 0}},
      {"magenta", {1, 0, 1}}, {"cyan", {0, 1, 1}}, {"black", {0, 0, 0}}, {"white", {1, 1, 1}}};
  for (const auto& [word, value] : table)
    if (word == name) return value;
  return std::nullopt;
}

}  // namespace

Styles::Styles(Context& context, Model& model) : context_(context) {
  for (const Record& i : context.file.instances()) {
    if (context.is(i, Entity::StyledItem) && !context.is(i, Entity::AnnotationOccurrence)) {
      read_style(i, context.is(i, Entity::OverRidingStyledItem));
    } else if (context.is(i, Entity::Invisibility)) {
      for (const Ref ref : context.references(i)) {
        const Record* item = context.find(ref);
        if (!item) continue;
        if (const Record* t = target(*item)) by_item_[context.index(*t)].visible = false;
      }
    } else if (context.is(i, Entity::PresentationLayerAssignment)) {
      const auto layer = context.read<step::Layer>(i);
      if (!layer) continue;
      const int number = model.layer_number(layer->name);
      for (const Ref ref : layer->items)
        if (const Record* item = context.find(ref))
          if (const Record* t = target(*item)) by_item_[context.index(*t)].layer = number;
    }
  }
}

// What a style, layer or invisibility is said of: an item; where a style holds in one place only, what places the item
// there. Null where that place is a path through several assemblies: said so where the style is read.
const Record* Styles::target(const Record& item) {
  if (!context_.is(item, Entity::StyledItem)) return &item;
  if (context_.is(item, Entity::ContextDependentOverRidingStyledItem)) {
    step::Tape tape;
    step::Reader r(context_.file, item, context_.execution.limits, tape, context_.report);
    if (!r.at(Entity::ContextDependentOverRidingStyledItem)) return nullptr;
    const std::vector<Ref> places = r.refs(0);
    const Record* place = places.size() == 1 ? context_.find(places.front()) : nullptr;
    const bool good = place && (context_.is(*place, Entity::RepresentationRelationship) || context_.is(*place, Entity::MappedItem));
    return good ? place : nullptr;
  }
  const auto s = context_.read<step::Styled>(item);
  return s ? context_.find(s->item) : nullptr;
}

void Styles::read_style(const Record& styled, bool overriding) {
  const auto r = context_.read<step::Styled>(styled);
  const Record* item = r ? target(styled) : nullptr;
  if (r && !item && context_.is(styled, Entity::ContextDependentOverRidingStyledItem))
    context_.add(styled, rules::ignored, "a style that holds in one place only, which is a path through several assemblies: it is left out");
  if (!item) return;
  std::optional<Colour> found;
  for (const bool surface : {true, false}) {
    for (const Ref ref : r->styles) {
      const Record* style = context_.find(ref);
      if (style && !found) found = colour_of(*style, 0, surface);
    }
  }
  if (!found) return;
  Own& own = by_item_[context_.index(*item)];
  if (own.colour && own.overriding && !overriding) return;
  own.colour = found;
  own.overriding = overriding;
}

// The first colour below a style, down the branch of surfaces or of curves and points.
std::optional<Colour> Styles::colour_of(const Record& style, int depth, bool surface) {
  if (context_.is(style, Entity::Colour) || context_.is(style, Entity::PreDefinedItem)) return colour(style);
  if (depth > 8) return std::nullopt;
  const bool of_curve = context_.is(style, Entity::CurveStyle) || context_.is(style, Entity::PointStyle);
  if (surface && of_curve) return std::nullopt;
  const std::size_t key = context_.index(style) * 2 + surface;
  if (const auto known = by_style_.find(key); known != by_style_.end()) return known->second;
  by_style_[key] = std::nullopt;  // also ends cycles
  std::optional<Colour> found;
  for (const Ref ref : context_.references(style)) {
    const Record* next = context_.find(ref);
    if (!next || context_.is(*next, Entity::Representation) || context_.is(*next, Entity::RepresentationItem)) continue;
    found = colour_of(*next, depth + 1, surface);
    if (found) break;
  }
  by_style_[key] = found;
  return found;
}

std::optional<Colour> Styles::colour(const Record& instance) {
  if (context_.is(instance, Entity::ColourRgb)) {
    const auto c = context_.read<step::Rgb>(instance);
    if (!c) return std::nullopt;
    // Some senders write 0 to 255.
    const double scale = std::max({c->r, c->g, c->b}) > 1.0 + 1e-6 ? 255.0 : 1.0;
    const auto clamp = [&](double v) { return std::clamp(v / scale, 0.0, 1.0); };
    return Colour{clamp(c->r), clamp(c->g), clamp(c->b)};
  }
  if (!context_.is(instance, Entity::PreDefinedItem)) return std::nullopt;
  step::Tape tape;
  step::Reader r(context_.file, instance, context_.execution.limits, tape, context_.report);
  return r.at(Entity::PreDefinedItem) ? named_colour(r.text(0)) : std::nullopt;
}

Attributes Styles::of(const Record& instance) const {
  Attributes out;
  const auto own = by_item_.find(context_.index(instance));
  if (own == by_item_.end()) return out;
  out.colour = own->second.colour;
  out.layer = own->second.layer;
  out.visible = own->second.visible;
  return out;
}

Attributes under(const Attributes& owner, Attributes own) {
  if (!own.colour) own.colour = owner.colour;
  if (own.layer == 0) own.layer = owner.layer;
  own.visible = own.visible && owner.visible;
  return own;
}

}  // namespace trimloop::io::step_import
