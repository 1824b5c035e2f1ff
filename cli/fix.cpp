// trimloop fix: the repair road. --none gives back the bytes that came in; --set changes one parameter and nothing that does
// not have to move with it.

#include <fmt/format.h>

#include "base/bytes.h"
#include "base/number.h"
#include "cli/terminal.h"
#include "formats/iges/edit.h"
#include "formats/step/file.h"

namespace trimloop::cli {
namespace {

// "D171:5=0.25"
struct Setting {
  iges::Ref entity;
  std::size_t index = 0;
  std::string value;
};

std::optional<Setting> parse(const std::string& text) {
  const std::size_t colon = text.find(':'), equals = text.find('=', colon == std::string::npos ? 0 : colon);
  if (text.empty() || (text[0] != 'D' && text[0] != 'd') || colon == std::string::npos || equals == std::string::npos) return {};
  const auto de = read_integer(std::string_view(text).substr(1, colon - 1));
  const auto index = read_integer(std::string_view(text).substr(colon + 1, equals - colon - 1));
  if (!de || !index || de.value < 1 || de.value > 9'999'999 || index.value < 1) return {};
  return Setting{{static_cast<std::int32_t>(de.value)}, static_cast<std::size_t>(index.value), text.substr(equals + 1)};
}

std::string token_text(const iges::File& file, iges::Ref entity, std::size_t index) {
  Report ignored;
  const iges::DirectoryEntry* entry = file.find(entity);
  if (!entry) return {};
  const iges::Parameters parameters = file.parameters(*entry, ignored);
  return index < parameters.tokens.size() ? printable(parameters.tokens[index].text, 80) : std::string();
}

}  // namespace

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
  if (!options.set.empty() && !is_iges) {
    complain(common, "--set of a STEP file is promised and not built yet", "trimloop --help");
    return Usage;
  }
  std::string log;
  std::string bytes = in.source.packed ? *in.source.packed : is_step ? in.source.step->write() : in.source.iges->write();
  for (const std::string& text : options.set) {
    const std::optional<Setting> setting = parse(text);
    if (!setting) {
      complain(common, fmt::format("--set {} is not of the form D171:5=0.25", printable(text)));
      return Usage;
    }
    Report ignored;
    const iges::File file = iges::File::parse(std::move(bytes), common.execution.limits, ignored);
    const Result<std::string> value = options.raw ? Result<std::string>(setting->value)
                                                  : iges::parameter_text(file, setting->entity, setting->index, setting->value);
    auto changed = value ? iges::set_parameter(file, setting->entity, setting->index, *value)
                         : Result<std::string>(tl::unexpected<Error>(value.error()));
    if (!changed) {
      complain(common, fmt::format("--set {}: {}", printable(text), changed.error().text), "trimloop dump FILE D171 shows its parameters");
      return Findings;
    }
    log += fmt::format("D{} parameter {}: '{}' -> '{}'\n", setting->entity.de, setting->index,
                       token_text(file, setting->entity, setting->index), *value);
    bytes = std::move(*changed);
  }
  if (!options.log.empty()) {
    Common to_log = common;
    to_log.output = options.log;
    if (!emit(to_log, log)) return CannotReadOrWrite;
  }
  const std::size_t size = bytes.size();
  if (!emit(common, bytes)) return CannotReadOrWrite;
  say(common, fmt::format("{}: {} changed, {} bytes", common.output,
                          options.set.empty() ? "nothing" : fmt::format("{} parameter{}", options.set.size(), options.set.size() == 1 ? "" : "s"), size));
  return Done;
}

}  // namespace trimloop::cli
