#pragma once
// Replacements in the bytes of a file, and where cards stand in them: what edits and repairs are made of.

#include <string>
#include <string_view>
#include <vector>

#include "formats/iges/cards.h"
#include "formats/iges/file.h"

namespace trimloop::iges {

constexpr std::size_t card_columns = 80;

// Collected in any order, applied once and by offset.
class Patches {
 public:
  void replace(std::size_t offset, std::size_t length, std::string text) { list_.push_back({offset, length, std::move(text)}); }
  bool empty() const { return list_.empty(); }
  std::string apply(std::string_view bytes);

 private:
  struct Patch {
    std::size_t offset, length;
    std::string text;
  };
  std::vector<Patch> list_;
};

// A number in place of another one, in the other one's style: filled up with zeros or with blanks.
std::string restyled(std::string_view old, std::int64_t value);

// Adds `delta` to the number in columns [from, from + width) of a card; leaves what is none.
void shift_field(Patches& patches, const Cards& cards, const Card& card, std::size_t from, std::size_t width, std::int64_t delta);

inline bool stands_in_file(const Card& card) { return card.rebuilt == 0 && card.length >= card_columns; }

std::string line_end_after(const Cards& cards, const Card& card);
std::size_t next_line(const Cards& cards, const Card& card);  // where a card behind this one would go

struct EntryCards {
  const Card *first = nullptr, *second = nullptr;
};
EntryCards directory_cards(const Cards& cards, const DirectoryEntry& entry);

}  // namespace trimloop::iges
