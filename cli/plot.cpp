// trimloop plot: curves, surfaces and parameter space as pictures.

#include <fmt/format.h>

#include <filesystem>

#include "cli/terminal.h"
#include "formats/obj/read.h"
#include "io/file.h"
#include "io/plot/plot.h"

namespace trimloop::cli {

namespace {

namespace fs = std::filesystem;

std::string output_of(const Common& common, const PlotOptions& options) {
  if (!common.output.empty()) return common.output;
  return options.file == "-" ? std::string("-") : fs::path(options.file).stem().string() + ".svg";
}

int write(const Common& common, const std::string& output, const Result<io::plot::Picture>& picture) {
  if (!picture) {
    complain(common, picture.error().text, picture.error().code == ErrorCode::NotFound ? "trimloop plot --help lists what can be drawn" : "");
    return picture.error().code == ErrorCode::Limit || picture.error().code == ErrorCode::Cancelled ? LimitReached : Findings;
  }
  Common target = common;
  target.output = output;
  if (!emit(target, picture->svg)) return CannotReadOrWrite;
  say(common, fmt::format("{}: {} drawing{}{}; open it in a browser", output == "-" ? "standard output" : output, picture->drawn,
                          picture->drawn == 1 ? "" : "s",
                          picture->left_out ? fmt::format(", {} more not drawn (--most, --entity)", picture->left_out) : ""));
  return Done;
}

// The control mesh of an OBJ file, before any scheme.
Result<subdivision::ControlMesh> control_mesh(const Common& common, const std::string& file) {
  const auto bytes = io::load(file, common.execution.limits.file_bytes);
  if (!bytes) return tl::unexpected(bytes.error());
  const auto polygons = obj::read(*bytes, common.execution.limits);
  if (!polygons) return tl::unexpected(polygons.error());
  subdivision::ControlMesh mesh;
  for (const auto& p : polygons->positions) mesh.points.push_back({p[0], p[1], p[2]});
  mesh.corners = polygons->corners;
  mesh.face_start = polygons->face_start;
  for (const auto& l : polygons->lines) mesh.creases.push_back({l[0], l[1], infinity});
  return mesh;
}

}  // namespace

int plot(const Common& common, const PlotOptions& options) {
  const std::string output = output_of(common, options);
  if (!common.force && output != "-" && fs::exists(output)) {
    complain(common, fmt::format("{} exists", output), "the same command with --force");
    return CannotReadOrWrite;
  }
  if (options.what == "subdivision") {
    const auto scheme = subdivision::scheme_from_name(options.scheme);
    if (!scheme) {
      complain(common, fmt::format("\"{}\" is no scheme", options.scheme), "--scheme catmull-clark, doo-sabin, loop, butterfly, mid-edge or sqrt3");
      return Usage;
    }
    const auto mesh = control_mesh(common, options.file);
    if (!mesh) {
      complain(common, fmt::format("{}: {}", options.file, mesh.error().text));
      return mesh.error().code == ErrorCode::Io ? CannotReadOrWrite : Findings;
    }
    return write(common, output, io::plot::draw_subdivision(*mesh, *scheme, options.rounds));
  }
  const io::ReadResult in = read_input(common, options.file);
  if (!in.usable) {
    complain_unusable(common, options.file, in);
    return exit_code_of(in);
  }
  io::plot::Options how;
  if (!options.what.empty()) how.what = io::plot::what_from_name(options.what);
  how.entity = options.entity;
  how.at = options.at;
  how.most_drawings = options.most;
  how.execution = common.execution;
  return write(common, output, io::plot::draw(in.model, in.source, how));
}

}  // namespace trimloop::cli
