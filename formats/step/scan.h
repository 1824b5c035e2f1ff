#pragma once
// The bytes of Part 21 at the lowest level: what may stand between tokens, and where an instance ends. ISO 10303-21 6.

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace trimloop::step {

inline bool is_blank(char c) { return static_cast<unsigned char>(c) <= 0x20 || c == 0x7F; }
inline bool is_digit(char c) { return c >= '0' && c <= '9'; }
inline bool is_word(char c) {
  return (c >= 'A' && c <= 'Z') || is_digit(c) || c == '_' || (c >= 'a' && c <= 'z') || c == '-';
}

// First place at or after `at` that is neither blank nor comment; bytes.size() at the end. `open_comment` is set where a
// comment does not end (the rest of the file is then comment).
std::size_t skip_blanks(std::string_view bytes, std::size_t at, bool* open_comment = nullptr);

// What ended a statement.
struct StatementEnd {
  enum class Kind : std::uint8_t {
    Semicolon,      // at: the ';'
    NextInstance,   // no ';', but the '#n=' of another instance: at is its '#'
    OpenString,     // a string that does not end before another instance begins: at is where the string begins
    OpenComment,    // a comment that does not end
    EndOfFile
  } kind = Kind::EndOfFile;
  std::size_t at = 0;
  std::size_t resume = 0;  // where the next statement may begin
};
// Finds the end of the statement whose inside begins at `at`: strings, comments and binaries are passed over.
StatementEnd find_statement_end(std::string_view bytes, std::size_t at);

// Place of the apostrophe that ends the string beginning at `at` (an apostrophe), or npos. '' and \S\' do not end it.
std::size_t end_of_string(std::string_view bytes, std::size_t at);

}  // namespace trimloop::step
