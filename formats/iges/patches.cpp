#include "formats/iges/patches.h"

#include <algorithm>

#include "base/number.h"

namespace trimloop::iges {

std::string Patches::apply(std::string_view bytes) {
  std::stable_sort(list_.begin(), list_.end(), [](const Patch& a, const Patch& b) { return a.offset < b.offset; });
  std::string out;
  std::size_t at = 0;
  for (const Patch& p : list_) {
    out += bytes.substr(at, p.offset - at);
    out += p.text;
    at = p.offset + p.length;
  }
  return out += bytes.substr(at);
}

std::string restyled(std::string_view old, std::int64_t value) {
  const bool zeros = !old.empty() && old[0] == '0';
  const std::string text = std::to_string(value);
  if (text.size() >= old.size()) return text;
  return std::string(old.size() - text.size(), zeros ? '0' : ' ') + text;
}

void shift_field(Patches& patches, const Cards& cards, const Card& card, std::size_t from, std::size_t width, std::int64_t delta) {
  const std::string_view field = cards.columns(card, from, width);
  const NumberText<std::int64_t> number = read_integer(field);
  if (field.size() == width && number) patches.replace(card.offset + from, width, restyled(field, number.value + delta));
}

// Where the cards that follow the last one of a section would go, and what ends a line there.
std::string line_end_after(const Cards& cards, const Card& card) {
  std::size_t at = card.offset + card_columns;
  while (at < cards.bytes.size() && cards.bytes[at] != '\n' && cards.bytes[at] != '\r' && at < card.offset + 4 * card_columns) ++at;
  std::string out;
  if (at < cards.bytes.size() && cards.bytes[at] == '\r') out += '\r', ++at;
  if (at < cards.bytes.size() && cards.bytes[at] == '\n') out += '\n';
  // A stream of cards without line ends has text of the next card right behind.
  return cards.stride == card_columns ? std::string() : out.empty() ? "\n" : out;
}
std::size_t next_line(const Cards& cards, const Card& card) {
  const std::string end = line_end_after(cards, card);
  if (end.empty()) return card.offset + card_columns;
  const std::size_t at = cards.bytes.find(end, card.offset + card_columns);
  return at == std::string_view::npos ? cards.bytes.size() : at + end.size();
}

EntryCards directory_cards(const Cards& cards, const DirectoryEntry& entry) {
  const auto& list = cards.directory.cards;
  const auto found = std::lower_bound(list.begin(), list.end(), entry.offset,
                                      [](const Card& c, std::size_t offset) { return c.offset < offset; });
  if (found == list.end() || found->offset != entry.offset || std::next(found) == list.end()) return {};
  return {&*found, &*std::next(found)};
}

}  // namespace trimloop::iges
