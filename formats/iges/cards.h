#pragma once
// The card layer: which 80 columns of the file belong to which section, whatever happened to its line ends.
//
// A card is what has a section letter in column 73 and a sequence number behind it. Cards may come one on a line, many on
// a line or in one unbroken stream; be short of trailing blanks or followed by rubbish; be shifted by stray characters or
// shrunk by tabs. Those that cannot be taken from the file as they are, are rebuilt in `Cards::rebuilt`.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/report.h"

namespace trimloop::iges {

struct Card {
  std::size_t offset = 0;     // in the file, of column 1
  std::uint32_t rebuilt = 0;  // 0: the columns stand in the file; else 1 + number of the rebuilt card
  std::uint32_t length = 0;   // columns present, at most 80; the rest counts as blank
};

// The cards of one section, and how sequence numbers (which is what pointers hold) map to them.
class Section {
 public:
  std::vector<Card> cards;

  std::size_t size() const { return cards.size(); }
  bool empty() const { return cards.empty(); }
  // Appends a card. `number` <= 0 means that it has none that can be read. False when it is not the next number.
  bool add(Card card, std::int32_t number);
  std::int32_t number(std::size_t index) const;
  std::size_t index_of(std::int64_t number) const;  // size() when there is none
  // True when the cards' own numbers ascend with gaps and are therefore believed; else cards count from 1.
  bool has_gaps() const { return state_ == Numbers::Ascending; }
  void count_from_one();  // forget the cards' own numbers

 private:
  enum class Numbers : std::uint8_t { Regular, Ascending, Useless } state_ = Numbers::Regular;
  std::vector<std::int32_t> numbers_;  // of Ascending only
};

struct Cards {
  std::string_view bytes;
  Section start, global, directory, parameter;
  Card terminate;
  bool terminated = false;
  bool cut_off = false;         // the file ends inside a card
  std::string rebuilt;          // 80 columns for each rebuilt card
  // Set while all lines have the same length: `stride` bytes each, line end included, up to `regular_end`.
  std::size_t stride = 0, regular_end = 0;

  // Columns [from, from + width) of a card, from 0; shorter where the card is.
  std::string_view columns(const Card& card, std::size_t from, std::size_t width) const {
    const char* text = card.rebuilt ? rebuilt.data() + std::size_t{80} * (card.rebuilt - 1) : bytes.data() + card.offset;
    if (from >= card.length) return {};
    return {text + from, card.length - from < width ? card.length - from : width};
  }
  char section_at(std::size_t offset) const;  // S G D P T, or 0
};

// Finds the cards of `bytes`. Linear time; memory at most twice the size of the file. Findings IG-F.. carry offsets only.
// A Fatal finding means that there is nothing to go on with.
Cards split_cards(std::string_view bytes, Report& report);

}  // namespace trimloop::iges
