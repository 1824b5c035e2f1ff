// The string codec against the standard's own examples and over every Unicode scalar.

#include "formats/step/strings.h"

#include <boost/test/unit_test.hpp>

using trimloop::step::decode_string;
using trimloop::step::encode_string;
using trimloop::step::StringFaults;

namespace {

std::string utf8(char32_t c) {
  std::string out;
  const auto put = [&](char32_t byte) { out += static_cast<char>(byte); };
  if (c < 0x80) put(c);
  else if (c < 0x800) put(0xC0 | c >> 6), put(0x80 | (c & 63));
  else if (c < 0x10000) put(0xE0 | c >> 12), put(0x80 | (c >> 6 & 63)), put(0x80 | (c & 63));
  else put(0xF0 | c >> 18), put(0x80 | (c >> 12 & 63)), put(0x80 | (c >> 6 & 63)), put(0x80 | (c & 63));
  return out;
}

std::string back(const std::string& quoted) {
  StringFaults faults;
  BOOST_REQUIRE(quoted.size() >= 2);
  std::string out = decode_string(std::string_view(quoted).substr(1, quoted.size() - 2), &faults);
  BOOST_REQUIRE(faults.none());
  return out;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(strings)

BOOST_AUTO_TEST_CASE(every_scalar_comes_back) {
  for (char32_t c = 0; c <= 0x10FFFF; ++c) {
    if (c >= 0xD800 && c <= 0xDFFF) continue;
    const std::string text = utf8(c), alone = encode_string(text);
    for (const char byte : alone) BOOST_REQUIRE((byte >= 0x20 && byte <= 0x7E));
    if (back(alone) != text) BOOST_TEST(false, "U+" << static_cast<unsigned>(c));
  }
}

BOOST_AUTO_TEST_CASE(mixed_text_comes_back) {
  std::string text = "it's a \\ ";
  for (const char32_t c : {U'\u00E9', U'\U0001F600', U'\u4E2D', U'\u6587', U'x', U'\n', U'\uFFFF', U'\U00010000'}) text += utf8(c) + utf8(c);
  BOOST_TEST(back(encode_string(text)) == text);
  BOOST_TEST(encode_string("it's \\") == "'it''s \\\\'");
  BOOST_TEST(encode_string("\xE4\xB8\xAD\xE6\x96\x87") == "'\\X2\\4E2D6587\\X0\\'");
}

BOOST_AUTO_TEST_CASE(escapes_of_the_standard) {
  BOOST_TEST(decode_string("h\\S\\Drte") == "h\xC3\x84rte");           // 6.4.3.2: D + 128 is A with diaeresis
  BOOST_TEST(decode_string("\\PE\\\\S\\*\\S\\U\\S\\b") == "\xD0\x8A\xD0\xB5\xD1\x82");  // page E is Cyrillic
  BOOST_TEST(decode_string("\\S\\''x") == "\xC2\xA7x");                 // the character may be an apostrophe
  BOOST_TEST(decode_string("see \\X\\A7 4.1") == "see \xC2\xA7 4.1");
  BOOST_TEST(decode_string("\\X2\\03B103B203B3\\X0\\") == "\xCE\xB1\xCE\xB2\xCE\xB3");
  BOOST_TEST(decode_string("\\X4\\000003B10001F600\\X0\\") == "\xCE\xB1\xF0\x9F\x98\x80");
  BOOST_TEST(decode_string("\\X2\\D83DDE00\\X0\\") == "\xF0\x9F\x98\x80");
  BOOST_TEST(decode_string("a\\N\\b\\F\\c") == "a\nb\fc");
  BOOST_TEST(decode_string("don''t \\\\ stop") == "don't \\ stop");
  BOOST_TEST(decode_string("a\nb\rc") == "abc");
}

BOOST_AUTO_TEST_CASE(faults_are_told_and_the_text_is_kept) {
  StringFaults f;
  BOOST_TEST(decode_string("ab\\Q", &f) == "ab\\Q");
  BOOST_TEST(f.escape == 2u);
  BOOST_TEST(decode_string("\\X2\\00E9", &f) == "\xC3\xA9");
  BOOST_TEST(f.escape == 0u);
  BOOST_TEST(decode_string("\\X2\\00E\\X0\\x", &f) == "00Ex");
  BOOST_TEST(f.escape != StringFaults::nowhere);
  BOOST_TEST(decode_string("\\X2\\D800\\X0\\", &f) == "\xEF\xBF\xBD");
  BOOST_TEST(f.surrogate == 0u);
  BOOST_TEST(decode_string("\xC3\xA9\xE9", &f) == "\xC3\xA9\xC3\xA9");
  BOOST_TEST(f.raw_byte == 0u);
  BOOST_TEST(decode_string("\\X\\9", &f) == "\\X\\9");
  BOOST_TEST(f.escape == 0u);
  BOOST_TEST(encode_string("a\xE9z") == "'a\\X\\E9z'");
}

BOOST_AUTO_TEST_SUITE_END()
