#pragma once
// The Directory section: pairs of cards into entries (IG-D..), and which Parameter cards belong to which entry.

#include <cstdint>
#include <optional>
#include <vector>

#include "formats/iges/cards.h"
#include "formats/iges/file.h"

namespace trimloop::iges {

// Parameter cards of one entry, counted from 0 within the section. No two entries share a card.
struct CardRange {
  std::uint32_t first = 0, count = 0;
};

struct Directory {
  std::vector<DirectoryEntry> entries;  // by ascending `de`
  // Entries whose second card names another type; the Parameter data tell which one is right.
  struct OtherType {
    std::size_t entry = 0;
    int type = 0;
  };
  std::vector<OtherType> other_types;

  const DirectoryEntry* find(std::int64_t de) const;
};

// Reads every pair of cards. A bad field gets its default and a finding.
Directory read_directory(const Cards& cards, const Global& global, Report& report);

// Finds the cards of every entry: by the stated pointer where the cards' back pointers agree, else by back pointers, else
// by the pointer alone. Entries without data become unusable. Linear time but for sorting.
std::vector<CardRange> assign_parameter_cards(const Cards& cards, const Global& global, Directory& directory, Report& report);

// The number in a fixed-width field: blank is 0, anything but a number is nothing.
std::optional<int> read_columns(std::string_view field);

}  // namespace trimloop::iges
