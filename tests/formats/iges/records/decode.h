#pragma once
// A record under test beside a stock of entities that it may point to, read from the text of a whole file.

#include <algorithm>
#include <cmath>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "base/number.h"
#include "formats/iges/records/any.h"
#include "tests/support/iges_text.h"

namespace trimloop::test {

// Directory pointers of the stock.
namespace stock {
constexpr int point = 1, direction = 3, line = 5, arc = 7, surface = 9, curve_on_surface = 11, boundary = 13,
              vertices = 15, edges = 17, loop = 19, face = 21, shell = 23, subfigure = 25, name = 27, group = 29,
              pcurve = 31, open_shell = 33, composite = 35, colour = 37, subject = 39;
}

inline IgesText stock_file() {
  IgesText text;
  text.add(116, "0.,0.,0.,0");
  text.add(123, "0.,0.,1.");
  text.add(110, "0.,0.,0.,1.,0.,0.");
  text.add(100, "0.,0.,0.,1.,0.,0.,1.");
  text.add(128,
           "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,1.,1.,0.,0.,1.,0.,1.");
  text.add(142, "0,9,31,5,2");
  text.add(141, "0,1,9,1,5,1,0");
  text.add(502, "2,0.,0.,0.,1.,0.,0.", {.form = 1});
  text.add(504, "1,5,15,1,15,2", {.form = 1});
  text.add(508, "1,0,17,1,1,0", {.form = 1});
  text.add(510, "9,1,1,19", {.form = 1});
  text.add(514, "1,21,1", {.form = 1});
  text.add(308, "0,4Hpart,1,5");
  text.add(406, "1,4Hname", {.form = 15});
  text.add(402, "1,5", {.form = 7});
  text.add(126, "1,1,1,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,1.,1.,0.,0.,1.,0.,0.,1.", {.status = "00010500"});
  text.add(514, "1,21,1", {.form = 2});
  text.add(102, "2,5,7");
  text.add(314, "100.,0.,0.,3Hred");
  return text;
}

struct Decoded {
  std::unique_ptr<iges::File> file;
  Report report;  // of reading this one record
  iges::Parameters parameters;
  iges::AnyRecord record;

  template <class Record>
  const Record& as() const {
    const Record* typed = record.as<Record>();
    static const Record nothing;
    return typed ? *typed : nothing;
  }
  bool has(std::string_view rule) const { return report.count(rule) > 0; }
  std::vector<std::string> written() const { return iges::write_any(record); }
};

inline Decoded decode(const IgesText& text, int de, const Limits& limits = {}) {
  Decoded out;
  Report of_file;
  out.file = std::make_unique<iges::File>(iges::File::parse(text.text(), limits, of_file));
  if (const iges::DirectoryEntry* entry = out.file->find(iges::Ref{de})) {
    out.parameters = out.file->parameters(*entry, out.report);
    out.record = iges::read_any(*out.file, *entry, out.parameters, limits, out.report);
  }
  return out;
}

inline Decoded decode(int type, int form, std::string_view parameters, const Limits& limits = {}) {
  IgesText text = stock_file();
  const int de = text.add(type, parameters, {.form = form});
  return decode(text, de, limits);
}

inline std::string joined(const std::vector<std::string>& tokens) {
  std::string out;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (i > 0) out += ',';
    out += tokens[i];
  }
  return out;
}

// The same value: integers and pointers equal, strings equal byte for byte, reals equal as doubles, empty only to
// empty.
inline bool same_token(const iges::Token& token, const std::string& text) {
  using Kind = iges::Token::Kind;
  if (token.kind == Kind::Empty) return text.empty();
  if (token.kind == Kind::Hollerith) return text == hollerith(token.text);
  const auto integer = read_integer(token.text), other = read_integer(text);
  if (integer && other) return integer.value == other.value;
  const auto real = read_real(token.text), other_real = read_real(text);
  if (real && other_real)
    return real.value == other_real.value && std::signbit(real.value) == std::signbit(other_real.value);
  std::string_view trimmed = token.text;
  while (!trimmed.empty() && trimmed.front() == ' ') trimmed.remove_prefix(1);
  while (!trimmed.empty() && trimmed.back() == ' ') trimmed.remove_suffix(1);
  return trimmed == text;
}

// Index of the first parameter that was not written as it was read, or 0 when all are the same.
inline std::size_t first_difference(const iges::Parameters& parameters, const std::vector<std::string>& written) {
  const std::size_t count = parameters.tokens.empty() ? 0 : parameters.tokens.size() - 1;
  for (std::size_t i = 0; i < std::min(count, written.size()); ++i)
    if (!same_token(parameters.tokens[i + 1], written[i])) return i + 1;
  return count == written.size() ? 0 : std::min(count, written.size()) + 1;
}

}  // namespace trimloop::test
