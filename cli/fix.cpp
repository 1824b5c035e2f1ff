// trimloop fix: the repair road. --none gives back the bytes that came in; --set changes one parameter and nothing that does
// not have to move with it; --all and --select repair what can be repaired without changing what the file means.

#include <fmt/format.h>

#include <algorithm>

#include "base/bytes.h"
#include "base/number.h"
#include "cli/terminal.h"
#include "formats/iges/edit.h"
#include "formats/iges/repair.h"
#include "formats/step/edit.h"

namespace trimloop::cli {
namespace {

// "D171:5=0.25" of IGES, "#42:2.3=0.25" or "#4:SI_UNIT.1=.MILLI." of STEP.
struct Setting {
  std::string entity;     // as typed, "D171" or "#42"
  std::string parameter;
  std::string value;
};

std::optional<Setting> parse(const std::string& text) {
  const std::size_t colon = text.find(':'), equals = text.find('=', colon == std::string::npos ? 0 : colon);
  if (colon == std::string::npos || equals == std::string::npos) return {};
  return Setting{text.substr(0, colon), text.substr(colon + 1, equals - colon - 1), text.substr(equals + 1)};
}

struct Changed {
  std::string bytes;
  std::string before, after;  // texts of the parameter, for the log
};

std::string token_text(const iges::File& file, iges::Ref entity, std::size_t index) {
  Report ignored;
  const iges::DirectoryEntry* entry = file.find(entity);
  if (!entry) return {};
  const iges::Parameters parameters = file.parameters(*entry, ignored);
  return index < parameters.tokens.size() ? std::string(parameters.tokens[index].text) : std::string();
}

Result<Changed> change_iges(std::string bytes, const Setting& setting, bool raw, const Limits& limits) {
  const auto de = read_integer(std::string_view(setting.entity).substr(std::min<std::size_t>(1, setting.entity.size())));
  const auto index = read_integer(setting.parameter);
  if (setting.entity.empty() || (setting.entity[0] != 'D' && setting.entity[0] != 'd') || !de || !index || de.value < 1 ||
      de.value > 9'999'999 || index.value < 1) {
    return fail(ErrorCode::InvalidArgument, "not of the form D171:5=0.25");
  }
  const iges::Ref entity{static_cast<std::int32_t>(de.value)};
  const auto at = static_cast<std::size_t>(index.value);
  Report ignored;
  const iges::File file = iges::File::parse(std::move(bytes), limits, ignored);
  auto value = raw ? Result<std::string>(setting.value) : iges::parameter_text(file, entity, at, setting.value);
  if (!value) return tl::unexpected<Error>(value.error());
  auto changed = iges::set_parameter(file, entity, at, *value);
  if (!changed) return tl::unexpected<Error>(changed.error());
  return Changed{std::move(*changed), token_text(file, entity, at), std::move(*value)};
}

Result<Changed> change_step(std::string bytes, const Setting& setting, bool raw, const Limits& limits) {
  const auto id = read_integer(std::string_view(setting.entity).substr(std::min<std::size_t>(1, setting.entity.size())));
  const auto path = step::parameter_path(setting.parameter);
  if (setting.entity.empty() || setting.entity[0] != '#' || !id || id.value < 1 || !path) {
    return fail(ErrorCode::InvalidArgument, "not of the form #42:2.3=0.25");
  }
  const step::Ref instance{static_cast<std::uint64_t>(id.value)};
  Report ignored;
  const step::File file = step::File::parse(std::move(bytes), limits, ignored);
  const auto before = step::parameter_at(file, instance, *path);
  if (!before) return tl::unexpected<Error>(before.error());
  auto value = raw ? Result<std::string>(setting.value) : step::parameter_text(file, instance, *path, setting.value);
  if (!value) return tl::unexpected<Error>(value.error());
  auto changed = step::set_parameter(file, instance, *path, *value);
  if (!changed) return tl::unexpected<Error>(changed.error());
  return Changed{std::move(*changed), std::string(*before), std::move(*value)};
}

// The rules of --select, or all; nothing when a word names none that can be repaired.
std::optional<std::vector<const Rule*>> selected(const Common& common, const FixOptions& options) {
  const auto repairable = iges::repairable_rules();
  if (options.all) return std::vector<const Rule*>(repairable.begin(), repairable.end());
  std::vector<const Rule*> out;
  for (const std::string& word : options.select) {
    const Rule* rule = io::find_rule(word);
    if (std::find(repairable.begin(), repairable.end(), rule) == repairable.end()) {
      complain(common, rule ? fmt::format("{} {} has no repair that cannot change what the file means", rule->id, rule->slug)
                            : fmt::format("there is no rule {}", printable(word)), "trimloop explain --list");
      return {};
    }
    out.push_back(rule);
  }
  return out;
}

std::string line_of(const iges::Change& c) {
  const std::string place = c.line ? fmt::format("line {}", c.line) : std::string("the end");
  return fmt::format("{} {} {}{}: '{}' -> '{}'\n", c.rule->id, c.rule->slug, place, c.entity.empty() ? std::string() : fmt::format(" {}", c.entity),
                     printable(c.before, 100), printable(c.after, 100));
}

// --set: one parameter after another. The exit code when one cannot be set.
std::optional<int> set_parameters(const Common& common, const FixOptions& options, bool is_step, std::string& bytes, std::string& log) {
  for (const std::string& text : options.set) {
    const std::optional<Setting> setting = parse(text);
    if (!setting) {
      complain(common, fmt::format("--set {} is not of the form {}", printable(text), is_step ? "#42:2.3=0.25" : "D171:5=0.25"));
      return Usage;
    }
    const Limits& limits = common.execution.limits;
    auto changed = is_step ? change_step(std::move(bytes), *setting, options.raw, limits)
                           : change_iges(std::move(bytes), *setting, options.raw, limits);
    if (!changed) {
      complain(common, fmt::format("--set {}: {}", printable(text), changed.error().text),
               fmt::format("trimloop dump FILE {} shows its parameters", printable(setting->entity)));
      return Findings;
    }
    log += fmt::format("{} parameter {}: '{}' -> '{}'\n", setting->entity, setting->parameter, printable(changed->before, 80),
                       changed->after);
    bytes = std::move(changed->bytes);
  }
  return {};
}

}  // namespace

int fix(const Common& common, const FixOptions& options) {
  if (common.output.empty() && !options.dry_run) {
    complain(common, "fix needs an output", "trimloop fix --none IN OUT");
    return Usage;
  }
  const auto rules = selected(common, options);
  if (!rules) return Usage;
  const io::ReadResult in = read_input(common, options.input);
  const bool is_iges = in.source.iges && !in.source.iges->directory().empty();
  const bool is_step = in.source.step && !in.source.step->instances().empty();
  if (!is_iges && !is_step) {
    complain_unusable(common, options.input, in);
    return exit_code_of(in);
  }
  if (!is_iges && !rules->empty()) {
    complain(common, "the repairs are for IGES files", "trimloop --help");
    return Usage;
  }
  // A compressed file is given back as it came, or changed and unpacked.
  std::string bytes = in.source.packed && options.set.empty() ? *in.source.packed : is_step ? in.source.step->write() : in.source.iges->write();
  std::string log;
  if (const auto code = set_parameters(common, options, is_step, bytes, log)) return *code;
  std::size_t changes = options.set.size();
  if (!rules->empty()) {
    // What is no more than an oddity is repaired only where somebody asks for it by name.
    iges::Repaired repaired = iges::repair(std::move(bytes), [&](const Rule& r) { return std::find(rules->begin(), rules->end(), &r) != rules->end(); },
                                           options.all ? Severity::Warning : Severity::Hint, common.execution.limits);
    for (const iges::Change& c : repaired.changes) log += line_of(c);
    for (const auto& [rule, why] : repaired.refused) log += fmt::format("{} {} stays: {}\n", rule->id, rule->slug, why);
    changes += repaired.changes.size();
    bytes = std::move(repaired.bytes);
  }
  if (!options.log.empty()) {
    Common to_log = common;
    to_log.output = options.log;
    if (!emit(to_log, log)) return CannotReadOrWrite;
  }
  const std::string done = fmt::format("{} change{}", changes == 0 ? std::string("no") : std::to_string(changes), changes == 1 ? "" : "s");
  if (options.dry_run) {
    Common to_output = common;
    to_output.output.clear();
    if (!log.empty() && !emit(to_output, log)) return CannotReadOrWrite;
    say(common, fmt::format("{}: {}, nothing written", options.input, done));
    return Done;
  }
  const std::size_t size = bytes.size();
  if (!emit(common, bytes)) return CannotReadOrWrite;
  say(common, fmt::format("{}: {}, {} bytes", common.output, done, size));
  return Done;
}

}  // namespace trimloop::cli
