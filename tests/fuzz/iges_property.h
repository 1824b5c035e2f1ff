#pragma once
// What must hold for any bytes whatever given to the IGES reader and importer. Called by the fuzzers and, on kept inputs, by
// plain tests. Returns the first broken promise, or nullptr.

#include <string>
#include <string_view>

#include "formats/iges/file.h"
#include "formats/iges/records/any.h"
#include "tests/fuzz/import_property.h"

namespace trimloop::test {

// Bytes -> cards -> Directory -> tokens -> typed records.
inline const char* broken_iges_promise(std::string_view bytes) {
  using namespace trimloop::iges;
  Report report;
  const Limits limits;
  const File file = File::parse(std::string(bytes), limits, report);
  if (file.write() != bytes) return "an untouched file goes back as it came";
  if (report.has_fatal() && !file.directory().empty()) return "a fatal finding leaves no entities";
  if (bytes.empty() && !report.has_fatal()) return "an empty file is no IGES";

  std::size_t cards = 0;
  std::int32_t last = 0;
  for (const DirectoryEntry& entry : file.directory()) {
    if (entry.de <= last || entry.de % 2 == 0) return "directory pointers are odd and ascend";
    last = entry.de;
    if (file.find(Ref{entry.de}) != &entry) return "find() leads to the entry";
    const Parameters parameters = file.parameters(entry, report);
    cards += parameters.card_count;
    for (const Token& token : parameters.tokens) {
      if (token.offset > bytes.size()) return "tokens lie within the file";
      if (token.kind == Token::Kind::Empty && !token.text.empty()) return "an empty token has no text";
    }
    const AnyRecord record = read_any(file, entry, parameters, limits, report);
    if (write_any(record).size() > bytes.size()) return "a record is not larger than its file";
  }
  if (cards * 65 > bytes.size() + 65 * file.directory().size() + 160) return "no two entities share cards";
  for (const Diagnostic& d : report.items()) {
    if (d.rule == nullptr || d.text.empty()) return "every finding has a rule and a text";
    if (d.location.offset != Location::nowhere && (d.location.offset > bytes.size() || d.location.line == 0))
      return "every finding with a place has a line";
  }
  return nullptr;
}

// Bytes -> model.
inline const char* broken_iges_import(std::string bytes) { return broken_import(std::move(bytes), "fuzz.igs"); }

}  // namespace trimloop::test
