#pragma once
// The Global section: its text, its 26 parameters and what is wrong with them (IG-G..).

#include <algorithm>

#include "formats/iges/cards.h"
#include "formats/iges/file.h"

namespace trimloop::iges {

// Reads the Global cards. Findings carry offsets only; a Fatal one means that no record can be read.
Global read_global(const Cards& cards, Report& report);

// What field 15 calls the unit of flag 1 to 11 but 3; empty for others.
std::string_view unit_name_of_flag(int flag);

// Data columns of several cards as one text, every card filled up with blanks to `width` columns.
void join_columns(const Cards& cards, const Card* first, std::size_t count, std::size_t width, std::string& out);

// Offset in the file of a position in such a text.
inline std::size_t offset_in_file(const Card* first, std::size_t count, std::size_t width, std::size_t position) {
  if (count == 0) return 0;
  const std::size_t index = std::min(position / width, count - 1);
  const Card& card = first[index];
  // A rebuilt card has no exact columns in the file: its start has to do.
  return card.rebuilt ? card.offset : card.offset + std::min<std::size_t>(position - index * width, card.length);
}

}  // namespace trimloop::iges
