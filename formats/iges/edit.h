#pragma once
// Changes to one entity that leave every other byte of the file as it was.
//
// What may differ afterwards, and nothing else:
//   * the Parameter cards of the entity from the changed parameter on, as far as text has to move: parameters stay on
//     their card where they fit; where they do not, cards are inserted behind it (or dropped) for this entity only;
//   * when the number of cards changes: sequence numbers of the Parameter cards behind, the Parameter pointers of the
//     entities whose data lie behind, the card count of the entity and the counts of the Terminate card.
// Untouched parameters keep their text, blanks and comments included. Docs: docs/formats-iges.md, "Edits".

#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "formats/iges/file.h"

namespace trimloop::iges {

// Puts `text` (as it shall stand in the file: "0.25", "3Habc", "" for an empty field) in place of parameter `index` (1 =
// first after the type). Refused (InvalidArgument) when there is no such parameter or the text holds a delimiter outside
// a string; Unsupported when the record has no end or its cards do not stand in the file as 80 columns.
Result<std::string> set_parameter(const File& file, Ref entity, std::size_t index, std::string_view text);

// A new entity behind all others: two Directory cards, its Parameter cards, and the counts of the Terminate card.
struct Added {
  std::string bytes;
  Ref entity;
};
Result<Added> add_entity(const File& file, DirectoryEntry entry, const std::vector<std::string>& tokens);

// Makes the entity null (type 0, IGES 5.3 4.1): its number stays taken, so that no pointer of another entity has to move.
// Refused when another entity points to it.
Result<std::string> remove_entity(const File& file, Ref entity);

// The text of `value` for parameter `index` of a record, by the kind that the layout table gives it: reals in shortest
// exact form within the file's declared precision (rounded to the digits of Global 9 or 11 where it takes more; refused
// beyond the power of ten of Global 8 or 10), integers and pointers as such, strings with their count. Refused when the value
// is none of that kind.
Result<std::string> parameter_text(const File& file, Ref entity, std::size_t index, std::string_view value);

// Entities that point to `entity`, by own parameters, pointer groups or Directory fields.
std::vector<Ref> pointing_at(const File& file, Ref entity);

}  // namespace trimloop::iges
