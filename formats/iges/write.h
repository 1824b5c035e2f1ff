#pragma once
// New IGES files from records: tokens packed into cards, directory pairs numbered, counters filled in.

#include "formats/iges/file.h"
#include "formats/iges/records/record.h"

namespace trimloop::iges {

// Promises: 80 columns a card; a number never runs over the end of a card and has its delimiter beside it; only strings
// longer than a card are cut. Control characters within strings become blanks (they would break the cards), their count
// stays right. What cannot be written (a field beyond its columns, delimiters that are none) makes finish() fail.
class Writer {
 public:
  // `most_cards` of a section: what seven digits can number.
  explicit Writer(Global global, std::vector<std::string> start_lines = {}, std::size_t most_cards = 9'999'999);

  // Adds an entity and returns its directory pointer. The entry's type/form/status/colour/... are used as given;
  // pointers and counts are filled in. `groups` follow the own parameters.
  Ref add(DirectoryEntry entry, const std::vector<std::string>& tokens, const TrailingGroups& groups = {});
  Ref add(DirectoryEntry entry, const TokenWriter& tokens, const TrailingGroups& groups = {});
  template <class Record>
  Ref add(DirectoryEntry entry, const Record& record, const TrailingGroups& groups = {}) {
    TokenWriter writer;
    record.write(writer);
    entry.type = Record::type;
    return add(std::move(entry), writer, groups);
  }
  std::size_t entities() const;

  // The whole file, LF ends. ErrorCode::Limit where a section would need more cards than that.
  Result<std::string> finish() const;

  Writer(Writer&&) noexcept;
  ~Writer();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trimloop::iges
