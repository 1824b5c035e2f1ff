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

}  // namespace

Attributes own_attributes(Context& context, const DirectoryEntry& entry) {
  Attributes out;
  out.name = name_of_properties(context, entry);
  out.colour = colour(context, entry);
  out.layer = layer(context, entry);
  out.visible = entry.status.blank == 0;
  return out;
}

Attributes under(const Attributes& owner, const DirectoryEntry& owner_entry, Attributes own) {
  const bool owner_decides = owner_entry.status.hierarchy == 0;
  if (owner.colour && (owner_decides || !own.colour)) own.colour = owner.colour;
  if (owner.layer != 0 && (owner_decides || own.layer == 0)) own.layer = owner.layer;
  // What is inside something hidden is not seen, whatever it says of itself.
  own.visible = own.visible && owner.visible;
  return own;
}

}  // namespace trimloop::io::iges_import
