#include "formats/step/header.h"

#include <fmt/format.h>

#include "base/bytes.h"
#include "formats/step/rules.h"
#include "formats/step/scan.h"
#include "formats/step/strings.h"
#include "formats/step/tape.h"

namespace trimloop::step {
namespace {

constexpr std::string_view names[] = {"FILE_DESCRIPTION", "FILE_NAME", "FILE_SCHEMA"};
constexpr std::size_t arity[] = {2, 7, 1};

// The strings at token i: a list of them, or one alone.
std::vector<std::string> strings(const Tape& tape, std::uint32_t i, bool& was_list) {
  std::vector<std::string> out;
  was_list = tape[i].kind == Token::Kind::List;
  const std::uint32_t begin = was_list ? i + 1 : i, end = tape[i].end;
  for (std::uint32_t k = begin; k < end; ++k)
    if (tape[k].kind == Token::Kind::String) out.push_back(decode_string(tape.text(tape[k])));
  return out;
}

std::string joined(const std::vector<std::string>& parts) {
  std::string out;
  for (const std::string& p : parts) out += p;
  return out;
}

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const Limits& limits, Report& report) : bytes_(bytes), limits_(limits), report_(report) {}

  Header read(const std::vector<HeaderEntity>& entities) {
    int last = -1;
    for (const HeaderEntity& e : entities) {
      if (!tape_.read(bytes_.substr(e.offset, e.length), limits_) || !tape_.faults().empty())
        add(rules::header_entities, e, "a header entity cannot be read as a whole");
      if (tape_.parts().empty()) continue;
      const std::string_view keyword = tape_.parts().front().keyword;
      const auto known = std::find(std::begin(names), std::end(names), keyword);
      if (known == std::end(names)) continue;  // SCHEMA_POPULATION, FILE_POPULATION, SECTION_LANGUAGE, ...
      const int which = static_cast<int>(known - std::begin(names));
      if (seen_[which]) {
        add(rules::header_entities, e, fmt::format("{} comes twice; the first one counts", keyword));
        continue;
      }
      if (which < last) add(rules::header_entities, e, fmt::format("{} comes too late", keyword));
      last = which;
      seen_[which] = true;
      take(which, e);
    }
    for (int i = 0; i < 3; ++i)
      if (!seen_[i]) report_.add(rules::header_entities, fmt::format("{} is missing", names[i])).location.offset = 0;
    return std::move(header_);
  }

 private:
  void add(const Rule& rule, const HeaderEntity& e, std::string text) {
    report_.add(rule, std::move(text)).location.offset = e.offset;
  }

  void take(int which, const HeaderEntity& e) {
    const Tape::Part& part = tape_.parts().front();
    std::vector<std::uint32_t> fields;
    for (std::uint32_t i = part.first; i < part.end; i = tape_[i].end) fields.push_back(i);
    if (fields.size() != arity[which]) {
      Diagnostic& d = report_.add(rules::header_arity, fmt::format("{} has {} fields instead of {}", names[which], fields.size(), arity[which]));
      d.location.offset = e.offset;
      d.measured = static_cast<double>(fields.size());
      d.limit = static_cast<double>(arity[which]);
    }
    const auto field = [&](std::size_t i, bool wants_list) {
      if (i >= fields.size()) return std::vector<std::string>{};
      bool was_list = false;
      auto out = strings(tape_, fields[i], was_list);
      if (was_list != wants_list && tape_[fields[i]].kind != Token::Kind::Unset)
        add(rules::header_types, e, fmt::format("field {} of {} is {}", i + 1, names[which], wants_list ? "no list" : "a list"));
      return out;
    };
    if (which == 0) {
      header_.description = field(0, true);
      header_.implementation_level = joined(field(1, false));
      check_level(e);
    } else if (which == 1) {
      header_.name = joined(field(0, false));
      header_.time_stamp = joined(field(1, false));
      header_.authors = field(2, true);
      header_.organizations = field(3, true);
      header_.preprocessor = joined(field(4, false));
      header_.originating_system = joined(field(5, false));
      header_.authorisation = joined(field(6, false));
    } else {
      header_.schemas = field(0, true);
      if (header_.schemas.empty()) add(rules::schema_name, e, "no schema is named");
      else if (protocol_of(header_.schemas).empty())
        add(rules::schema_name, e, fmt::format("the schema is not one of those for shapes: {}", printable(header_.schemas.front(), 60)));
    }
  }

  void check_level(const HeaderEntity& e) {
    const std::string& level = header_.implementation_level;
    const bool good = level.size() == 3 && level[0] >= '1' && level[0] <= '4' && level[1] == ';' && level[2] >= '1' && level[2] <= '3';
    if (!good) add(rules::implementation_level, e, fmt::format("the implementation level is '{}'", printable(level, 30)));
  }

  std::string_view bytes_;
  const Limits& limits_;
  Report& report_;
  Tape tape_;
  Header header_;
  bool seen_[3] = {false, false, false};
};

bool has_word(std::string_view text, std::string_view word) { return text.find(word) != std::string_view::npos; }

}  // namespace

Header read_header(std::string_view bytes, const std::vector<HeaderEntity>& entities, const Limits& limits, Report& report) {
  return HeaderReader(bytes, limits, report).read(entities);
}

void read_data_parameters(std::string_view text, const Limits& limits, std::string& name, std::vector<std::string>& schemas) {
  Tape tape;
  const std::string record = "DATA" + std::string(text);
  if (!tape.read(record, limits)) return;
  const Tape::Part& part = tape.parts().front();
  bool was_list = false;
  if (part.first < part.end) name = joined(strings(tape, part.first, was_list));
  const std::uint32_t second = part.first < part.end ? tape[part.first].end : part.end;
  if (second < part.end) schemas = strings(tape, second, was_list);
}

// Names and object identifiers as the recommended practices list them; blanks and case do not count.
std::string protocol_of(const std::vector<std::string>& schemas) {
  for (const std::string& raw : schemas) {
    std::string s;
    for (const char c : raw)
      if (!is_blank(c)) s += static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
    const std::string_view identifier = std::string_view(s).substr(std::min(s.find('{'), s.size()));
    if (has_word(s, "AP242") || has_word(s, "MANAGED_MODEL_BASED_3D_ENGINEERING")) {
      if (has_word(identifier, "10303442114")) return "AP242 edition 1";
      if (has_word(identifier, "10303442314") || has_word(identifier, "10303442214")) return "AP242 edition 2";
      if (has_word(identifier, "10303442414")) return "AP242 edition 3";
      if (has_word(identifier, "10303442714") || has_word(identifier, "10303442514")) return "AP242 edition 4";
      return "AP242";
    }
    if (has_word(s, "AP203_CONFIGURATION_CONTROLLED_3D_DESIGN")) return "AP203 edition 2";
    if (has_word(s, "CONFIG_CONTROL_DESIGN")) return "AP203";
    if (has_word(s, "AUTOMOTIVE_DESIGN_CC")) return "AP214";
    if (has_word(s, "AUTOMOTIVE_DESIGN")) return has_word(identifier, "1030321431") ? "AP214 edition 3" : "AP214";
    if (has_word(s, "STRUCTURAL_ANALYSIS_DESIGN") || has_word(s, "AP209")) return "AP209";
    if (has_word(s, "INTEGRATED_CNC_SCHEMA") || has_word(s, "AP238")) return "AP238";
    if (has_word(s, "AP210")) return "AP210";
    if (has_word(s, "ASSOCIATIVE_DRAUGHTING")) return "AP202";
    if (has_word(s, "EXPLICIT_DRAUGHTING")) return "AP201";
    if (has_word(s, "SHIP_")) return "AP215-218";
    if (has_word(s, "CONFIGURATION_CONTROL_3D_DESIGN") || has_word(s, "AP203")) return "AP203 edition 2";
  }
  return {};
}

}  // namespace trimloop::step
