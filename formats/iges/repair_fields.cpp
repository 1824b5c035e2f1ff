// Repairs of the fields of the Global section and of the Directory: what was understood is written.

#include <fmt/format.h>

#include <algorithm>

#include "formats/iges/directory.h"
#include "formats/iges/global.h"
#include "formats/iges/repairs.h"
#include "formats/iges/rules.h"
#include "formats/iges/tokens.h"

namespace trimloop::iges {
namespace {

constexpr std::size_t global_columns = 72, field_width = 8;

// The text of the Global cards and its fields; field 3 is the first token.
struct GlobalText {
  std::string joined;
  std::vector<Token> tokens;
  std::size_t first_field = 0;  // position of the first token's text
  std::string delimiters;

  explicit GlobalText(const Cards& cards) {
    for (const Card& card : cards.global.cards) {
      joined += cards.columns(card, 0, global_columns);
      joined.resize((joined.size() + global_columns - 1) / global_columns * global_columns, ' ');
    }
    const auto opening = read_delimiters(joined);
    if (!opening || opening->record_ends) return;
    first_field = opening->end;
    std::vector<LexFault> faults;
    delimiters = {opening->parameter, opening->record};
    Lexer(opening->parameter, opening->record).lex(std::string_view(joined).substr(first_field), tokens, faults);
  }
  GlobalText(const GlobalText&) = delete;  // the tokens are views of the text
  // From where field `n` starts to its delimiter.
  std::size_t begin_of(std::size_t n) const { return first_field + tokens[n - 3].offset; }
  std::size_t end_of(std::size_t n) const {
    const Token& token = tokens[n - 3];
    const std::size_t text_end = static_cast<std::size_t>(token.text.data() - joined.data()) + token.text.size();
    const std::size_t at = joined.find_first_of(delimiters, token.kind == Token::Kind::Empty ? begin_of(n) : text_end);
    return std::min(at, joined.size() - 1);
  }
};

// A field of the Global section gets another text. Cards before it stay; those behind are packed anew, and one may be added.
void set_global(Repair& r, std::size_t n, const std::string& text) {
  const Cards& cards = r.cards();
  const GlobalText global(cards);
  const auto& list = cards.global.cards;
  if (n < 3 || n - 3 >= global.tokens.size() || !std::all_of(list.begin(), list.end(), stands_in_file)) {
    r.refusal = "the Global cards do not stand in the file as 80 columns";
    return;
  }
  const std::size_t begin = global.begin_of(n), first = begin / global_columns;
  std::string line = global.joined.substr(first * global_columns, begin % global_columns);
  std::vector<std::string> lines;
  const auto put = [&](std::string_view unit, bool may_be_cut) {
    if (line.size() + unit.size() > global_columns && !may_be_cut && !line.empty()) lines.push_back(std::move(line)), line.clear();
    while (line.size() + unit.size() > global_columns) {
      const std::size_t room = global_columns - line.size();
      line += unit.substr(0, room);
      unit.remove_prefix(room);
      lines.push_back(std::move(line));
      line.clear();
    }
    line += unit;
  };
  for (std::size_t k = n; k - 3 < global.tokens.size(); ++k) {
    const std::size_t from = global.begin_of(k), to = global.end_of(k);
    std::string unit = k == n ? text : global.joined.substr(from, to - from);
    while (!unit.empty() && unit.back() == ' ' && global.tokens[k - 3].kind != Token::Kind::Hollerith) unit.pop_back();
    put(unit + global.joined[to], global.tokens[k - 3].kind == Token::Kind::Hollerith);
  }
  lines.push_back(line);
  for (std::size_t i = 0; i < lines.size() || first + i < list.size(); ++i) {
    std::string data = i < lines.size() ? lines[i] : std::string();
    data.resize(global_columns, ' ');
    if (first + i < list.size()) {
      r.columns(list[first + i], 0, std::move(data));
    } else {
      r.replace(next_line(cards, list.back()), 0,
                fmt::format("{}G{:7}{}", data, first + i + 1, line_end_after(cards, list.back())));
    }
  }
  if (first + lines.size() > list.size()) r.count_card(9, static_cast<std::int64_t>(first + lines.size() - list.size()));
}

// What stands in a Directory field, as it was understood.
std::string understood(const DirectoryEntry& e, std::size_t field) {
  switch (field) {
    case 1: case 11: return std::to_string(e.type);
    case 3: return "0";
    case 4: return std::to_string(e.line_font);
    case 5: return std::to_string(e.level);
    case 6: return std::to_string(e.view);
    case 7: return std::to_string(e.transform);
    case 8: return std::to_string(e.label_display);
    case 9: return fmt::format("{:02}{:02}{:02}{:02}", e.status.blank, e.status.subordinate, e.status.use, e.status.hierarchy);
    case 12: return std::to_string(e.line_weight);
    case 13: return std::to_string(e.colour);
    default: return {};
  }
}

void set_field(Repair& r, const DirectoryEntry& entry, std::size_t field, std::string text) {
  const EntryCards own = directory_cards(r.cards(), entry);
  if (!own.first || text.size() > field_width) return;
  text.insert(0, field_width - text.size(), ' ');
  r.columns(field > 10 ? *own.second : *own.first, (field - 1) % 10 * field_width, std::move(text), fmt::format("D{}", entry.de));
}

}  // namespace

// Fields that are left out have their defaults; empty ones have them as well.
void complete_global(Repair& r) {
  constexpr std::size_t wanted = 24;
  const Global& g = r.file.global();
  if (g.fields_present >= wanted) {
    r.refusal = "there are too many fields, not too few";
    return;
  }
  const GlobalText global(r.cards());
  const std::size_t last = global.tokens.size() + 2;
  if (global.tokens.empty()) return;
  const std::string text = global.joined.substr(global.begin_of(last), global.end_of(last) - global.begin_of(last));
  set_global(r, last, text + std::string(wanted - g.fields_present, g.parameter_delimiter));
}

// One field for each reading: the cards move.
void correct_global(Repair& r) {
  const Global& g = r.file.global();
  r.findings([&](const Diagnostic& d) {
    if (!r.empty() || d.parameter < 3) return;
    std::string text;
    switch (d.parameter) {
      case 8: text = std::to_string(g.single_magnitude); break;
      case 9: text = std::to_string(g.single_significance); break;
      case 10: text = std::to_string(g.double_magnitude); break;
      case 11: text = std::to_string(g.double_significance); break;
      case 15: text = unit_name_of_flag(g.unit_flag); break;
      case 16: text = std::to_string(g.weight_gradations); break;
      case 23: text = std::to_string(g.version_flag); break;
      case 24: text = std::to_string(g.drafting_standard); break;
      default: return;
    }
    if (d.parameter == 15) text = fmt::format("{}H{}", text.size(), text);
    set_global(r, static_cast<std::size_t>(d.parameter), text);
  });
}

void correct_directory(Repair& r) {
  r.findings([&](const Diagnostic& d) {
    const DirectoryEntry* entry = r.entry(d);
    const EntryCards own = entry ? directory_cards(r.cards(), *entry) : EntryCards{};
    if (!own.first || !entry->usable) return;
    if (&r.rule == &rules::reserved) {
      r.columns(*own.second, 5 * field_width, std::string(2 * field_width, ' '), d.entity);
    } else if (&r.rule == &rules::type_twice) {
      for (const std::size_t field : {std::size_t{1}, std::size_t{11}}) set_field(r, *entry, field, understood(*entry, field));
    } else {
      const Card& card = d.location.offset < own.second->offset ? *own.first : *own.second;
      const std::size_t field = (d.location.offset - card.offset) / field_width + (&card == own.first ? 1 : 11);
      set_field(r, *entry, field, understood(*entry, field));
    }
  });
}

// The form that the record asks for.
void correct_form(Repair& r) {
  r.findings([&](const Diagnostic& d) {
    const DirectoryEntry* entry = r.entry(d);
    if (!entry || !entry->usable) return;
    int form = entry->form == 0 ? 1 : 0;  // 108: bounded or not; 190-198: with a reference direction or not
    if (entry->type == 104) form = static_cast<int>(d.limit);
    if (entry->type == 124) form = d.measured < 0 ? 1 : 0;
    set_field(r, *entry, 15, std::to_string(form));
  });
}

// 142: the curve in parameter space says that it is one.
void correct_use_flag(Repair& r) {
  constexpr int parameter_space = 5;
  r.findings([&](const Diagnostic& d) {
    const DirectoryEntry* owner = r.entry(d);
    if (!owner || d.parameter < 1) return;
    Report ignored;
    const Parameters p = r.file.parameters(*owner, ignored);
    const auto index = static_cast<std::size_t>(d.parameter);
    const auto de = index < p.tokens.size() ? read_columns(p.tokens[index].text) : std::nullopt;
    const DirectoryEntry* curve = de ? r.file.find(Ref{*de}) : nullptr;
    if (!curve) return;
    DirectoryEntry as = *curve;
    as.status.use = parameter_space;
    set_field(r, *curve, 9, understood(as, 9));
  });
}

}  // namespace trimloop::iges
