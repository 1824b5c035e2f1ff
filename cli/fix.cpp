// trimloop fix --none: the repair road with no repair. What goes in comes out, byte for byte.

#include <fmt/format.h>

#include "cli/terminal.h"
#include "formats/iges/file.h"

namespace trimloop::cli {

int fix(const Common& common, const FixOptions& options) {
  if (common.output.empty()) {
    complain(common, "fix needs an output", "trimloop fix --none IN OUT");
    return Usage;
  }
  const io::ReadResult in = read_input(common, options.input);
  if (!in.source.iges || in.source.iges->directory().empty()) {
    complain_unusable(common, options.input, in);
    return exit_code_of(in);
  }
  if (!emit(common, in.source.iges->write())) return CannotReadOrWrite;
  say(common, fmt::format("{}: nothing changed, {} bytes", common.output, in.source.iges->bytes().size()));
  return Done;
}

}  // namespace trimloop::cli
