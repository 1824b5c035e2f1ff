// Repairs of the card layer: text around the cards, line ends, columns, sequence numbers, counts and pointers back.

#include <fmt/format.h>

#include <algorithm>

#include "base/number.h"
#include "formats/iges/repairs.h"
#include "formats/iges/rules.h"

namespace trimloop::iges {
namespace {

constexpr std::size_t data_columns = 64, letter_column = 72, sequence_column = 73;

// Every card that stands in the file, by offset.
std::vector<const Card*> all_cards(const Cards& cards) {
  std::vector<const Card*> out;
  for (const Section* section : {&cards.start, &cards.global, &cards.directory, &cards.parameter})
    for (const Card& card : section->cards) out.push_back(&card);
  if (cards.terminated) out.push_back(&cards.terminate);
  std::sort(out.begin(), out.end(), [](const Card* a, const Card* b) { return a->offset < b->offset; });
  return out;
}

// The line end that most lines have; LF where there is none.
std::string usual_line_end(std::string_view bytes) {
  std::size_t lf = 0, cr = 0, crlf = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (bytes[i] == '\r' && i + 1 < bytes.size() && bytes[i + 1] == '\n') ++crlf, ++i;
    else if (bytes[i] == '\r') ++cr;
    else if (bytes[i] == '\n') ++lf;
  }
  return crlf > std::max(lf, cr) ? "\r\n" : cr > std::max(lf, crlf) ? "\r" : "\n";
}

std::string counts(const Cards& c, std::size_t start) {
  return fmt::format("S{:7}G{:7}D{:7}P{:7}", start, c.global.size(), c.directory.size(), c.parameter.size());
}

std::string card(std::string data, char letter, std::size_t number) {
  data.resize(letter_column, ' ');
  return data + letter + fmt::format("{:7}", number);
}

}  // namespace

void remove_leading_text(Repair& r) {
  const auto cards = all_cards(r.cards());
  if (!cards.empty() && cards[0]->offset > 0) r.replace(0, cards[0]->offset, {});
}

// Two files in one are not one file and some rubbish.
void remove_text_behind(Repair& r) {
  if (r.report.count(rules::terminate_repeat.id) > 0) {
    r.refusal = "what follows looks like a second file";
    return;
  }
  const Cards& cards = r.cards();
  if (!cards.terminated || !stands_in_file(cards.terminate)) return;
  const std::size_t end = next_line(cards, cards.terminate);
  const std::size_t from = end > cards.bytes.size() ? cards.bytes.size() : end;
  if (from < cards.bytes.size()) r.replace(from, cards.bytes.size() - from, {});
}

void unify_line_ends(Repair& r) {
  const std::string_view bytes = r.file.bytes();
  const std::string wanted = usual_line_end(bytes);
  bool any = false;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (bytes[i] != '\r' && bytes[i] != '\n') continue;
    any = true;
    const std::size_t length = bytes[i] == '\r' && i + 1 < bytes.size() && bytes[i + 1] == '\n' ? 2 : 1;
    if (bytes.substr(i, length) != wanted) r.replace(i, length, wanted);
    i += length - 1;
  }
  if (!any) separate_cards(r);
}

void separate_cards(Repair& r) {
  const std::string_view bytes = r.file.bytes();
  const std::string end = usual_line_end(bytes);
  const auto cards = all_cards(r.cards());
  for (std::size_t i = 0; i + 1 < cards.size(); ++i) {
    const std::size_t from = cards[i]->offset + cards[i]->length, to = cards[i + 1]->offset;
    if (from <= to && bytes.substr(from, to - from).find_first_of("\r\n") == std::string_view::npos) r.replace(to, 0, end);
  }
}

// Blanks go before the sequence number, which belongs to the right; behind the letter where there is none.
void pad_cards(Repair& r) {
  for (const Card* c : all_cards(r.cards()))
    if (c->rebuilt == 0 && c->length > letter_column && c->length < card_columns)
      r.replace(c->offset + sequence_column, 0, std::string(card_columns - c->length, ' '));
}

// Pointers are sequence numbers of Directory and Parameter cards: where those have gaps and are believed, they stay.
void number_cards(Repair& r) {
  const Cards& cards = r.cards();
  for (const Section* section : {&cards.start, &cards.global, &cards.directory, &cards.parameter}) {
    const bool pointed_at = section == &cards.directory || section == &cards.parameter;
    if (pointed_at && section->has_gaps()) {
      r.refusal = "the numbers have gaps, and pointers go by them";
      continue;
    }
    for (std::size_t i = 0; i < section->size(); ++i)
      if (stands_in_file(section->cards[i])) r.columns(section->cards[i], sequence_column, fmt::format("{:7}", i + 1));
  }
}

void add_terminate(Repair& r) {
  const Cards& cards = r.cards();
  if (cards.cut_off || cards.parameter.empty()) {
    r.refusal = "the file was cut off";
    return;
  }
  const std::string_view bytes = cards.bytes;
  const std::string end = usual_line_end(bytes);
  const bool open = !bytes.empty() && bytes.back() != '\n' && bytes.back() != '\r' && cards.stride != card_columns;
  r.replace(bytes.size(), 0, (open ? end : std::string()) + card(counts(cards, cards.start.size()), 'T', 1) + (cards.stride == card_columns ? "" : end));
}

void correct_counts(Repair& r) {
  if (r.cards().terminated) r.columns(r.cards().terminate, 0, counts(r.cards(), r.cards().start.size()));
}

void add_start(Repair& r) {
  const Cards& cards = r.cards();
  const std::string end = cards.stride == card_columns ? std::string() : usual_line_end(cards.bytes);
  r.replace(0, 0, card({}, 'S', 1) + end);
  if (cards.terminated && stands_in_file(cards.terminate)) r.columns(cards.terminate, 0, fmt::format("S{:7}", 1));
}

// A pointer back that begins in column 65, where a blank belongs. Other characters there stay: who knows what they are.
void clear_column_65(Repair& r) {
  for (const DirectoryEntry& entry : r.file.directory()) {
    Report ignored;
    const Parameters p = r.file.parameters(entry, ignored);
    for (std::size_t i = p.first_card; i < p.first_card + p.card_count; ++i) {
      const Card& c = r.cards().parameter.cards[i];
      const std::string_view field = r.cards().columns(c, data_columns, 8);
      const NumberText<std::int64_t> number = read_integer(field);
      if (!field.empty() && field[0] != ' ' && number && number.value == entry.de)
        r.columns(c, data_columns, fmt::format("{:8}", entry.de), fmt::format("D{}", entry.de));
    }
  }
}

void correct_card_count(Repair& r) {
  r.findings([&](const Diagnostic& d) {
    const DirectoryEntry* entry = r.entry(d);
    const EntryCards own = entry && entry->usable ? directory_cards(r.cards(), *entry) : EntryCards{};
    if (!own.second) return;
    Report ignored;
    const std::size_t count = r.file.parameters(*entry, ignored).card_count;
    if (count > 0) r.columns(*own.second, 24, restyled(r.cards().columns(*own.second, 24, 8), static_cast<std::int64_t>(count)), d.entity);
  });
}

void correct_back_pointers(Repair& r) {
  r.findings([&](const Diagnostic& d) {
    const DirectoryEntry* entry = r.entry(d);
    if (!entry || !entry->usable) return;
    Report ignored;
    const Parameters p = r.file.parameters(*entry, ignored);
    for (std::size_t i = p.first_card; i < p.first_card + p.card_count; ++i)
      r.columns(r.cards().parameter.cards[i], data_columns, fmt::format("{:8}", entry->de), d.entity);
  });
}

}  // namespace trimloop::iges
