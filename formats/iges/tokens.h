#pragma once
// Free-format text: Global section and parameter data (IGES 5.3 2.2.3). The grammar stands above `lex` in tokens.cpp.

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "formats/iges/file.h"

namespace trimloop::iges {

// What can be wrong with the spelling of one token. Decoding numbers is left to those who know what to expect.
struct LexFault {
  enum class Kind {
    CountPassesAll,    // Hollerith count exceeds the whole text
    CountPassesEnd,    // it runs past the delimiter where the string must end
    TextBehindString,  // characters between the end of a string and the next delimiter
    SmallH,            // 'h' instead of 'H'
    EmptyString,       // 0H
    TooManyTokens      // `most_tokens` reached; the rest is not read
  } kind;
  std::size_t token = 0;     // index
  std::size_t position = 0;  // in the text
};

struct Lexed {
  std::size_t end = 0;       // behind the record delimiter, or the text's end
  bool terminated = false;   // by the record delimiter
};

// Splits records at one pair of delimiters. Immutable; one per file.
class Lexer {
 public:
  Lexer(char parameter_delimiter, char record_delimiter);

  // Appends the tokens of the record at the start of `text`. A token's `offset` is its position in `text`. A token costs
  // 32 bytes, so text of nothing but delimiters is not read to its end: see most_tokens().
  Lexed lex(std::string_view text, std::vector<Token>& tokens, std::vector<LexFault>& faults) const;

  // Small records may be all delimiters; in larger ones a token has two bytes on average ("0,"), or they are no data.
  static std::size_t most_tokens(std::size_t text_size) { return std::max<std::size_t>(65536, text_size / 2); }
  static constexpr std::size_t most_faults = 10'000;  // in one record

 private:
  char parameter_delimiter_, record_delimiter_;
};

// The two delimiters at the start of the Global text (parameters 1 and 2) and where parameter 3 starts.
struct Delimiters {
  char parameter = ',', record = ';';
  std::size_t end = 0;
  bool record_ends = false;  // the record delimiter stands where parameter 3 should start
};
// Nothing when the text starts in no legal way.
std::optional<Delimiters> read_delimiters(std::string_view global_text);

}  // namespace trimloop::iges
