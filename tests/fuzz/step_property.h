#pragma once
// What must hold for any bytes whatever given to the STEP reader and importer. Called by the fuzzers and, on kept inputs,
// by a plain test. Returns the first broken promise, or nullptr.

#include <string>
#include <string_view>

#include "formats/step/file.h"
#include "formats/step/strings.h"
#include "formats/step/tape.h"
#include "tests/fuzz/import_property.h"

namespace trimloop::test {

// Bytes -> index -> tapes -> strings.
inline const char* broken_step_promise(std::string_view bytes) {
  namespace ts = trimloop::step;
  Report report;
  const Limits limits;
  const ts::File file = ts::File::parse(std::string(bytes), limits, report);
  if (file.write() != bytes) return "an untouched file goes back as it came";
  if (report.has_fatal() && bytes.size() < 20 && !file.instances().empty()) return "a file without a frame has no instances";
  std::size_t end = 0;
  ts::Tape tape;
  for (const ts::Instance& i : file.instances()) {
    if (i.offset < end) return "instances follow each other";
    end = i.offset + i.length;
    if (end > bytes.size() || i.value > i.length) return "an instance lies in the file";
    if (i.id == 0 || file.find({i.id}) == nullptr) return "every instance is found by its name";
    if (i.keyword >= file.keywords().size()) return "every instance has a keyword";
    if (!tape.read(file.value(i), limits) && tape.faults().empty()) return "a record that cannot be read has a fault";
    for (const ts::Tape::Part& part : tape.parts())
      for (std::uint32_t t = part.first; t < part.end; t = tape[t].end)
        if (tape[t].end <= t || tape[t].end > tape.size()) return "a token ends behind itself";
    for (std::uint32_t t = 0; t < tape.size(); ++t) {
      if (tape[t].kind != ts::Token::Kind::String) continue;
      const std::string text = ts::decode_string(tape.text(tape[t]));
      const std::string again = ts::encode_string(text);
      if (again.size() < 2 || ts::decode_string(std::string_view(again).substr(1, again.size() - 2)) != text) return "a string goes round";
    }
  }
  return nullptr;
}

// Bytes -> model.
inline const char* broken_step_import(std::string bytes) { return broken_import(std::move(bytes), "fuzz.stp"); }

}  // namespace trimloop::test
