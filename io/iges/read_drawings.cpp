#include <unordered_map>

#include "base/number.h"
#include "formats/iges/records/structure.h"
#include "formats/iges/rules.h"
#include "io/iges/annotation.h"
#include "io/iges/attributes.h"
#include "io/iges/placement.h"

namespace trimloop::io::iges_import {
namespace {

// The property of `form` among those of an entity whose record has been read.
const iges::Property* property(Context& context, const DirectoryEntry& entry, int form) {
  for (const Ref ref : context.groups(entry).properties) {
    const DirectoryEntry* e = ref ? context.file.find(ref) : nullptr;
    if (e && e->type == iges::Property::type && e->form == form) return context.record<iges::Property>(*e);
  }
  return nullptr;
}

View view_of(Context& context, const DirectoryEntry& entry, const iges::TableRecord& record) {
  View view;
  view.number = static_cast<int>(record.integer("VNO"));
  view.scale = record.real("SCALE");
  view.name = own_attributes(context, entry).name;
  view.from_model = model_placement(context, entry);
  view.source.push_back(source_of(entry));
  return view;
}

// Sizes are in drawing units (406 form 17), those of the file when none are stated.
void add_size(Context& context, const DirectoryEntry& entry, Drawing& drawing) {
  constexpr int drawing_size = 16, drawing_units = 17;
  const iges::Property* size = property(context, entry, drawing_size);
  if (!size || size->raw.size() < 2) return;
  double mm = context.unit.scale;
  if (const iges::Property* units = property(context, entry, drawing_units); units && !units->raw.empty()) {
    iges::Global global;
    global.unit_flag = static_cast<int>(read_integer(units->raw[0].text).value);
    if (units->raw.size() > 1) global.unit_name = units->raw[1].text;
    if (const FileUnit unit = file_unit(global, {}); unit.known) mm = unit.scale;
  }
  drawing.width_mm = read_real(size->raw[0].text).value * mm;
  drawing.height_mm = read_real(size->raw[1].text).value * mm;
}

}  // namespace

void read_drawings(Context& context, Model& model) {
  std::unordered_map<std::int32_t, std::uint32_t> views;  // 410 -> index
  for (const DirectoryEntry& entry : context.file.directory()) {
    const iges::TableRecord* record = entry.type == 410 && entry.usable ? context.table(entry) : nullptr;
    if (!record) continue;
    context.state(entry).consumed = true;
    views.emplace(entry.de, static_cast<std::uint32_t>(model.views.size()));
    model.views.push_back(view_of(context, entry, *record));
  }
  for (const DirectoryEntry& entry : context.file.directory()) {
    const iges::TableRecord* record = entry.type == 404 && entry.usable ? context.table(entry) : nullptr;
    if (!record) continue;
    context.state(entry).consumed = true;
    Drawing drawing;
    drawing.name = own_attributes(context, entry).name;
    drawing.source.push_back(source_of(entry));
    add_size(context, entry, drawing);
    const double mm = context.unit.scale;
    for (std::size_t i = 1, n = record->count("NV"); i <= n; ++i) {
      const auto view = views.find(record->ref("VPTR", {i}).de);
      if (view == views.end()) {
        context.add(entry, iges::rules::drawing_view, "view " + std::to_string(i) + " of the drawing is no view (410)");
        continue;
      }
      drawing.views.push_back({view->second, {record->real("XORG", {i}) * mm, record->real("YORG", {i}) * mm},
                               entry.form == 1 ? record->real("ANGLE", {i}) : 0});
    }
    for (std::size_t i = 1, n = record->count("M"); i <= n; ++i) {
      const DirectoryEntry* e = context.file.find(record->ref("DPTR", {i}));
      if (!e || !is_annotation(*e)) continue;
      Annotation annotation = read_annotation(context, *e);
      annotation.attributes = model.add(own_attributes(context, *e));
      drawing.annotation.push_back(std::move(annotation));
    }
    model.drawings.push_back(std::move(drawing));
  }
}

}  // namespace trimloop::io::iges_import
