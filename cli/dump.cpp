// trimloop dump: records as the file has them and as they were understood.

#include <fmt/format.h>

#include <algorithm>

#include "base/bytes.h"
#include "base/number.h"
#include "cli/terminal.h"
#include "formats/iges/file.h"
#include "formats/iges/names.h"

namespace trimloop::cli {

namespace {

std::string dump_entry(const Common& common, const io::ReadResult& in, const iges::DirectoryEntry& entry) {
  const iges::File& file = *in.source.iges;
  const Location place = file.locate(entry.offset);
  const std::string_view form = iges::form_name(entry.type, entry.form), shown = form.empty() ? iges::entity_name(entry.type) : form;
  std::string out = fmt::format("D{}  {}:{} {}  (line {})\n", entry.de, entry.type, entry.form, shown, place.line);
  const auto field = [&out](std::string_view name, const std::string& value) { out += fmt::format("  {:<22} {}\n", name, value); };
  field("status", fmt::format("{:02}{:02}{:02}{:02}  {}, {}", entry.status.blank, entry.status.subordinate, entry.status.use,
                              entry.status.hierarchy, entry.status.blank ? "hidden" : "visible",
                              entry.status.subordinate == 0   ? "independent"
                              : entry.status.subordinate == 1 ? "physically dependent"
                              : entry.status.subordinate == 2 ? "logically dependent"
                                                              : "dependent both ways"));
  if (entry.level) field("level", fmt::format("{}", entry.level));
  if (entry.transform) field("matrix", fmt::format("D{}", entry.transform));
  if (entry.colour) field("colour", entry.colour < 0 ? fmt::format("D{}", -entry.colour) : fmt::format("{}", entry.colour));
  if (!entry.label.empty()) field("label", printable(entry.label));

  Report findings;
  const iges::Parameters parameters = file.parameters(entry, findings);
  const std::vector<std::string> names = iges::parameter_names(entry.type, entry.form, parameters);
  for (std::size_t i = 1; i < parameters.tokens.size(); ++i) {
    const iges::Token& token = parameters.tokens[i];
    const std::string text = token.kind == iges::Token::Kind::Empty      ? "(default)"
                             : token.kind == iges::Token::Kind::Hollerith ? "\"" + printable(token.text, 200) + "\""
                                                                          : printable(token.text, 200);
    field(fmt::format("{:>4}  {}", i, i <= names.size() ? names[i - 1] : std::string()), text);
  }
  if (!parameters.comment.empty()) field("comment", printable(parameters.comment, 200));
  const std::string own = fmt::format("D{}", entry.de);
  for (const Diagnostic& d : in.report.items()) {
    if (d.entity == own) out += describe(common, in, d);
  }
  return out;
}

}  // namespace

int dump(const Common& common, const DumpOptions& options) {
  const io::ReadResult in = read_input(common, options.file);
  if (!in.source.iges || in.source.iges->directory().empty()) {
    complain_unusable(common, options.file, in);
    return exit_code_of(in) == Done ? Findings : exit_code_of(in);
  }
  std::string out;
  if (options.entities.empty()) {
    for (const iges::DirectoryEntry& entry : in.source.iges->directory()) out += dump_entry(common, in, entry);
  }
  for (const std::string& word : options.entities) {
    const auto number = read_integer(word.substr(!word.empty() && (word[0] == 'D' || word[0] == 'd') ? 1 : 0));
    const iges::DirectoryEntry* entry =
        number ? in.source.iges->find(iges::Ref{static_cast<std::int32_t>(number.value)}) : nullptr;
    if (entry == nullptr) {
      complain(common, fmt::format("{} has no entity {}", options.file, printable(word)),
               "an odd directory number such as D171; without one, all are shown");
      return Usage;
    }
    out += dump_entry(common, in, *entry);
  }
  return emit(common, out) ? Done : CannotReadOrWrite;
}

}  // namespace trimloop::cli
