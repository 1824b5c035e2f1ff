// trimloop dump: records as the file has them and as they were understood.

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "base/bytes.h"
#include "base/number.h"
#include "cli/terminal.h"
#include "formats/iges/file.h"
#include "formats/iges/names.h"
#include "formats/step/file.h"
#include "formats/step/tape.h"

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
  static constexpr std::string_view uses[] = {"geometry", "annotation", "definition", "other", "logical or positional", "2D parametric", "construction"};
  if (entry.status.use > 0 && entry.status.use < 7) field("use", std::string(uses[entry.status.use]));
  // Negative: a pointer to a definition. Else the number, with its word where there is one.
  const auto number_or_pointer = [](int value, std::span<const std::string_view> words = {}) {
    if (value < 0) return fmt::format("D{}", -static_cast<std::int64_t>(value));
    const auto at = static_cast<std::size_t>(value);
    return at < words.size() ? fmt::format("{}  {}", value, words[at]) : fmt::format("{}", value);
  };
  if (entry.structure) field("structure", number_or_pointer(entry.structure));
  if (entry.level) field("level", number_or_pointer(entry.level));
  if (entry.view) field("view", fmt::format("D{}", entry.view));
  if (entry.label_display) field("label display", fmt::format("D{}", entry.label_display));
  static constexpr std::string_view fonts[] = {"", "solid", "dashed", "phantom", "centre", "dotted"};
  if (entry.line_font) field("line font", number_or_pointer(entry.line_font, fonts));
  const iges::Global& global = file.global();
  if (entry.line_weight) {
    const bool stated = global.weight_gradations > 0 && global.max_line_width > 0;
    field("line weight", fmt::format("{}{}", entry.line_weight,
                                     stated ? fmt::format("  {:.4g} of the file's units", entry.line_weight * global.max_line_width / global.weight_gradations) : ""));
  }
  if (entry.transform) field("matrix", fmt::format("D{}", entry.transform));
  static constexpr std::string_view colours[] = {"", "black", "red", "green", "blue", "yellow", "magenta", "cyan", "white"};
  if (entry.colour) field("colour", number_or_pointer(entry.colour, colours));
  if (!entry.label.empty()) field("label", printable(entry.label));

  Report findings;
  const iges::Parameters parameters = file.parameters(entry, findings);
  const std::vector<std::string> names = iges::parameter_names(entry.type, entry.form, parameters);
  for (std::size_t i = 1; i < parameters.tokens.size(); ++i) {
    const iges::Token& token = parameters.tokens[i];
    const std::string text = token.kind == iges::Token::Kind::Empty      ? "(default)"
                             : token.kind == iges::Token::Kind::Hollerith ? fmt::format("\"{}\"", printable(token.text, 200))
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

// An attribute as the file has it: one token, or a list with all it holds.
std::string text_of(const step::Tape& tape, std::string_view record, std::uint32_t i, std::size_t end) {
  const step::Token& t = tape[i];
  const bool quoted = t.kind == step::Token::Kind::String || t.kind == step::Token::Kind::Enumeration;
  const std::size_t begin = quoted ? t.offset - 1u : t.offset;
  std::string_view text = record.substr(begin, end - begin);
  while (!text.empty() && (text.back() == ',' || text.back() == ' ' || text.back() == '\n' || text.back() == '\r')) text.remove_suffix(1);
  return printable(text, 200);
}

std::string dump_instance(const Common& common, const io::ReadResult& in, const step::Instance& instance) {
  const step::File& file = *in.source.step;
  std::string out = fmt::format("#{}  {}  (line {})\n", instance.id, file.keyword(instance).name, file.locate(instance.offset).line);
  step::Tape tape;
  const std::string_view record = file.value(instance);
  tape.read(record, common.execution.limits);
  for (const step::Tape::Part& part : tape.parts()) {
    const bool simple = tape.parts().size() == 1;
    if (!simple) out += fmt::format("  {}\n", part.keyword);
    const step::Entity entity = step::entity_of(part.keyword);
    int index = simple ? 0 : step::info(entity).first;
    int number = 1;
    for (std::uint32_t i = part.first; i < part.end; i = tape[i].end, ++index, ++number) {
      const std::uint32_t next = tape[i].end;
      std::size_t end = next < part.end ? tape[next].offset : record.size();
      if (next < part.end && (tape[next].kind == step::Token::Kind::String || tape[next].kind == step::Token::Kind::Enumeration)) --end;
      if (next >= part.end) {  // up to the part's own ')'
        end = tape[i].offset + tape[i].length + (tape[i].kind == step::Token::Kind::String || tape[i].kind == step::Token::Kind::Enumeration);
        for (std::uint32_t k = i; k < next; ++k) end = std::max<std::size_t>(end, tape[k].offset + tape[k].length);
        int open = 0;  // the parentheses of its own lists
        for (std::uint32_t k = i; k < next; ++k) open += (tape[k].kind == step::Token::Kind::List || tape[k].kind == step::Token::Kind::Typed) && tape[k].end == next;
        for (; end < record.size() && open > 0; ++end) open -= record[end] == ')';
      }
      out += fmt::format("  {:>4}  {:<26} {}\n", number, step::attribute_name(entity, index), text_of(tape, record, i, end));
    }
  }
  const std::string own = fmt::format("#{}", instance.id);
  for (const Diagnostic& d : in.report.items())
    if (d.entity == own) out += describe(common, in, d);
  return out;
}

int dump_step(const Common& common, const DumpOptions& options, const io::ReadResult& in) {
  std::string out;
  if (options.entities.empty())
    for (const step::Instance& i : in.source.step->instances()) out += dump_instance(common, in, i);
  for (const std::string& word : options.entities) {
    const auto number = read_integer(word.substr(!word.empty() && word[0] == '#' ? 1 : 0));
    const step::Instance* instance = number && number.value > 0 ? in.source.step->find({static_cast<std::uint64_t>(number.value)}) : nullptr;
    if (instance == nullptr) {
      complain(common, fmt::format("{} has no instance {}", options.file, printable(word)), "a name such as '#42' or 42; without one, all are shown");
      return Usage;
    }
    out += dump_instance(common, in, *instance);
  }
  return emit(common, out) ? Done : CannotReadOrWrite;
}

}  // namespace

int dump(const Common& common, const DumpOptions& options) {
  const io::ReadResult in = read_input(common, options.file);
  if (in.source.step && !in.source.step->instances().empty()) return dump_step(common, options, in);
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
