#pragma once
// Strings of Part 21: UTF-8 <-> the text between the apostrophes, with every escape of the standard.
// ISO 10303-21:2016 6.4.3. Both directions are shared by the reader and the writer.

#include <cstddef>
#include <string>
#include <string_view>

namespace trimloop::step {

// What decoding met; offsets count from the start of the raw text, `nowhere` when it was not met.
struct StringFaults {
  static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);
  std::size_t escape = nowhere;     // first malformed escape; its characters are kept as they stand
  std::size_t surrogate = nowhere;  // first unpaired surrogate or value above U+10FFFF, read as U+FFFD
  std::size_t raw_byte = nowhere;   // first byte above 0x7E: UTF-8 where it is valid, else ISO 8859-1
  bool none() const { return escape == nowhere && surrogate == nowhere && raw_byte == nowhere; }
};

// `raw` is what stands between the outer apostrophes: '' is one apostrophe, \\ one backslash, \S\c and \P?\ the pages of
// ISO 8859, \X\hh one byte of ISO 8859-1, \X2\ ... \X0\ UTF-16, \X4\ ... \X0\ UTF-32, \N\ a line feed, \F\ a form feed.
// Control bytes are passed over, as the standard asks. O(length).
std::string decode_string(std::string_view raw, StringFaults* faults = nullptr);

// With the outer apostrophes, in the basic alphabet of all editions (0x20 to 0x7E): the shortest of our forms for each
// run of other characters, \X2\ within the basic plane and \X4\ outside it. Invalid UTF-8 bytes become \X\hh.
// decode_string of what stands between the apostrophes gives `utf8` back for every valid UTF-8 text.
std::string encode_string(std::string_view utf8);

}  // namespace trimloop::step
