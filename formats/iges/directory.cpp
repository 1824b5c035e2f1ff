#include "formats/iges/directory.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "base/bytes.h"
#include "formats/iges/names.h"
#include "formats/iges/rules.h"

namespace trimloop::iges {

std::optional<int> read_columns(std::string_view field) {
  std::size_t i = 0;
  while (i < field.size() && (field[i] == ' ' || field[i] == '\t')) ++i;
  if (i == field.size()) return 0;
  const bool negative = field[i] == '-';
  if (negative || field[i] == '+') ++i;
  int value = 0;
  std::size_t digits = 0;
  for (; i < field.size() && field[i] >= '0' && field[i] <= '9'; ++i)
    if (++digits <= 9) value = value * 10 + (field[i] - '0');  // more would not fit, and are refused below
  while (i < field.size() && (field[i] == ' ' || field[i] == '\t' || field[i] == '\0')) ++i;
  if (i != field.size() || digits == 0 || digits > 9) return std::nullopt;
  return negative ? -value : value;
}

const DirectoryEntry* Directory::find(std::int64_t de) const {
  if (de <= 0 || de % 2 == 0 || entries.empty()) return nullptr;
  // Without gaps the entry stands where its number says.
  const auto guess = static_cast<std::size_t>(de / 2);
  if (guess < entries.size() && entries[guess].de == de) return &entries[guess];
  const auto found = std::lower_bound(entries.begin(), entries.end(), de,
                                      [](const DirectoryEntry& e, std::int64_t d) { return e.de < d; });
  return found != entries.end() && found->de == de ? &*found : nullptr;
}

namespace {

constexpr std::size_t field_width = 8;
constexpr std::array<const char*, 20> field_names = {"entity type",    "parameter pointer",
                                                     "structure",      "line font",
                                                     "level",          "view",
                                                     "transformation", "label display",
                                                     "status",         "sequence",
                                                     "entity type",    "line weight",
                                                     "colour",         "parameter line count",
                                                     "form",           "reserved",
                                                     "reserved",       "label",
                                                     "subscript",      "sequence"};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\0')) text.remove_suffix(1);
  return text;
}

bool is_implementor_type(int type) {
  return (type >= 600 && type <= 699) || (type >= 5001 && type <= 9999) || type >= 10000;
}

// 2.2.4.4.3: types whose meaning is defined by another entity.
bool has_structure(int type, int form) {
  return type == 422 || (type == 402 && form >= 5001) || is_implementor_type(type);
}

class DirectoryReader {
 public:
  DirectoryReader(const Cards& cards, const Global& global, Report& report)
      : cards_(cards), section_(cards.directory), global_(global), report_(report) {}

  Directory read() {
    if (section_.size() % 2 != 0) {
      const Card& last = section_.cards.back();
      say(rules::directory_odd, last, 0, fmt::format("the Directory has {} cards; two make an entry", section_.size()));
    }
    out_.entries.reserve(section_.size() / 2);
    const bool by_number =
        section_.has_gaps() && pairs_by_number() * 4 >= section_.size();  // half of the entries at least
    for (std::size_t i = 0; i + 1 < section_.size();) {
      if (by_number && !is_pair(i)) {
        say(rules::pairing, section_.cards[i], 10,
            fmt::format("Directory card {} has no partner; it is not read", section_.number(i)));
        ++i;
        continue;
      }
      read_entry(i, by_number ? section_.number(i) : static_cast<std::int32_t>(i + 1));
      i += 2;
    }
    check_pointers();
    return std::move(out_);
  }

 private:
  bool is_pair(std::size_t i) const {
    return section_.number(i) % 2 == 1 && i + 1 < section_.size() && section_.number(i + 1) == section_.number(i) + 1;
  }
  std::size_t pairs_by_number() const {
    std::size_t pairs = 0;
    for (std::size_t i = 0; i + 1 < section_.size(); ++i)
      if (is_pair(i)) ++pairs, ++i;
    return pairs;
  }

  // -- one entry

  std::string_view text_of(int field) const {
    return cards_.columns(*card_[field > 10], static_cast<std::size_t>((field - 1) % 10) * field_width, field_width);
  }

  int number(int field, bool* good = nullptr) {
    const std::string_view text = text_of(field);
    const auto value = read_columns(text);
    if (good) *good = value.has_value();
    if (!value)
      say(rules::field_syntax, field,
          fmt::format("the {} is '{}', not a number; 0 is used", field_names[static_cast<std::size_t>(field - 1)],
                      printable(text)));
    return value.value_or(0);
  }

  void read_entry(std::size_t index, std::int32_t de) {
    card_ = {&section_.cards[index], &section_.cards[index + 1]};
    entry_ = DirectoryEntry{};
    entry_.de = de;
    entry_.offset = card_[0]->offset;
    read_type();
    entry_.parameter_pointer = number(2);
    entry_.structure = number(3);
    entry_.line_font = number(4);
    entry_.level = number(5);
    entry_.view = number(6);
    entry_.transform = number(7);
    entry_.label_display = number(8);
    read_status();
    entry_.line_weight = number(12);
    entry_.colour = number(13);
    entry_.parameter_count = number(14);
    read_label();
    judge_fields();
    out_.entries.push_back(std::move(entry_));
  }

  void read_type() {
    bool first_good = true, second_good = true;
    const int first = number(1, &first_good), second = number(11, &second_good);
    entry_.form = number(15);
    entry_.type = first_good && first != 0 ? first : second;
    if (!first_good && !second_good) entry_.usable = false;
    if (first == second || !first_good || !second_good) return;
    say(rules::type_twice, 11, fmt::format("the first card says type {}, the second {}", first, second));
    if (entry_.type != second) out_.other_types.push_back({out_.entries.size(), second});
  }

  // 2.2.4.4.9: four two-digit numbers; blank digits count as zero.
  void read_status() {
    std::array<char, field_width> digits;
    digits.fill('0');
    const std::string_view text = text_of(9);
    bool well_formed = true, begun = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
      const bool blank = text[i] == ' ' || text[i] == '\t';
      const bool digit = text[i] >= '0' && text[i] <= '9';
      begun = begun || !blank;
      well_formed = well_formed && (digit || (blank && !begun));
      if (digit) digits[i] = text[i];
    }
    if (!well_formed)
      say(rules::status_format, 9,
          fmt::format("the status is '{}', not eight digits; blanks and letters count as 0", printable(text)));
    const auto pair = [&digits](std::size_t i) { return (digits[2 * i] - '0') * 10 + (digits[2 * i + 1] - '0'); };
    entry_.status.blank = in_range(rules::blank_status, "blank status", pair(0), 1);
    entry_.status.subordinate = in_range(rules::subordinate, "subordinate switch", pair(1), 3);
    entry_.status.use = in_range(rules::use_flag, "use flag", pair(2), 6);
    entry_.status.hierarchy = in_range(rules::hierarchy, "hierarchy flag", pair(3), 2);
  }

  int in_range(const Rule& rule, const char* name, int value, int largest) {
    if (value <= largest) return value;
    Diagnostic& d = say(rule, 9, fmt::format("the {} is {:02}, more than {:02}; 00 is used", name, value, largest));
    d.measured = value;
    d.limit = largest;
    return 0;
  }

  void read_label() {
    const std::string_view reserved_a = trimmed(text_of(16)), reserved_b = trimmed(text_of(17));
    if (!(reserved_a.empty() || reserved_a == "0") || !(reserved_b.empty() || reserved_b == "0"))
      say(rules::reserved, 16, "the reserved fields are not blank");
    entry_.label = trimmed(text_of(18));
    const std::string_view text = text_of(19);
    const auto subscript = read_columns(text);
    if (!subscript) say(rules::subscript, 19, fmt::format("the subscript is '{}', not a number", printable(text)));
    entry_.subscript = subscript.value_or(0);
  }

  void judge_fields() {
    if (entry_.type == 0 && entry_.usable) say(rules::null_entity, 1, "a null entity: it means nothing");
    if (entry_.type < 0 || (entry_.type != 0 && entity_name(entry_.type).empty() && !is_implementor_type(entry_.type)))
      say(rules::type_unknown, 1,
          fmt::format("type {} is not in the standard; the entity is kept as it is", entry_.type));
    if (entry_.structure != 0 && !has_structure(entry_.type, entry_.form))
      say(rules::structure, 3,
          fmt::format("the structure field is {}; type {} has no use for it", entry_.structure, entry_.type));
    if (entry_.line_weight < 0 || entry_.line_weight > global_.weight_gradations) {
      Diagnostic& d = say(rules::line_weight, 12,
                          fmt::format("the line weight is {} of {}", entry_.line_weight, global_.weight_gradations));
      d.measured = entry_.line_weight;
      d.limit = global_.weight_gradations;
    }
  }

  // -- pointers between entries, once all are known

  void check_pointers() {
    for (DirectoryEntry& e : out_.entries) {
      if ((e.line_font | e.level | e.view | e.transform | e.label_display | e.colour) == 0) continue;
      entry_ = e;
      std::size_t index = section_.index_of(e.de);
      if (index + 1 >= section_.size() || section_.cards[index].offset != e.offset)
        index = static_cast<std::size_t>(e.de - 1);
      card_ = {&section_.cards[index], &section_.cards[index + 1]};
      value_or_pointer(rules::line_font, 4, e.line_font, 5, 304);
      if (e.level < 0)
        pointer(
            rules::level, 5, e.level, true, [](const DirectoryEntry& t) { return t.type == 406 && t.form == 1; },
            "a level list (406 form 1)");
      pointer(
          rules::view, 6, e.view, false,
          [](const DirectoryEntry& t) {
            return t.type == 410 || (t.type == 402 && (t.form == 3 || t.form == 4 || t.form == 19));
          },
          "a view (410, or 402 form 3, 4, 19)");
      pointer(
          rules::transform, 7, e.transform, false, [](const DirectoryEntry& t) { return t.type == 124; },
          "a matrix (124)");
      pointer(
          rules::label_display, 8, e.label_display, false,
          [](const DirectoryEntry& t) { return t.type == 402 && t.form == 5; }, "a label display (402 form 5)");
      value_or_pointer(rules::colour, 13, e.colour, 8, 314);
    }
  }

  // Fields 4 and 13: a small number, or minus a pointer to a definition.
  void value_or_pointer(const Rule& rule, int field, int& value, int largest, int type) {
    if (value < 0) {
      pointer(
          rule, field, value, true, [type](const DirectoryEntry& t) { return t.type == type; },
          fmt::format("a definition ({})", type));
    } else if (value > largest) {
      const DirectoryEntry* target = out_.find(value);
      const bool sign_lost = target && target->type == type;
      if (sign_lost)
        say(rules::pointer_sign, field,
            fmt::format("the {} is {}; a pointer must be negative here and is read so", name(field), value));
      else
        say(rule, field, fmt::format("the {} is {}, more than {}; 0 is used", name(field), value, largest)).measured =
            value;
      value = sign_lost ? -value : 0;
    }
  }

  // What does not reach an entry of the right kind is set to 0, so that nobody follows it.
  template <class Admits>
  void pointer(const Rule& rule, int field, int& value, bool negative, Admits admits, const std::string& wanted) {
    if (value == 0) return;
    const std::int64_t de = std::abs(static_cast<std::int64_t>(value));
    const DirectoryEntry* target = out_.find(de);
    const auto refuse = [&](const Rule& why, std::string reason) {
      say(why, field, fmt::format("the {} is {}, {}; 0 is used", name(field), value, reason));
      value = 0;
    };
    if ((value < 0) != negative) return refuse(rules::pointer_sign, "which has the wrong sign");
    if (de % 2 == 0) return refuse(rules::even_pointer, "the second card of an entry");
    if (!target) return refuse(rules::dangling, "which is not in the Directory");
    if (!admits(*target)) return refuse(rule, fmt::format("an entity {}, not {}", target->type, wanted));
  }

  // -- findings

  static const char* name(int field) { return field_names[static_cast<std::size_t>(field - 1)]; }

  Diagnostic& say(const Rule& rule, int field, std::string text) {
    Diagnostic& d = say(rule, *card_[field > 10], field, std::move(text));
    d.entity = fmt::format("D{}", entry_.de);
    d.type = fmt::format("{}:{}", entry_.type, entry_.form);
    return d;
  }
  Diagnostic& say(const Rule& rule, const Card& card, int field, std::string text) {
    Diagnostic& d = report_.add(rule, std::move(text));
    const std::size_t column = field > 0 ? static_cast<std::size_t>((field - 1) % 10) * field_width : 0;
    d.location.offset = card.offset + (card.rebuilt ? 0 : std::min<std::size_t>(column, card.length));
    d.location.length = field_width;
    return d;
  }

  const Cards& cards_;
  const Section& section_;
  const Global& global_;
  Report& report_;
  Directory out_;
  DirectoryEntry entry_;
  std::array<const Card*, 2> card_{};
};

}  // namespace

Directory read_directory(const Cards& cards, const Global& global, Report& report) {
  return DirectoryReader(cards, global, report).read();
}

}  // namespace trimloop::iges
