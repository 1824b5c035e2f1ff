// trimloop convert and nurbs: any readable format to any writable one.

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "base/bytes.h"
#include "cli/nurbs_schema.h"
#include "cli/terminal.h"

namespace trimloop::cli {

namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

std::string_view to_word(FaceStatus status) {
  return status == FaceStatus::Ok ? "ok" : status == FaceStatus::Healed ? "healed" : "failed";
}

ordered_json row_of(const io::NurbsEntity& e) {
  using Form = io::NurbsEntity::Form;
  ordered_json row{{"source", e.source},
                   {"shape", std::string(e.shape)},
                   {"form", e.form == Form::Exact ? "exact" : e.form == Form::Near ? "near" : "kept"},
                   {"deviation", e.deviation_mm}};
  if (e.form == Form::Kept) row["reason"] = e.reason;
  if (e.is_surface) row["edges"] = e.edges, row["edges_kept"] = e.edges_kept;
  return row;
}

// The entities that no rational spline is equal to, a line for each reason.
std::vector<std::string> kept_lines(const std::vector<io::NurbsEntity>& entities) {
  struct Kept {
    std::size_t count = 0;
    const io::NurbsEntity* first = nullptr;
  };
  std::map<std::pair<std::string_view, std::string>, Kept> kept;
  for (const io::NurbsEntity& e : entities) {
    if (e.form != io::NurbsEntity::Form::Kept) continue;
    Kept& k = kept[{e.shape, e.reason}];
    if (k.count++ == 0) k.first = &e;
  }
  std::vector<std::string> out;
  for (const auto& [what, k] : kept)
    out.push_back(fmt::format("{} {} kept as it is ({}{}): {}", k.count, what.first, k.count > 1 ? "first " : "",
                              k.first->source.empty() ? "unnamed" : k.first->source, printable(what.second, 200)));
  return out;
}

ordered_json report_json(const io::WriteResult& result, const io::ReadResult& in, bool is_mesh, bool timings) {
  ordered_json out;
  out["faces"] = ordered_json::array();
  for (const io::FaceReport& face : result.faces) {
    ordered_json row;
    row["id"] = face.id;
    row["source"] = face.source;
    row["status"] = to_word(face.status);
    row["reason"] = face.reason.empty() ? ordered_json(nullptr) : ordered_json(printable(face.reason, 1000));
    if (face.status == FaceStatus::Healed) {
      row["area_before"] = face.area_before_mm2 >= 0 ? ordered_json(face.area_before_mm2) : ordered_json(nullptr);
      row["area_after"] = face.area_mm2;
    }
    row["triangles"] = face.triangles;
    if (is_mesh) {
      row["bound"] = face.bound_mm;
      row["bound_kind"] = face.bound_kind == mesh::BoundKind::Proven ? "proven" : "sampled";
    }
    out["faces"].push_back(row);
  }
  out["triangles"] = result.triangles;
  out["vertices"] = result.vertices;
  out["open_edges"] = result.open_edges;
  out["deflection"] = result.deflection_mm;
  out["max_bound"] = result.max_bound_mm;
  if (is_mesh) out["coarsened"] = result.coarsened;
  if (!is_mesh) {
    out["nurbs"] = {{"exact_surfaces", result.nurbs.exact_surfaces}, {"exact_curves", result.nurbs.exact_curves},
                    {"approximated_pcurves", result.nurbs.approximated_pcurves},
                    {"max_deviation", result.nurbs.max_deviation_mm}};
    for (const io::NurbsEntity& e : result.nurbs.entities) out["nurbs"]["entities"].push_back(row_of(e));
    out["trimming"] = {{"lifted_curves", result.nurbs.lifted_curves},
                       {"max_lifted", result.nurbs.max_lifted_mm},
                       {"slivers_left_out", result.nurbs.slivers_left_out}};
  }
  out["loss"] = result.losses;
  if (timings) {
    out["milliseconds"] = {{"read", in.timings.read_ms}, {"import", in.timings.import_ms}, {"sew", in.timings.sew_ms},
                           {"mesh", result.timings.mesh_ms}, {"write", result.timings.write_ms}};
  }
  return out;
}

// "YYYYMMDD.HHNNSS" from --timestamp, SOURCE_DATE_EPOCH or the input, in that order; empty: the fixed null stamp.
std::string timestamp(const std::string& given, const io::SourceInfo& source) {
  if (!given.empty()) return given;
  if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH")) {
    const std::time_t seconds = std::strtoll(epoch, nullptr, 10);
    std::tm utc{};
    if (gmtime_r(&seconds, &utc)) {
      return fmt::format("{:04}{:02}{:02}.{:02}{:02}{:02}", utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday, utc.tm_hour,
                         utc.tm_min, utc.tm_sec);
    }
  }
  return source.date;
}

struct Job {
  std::string input, output;
  io::ReadOptions read;
  io::WriteOptions write;
  std::string report, stamp;
  bool strict = false;
};

bool is_mesh_format(io::Format format) {
  return format == io::Format::Stl || format == io::Format::Obj || format == io::Format::Ply || format == io::Format::Glb;
}

int convert_one(const Common& common, const Job& job) {
  if (!common.force && job.output != "-" && fs::exists(job.output)) {
    complain(common, fmt::format("{} exists", job.output), "the same command with --force");
    return CannotReadOrWrite;
  }
  io::ReadOptions read = job.read;
  read.measure_findings = !job.report.empty() || common.json;
  const io::ReadResult in = read_input(common, job.input, read);
  if (!in.usable) {
    complain_unusable(common, job.input, in);
    return exit_code_of(in);
  }
  io::WriteOptions options = job.write;
  options.timestamp = timestamp(job.stamp, in.source);
  options.execution = common.execution;
  options.execution.progress = progress_bar(common, job.input);
  const auto result = io::encode(in.model, in.source, options);
  end_progress(common);
  if (!result) {
    complain(common, fmt::format("{}: {}", job.input, result.error().text));
    const ErrorCode code = result.error().code;
    if (code == ErrorCode::Limit || code == ErrorCode::Cancelled) return LimitReached;
    return code == ErrorCode::InvalidArgument || code == ErrorCode::Unsupported ? Usage : Findings;
  }
  for (const std::string& loss : result->losses) say(common, fmt::format("{}: not in the output: {}", job.input, loss));
  if (job.strict && !result->losses.empty()) {
    complain(common, fmt::format("{}: {} losses under --strict, nothing written", job.input, result->losses.size()));
    return Findings;
  }
  Common target = common;
  target.output = job.output;
  if (!emit(target, result->bytes)) return CannotReadOrWrite;

  const bool is_mesh = is_mesh_format(options.format);
  const std::string report = report_json(*result, in, is_mesh, common.timings).dump(2) + "\n";
  if (!job.report.empty()) {
    target.output = job.report;
    target.force = true;
    if (!emit(target, report)) return CannotReadOrWrite;
  }
  const auto failed = std::count_if(result->faces.begin(), result->faces.end(),
                                    [](const io::FaceReport& f) { return f.status == FaceStatus::Failed; });
  say(common, fmt::format("{}: {} faces{}{}{}; {}", job.output == "-" ? "standard output" : job.output, result->faces.size(),
                          failed ? fmt::format(" ({} failed)", failed) : "",
                          is_mesh ? fmt::format(", {} triangles within {:.4g} mm (asked for {:.4g}{})", result->triangles,
                                                result->max_bound_mm, result->deflection_mm,
                                                result->coarsened > 1 ? fmt::format(", widened {:.3g} times to stay within {} triangles",
                                                                                    result->coarsened, *options.max_triangles)
                                                                      : "")
                                  : "",
                          common.timings ? fmt::format("; read {:.2f} import {:.2f} sew {:.2f} mesh {:.2f} write {:.2f} ms", in.timings.read_ms,
                                                       in.timings.import_ms, in.timings.sew_ms, result->timings.mesh_ms, result->timings.write_ms)
                                         : "",
                          summary(in.report)));
  if (options.to_nurbs) {
    const io::NurbsStatement& n = result->nurbs;
    say(common, fmt::format("{}: {} surfaces and {} curves exact; {} trimming curves re-expressed within {:.3g} mm", job.output,
                            n.exact_surfaces, n.exact_curves, n.approximated_pcurves, n.max_deviation_mm));
    for (const std::string& line : kept_lines(n.entities)) say(common, fmt::format("{}: {}", job.output, line));
    for (const Diagnostic& d : in.report.items())  // what the description itself could not say exactly
      if (d.rule->id == "DS-51") say(common, fmt::format("{}: {}", job.input, d.text));
  }
  if (common.json) {
    target.output.clear();
    if (job.output != "-" && !emit(target, report)) return CannotReadOrWrite;
  }
  return Done;
}

io::Format format_of(const std::string& to, const std::string& output) {
  if (!to.empty()) return io::format_from_extension("x." + to).value_or(io::Format::Unknown);
  return io::format_from_extension(output).value_or(io::Format::Unknown);
}

bool is_written(io::Format format) {
  return format != io::Format::Unknown && format != io::Format::Csv && format != io::Format::Font;
}

bool is_folder(const std::string& path) { return !path.empty() && (path.back() == '/' || fs::is_directory(path)); }

}  // namespace

int convert(const Common& common, const ConvertOptions& options) {
  Job job;
  job.write.deflection = options.deflection;
  job.write.angle_deg = options.angle_deg;
  if (options.max_triangles) job.write.max_triangles = options.max_triangles;
  job.write.to_nurbs = options.to_nurbs;
  if (options.schema == "ap214") job.write.step_schema = io::StepSchema::Ap214;
  if (options.iges_profile == "conservative") job.write.iges_profile = io::IgesProfile::Conservative;
  if (options.iges_bodies == "surfaces") job.write.iges_bodies = io::IgesBodies::Surfaces;
  if (!options.unit.empty()) job.write.unit = unit_from_name(options.unit);
  job.report = options.report;
  job.stamp = options.timestamp;
  job.strict = options.strict;
  if (!take_sew(options.sew, job.read)) {
    complain(common, fmt::format("--sew {} is neither auto, off nor a length in mm", printable(options.sew)),
             "trimloop convert --sew 0.01 IN OUT");
    return Usage;
  }

  std::vector<std::string> inputs = options.paths;
  std::string output = common.output;
  if (output.empty() && inputs.size() >= 2) {
    output = inputs.back();
    inputs.pop_back();
  }
  if (output.empty() || (inputs.size() > 1 && !is_folder(output))) {
    complain(common, inputs.size() > 1 ? "several inputs need a folder to go to" : "convert needs an output",
             inputs.size() > 1 ? "trimloop convert *.igs --to glb -o DIR/" : "trimloop convert IN OUT.glb");
    return Usage;
  }
  const bool into_folder = is_folder(output);
  job.write.format = into_folder ? format_of(options.to, "") : format_of(options.to, output);
  if (!is_written(job.write.format)) {
    complain(common, "the output's extension names no format that is written", "--to iges, step, stl, obj, ply, glb, svg or json");
    return Usage;
  }
  if (into_folder) {
    std::error_code failed;
    fs::create_directories(output, failed);
    if (failed) {
      complain(common, fmt::format("cannot make the folder {}: {}", output, failed.message()));
      return CannotReadOrWrite;
    }
  }
  int worst = Done;
  for (const std::string& input : inputs) {
    job.input = input;
    job.output = output;
    if (into_folder) {
      const std::string extension = job.write.format == io::Format::Iges ? "igs" : std::string(to_string(job.write.format));
      job.output = (fs::path(output) / fs::path(input).stem()).string() + "." + extension;
    }
    worst = std::max(worst, convert_one(common, job));
  }
  return worst;
}

int nurbs(const Common& common, const NurbsOptions& options) {
  if (options.schema) return emit(common, nurbs_schema()) ? Done : CannotReadOrWrite;
  Job job;
  if (options.paths.empty()) {
    complain(common, "nurbs needs an input and an output", "trimloop nurbs IN OUT.igs, or trimloop nurbs --schema");
    return Usage;
  }
  job.input = options.paths[0];
  job.output = options.paths.size() == 2 ? options.paths[1] : common.output;
  job.stamp = options.timestamp;
  job.read.tolerance_mm = options.tolerance_mm;
  job.read.font_text = options.text;
  job.read.em_mm = options.em_mm;
  job.write.to_nurbs = true;
  if (job.output.empty()) {
    complain(common, "nurbs needs an output", "trimloop nurbs IN OUT.igs");
    return Usage;
  }
  job.write.format = job.output == "-" ? (options.as.empty() ? io::Format::Iges : io::Format::Json) : format_of("", job.output);
  const bool pieces = job.write.format == io::Format::Json || job.write.format == io::Format::Svg;
  if (!is_written(job.write.format)) {
    complain(common, "the output's extension names no format that is written", "trimloop nurbs IN OUT.igs (or .stp, .glb, .svg, .json)");
    return Usage;
  }
  if (!options.as.empty() && !pieces) {
    complain(common, "Bézier pieces are written as JSON or SVG", "trimloop nurbs IN OUT.json --as bezier");
    return Usage;
  }
  return convert_one(common, job);
}

}  // namespace trimloop::cli
