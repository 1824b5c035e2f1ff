#include <fmt/format.h>

#include "io/description/import.h"
#include "io/description/rules.h"
#include "io/description/shapes.h"

namespace trimloop::io::description {

namespace {

void add_shape(Builder& builder, Fields& f, double unit_mm, Report& report) {
  const std::string type = f.text_or("type", ""), name = f.text_or("name", "");
  double bound = 0;
  if (is_curve(type)) {
    auto shape = curve_shape(type, f);
    f.finish();
    if (!shape || !f.good()) return;
    bound = shape->bound_mm * unit_mm;
    auto placed = unit_mm == 1 ? Result<Curve>(std::move(shape->curve)) : transformed(shape->curve, Transform::scale(unit_mm));
    if (!placed) return f.impossible(placed.error());
    builder.add(std::move(*placed), name);
  } else if (is_surface(type)) {
    auto shape = surface_shape(type, f);
    f.finish();
    if (!shape || !f.good()) return;
    bound = shape->bound_mm * unit_mm;
    if (shape->joint_angle_rad) {
      Diagnostic& d = report.add(description_rules::joints, fmt::format("{}: the normals of neighbouring patches differ by at most {:.3g} rad",
                                                                        f.path(), *shape->joint_angle_rad));
      d.entity = f.path();
      d.measured = *shape->joint_angle_rad;
    }
    if (unit_mm != 1)
      for (NurbsSurface& s : shape->patches) s = transformed(s, Transform::scale(unit_mm));
    builder.add(std::move(shape->patches), name);
  } else {
    f.wrong("type", type.empty() ? "the shape's type is missing" : fmt::format("\"{}\" is no shape that can be described", type));
    return;
  }
  if (bound > 0) {
    Diagnostic& d = report.add(description_rules::bound, fmt::format("{}: {} is within {:.3g} mm", f.path(), type, bound));
    d.entity = f.path();
    d.measured = bound;
  }
}

}  // namespace

// { "name", "unit": "mm", "shapes": [ ... ] }, or one shape by itself.
Model read_json(std::string_view text, const Execution& execution, Report& report) {
  const auto value = json::parse(text, execution.limits);
  if (!value) {
    Diagnostic& d = report.add(description_rules::text, value.error().text);
    if (value.error().code == ErrorCode::InvalidArgument && value.error().measured >= 0)
      d.location.offset = static_cast<std::size_t>(value.error().measured);
    return {};
  }
  Builder builder;
  Fields root(*value, "$", report);
  double unit_mm = 1;
  std::string name;
  if (root.good() && root.has("shapes")) {
    const std::string unit = root.text_or("unit", "mm");
    const auto known = unit_from_name(unit);
    if (!known) root.wrong("unit", fmt::format("\"{}\" is no unit of length", unit));
    else unit_mm = millimetres_per(*known);
    name = root.text_or("name", "");
    for (Fields& shape : root.objects("shapes", 1)) add_shape(builder, shape, unit_mm, report);
    root.finish();
  } else if (root.good()) {
    add_shape(builder, root, unit_mm, report);
  }
  if (report.has_fatal()) return {};
  return builder.finish(name);
}

}  // namespace trimloop::io::description
