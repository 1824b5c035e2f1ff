#include "formats/iges/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>

#include "base/assert.h"
#include "base/bytes.h"
#include "formats/iges/cards.h"
#include "formats/iges/directory.h"
#include "formats/iges/global.h"
#include "formats/iges/rules.h"
#include "formats/iges/tokens.h"

namespace trimloop::iges {
namespace {

constexpr std::size_t parameter_columns = 64;

// Both while the offset is still a position in the joined text.
bool runs_over(const Token& token) {
  return token.kind == Token::Kind::Text &&
         token.offset / parameter_columns != (token.offset + token.text.size() - 1) / parameter_columns;
}
std::size_t place_of(const Card* first, std::size_t count, std::size_t position) {
  return offset_in_file(first, count, parameter_columns, position);
}

// io refuses such files before it reads them; this is for those who bring bytes of their own.
constexpr Rule file_size{"LM-01",
                         "file-size",
                         Severity::Fatal,
                         "the file is not larger than the ceiling",
                         "a file beyond the ceiling could exhaust memory or time",
                         "raise --limit-size if you trust the file",
                         "bytes",
                         ""};

}  // namespace

struct File::Impl {
  std::string bytes;
  Cards cards;
  Global global;
  std::string start_text;
  Directory directory;
  std::vector<CardRange> ranges;  // of each entry
  Lexer lexer{',', ';'};

  mutable std::once_flag lines_built;
  mutable std::optional<LineIndex> lines;

  void read(const Limits& limits, Report& report);
  void read_start();
  void check_terminate(Report& report) const;
  void check_last_record(Report& report) const;
  Location locate(std::size_t offset) const;
  std::size_t index_of(const DirectoryEntry& entry) const;
  void lex(const DirectoryEntry& entry, Parameters& out, Report& report) const;
  void report_faults(const DirectoryEntry& entry, const Parameters& out, const std::vector<LexFault>& faults,
                     Report& report) const;
};

File::File() : impl_(std::make_unique<Impl>()) {}
File::File(File&&) noexcept = default;
File& File::operator=(File&&) noexcept = default;
File::~File() = default;

// ---- Structure

File File::parse(std::string bytes, const Limits& limits, Report& report) {
  File file;
  file.impl_->bytes = std::move(bytes);
  Report found;  // with offsets only, until lines can be told
  file.impl_->read(limits, found);
  found.sort();
  found.locate([&file](Location& place) {
    const std::size_t length = place.length;
    place = file.impl_->locate(place.offset);
    place.length = length;
  });
  report.append(std::move(found));
  return file;
}

void File::Impl::read(const Limits& limits, Report& report) {
  if (bytes.size() > limits.file_bytes) {
    Diagnostic& d = report.add(
        file_size, fmt::format("the file has {} bytes, more than the limit of {}", bytes.size(), limits.file_bytes));
    d.measured = static_cast<double>(bytes.size());
    d.limit = static_cast<double>(limits.file_bytes);
    return;
  }
  const Sniff kind = sniff(bytes);
  if (kind == Sniff::CompressedAscii || kind == Sniff::Binary) {
    report
        .add(rules::representation, fmt::format("the file is {} IGES, an obsolete form that cannot be read",
                                                kind == Sniff::Binary ? "binary" : "compressed ASCII"))
        .location.offset = 0;
    return;
  }
  cards = split_cards(bytes, report);
  read_start();
  if (report.has_fatal()) return;
  global = read_global(cards, report);
  if (report.has_fatal()) return;
  lexer = Lexer(global.parameter_delimiter, global.record_delimiter);
  directory = read_directory(cards, global, report);
  ranges = assign_parameter_cards(cards, global, directory, report);
  check_terminate(report);
  check_last_record(report);
}

void File::Impl::read_start() {
  for (const Card& card : cards.start.cards) {
    std::string_view line = cards.columns(card, 0, 72);
    line = line.substr(0, line.find_last_not_of(' ') + 1);
    (start_text += line) += '\n';
  }
}

// 2.2.4.6: S, G, D and P with the number of cards, eight columns each.
void File::Impl::check_terminate(Report& report) const {
  if (!cards.terminated) return;
  const Section* sections[] = {&cards.start, &cards.global, &cards.directory, &cards.parameter};
  std::string wrong;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::string_view field = cards.columns(cards.terminate, 8 * i, 8);
    const auto stated = field.empty() ? std::nullopt : read_columns(field.substr(1));
    const std::size_t real = sections[i]->size();
    if (!stated || static_cast<std::size_t>(*stated) != real)
      wrong += fmt::format("{}{} {} (the file has {})", wrong.empty() ? "" : ", ", "SGDP"[i], printable(field), real);
  }
  if (!wrong.empty())
    report.add(rules::terminate_counts, "the Terminate card states " + wrong).location = {cards.terminate.offset, 32};
}

// A file without Terminate card was cut when its last record has no end, or when entries point behind the last card.
void File::Impl::check_last_record(Report& report) const {
  if (cards.terminated || cards.cut_off || ranges.empty()) return;
  const Section& section = cards.parameter;
  const auto points_behind = [&section](const DirectoryEntry& e) {
    return section.index_of(e.parameter_pointer) >= section.size();
  };
  const CardRange last = *std::max_element(
      ranges.begin(), ranges.end(), [](CardRange a, CardRange b) { return a.first + a.count < b.first + b.count; });
  bool ends = false;  // a delimiter within a string is taken for the end: then only the missing Terminate card is told
  for (std::uint32_t i = last.first; i < last.first + last.count && !ends; ++i)
    ends =
        cards.columns(section.cards[i], 0, parameter_columns).find(global.record_delimiter) != std::string_view::npos;
  if (ends && std::none_of(directory.entries.begin(), directory.entries.end(), points_behind)) return;
  report.add(rules::truncated, "the file ends before the data of its entities do").location = {bytes.size(), 0};
}

// ---- Records

std::size_t File::Impl::index_of(const DirectoryEntry& entry) const {
  const DirectoryEntry* own = directory.find(entry.de);
  return own ? static_cast<std::size_t>(own - directory.entries.data()) : directory.entries.size();
}

void File::Impl::lex(const DirectoryEntry& entry, Parameters& out, Report& report) const {
  out.tokens.clear();
  out.comment.clear();
  out.joined.clear();
  const std::size_t index = index_of(entry);
  const CardRange range = index < ranges.size() ? ranges[index] : CardRange{};
  out.first_card = range.first;
  out.card_count = range.count;
  out.terminated = false;
  if (range.count == 0) return;

  const Card* first = &cards.parameter.cards[range.first];
  join_columns(cards, first, range.count, parameter_columns, out.joined);
  std::vector<LexFault> faults;
  const Lexed lexed = lexer.lex(out.joined, out.tokens, faults);
  out.terminated = lexed.terminated;
  const std::string_view rest = std::string_view(out.joined).substr(lexed.end);
  if (const std::size_t from = rest.find_first_not_of(' '); from != std::string_view::npos)
    out.comment = rest.substr(from, rest.find_last_not_of(' ') + 1 - from);

  bool split = false;
  for (const Token& token : out.tokens) split = split || runs_over(token);
  if (split || !out.terminated || !faults.empty()) report_faults(entry, out, faults, report);
  for (Token& token : out.tokens) token.offset = place_of(first, range.count, token.offset);
}

// The tokens' offsets are still positions in the joined text.
void File::Impl::report_faults(const DirectoryEntry& entry, const Parameters& out, const std::vector<LexFault>& faults,
                               Report& report) const {
  const Card* first = &cards.parameter.cards[out.first_card];
  const auto say = [&](const Rule& rule, Severity severity, std::size_t token, std::string text) {
    Diagnostic& d = report.add(rule, severity, std::move(text));
    const Token& t = out.tokens[token];
    d.location = locate(place_of(first, out.card_count, t.offset));
    d.location.length = t.text.size();
    d.entity = fmt::format("D{}", entry.de);
    d.type = fmt::format("{}:{}", entry.type, entry.form);
    if (token > 0) d.parameter = static_cast<int>(token);
  };
  for (const LexFault& fault : faults) {
    const std::string text = printable(out.tokens[fault.token].text, 40);
    switch (fault.kind) {
      case LexFault::Kind::CountPassesAll:
      case LexFault::Kind::CountPassesEnd:
        say(rules::hollerith, Severity::Error, fault.token,
            fmt::format("the string '{}' counts more characters than it has", text));
        break;
      case LexFault::Kind::TextBehindString:
        say(rules::hollerith, Severity::Warning, fault.token,
            fmt::format("text follows the string '{}' before the next delimiter", text));
        break;
      case LexFault::Kind::SmallH:
        say(rules::letter_case, Severity::Info, fault.token, "a string is announced by a small h");
        break;
      case LexFault::Kind::TooManyTokens:
        say(rules::too_many, Severity::Error, fault.token,
            fmt::format("more than {} parameters, most of them empty; the rest is not read", out.tokens.size()));
        break;
      case LexFault::Kind::EmptyString:
        say(rules::hollerith, Severity::Warning, fault.token, "a string of length 0; leave the field empty instead");
        break;
    }
  }
  for (std::size_t i = 0; i < out.tokens.size(); ++i) {
    const Token& t = out.tokens[i];
    if (!runs_over(t)) continue;
    say(rules::token_split, Severity::Warning, i,
        fmt::format("'{}' runs over the end of a card", printable(t.text, 40)));
    break;  // once a record
  }
  const bool too_many = !faults.empty() && faults.back().kind == LexFault::Kind::TooManyTokens;
  if (out.terminated || out.tokens.empty() || too_many) return;
  const bool drift = out.tokens.size() == 1 && out.tokens[0].text.find_first_of(",;/|:") != std::string_view::npos;
  if (drift)
    say(rules::delimiter_drift, Severity::Error, 0,
        fmt::format("the record does not use the delimiters '{}' and '{}'", global.parameter_delimiter,
                    global.record_delimiter));
  else
    say(rules::unterminated, Severity::Error, out.tokens.size() - 1,
        fmt::format("the record does not end with '{}'", global.record_delimiter));
}

Parameters File::parameters(const DirectoryEntry& entry, Report& report) const {
  Parameters out;
  impl_->lex(entry, out, report);
  return out;
}

void File::parameters(const DirectoryEntry& entry, Parameters& out, Report& report) const {
  impl_->lex(entry, out, report);
}

// ---- Places and plain access

Location File::Impl::locate(std::size_t offset) const {
  Location out;
  if (offset == Location::nowhere) return out;
  out.offset = offset = std::min(offset, bytes.size());
  out.section = cards.section_at(offset);
  if (cards.stride > 0 && offset < cards.regular_end) {  // no need to look for line ends
    out.line = offset / cards.stride + 1;
    out.column = offset % cards.stride + 1;
    return out;
  }
  std::call_once(lines_built, [this] { lines.emplace(bytes); });
  const LineColumn place = lines->locate(offset);
  out.line = place.line;
  out.column = place.column;
  return out;
}

std::string_view File::bytes() const { return impl_->bytes; }
const Cards& File::cards() const { return impl_->cards; }
const Global& File::global() const { return impl_->global; }
std::string_view File::start_text() const { return impl_->start_text; }
const std::vector<DirectoryEntry>& File::directory() const { return impl_->directory.entries; }
const DirectoryEntry* File::find(Ref ref) const { return impl_->directory.find(ref.de); }
Location File::locate(std::size_t offset) const { return impl_->locate(offset); }
std::string File::write() const { return impl_->bytes; }

// ---- Sniffing

Sniff sniff(std::string_view first_bytes) {
  std::string_view text = first_bytes.substr(0, 64 * 1024);
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  const auto flag = [&text](char letter) {  // a first card with `letter` in column 73 and a number behind it
    const std::string_view number = text.size() >= 80 ? text.substr(73, 7) : std::string_view();
    return !number.empty() && text[72] == letter && number.find_first_not_of(" 0123456789") == std::string_view::npos &&
           number.find_first_not_of(' ') != std::string_view::npos;
  };
  if (flag('C')) return Sniff::CompressedAscii;
  const std::string_view head = text.substr(0, 80);
  const bool has_control = std::any_of(head.begin(), head.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\r' && c != '\t';
  });
  if (flag('B') || (!head.empty() && head[0] == 'B' && has_control)) return Sniff::Binary;
  Report ignored;
  const Cards cards = split_cards(text, ignored);
  const bool found = !cards.start.empty() || !cards.global.empty() || !cards.directory.empty();
  return found ? Sniff::FixedAscii : Sniff::No;
}

}  // namespace trimloop::iges
