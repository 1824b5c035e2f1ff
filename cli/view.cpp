// trimloop view: one self-contained HTML page.

#include <fmt/format.h>

#include <filesystem>

#include "cli/terminal.h"
#include "cli/viewer_script.h"
#include "io/view/page.h"

namespace trimloop::cli {

int view(const Common& common, const ViewOptions& options) {
  if (viewer_script().empty()) {
    complain(common, "this program was built without Node, so `view` is absent",
             "install nodejs and npm, configure and build again");
    return Usage;
  }
  io::ReadOptions read;
  read.measure_findings = true;
  const io::ReadResult in = read_input(common, options.file, read);
  if (!in.usable) {
    complain_unusable(common, options.file, in);
    return exit_code_of(in);
  }
  io::WriteOptions write;
  write.deflection = options.deflection;
  write.angle_deg = options.angle_deg;
  write.execution = common.execution;
  const auto scene = io::make_scene(in.model, write);
  const auto page = scene ? io::to_page(in.model, in.source, *scene, viewer_script())
                          : Result<std::string>(tl::unexpected(scene.error()));
  if (!page) {
    complain(common, fmt::format("{}: {}", options.file, page.error().text));
    return page.error().code == ErrorCode::Limit || page.error().code == ErrorCode::Cancelled ? LimitReached : Usage;
  }
  Common target = common;
  if (target.output.empty()) {
    const std::string stem = options.file == "-" ? "standard-input" : std::filesystem::path(options.file).stem().string();
    target.output = stem + ".html";
  }
  if (!emit(target, *page)) return CannotReadOrWrite;
  say(common, fmt::format("{}: {} {}, {:.0f} KB; open it in a browser", target.output, scene->bodies.size(),
                          scene->bodies.size() == 1 ? "body" : "bodies", static_cast<double>(page->size()) / 1024));
  return Done;
}

}  // namespace trimloop::cli
