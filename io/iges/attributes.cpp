#include "io/iges/attributes.h"

#include "base/number.h"
#include "formats/iges/records/structure.h"

namespace trimloop::io::iges_import {
namespace {

std::string name_of_properties(Context& context, const DirectoryEntry& entry) {
  for (const Ref ref : context.groups(entry).properties) {
    const DirectoryEntry* e = ref ? context.file.find(ref) : nullptr;
    if (!e || e->type != iges::Property::type || e->form != 15) continue;
    if (const auto* property = context.record<iges::Property>(*e); property && !property->name.empty())
      return property->name;
  }
  return {};
}

std::optional<Colour> colour(Context& context, const DirectoryEntry& entry) {
  switch (entry.colour) {  // IGES 5.3 2.2.4.4.13
    case 1: return Colour{0, 0, 0};
    case 2: return Colour{1, 0, 0};
    case 3: return Colour{0, 1, 0};
    case 4: return Colour{0, 0, 1};
    case 5: return Colour{1, 1, 0};
    case 6: return Colour{1, 0, 1};
    case 7: return Colour{0, 1, 1};
    case 8: return Colour{1, 1, 1};
    default: break;
  }
  if (entry.colour >= 0) return std::nullopt;
  const DirectoryEntry* e = context.file.find(Ref{-entry.colour});
  const auto* record = e ? context.record<iges::ColourDefinition>(*e) : nullptr;
  if (!record) return std::nullopt;
  const auto share = [](double percent) { return percent >= 0 ? std::min(percent / 100, 1.0) : 0.0; };
  return Colour{share(record->red), share(record->green), share(record->blue)};
}

int layer(Context& context, const DirectoryEntry& entry) {
  if (entry.level >= 0) return entry.level;
  // A list of levels (406 form 1): the first one stands for all.
  const DirectoryEntry* e = context.file.find(Ref{-entry.level});
  const auto* list = e && e->form == 1 ? context.record<iges::Property>(*e) : nullptr;
  if (!list || list->raw.empty()) return 0;
  const auto first = read_integer(list->raw.front().text);
  return first && first.value >= 0 && first.value <= std::numeric_limits<int>::max() ? static_cast<int>(first.value) : 0;
}

// A pattern of its own (304) has a nearest standard font in its own directory entry.
int line_font(Context& context, const DirectoryEntry& entry) {
  if (entry.line_font >= 0) return entry.line_font <= 5 ? entry.line_font : 0;
  const DirectoryEntry* e = context.file.find(Ref{-entry.line_font});
  return e && e->type == 304 && e->line_font > 0 && e->line_font <= 5 ? e->line_font : 1;
}

// Weight numbers count in steps of the largest width (Global 16 and 17).
double line_weight_mm(Context& context, const DirectoryEntry& entry) {
  const iges::Global& g = context.file.global();
  if (entry.line_weight <= 0 || g.weight_gradations <= 0 || !(g.max_line_width > 0)) return 0;
  return entry.line_weight * g.max_line_width / g.weight_gradations * context.unit.scale * g.model_scale;
}

}  // namespace

Attributes own_attributes(Context& context, const DirectoryEntry& entry) {
  Attributes out;
  out.name = name_of_properties(context, entry);
  out.colour = colour(context, entry);
  out.layer = layer(context, entry);
  out.visible = entry.status.blank == 0;
  out.line_font = line_font(context, entry);
  out.line_weight_mm = line_weight_mm(context, entry);
  return out;
}

Attributes under(const Attributes& owner, const DirectoryEntry& owner_entry, Attributes own) {
  const bool owner_decides = owner_entry.status.hierarchy == 0;
  if (owner.colour && (owner_decides || !own.colour)) own.colour = owner.colour;
  if (owner.layer != 0 && (owner_decides || own.layer == 0)) own.layer = owner.layer;
  if (owner.line_font != 0 && (owner_decides || own.line_font == 0)) own.line_font = owner.line_font;
  if (owner.line_weight_mm > 0 && (owner_decides || own.line_weight_mm == 0)) own.line_weight_mm = owner.line_weight_mm;
  // What is inside something hidden is not seen, whatever it says of itself.
  own.visible = own.visible && owner.visible;
  return own;
}

// 406 form 3 tells what the level of its own entry is for.
std::vector<std::string> layer_names(Context& context) {
  constexpr int level_function = 3, most = 65'535;  // levels beyond keep their number only
  std::vector<std::string> out;
  for (const DirectoryEntry& entry : context.file.directory()) {
    const bool names_level = entry.type == iges::Property::type && entry.form == level_function && entry.usable;
    if (!names_level || entry.level < 1 || entry.level > most) continue;
    const auto* record = context.record<iges::Property>(entry);
    if (!record || record->raw.size() < 2 || record->raw[1].text.empty()) continue;
    const auto at = static_cast<std::size_t>(entry.level - 1);
    if (out.size() <= at) out.resize(at + 1);
    if (out[at].empty()) out[at] = record->raw[1].text;
  }
  return out;
}

}  // namespace trimloop::io::iges_import
