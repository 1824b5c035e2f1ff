// Drawings, tables, control meshes and fonts.
#include <fmt/format.h>

#include "formats/csv/table.h"
#include "formats/font/outline.h"
#include "formats/obj/read.h"
#include "formats/svg/document.h"
#include "io/description/builder.h"
#include "io/description/import.h"
#include "io/description/rules.h"
#include "io/outlines.h"

namespace trimloop::io::description {

namespace rules = description_rules;

namespace {

// The drawing's y runs down; a model's runs up.
Transform upright(const svg::Matrix& m, double unit_mm) {
  Transform t;
  t.r = {{{unit_mm * m[0], unit_mm * m[2], 0}, {-unit_mm * m[1], -unit_mm * m[3], 0}, {0, 0, 1}}};
  t.t = {unit_mm * m[4], -unit_mm * m[5], 0};
  return t;
}

// A glyph's outline as path segments, which it is but for arcs.
std::vector<svg::Segment> path_of(const std::vector<font::Segment>& outline) {
  using From = font::Segment::Kind;
  using To = svg::Segment::Kind;
  std::vector<svg::Segment> path;
  for (const font::Segment& s : outline) {
    svg::Segment out;
    out.kind = s.kind == From::Move ? To::Move : s.kind == From::Line ? To::Line : s.kind == From::Quad ? To::Quad : s.kind == From::Cubic ? To::Cubic : To::Close;
    out.at = s.at;
    path.push_back(out);
  }
  return path;
}

Diagnostic& at_offset(Report& report, const Rule& rule, std::string text, std::size_t offset) {
  Diagnostic& d = report.add(rule, std::move(text));
  d.location.offset = offset;
  return d;
}

}  // namespace

Model read_svg(std::string_view text, const Execution& execution, Report& report) {
  Builder builder;
  const auto drawing = svg::parse(text, execution.limits);
  if (!drawing) {
    at_offset(report, rules::drawing, drawing.error().text, static_cast<std::size_t>(std::max(0.0, drawing.error().measured)));
    return builder.finish({});
  }
  for (const svg::Fault& fault : drawing->faults)
    at_offset(report, rules::drawing_element, fmt::format("<{}>: {}", fault.element, fault.text), fault.offset).type = fault.element;
  for (const auto& [element, count] : drawing->left_out)
    report.add(rules::drawing_left_out, fmt::format("{} <{}> left out", count, element)).type = element;
  for (const svg::Outline& outline : drawing->outlines) {
    auto curves = curves_of(outline.path, upright(outline.matrix, drawing->user_unit_mm));
    if (!curves) {
      at_offset(report, rules::drawing_element, fmt::format("<{}>: {}", outline.element, curves.error().text), outline.offset).type = outline.element;
      continue;
    }
    for (Curve& c : *curves) builder.add(std::move(c), outline.id);
  }
  return builder.finish({});
}

Model read_csv(std::string_view text, const Execution& execution, Report& report) {
  Builder builder;
  const auto blocks = csv::parse(text, execution.limits);
  if (!blocks) {
    Diagnostic& d = report.add(rules::table, blocks.error().text);
    if (blocks.error().code == ErrorCode::InvalidArgument) d.location.line = static_cast<std::size_t>(blocks.error().measured);
    return builder.finish({});
  }
  for (const csv::Block& block : *blocks) {
    if (block.columns < 2 || block.columns > 3) {
      Diagnostic& d = report.add(rules::table, fmt::format("rows of {} numbers are no points", block.columns));
      d.location.line = block.line;
      d.measured = static_cast<double>(block.columns);
      d.limit = 3;
      return Builder().finish({});
    }
    Polyline line;
    for (std::size_t i = 0; i < block.rows(); ++i) {
      const double* row = block.values.data() + i * block.columns;
      line.points.push_back({row[0], row[1], block.columns == 3 ? row[2] : 0});
    }
    if (line.points.size() == 1) builder.add(line.points[0], {});
    else builder.add(Curve{std::move(line)}, {});
  }
  return builder.finish({});
}

Model read_obj(std::string_view text, double tolerance_mm, const Execution& execution, Report& report) {
  Builder builder;
  const auto refuse = [&](const Error& error) {
    Diagnostic& d = report.add(rules::mesh, error.text);
    d.measured = error.measured;
    d.limit = error.limit;
    return Builder().finish({});
  };
  const auto polygons = obj::read(text, execution.limits);
  if (!polygons) return refuse(polygons.error());
  subdivision::ControlMesh mesh;
  for (const auto& p : polygons->positions) mesh.points.push_back({p[0], p[1], p[2]});
  mesh.corners = polygons->corners;
  mesh.face_start = polygons->face_start;
  for (const auto& l : polygons->lines) mesh.creases.push_back({l[0], l[1], infinity});
  subdivision::LimitOptions options;
  options.tolerance = tolerance_mm;
  auto limit = subdivision::catmull_clark_limit(mesh, options);
  if (!limit) return refuse(limit.error());
  std::vector<NurbsSurface> patches;
  for (subdivision::LimitPatch& p : limit->patches) patches.push_back(std::move(p.surface));
  if (!patches.empty()) builder.add(std::move(patches), {});
  if (limit->caps > 0) {
    Diagnostic& d = report.add(rules::bound, fmt::format("{} patches are exact, {} caps around irregular vertices are within {:.3g} mm",
                                                         limit->exact, limit->caps, limit->bound));
    d.measured = limit->bound;
    d.limit = tolerance_mm;
  }
  return builder.finish({});
}

Model read_font(std::string_view bytes, std::string_view text, double em_mm, Report& report) {
  Builder builder;
  const auto line = font::outline(bytes, text);
  if (!line) {
    report.add(rules::font, line.error().text);
    return builder.finish({});
  }
  for (const char32_t c : line->missing) report.add(rules::glyph, fmt::format("no glyph for U+{:04X}", static_cast<unsigned>(c)));
  Transform scale = Transform::scale(em_mm / line->units_per_em);
  auto curves = curves_of(path_of(line->path), scale);
  if (curves)
    for (Curve& c : *curves) builder.add(std::move(c), std::string(text));
  else report.add(rules::font, curves.error().text);
  return builder.finish({});
}

}  // namespace trimloop::io::description
