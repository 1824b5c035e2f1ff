#include "formats/iges/edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "formats/iges/cards.h"
#include "formats/iges/patches.h"
#include "formats/iges/records/layout.h"
#include "formats/iges/write.h"

namespace trimloop::iges {
namespace {

constexpr std::size_t data_columns = 64;

tl::unexpected<Error> unsupported(std::string text) { return fail(ErrorCode::Unsupported, std::move(text)); }
tl::unexpected<Error> invalid(std::string text) { return fail(ErrorCode::InvalidArgument, std::move(text)); }

// One stretch of a record's text that stays together: a parameter with its delimiter, or the comment behind the record.
struct Unit {
  std::string text;       // blanks before it on its card included
  bool may_be_cut = false;  // was cut before, or is a comment
};

// Where one parameter lies in the joined text.
struct Span {
  std::size_t begin = 0, first = 0, delimiter = 0;  // behind the last delimiter, first non-blank, own delimiter
};

std::vector<Span> spans(const Parameters& p, char pd, char rd) {
  std::vector<Span> out;
  std::size_t begin = 0;
  for (const Token& token : p.tokens) {
    Span s{begin, begin, begin};
    std::size_t from = begin;
    if (token.kind == Token::Kind::Hollerith) from = static_cast<std::size_t>(token.text.data() - p.joined.data()) + token.text.size();
    s.delimiter = p.joined.find_first_of(std::string{pd, rd}, from);
    if (s.delimiter == std::string::npos) return {};
    s.first = std::min(p.joined.find_first_not_of(' ', begin), s.delimiter);
    out.push_back(s);
    begin = s.delimiter + 1;
  }
  return out;
}

class ParameterEdit {
 public:
  ParameterEdit(const File& file, const DirectoryEntry& entry)
      : file_(file), cards_(file.cards()), entry_(entry), old_(file.parameters(entry, ignored_)) {}

  Result<std::string> set(std::size_t index, std::string_view text) {
    if (!old_.terminated) return unsupported(fmt::format("the record of D{} has no end", entry_.de));
    if (index == 0 || index >= old_.tokens.size())
      return invalid(fmt::format("D{} has {} parameters", entry_.de, old_.tokens.size() - 1));
    const char pd = file_.global().parameter_delimiter, rd = file_.global().record_delimiter;
    spans_ = spans(old_, pd, rd);
    if (spans_.size() != old_.tokens.size()) return unsupported(fmt::format("the record of D{} cannot be split", entry_.de));
    return lay_out(index, text);
  }

  // All parameters replaced by a text that fits on one card; the type is the first of them.
  Result<std::string> become(const std::string& text) {
    if (!stands(0, old_.card_count)) return unsupported("the cards do not stand in the file as 80 columns");
    new_data_ = {text};
    return finish(0, old_.card_count);
  }

  Patches patches;  // more may be added before finish() by those who know of other fields

 private:
  std::size_t card_of(std::size_t position) const { return position / data_columns; }
  const Card& card(std::size_t index) const { return cards_.parameter.cards[old_.first_card + index]; }
  bool stands(std::size_t from, std::size_t to) const {
    for (std::size_t i = from; i < to; ++i)
      if (!stands_in_file(card(i))) return false;
    return true;
  }
  bool crosses(const Span& s, std::size_t card) const { return card_of(s.first) < card && card_of(s.delimiter) >= card; }

  Result<std::string> lay_out(std::size_t index, std::string_view text) {
    const Span& changed = spans_[index];
    const std::size_t first = card_of(changed.first);
    // 1. The cards that hang together: no parameter runs over the end of the last of them.
    std::size_t end = card_of(changed.delimiter) + 1, unit = index + 1;
    for (; unit < spans_.size() && (card_of(spans_[unit].first) < end); ++unit)
      end = std::max(end, card_of(spans_[unit].delimiter) + 1);
    std::vector<Unit> units;
    const auto leading = [&](const Span& s) {
      return old_.joined.substr(std::max(s.begin, card_of(s.first) * data_columns), s.first - std::max(s.begin, card_of(s.first) * data_columns));
    };
    units.push_back({leading(changed) + std::string(text) + old_.joined[changed.delimiter], text.size() >= data_columns});
    for (std::size_t i = index + 1; i < unit; ++i) {
      const Span& s = spans_[i];
      units.push_back({leading(s) + old_.joined.substr(s.first, s.delimiter + 1 - s.first), card_of(s.first) != card_of(s.delimiter)});
    }
    if (unit == spans_.size()) {  // the comment behind the record moves with it
      const std::size_t from = spans_.back().delimiter + 1, last = old_.joined.find_last_not_of(' ');
      if (last != std::string::npos && last >= from) {
        units.push_back({old_.joined.substr(from, last + 1 - from), true});
        end = std::max(end, card_of(last) + 1);
      }
    }
    if (!stands(first, end)) return unsupported("the cards do not stand in the file as 80 columns");
    // 2. What stands before the changed parameter stays; the rest follows, cut where it does not fit.
    const std::size_t column = std::max(changed.begin, first * data_columns) - first * data_columns;
    std::string line = old_.joined.substr(first * data_columns, column);
    const auto flush = [&] {
      new_data_.push_back(std::move(line));
      line.clear();
    };
    for (const Unit& u : units) {
      std::string_view rest = u.text;
      if (line.size() + rest.size() > data_columns && !u.may_be_cut && !line.empty()) {
        flush();
        rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
      }
      while (line.size() + rest.size() > data_columns) {
        const std::size_t room = data_columns - line.size();
        line += rest.substr(0, room);
        rest.remove_prefix(room);
        flush();
      }
      line += rest;
    }
    if (!line.empty()) flush();
    return finish(first, end);
  }

  // Puts new_data_ in place of the cards [from, to) of the record and moves what must move.
  Result<std::string> finish(std::size_t from, std::size_t to) {
    const std::size_t old_count = to - from, new_count = new_data_.size();
    const std::size_t kept = std::min(old_count, new_count);
    for (std::size_t i = 0; i < kept; ++i) {
      std::string data = new_data_[i];
      data.resize(data_columns, ' ');
      patches.replace(card(from + i).offset, data_columns, std::move(data));
    }
    const std::int64_t delta = static_cast<std::int64_t>(new_count) - static_cast<std::int64_t>(old_count);
    if (delta != 0) {
      if (auto moved = move_cards(from, to, kept, delta); !moved) return tl::unexpected<Error>(moved.error());
    }
    return patches.apply(file_.bytes());
  }

  Result<bool> move_cards(std::size_t from, std::size_t to, std::size_t kept, std::int64_t delta) {
    const Section& section = cards_.parameter;
    const std::size_t behind = old_.first_card + to;  // first card that only gets another number
    if (section.size() + static_cast<std::size_t>(std::max<std::int64_t>(delta, 0)) > 9'999'999)
      return fail(ErrorCode::Limit, "the Parameter section would need more cards than seven digits can count");
    for (std::size_t i = 0; i < section.size(); ++i)
      if (section.number(i) != static_cast<std::int32_t>(i + 1) || !stands_in_file(section.cards[i]))
        return unsupported("the Parameter cards are not numbered from 1; a card more or less would tear their pointers");
    // Cards that go, cards that come.
    const std::size_t after = from + kept;
    if (delta < 0) {
      const std::size_t begin = card(after).offset, end = next_line(cards_, card(to - 1));
      patches.replace(begin, end - begin, {});
    } else {
      const Card& model = card(to - 1);
      const std::string back_pointer(cards_.columns(model, data_columns, 8)), line_end = line_end_after(cards_, model);
      std::string text;
      for (std::size_t i = kept; i < new_data_.size(); ++i) {
        std::string data = new_data_[i];
        data.resize(data_columns, ' ');
        text += data + back_pointer + 'P' +
                restyled(cards_.columns(model, 73, 7), static_cast<std::int64_t>(old_.first_card + from + i + 1)) + line_end;
      }
      patches.replace(next_line(cards_, model), 0, std::move(text));
    }
    for (std::size_t i = behind; i < section.size(); ++i) shift_field(patches, cards_, section.cards[i], 73, 7, delta);
    // Pointers to the data behind, the entity's own count, the Terminate card.
    for (const DirectoryEntry& e : file_.directory()) {
      const EntryCards own = directory_cards(cards_, e);
      if (!own.first) continue;
      if (e.parameter_pointer > static_cast<std::int64_t>(behind)) shift_field(patches, cards_, *own.first, 8, 8, delta);
      if (e.de == entry_.de) shift_field(patches, cards_, *own.second, 24, 8, delta);
    }
    if (cards_.terminated) shift_field(patches, cards_, cards_.terminate, 25, 7, delta);
    return true;
  }

  const File& file_;
  const Cards& cards_;
  const DirectoryEntry& entry_;
  Report ignored_;
  Parameters old_;
  std::vector<Span> spans_;
  std::vector<std::string> new_data_;  // of the cards that change
};

bool has_delimiter_outside_strings(const File& file, std::string_view text) {
  const std::string delimiters{file.global().parameter_delimiter, file.global().record_delimiter};
  const std::size_t h = text.find('H');
  const NumberText<std::int64_t> count = read_integer(text.substr(0, h == std::string_view::npos ? 0 : h));
  if (h != std::string_view::npos && count && count.value >= 0 && static_cast<std::size_t>(count.value) + h + 1 == text.size())
    return false;
  return text.find_first_of(delimiters) != std::string_view::npos;
}

const DirectoryEntry* usable(const File& file, Ref ref) {
  const DirectoryEntry* entry = ref ? file.find(ref) : nullptr;
  return entry && entry->usable ? entry : nullptr;
}

}  // namespace

Result<std::string> set_parameter(const File& file, Ref entity, std::size_t index, std::string_view text) {
  const DirectoryEntry* entry = usable(file, entity);
  if (!entry) return invalid(fmt::format("there is no entity D{} with data", entity.de));
  if (has_delimiter_outside_strings(file, text)) return invalid("the text holds a delimiter of the file");
  for (const char c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == '\x7f') return invalid("the text holds a control character");
  return ParameterEdit(file, *entry).set(index, text);
}

Result<Added> add_entity(const File& file, DirectoryEntry entry, const std::vector<std::string>& tokens) {
  const Cards& cards = file.cards();
  const Section &d = cards.directory, &p = cards.parameter;
  if (d.empty() || p.empty() || !stands_in_file(d.cards.back()) || !stands_in_file(p.cards.back()))
    return unsupported("the last cards do not stand in the file as 80 columns");
  const std::int32_t last_d = d.number(d.size() - 1), last_p = p.number(p.size() - 1);
  // The cards come from the writer of whole files, then get the numbers of this one.
  Global global = file.global();
  Writer writer(global);
  writer.add(entry, tokens);
  const Result<std::string> made = writer.finish();
  if (!made) return tl::unexpected<Error>(made.error());
  Report ignored;
  const Cards fresh = split_cards(*made, ignored);
  const std::int32_t de = last_d + 1;
  const auto numbered = [](std::string card, char section, std::int64_t number) {
    return card.substr(0, 72) + section + fmt::format("{:>7}", number);
  };
  std::string directory, parameter;
  const std::string d_end = line_end_after(cards, d.cards.back()), p_end = line_end_after(cards, p.cards.back());
  for (std::size_t i = 0; i < 2; ++i) {
    std::string card(fresh.columns(fresh.directory.cards[i], 0, 80));
    if (i == 0) card.replace(8, 8, fmt::format("{:>8}", last_p + 1));
    directory += numbered(card, 'D', last_d + 1 + static_cast<std::int64_t>(i)) + d_end;
  }
  for (std::size_t i = 0; i < fresh.parameter.size(); ++i) {
    std::string card(fresh.columns(fresh.parameter.cards[i], 0, 80));
    card.replace(64, 8, fmt::format("{:>8}", de));
    parameter += numbered(card, 'P', last_p + 1 + static_cast<std::int64_t>(i)) + p_end;
  }
  Patches patches;
  patches.replace(next_line(cards, d.cards.back()), 0, std::move(directory));
  patches.replace(next_line(cards, p.cards.back()), 0, std::move(parameter));
  if (cards.terminated) {
    shift_field(patches, cards, cards.terminate, 17, 7, 2);
    shift_field(patches, cards, cards.terminate, 25, 7, static_cast<std::int64_t>(fresh.parameter.size()));
  }
  return Added{patches.apply(file.bytes()), Ref{de}};
}

Result<std::string> remove_entity(const File& file, Ref entity) {
  const DirectoryEntry* entry = usable(file, entity);
  if (!entry) return invalid(fmt::format("there is no entity D{} with data", entity.de));
  if (const std::vector<Ref> users = pointing_at(file, entity); !users.empty())
    return invalid(fmt::format("D{} and {} more point to D{}", users[0].de, users.size() - 1, entity.de));
  const EntryCards own = directory_cards(file.cards(), *entry);
  if (!own.first || !stands_in_file(*own.first) || !stands_in_file(*own.second))
    return unsupported("the cards do not stand in the file as 80 columns");
  ParameterEdit edit(file, *entry);
  for (const Card* card : {own.first, own.second})
    edit.patches.replace(card->offset, 8, restyled(file.cards().columns(*card, 0, 8), 0));
  return edit.become(fmt::format("0{}", file.global().record_delimiter));
}

namespace {

// The letters of a record's own parameters ("" where the type has no layout).
std::string kinds_of(const DirectoryEntry& entry, const Parameters& parameters) {
  const Layout* layout = find_layout(entry.type, entry.form);
  if (!layout || parameters.tokens.empty()) return {};
  return LayoutWalk(*layout, parameters.tokens.size() - 1, [&](std::size_t i) -> std::optional<std::int64_t> {
           if (i >= parameters.tokens.size() || parameters.tokens[i].kind != Token::Kind::Text) return {};
           const NumberText<std::int64_t> number = read_integer(parameters.tokens[i].text);
           return number ? std::optional(number.value) : std::nullopt;
         }).kinds();
}

}  // namespace

namespace {

// Shortest text that reads back to the same bits. Where the file declares fewer digits than that takes (Global 9 and 11, the
// larger one), the value is rounded to them first: no receiver has to keep more. Refused beyond the declared power of ten.
Result<std::string> real_within(const Global& global, double value) {
  constexpr int most_digits = 17;
  const int digits = std::max(global.single_significance, global.double_significance);
  const int largest = std::max(global.single_magnitude, global.double_magnitude);
  if (value != 0 && std::abs(value) >= std::pow(10.0, largest) && largest < 308)
    return invalid(fmt::format("{} is beyond the power of ten that the file declares, {}", value, largest));
  if (digits < most_digits) {
    const NumberText<double> rounded = read_real(fmt::format("{:.{}E}", value, digits - 1));
    if (rounded) value = rounded.value;
  }
  return iges_real(value);
}

}  // namespace

Result<std::string> parameter_text(const File& file, Ref entity, std::size_t index, std::string_view value) {
  const DirectoryEntry* entry = usable(file, entity);
  if (!entry) return invalid(fmt::format("there is no entity D{} with data", entity.de));
  if (value.empty()) return std::string();
  Report ignored;
  const Parameters parameters = file.parameters(*entry, ignored);
  const std::string kinds = kinds_of(*entry, parameters);
  const char kind = index >= 1 && index <= kinds.size() ? kinds[index - 1] : 't';
  const NumberText<std::int64_t> integer = read_integer(value);
  switch (kind) {
    case 'r': {
      const NumberText<double> real = read_real(value);
      if (!real) return invalid(fmt::format("'{}' is no real", value));
      return real_within(file.global(), real.value);
    }
    case 'n': case 'i': case 'l': case 'p': case 'P': {
      const std::string_view number = kind == 'p' && value[0] == 'D' ? value.substr(1) : value;
      const NumberText<std::int64_t> whole = kind == 'p' ? read_integer(number) : integer;
      if (!whole) return invalid(fmt::format("'{}' is no integer", value));
      return std::to_string(whole.value);
    }
    case 's':
      return fmt::format("{}H{}", value.size(), value);
    default:
      if (integer) return std::to_string(integer.value);
      if (const NumberText<double> real = read_real(value)) return iges_real(real.value);
      return fmt::format("{}H{}", value.size(), value);
  }
}

std::vector<Ref> pointing_at(const File& file, Ref entity) {
  std::vector<Ref> out;
  Report ignored;
  Parameters parameters;
  for (const DirectoryEntry& e : file.directory()) {
    if (e.de == entity.de || !e.usable) continue;
    bool points = false;
    for (const int field : {e.structure, e.line_font, e.level, e.view, e.transform, e.label_display, e.colour})
      points = points || field == -entity.de;
    points = points || e.view == entity.de || e.transform == entity.de || e.label_display == entity.de;
    file.parameters(e, parameters, ignored);
    const std::string kinds = kinds_of(e, parameters);
    for (std::size_t i = 1; i < parameters.tokens.size() && !points; ++i) {
      if (parameters.tokens[i].kind != Token::Kind::Text) continue;
      const char kind = i <= kinds.size() ? kinds[i - 1] : 'p';
      if (kind != 'p' && kind != 'P' && kind != 't') continue;
      const NumberText<std::int64_t> number = read_integer(parameters.tokens[i].text);
      points = number && (number.value == -entity.de || (kind != 'P' && number.value == entity.de));
    }
    if (points) out.push_back(Ref{e.de});
  }
  return out;
}

}  // namespace trimloop::iges
