// trimloop fix --none: the repair road with no repair. What goes in comes out, byte for byte.

#include <fmt/format.h>

#include "cli/terminal.h"
#include "formats/iges/file.h"
#include "formats/step/file.h"

namespace trimloop::cli {

int fix(const Common& common, const FixOptions& options) {
  if (common.output.empty()) {
    complain(common, "fix needs an output", "trimloop fix --none IN OUT");
    return Usage;
  }
  const io::ReadResult in = read_input(common, options.input);
  const bool is_iges = in.source.iges && !in.source.iges->directory().empty();
  const bool is_step = in.source.step && !in.source.step->instances().empty();
  if (!is_iges && !is_step) {
    complain_unusable(common, options.input, in);
    return exit_code_of(in);
  }
  const std::string bytes = in.source.packed ? *in.source.packed : is_step ? in.source.step->write() : in.source.iges->write();
  if (!emit(common, bytes)) return CannotReadOrWrite;
  say(common, fmt::format("{}: nothing changed, {} bytes", common.output, bytes.size()));
  return Done;
}

}  // namespace trimloop::cli
