#include "formats/iges/cards.h"

#include <fmt/format.h>

#include <algorithm>

#include "formats/iges/rules.h"

namespace trimloop::iges {

// ---- Section

bool Section::add(Card card, std::int32_t number) {
  const std::int32_t last = cards.empty() ? 0 : this->number(cards.size() - 1);
  const bool follows = number == last + 1;
  if (state_ != Numbers::Useless && !follows && number > 0) {
    if (number > last) {
      if (state_ == Numbers::Regular)
        for (std::size_t i = 1; i <= cards.size(); ++i) numbers_.push_back(static_cast<std::int32_t>(i));
      state_ = Numbers::Ascending;
    } else {
      count_from_one();
    }
  }
  cards.push_back(card);
  if (state_ == Numbers::Ascending) numbers_.push_back(number > 0 ? number : last + 1);
  return follows;
}

std::int32_t Section::number(std::size_t index) const {
  return state_ == Numbers::Ascending ? numbers_[index] : static_cast<std::int32_t>(index + 1);
}

std::size_t Section::index_of(std::int64_t number) const {
  if (number <= 0) return size();
  if (state_ != Numbers::Ascending) return std::min(size(), static_cast<std::size_t>(number - 1));
  const auto found = std::lower_bound(numbers_.begin(), numbers_.end(), number);
  return found != numbers_.end() && *found == number ? static_cast<std::size_t>(found - numbers_.begin()) : size();
}

void Section::count_from_one() {
  state_ = Numbers::Useless;
  numbers_ = {};
}

// ---- Cards

char Cards::section_at(std::size_t offset) const {
  char letter = 0;
  std::size_t nearest = 0;
  const auto look = [&](const Card& card, char name) {
    if (card.offset <= offset && (letter == 0 || card.offset >= nearest)) nearest = card.offset, letter = name;
  };
  const auto look_in = [&](const Section& section, char name) {
    const auto after = std::upper_bound(section.cards.begin(), section.cards.end(), offset,
                                        [](std::size_t o, const Card& c) { return o < c.offset; });
    if (after != section.cards.begin()) look(*(after - 1), name);
  };
  look_in(start, 'S');
  look_in(global, 'G');
  look_in(directory, 'D');
  look_in(parameter, 'P');
  if (terminated) look(terminate, 'T');
  return letter;
}

// ---- Splitting

namespace {

constexpr std::size_t card_columns = 80, letter_column = 72;
constexpr std::size_t search_window = 64 * 1024;  // without a card in it, the file is not IGES
constexpr std::size_t widest_shift = 8;           // columns that a card may be displaced to the right

bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Upper-case section letter, or 0.
char as_section(char c) {
  switch (c) {
    case 'S':
    case 'G':
    case 'D':
    case 'P':
    case 'T':
      return c;
    case 's':
    case 'g':
    case 'd':
    case 'p':
    case 't':
      return static_cast<char>(c - 'a' + 'A');
    default:
      return 0;
  }
}

// Columns 74-80: digits with blanks around them, or nothing.
struct Sequence {
  bool plausible = true;    // nothing but digits and blanks
  bool justified = true;    // right-aligned, no leading zeros
  std::int32_t number = 0;  // 0: none that can be read
};

Sequence read_sequence(std::string_view field) {
  Sequence out;
  std::size_t i = 0, digits = 0;
  while (i < field.size() && is_blank(field[i])) ++i;
  out.justified = i == field.size() || field[i] != '0';
  for (; i < field.size() && is_digit(field[i]); ++i, ++digits) out.number = out.number * 10 + (field[i] - '0');
  if (i < field.size()) out.justified = false;
  for (; i < field.size(); ++i) out.plausible = out.plausible && is_blank(field[i]);
  if (!out.plausible) out.number = 0;
  return out;
}

bool all_blank(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return is_blank(c) || c == '\0' || c == '\x1a'; });
}

std::string_view without_trailing_blanks(std::string_view text) {
  while (!text.empty() && (is_blank(text.back()) || text.back() == '\0' || text.back() == '\x1a'))
    text.remove_suffix(1);
  return text;
}

// Something that is wrong in the same way on many cards: one finding says how often and where first.
struct Tally {
  std::size_t count = 0, first = 0, length = 0;
  void add(std::size_t offset, std::size_t bytes = card_columns) {
    if (count++ == 0) first = offset, length = bytes;
  }
};

class Splitter {
 public:
  Splitter(std::string_view bytes, Report& report) : report_(report) { cards_.bytes = bytes; }

  Cards run() {
    skip_byte_order_mark();
    while (offset_ < bytes().size() && !hopeless_) next_line();
    judge();
    return std::move(cards_);
  }

 private:
  std::string_view bytes() const { return cards_.bytes; }
  bool has_cards() const {
    return !cards_.start.empty() || !cards_.global.empty() || !cards_.directory.empty() || !cards_.parameter.empty();
  }

  void skip_byte_order_mark() {
    if (bytes().substr(0, 3) == "\xEF\xBB\xBF") leading_.add(0, 3), offset_ = 3;
  }

  // -- lines

  void next_line() {
    // The next LF and CR are looked up once and remembered, so that a file without one of them stays linear.
    if (lf_ == unknown || lf_ < offset_) lf_ = bytes().find('\n', offset_);
    if (cr_ == unknown || cr_ < offset_) cr_ = bytes().find('\r', offset_);
    const std::size_t end = std::min({lf_, cr_, bytes().size()});
    std::size_t next = end;
    if (end < bytes().size()) {
      const bool pair = end == cr_ && lf_ == cr_ + 1;
      next += pair ? 2 : 1;
      ++(pair ? crlf_lines_ : end == cr_ ? cr_lines_ : lf_lines_);
    }
    measure_stride(next - offset_);
    read_line(bytes().substr(offset_, end - offset_), offset_, next > end);
    offset_ = next;
  }

  void measure_stride(std::size_t length) {
    if (offset_ == 0) cards_.stride = length;
    if (cards_.regular_end == offset_ && length == cards_.stride) cards_.regular_end = offset_ + length;
  }

  void read_line(std::string_view line, std::size_t offset, bool has_end) {
    if (cards_.terminated) return behind_terminate(line, offset);
    std::size_t used = 0;
    bool first = true;
    while (used < line.size()) {
      const std::string_view rest = line.substr(used);
      const std::size_t taken = take_card(rest, offset + used, has_end);
      if (taken == 0) {
        no_card(rest, offset + used, has_end, first);
        return;
      }
      used += taken;
      if (!first) merged_.add(offset + used - taken);
      first = false;
      if (cards_.terminated && used < line.size()) return behind_terminate(line.substr(used), offset + used);
    }
  }

  void behind_terminate(std::string_view line, std::size_t offset) {
    if (without_trailing_blanks(line).empty()) {
      if (line.find('\x1a') != std::string_view::npos) dos_end_.add(offset, line.size());
      return;
    }
    behind_.add(offset, line.size());
    for (std::size_t at = 0; at + letter_column < line.size(); at += card_columns)  // a line may hold several cards
      if (line[at + letter_column] == 'T' && read_sequence(line.substr(at + letter_column + 1, 7)).number > 0)
        second_terminate_.add(offset + at);
  }

  void no_card(std::string_view rest, std::size_t offset, bool has_end, bool whole_line) {
    if (all_blank(rest)) return;
    if (!has_end && rest.size() < card_columns) {
      cards_.cut_off = true;
      cut_.add(offset, rest.size());
    } else if (!has_cards()) {
      leading_.add(offset, rest.size());
      hopeless_ = offset + rest.size() > search_window;
    } else if (!whole_line) {
      long_.add(offset, rest.size());
    } else if (rest.size() > letter_column && !is_blank(rest[letter_column]) &&
               read_sequence(rest.substr(73, 7)).number > 0) {
      unknown_letter_.add(offset);
    } else {
      short_.add(offset, rest.size());
    }
  }

  // -- cards

  // Takes the card at the start of `rest`; returns how many bytes it used up, 0 when there is none.
  std::size_t take_card(std::string_view rest, std::size_t offset, bool has_end) {
    if (rest.size() > letter_column && as_section(rest[letter_column])) {
      const Sequence sequence = read_sequence(rest.substr(letter_column + 1, 7));
      // Without a number, the letter alone may open a file only as S: any text may have a capital in column 73.
      const bool may_lack_number = has_cards() ? as_section(rest[letter_column]) == rest[letter_column]
                                               : rest[letter_column] == 'S' && (rest.size() == 73 || rest.size() >= 80);
      const bool numbered = sequence.plausible && (sequence.number > 0 || may_lack_number);
      const bool card_like = has_cards() && rest.size() >= 78 && rest.size() <= 82;
      if (numbered || card_like) {
        const std::size_t length = std::min(rest.size(), card_columns);
        if (length < card_columns) note_short(rest, offset, has_end);
        add({offset, 0, static_cast<std::uint32_t>(length)}, rest[letter_column], sequence);
        return with_trailing_blanks(rest, card_columns);
      }
    }
    if (const std::size_t taken = take_displaced(rest, offset)) return taken;
    if (rest.substr(0, card_columns).find('\t') != std::string_view::npos) return take_tabbed(rest, offset);
    return 0;
  }

  void note_short(std::string_view rest, std::size_t offset, bool has_end) {
    if (has_end || as_section(rest[letter_column]) == 'T') {
      short_cards_.add(offset, rest.size());
    } else {
      cards_.cut_off = true;
      cut_.add(offset, rest.size());
    }
  }

  // Trailing blanks behind a card belong to it.
  static std::size_t with_trailing_blanks(std::string_view rest, std::size_t columns) {
    if (rest.size() <= columns) return rest.size();
    const std::string_view tail = rest.substr(columns);
    const bool blanks = tail.size() < card_columns && all_blank(tail) && tail.find('\x1a') == std::string_view::npos;
    return blanks ? rest.size() : columns;
  }

  // A card whose letter stands a few columns to the right, at the end of its line: stray characters came in somewhere,
  // or a multi-byte character counts as one column for its writer.
  std::size_t take_displaced(std::string_view rest, std::size_t offset) {
    const std::string_view text = without_trailing_blanks(rest);
    if (text.size() <= letter_column + 1 || text.size() > card_columns + widest_shift) return 0;
    std::size_t at = text.size() - 1;
    while (at > letter_column && is_digit(text[at])) --at;
    while (at > letter_column && is_blank(text[at])) --at;
    const char letter = as_section(text[at]);
    if (at <= letter_column || !letter || text.size() - at > 8) return 0;
    const Sequence sequence = read_sequence(text.substr(at + 1));
    if (sequence.number == 0) return 0;

    const std::size_t shift = at - letter_column;
    if (letter == 'D' || all_blank(text.substr(0, shift))) {
      shifted_.add(offset, rest.size());
      add({offset + shift, 0, static_cast<std::uint32_t>(text.size() - shift)}, letter, sequence);
      return rest.size();
    }
    const std::size_t data = letter == 'P' ? 64 : 72;
    std::string columns(text.substr(0, data));
    columns += text.substr(data + shift);
    shifted_.add(offset, rest.size());
    return add_rebuilt(columns, offset, letter, sequence) ? rest.size() : 0;
  }

  // A card with tabs in place of blanks: tabs to every eighth column.
  std::size_t take_tabbed(std::string_view rest, std::size_t offset) {
    std::string columns;
    std::size_t used = 0;
    for (; used < rest.size() && columns.size() < card_columns; ++used) {
      if (rest[used] == '\t')
        columns.resize((columns.size() / 8 + 1) * 8, ' ');
      else
        columns += rest[used];
    }
    if (columns.size() <= letter_column || !as_section(columns[letter_column])) return 0;
    const Sequence sequence = read_sequence(std::string_view(columns).substr(letter_column + 1, 7));
    if (sequence.number == 0) return 0;
    tab_.add(offset, rest.size());
    return add_rebuilt(columns, offset, columns[letter_column], sequence) ? with_trailing_blanks(rest, used) : 0;
  }

  bool add_rebuilt(std::string& columns, std::size_t offset, char letter, Sequence sequence) {
    // Tabs make little text into much: rebuilt cards may take as much memory as the file, and no more.
    if (cards_.rebuilt.size() > bytes().size()) return false;
    if (cards_.rebuilt.empty()) cards_.rebuilt.reserve(bytes().size() + 2 * card_columns);
    columns.resize(card_columns, ' ');
    cards_.rebuilt += columns;
    const auto number = static_cast<std::uint32_t>(cards_.rebuilt.size() / card_columns);
    add({offset, number, card_columns}, letter, sequence);
    return true;
  }

  void add(Card card, char written, Sequence sequence) {
    const char letter = as_section(written);
    if (letter != written) lower_case_.add(card.offset);
    const std::size_t rank = std::string_view("SGDPT").find(letter);
    if (rank < rank_) disorder_.add(card.offset);
    if (letter == 'G' && (!cards_.directory.empty() || !cards_.parameter.empty()) && cards_.global.empty())
      late_global_.add(card.offset);
    rank_ = rank;

    if (letter == 'T') {
      cards_.terminate = card;
      cards_.terminated = true;
      return;
    }
    Section& section = letter == 'S'   ? cards_.start
                       : letter == 'G' ? cards_.global
                       : letter == 'D' ? cards_.directory
                                       : cards_.parameter;
    if (letter == 'P') {
      if (section.empty()) section.cards.reserve((bytes().size() - offset_) / (card_columns + 1) + 1);
      if (const std::string_view gap = cards_.columns(card, 64, 1); !gap.empty() && !is_blank(gap[0]))
        column65_.add(card.offset);
    }
    if (!section.add(card, sequence.number)) misnumbered_.add(card.offset);
    if (!sequence.justified) unjustified_.add(card.offset);
  }

  // -- findings

  void say(const Rule& rule, Severity severity, const Tally& tally, std::string text) {
    if (tally.count) report_.add(rule, severity, std::move(text)).location = {tally.first, tally.length};
  }

  void judge() {
    judge_lines();
    judge_cards();
    judge_sections();
  }

  void judge_lines() {
    const int kinds = (lf_lines_ > 0) + (crlf_lines_ > 0) + (cr_lines_ > 0);
    if (kinds > 1)
      say(rules::line_ending_mix, Severity::Info, {1, 0, 0},
          fmt::format("{} lines end with LF, {} with CRLF and {} with CR", lf_lines_, crlf_lines_, cr_lines_));
    if (kinds == 0 && merged_.count)
      say(rules::line_ending_mix, Severity::Info, {1, 0, 0}, "the file is one stream of cards without line ends");
    else
      say(rules::merged_cards, Severity::Warning, merged_,
          fmt::format("{} cards follow another one on the same line", merged_.count));
    say(rules::leading_junk, Severity::Warning, leading_,
        fmt::format("{} pieces of text stand before the first card", leading_.count));
    judge_characters();
  }

  // One fast look at all bytes; only a file that has odd ones is looked at again.
  void judge_characters() {
    unsigned char odd = 0;  // all in bytes, so that the compiler takes many at a time
    for (char c : bytes()) {
      const auto byte = static_cast<unsigned char>(c);
      odd |= static_cast<unsigned char>((static_cast<unsigned char>(byte - 0x20) >= 0x5f) & (byte != '\n') &
                                        (byte != '\r'));
    }
    if (!odd || !has_cards()) return;
    Tally strange, tabs;
    const std::size_t end =
        cards_.terminated ? std::min(bytes().size(), cards_.terminate.offset + card_columns) : bytes().size();
    for (std::size_t i = 0; i < end; ++i) {
      const auto c = static_cast<unsigned char>(bytes()[i]);
      if (c == '\t')
        tabs.add(i, 1);
      else if ((c < 0x20 && c != '\n' && c != '\r') || c >= 0x7f)
        strange.add(i, 1);
    }
    say(rules::tab, Severity::Warning, tabs, fmt::format("{} tabs; columns behind them are uncertain", tabs.count));
    say(rules::non_ascii, Severity::Warning, strange,
        fmt::format("{} bytes are no printing ASCII characters; the first is \\x{:02X}", strange.count,
                    static_cast<unsigned>(static_cast<unsigned char>(strange.count ? bytes()[strange.first] : 0))));
  }

  void judge_cards() {
    say(rules::card_length, Severity::Warning, short_cards_,
        fmt::format("{} cards have less than 80 columns", short_cards_.count));
    say(rules::card_length, Severity::Error, short_,
        fmt::format("{} lines are no cards: nothing in column 73 names their section; they are not read",
                    short_.count));
    say(rules::card_length, Severity::Error, long_,
        fmt::format("{} lines go on after column 80; that text is not read", long_.count));
    say(rules::section_letter, Severity::Error, unknown_letter_,
        fmt::format("{} cards have another letter than S, G, D, P, T in column 73; they are not read",
                    unknown_letter_.count));
    say(rules::section_letter, Severity::Error, lower_case_,
        fmt::format("{} cards have a small section letter; they are read as if it were a capital", lower_case_.count));
    say(rules::column_shift, Severity::Warning, shifted_,
        fmt::format("{} cards have their section letter to the right of column 73 and are read shifted",
                    shifted_.count));
    say(rules::sequence_number, Severity::Warning, misnumbered_,
        fmt::format("{} cards do not have the next sequence number of their section", misnumbered_.count));
    say(rules::sequence_justify, Severity::Info, unjustified_,
        fmt::format("{} sequence numbers are not right-justified", unjustified_.count));
    say(rules::pd_column65, Severity::Info, column65_,
        fmt::format("{} Parameter cards have a character in column 65", column65_.count));
    say(rules::truncated, Severity::Error, cut_, fmt::format("the file ends after {} columns of a card", cut_.length));
  }

  void judge_sections() {
    const Tally at_start{1, 0, 0}, at_end{1, bytes().size(), 0};
    if (!has_cards()) {
      say(rules::not_iges, Severity::Fatal, at_start,
          "no card with a section letter S, G, D, P or T in column 73 was found");
      return;
    }
    if (late_global_.count)
      say(rules::section_order, Severity::Fatal, late_global_,
          "the Global section comes after the Directory or Parameter section");
    else
      say(rules::section_order, Severity::Error, disorder_,
          fmt::format("{} cards belong to a section that came before", disorder_.count));
    if (cards_.start.empty()) say(rules::start_missing, Severity::Warning, at_start, "there is no Start section");
    if (cards_.directory.empty()) say(rules::empty_section, Severity::Error, at_end, "there is no Directory section");
    if (cards_.parameter.empty()) say(rules::empty_section, Severity::Error, at_end, "there is no Parameter section");
    if (!cards_.terminated) say(rules::terminate_missing, Severity::Error, at_end, "there is no Terminate card");
    say(rules::terminate_repeat, Severity::Error, second_terminate_,
        fmt::format("{} more Terminate cards follow the first; nothing behind the first is read",
                    second_terminate_.count));
    say(rules::after_terminate, Severity::Warning, behind_,
        fmt::format("{} lines follow the Terminate card", behind_.count));
    if (!behind_.count)
      say(rules::after_terminate, Severity::Info, dos_end_, "a DOS end-of-file byte follows the Terminate card");
  }

  Report& report_;
  Cards cards_;
  std::size_t offset_ = 0, rank_ = 0;
  static constexpr std::size_t unknown = std::string_view::npos - 1;
  std::size_t lf_ = unknown, cr_ = unknown;
  bool hopeless_ = false;
  std::size_t lf_lines_ = 0, crlf_lines_ = 0, cr_lines_ = 0;
  Tally leading_, merged_, cut_, short_, short_cards_, long_, unknown_letter_, lower_case_, shifted_, tab_,
      misnumbered_, unjustified_, column65_, disorder_, late_global_, behind_, second_terminate_, dos_end_;
};

}  // namespace

Cards split_cards(std::string_view bytes, Report& report) { return Splitter(bytes, report).run(); }

}  // namespace trimloop::iges
