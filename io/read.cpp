#include <fmt/format.h>

#include <chrono>
#include <cstring>

#include "base/bytes.h"
#include "formats/font/outline.h"
#include "formats/iges/file.h"
#include "formats/step/container.h"
#include "formats/step/file.h"
#include "formats/svg/document.h"
#include "io/description/import.h"
#include "io/file.h"
#include "io/iges/import.h"
#include "io/step/import.h"
#include "io/step/pmi.h"
#include "io/io.h"
#include "io/names.h"
#include "io/file_rules.h"
#include "io/sew.h"

namespace trimloop::io {

std::string_view to_string(Format format) {
  switch (format) {
    case Format::Unknown: return "unknown";
    case Format::Iges: return "iges";
    case Format::Step: return "step";
    case Format::Stl: return "stl";
    case Format::Obj: return "obj";
    case Format::Ply: return "ply";
    case Format::Glb: return "glb";
    case Format::Json: return "json";
    case Format::Svg: return "svg";
    case Format::Csv: return "csv";
    case Format::Font: return "font";
  }
  return "unknown";
}

std::optional<Format> format_from_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  if (extension == ".igs" || extension == ".iges") return Format::Iges;
  if (extension == ".stp" || extension == ".step") return Format::Step;
  if (extension == ".stl") return Format::Stl;
  if (extension == ".obj") return Format::Obj;
  if (extension == ".ply") return Format::Ply;
  if (extension == ".glb") return Format::Glb;
  if (extension == ".json") return Format::Json;
  if (extension == ".svg") return Format::Svg;
  if (extension == ".csv" || extension == ".xyz" || extension == ".txt") return Format::Csv;
  if (extension == ".ttf" || extension == ".otf" || extension == ".pfb") return Format::Font;
  return std::nullopt;
}

Format sniff(std::string_view first_bytes) {
  if (step::container_of(first_bytes) != step::Container::None) return Format::Step;
  if (first_bytes.substr(0, 4) == "glTF") return Format::Glb;
  if (first_bytes.substr(0, 4) == "ply\n" || first_bytes.substr(0, 5) == "ply\r\n") return Format::Ply;
  if (step::sniff(first_bytes)) return Format::Step;
  if (iges::sniff(first_bytes) != iges::Sniff::No) return Format::Iges;
  if (svg::sniff(first_bytes)) return Format::Svg;
  if (font::sniff(first_bytes)) return Format::Font;
  return Format::Unknown;
}

std::string source_name(Format format, const SourceRef& ref) {
  if (format == Format::Step) return fmt::format("#{}", ref.id);
  return fmt::format("D{}", ref.id);
}

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::string unit_text(const iges::Global& global, const Model& model) {
  if (global.unit_flag == 3 && !global.unit_name.empty()) return global.unit_name;
  return std::string(to_string(model.source_unit));
}

void describe_iges(const iges::File& file, SourceInfo& source) {
  const iges::Global& global = file.global();
  source.version = iges::version_name(global.version_flag);
  source.sender = global.native_system.empty() ? global.preprocessor : global.native_system;
  source.date = global.date;
  for (const iges::DirectoryEntry& entry : file.directory()) {
    ++source.entities[fmt::format("{}:{}", entry.type, entry.form)];
  }
}

void report_names(ReadResult& result) {
  for (const HostileName& name : hostile_names(result.model)) {
    Diagnostic& d = result.report.add(name_rules::hostile_name, fmt::format("a text with {}: \"{}\"", name.part, printable(name.text, 80)));
    if (name.source.empty()) continue;
    d.entity = source_name(result.source.format, name.source.front());
    const std::uint64_t id = name.source.front().id;
    if (!result.source.iges || id > 0x7fffffff) continue;
    if (const iges::DirectoryEntry* entry = result.source.iges->find(iges::Ref{static_cast<std::int32_t>(id)}))
      d.location = result.source.iges->locate(entry->offset), d.type = fmt::format("{}:{}", entry->type, entry->form);
  }
}

void read_iges(std::string bytes, const ReadOptions& options, ReadResult& result) {
  const auto start = Clock::now();
  auto file = std::make_shared<iges::File>(iges::File::parse(std::move(bytes), options.execution.limits, result.report));
  describe_iges(*file, result.source);
  result.timings.read_ms += milliseconds_since(start);
  if (!result.report.has_fatal()) {
    const auto import_start = Clock::now();
    result.model = iges_import::import(*file, options.execution, options.assume_unit, result.report, options.measure_findings, options.resolve);
    result.source.unit = unit_text(file->global(), result.model);
    result.timings.import_ms = milliseconds_since(import_start);
  }
  result.source.iges = std::move(file);
  report_names(result);
}

void describe_step(const step::File& file, SourceInfo& source) {
  const step::Header& header = file.header();
  source.version = step::protocol_of(header.schemas);
  if (source.version.empty() && !header.schemas.empty()) source.version = header.schemas.front();
  source.sender = header.originating_system.empty() ? header.preprocessor : header.originating_system;
  source.date = header.time_stamp;
  for (const step::Keyword& k : file.keywords())
    if (k.count) {
      source.entities[k.name] += k.count;
      if (const std::string_view kind = pmi_kind(k.name); !kind.empty()) source.pmi[std::string(kind)] += k.count;
    }
}

void read_step(std::string bytes, const ReadOptions& options, ReadResult& result) {
  const auto start = Clock::now();
  auto file = std::make_shared<step::File>(step::File::parse(std::move(bytes), options.execution.limits, result.report));
  describe_step(*file, result.source);
  result.timings.read_ms += milliseconds_since(start);
  if (!result.report.has_fatal()) {
    const auto import_start = Clock::now();
    result.model = step_import::import(*file, options.execution, options.assume_unit, result.report);
    result.source.unit = std::string(to_string(result.model.source_unit));
    result.timings.import_ms = milliseconds_since(import_start);
  }
  report_names(result);
  if (!result.report.items().empty()) file->locate(result.report);
  result.source.step = std::move(file);
}

bool is_description(Format format) {
  return format == Format::Json || format == Format::Svg || format == Format::Csv || format == Format::Obj || format == Format::Font;
}

void read_description(std::string_view bytes, const ReadOptions& options, ReadResult& result) {
  const auto start = Clock::now();
  const Execution& execution = options.execution;
  switch (result.source.format) {
    case Format::Json: result.model = description::read_json(bytes, execution, result.report); break;
    case Format::Svg: result.model = description::read_svg(bytes, execution, result.report); break;
    case Format::Csv: result.model = description::read_csv(bytes, execution, result.report); break;
    case Format::Obj: result.model = description::read_obj(bytes, options.tolerance_mm, execution, result.report); break;
    default: result.model = description::read_font(bytes, options.font_text, options.em_mm, result.report); break;
  }
  if (result.report.has_fatal()) result.model = {};
  result.timings.import_ms = milliseconds_since(start);
  result.source.unit = "mm";
  for (const Part& part : result.model.parts) {
    if (!part.curves.empty()) result.source.entities["curve"] += part.curves.size();
    if (!part.points.empty()) result.source.entities["point"] += part.points.size();
    for (const Body& body : part.bodies) result.source.entities["surface"] += body.faces.size();
  }
}

// Ten times the file's resolution; but of a tiny part a resolution of its sender's habit may be a good share, and edges
// and fillets would be sewn shut: no more than a ten-thousandth of the extent of the part's own vertices.
double automatic_gap(const Model& model) {
  constexpr double resolutions = 10, share = 1e-4;
  double gap = resolutions * model.resolution_mm;
  for (const Part& part : model.parts) {
    Box box;
    for (const Body& body : part.bodies)
      for (const Vertex& v : body.vertices)
        if (is_finite(v.point)) box.add(v.point);
    if (box.diagonal() > 0) gap = std::min(gap, share * box.diagonal());
  }
  return gap;
}

// A drawing of notes and views is a file one can work with, even where nothing in it is a shape: its census is told, its
// bytes go back. Only a file without a single readable entity is of no use.
bool has_entities(const SourceInfo& source) {
  if (source.step) return !source.step->instances().empty();
  if (is_description(source.format)) return !source.entities.empty();
  if (!source.iges) return false;
  for (const iges::DirectoryEntry& entry : source.iges->directory()) {
    if (entry.usable) return true;
  }
  return false;
}

}  // namespace

ReadResult read_bytes(std::string bytes, std::string name, const ReadOptions& options) {
  ReadResult result;
  result.source.name = name;
  result.source.bytes = bytes.size();
  constexpr std::size_t looked_at = std::size_t{1} << 16;
  if (step::container_of(bytes) != step::Container::None && bytes.size() <= options.execution.limits.file_bytes) {
    result.source.packed = std::make_shared<const std::string>(std::move(bytes));
    auto unpacked = step::unpack(*result.source.packed, options.execution.limits, result.report);
    if (!unpacked) {
      result.source.format = Format::Step;
      return result;
    }
    bytes = std::move(*unpacked);
  }
  const std::string_view head = std::string_view(bytes).substr(0, looked_at);
  Format format = sniff(head);
  // Content decides; the extension only breaks the tie when the content says nothing, and then its reader says why.
  if (format == Format::Unknown) format = format_from_extension(name).value_or(Format::Unknown);
  result.source.format = format;

  if (bytes.size() > options.execution.limits.file_bytes) {
    Diagnostic& d = result.report.add(file_rules::size, fmt::format("{} bytes are more than the limit", bytes.size()));
    d.measured = static_cast<double>(bytes.size());
    d.limit = static_cast<double>(options.execution.limits.file_bytes);
    result.limit_reached = true;
    return result;
  }
  if (format == Format::Iges) {
    read_iges(std::move(bytes), options, result);
  } else if (format == Format::Step) {
    read_step(std::move(bytes), options, result);
  } else if (is_description(format)) {
    read_description(bytes, options, result);
  } else {
    result.report.add(file_rules::format,
                      format == Format::Unknown
                          ? std::string("no format that this version reads is recognised in the content")
                          : fmt::format("this is a {} file; this version reads iges and step", to_string(format)));
  }
  if (options.sew && !result.report.has_fatal() && !options.execution.stop.stop_requested()) {
    const auto start = Clock::now();
    sew(result.model, format, options.sew_mm.value_or(automatic_gap(result.model)), options.measure_findings, options.execution.stop,
        result.report);
    result.timings.sew_ms = milliseconds_since(start);
  }
  if (options.execution.stop.stop_requested()) {
    result.model = {};
    result.limit_reached = true;
  }
  result.usable = !result.report.has_fatal() && !result.limit_reached && has_entities(result.source);
  if (!result.usable && !result.report.has_fatal() && !result.limit_reached) {
    result.report.add(file_rules::nothing_usable, "the file can be opened but holds no entity that can be read");
  }
  if (result.model.name.empty()) result.model.name = std::filesystem::path(name).stem().string();
  return result;
}

ReadResult read(const std::filesystem::path& path, const ReadOptions& options) {
  const auto start = Clock::now();
  auto bytes = load(path, options.execution.limits.file_bytes);
  if (!bytes) {
    ReadResult result;
    result.source.name = path.filename().string();
    const bool limit = bytes.error().code == ErrorCode::Limit;
    Diagnostic& d = result.report.add(limit ? file_rules::size : file_rules::cannot_read, bytes.error().text);
    d.measured = bytes.error().measured;
    d.limit = bytes.error().limit;
    result.limit_reached = limit;
    result.io_failed = !limit;
    return result;
  }
  const double load_ms = milliseconds_since(start);
  ReadResult result = read_bytes(std::move(*bytes), path.filename().string(), options);
  result.timings.read_ms += load_ms;
  return result;
}

}  // namespace trimloop::io
