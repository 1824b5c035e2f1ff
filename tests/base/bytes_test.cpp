#include "base/bytes.h"

#include <boost/test/unit_test.hpp>
#include <random>

using namespace trimloop;

namespace {

// The plain definition: walk from the start.
LineColumn walk(std::string_view bytes, std::size_t offset) {
  LineColumn here{1, 1};
  for (std::size_t i = 0; i < offset; ++i) {
    const bool ends = bytes[i] == '\n' || (bytes[i] == '\r' && (i + 1 == bytes.size() || bytes[i + 1] != '\n'));
    here = ends ? LineColumn{here.line + 1, 1} : LineColumn{here.line, here.column + 1};
  }
  return here;
}

}  // namespace

BOOST_AUTO_TEST_CASE(lines_end_with_lf_crlf_or_cr) {
  const LineIndex index("ab\ncd\r\nef\rgh");
  BOOST_TEST(index.line(1) == "ab");
  BOOST_TEST(index.line(2) == "cd");
  BOOST_TEST(index.line(3) == "ef");
  BOOST_TEST(index.line(4) == "gh");
  BOOST_TEST(index.line(5) == "");
  BOOST_TEST(index.line(0) == "");
  BOOST_TEST(index.locate(7).line == 3u);
  BOOST_TEST(index.locate(7).column == 1u);
  BOOST_TEST(index.locate(999).line == 4u);
}

BOOST_AUTO_TEST_CASE(places_agree_with_a_plain_walk_over_many_blocks) {
  std::mt19937 random(3);
  for (int round = 0; round < 20; ++round) {
    std::string text(9000, 'x');
    const unsigned rarity = round % 2 ? 3 : 2000;
    for (char& c : text)
      if (random() % rarity == 0) c = "\r\n"[random() % 2];
    const LineIndex index(text);
    for (std::size_t offset = 0; offset <= text.size(); offset += 1 + random() % 300) {
      const LineColumn expected = walk(text, offset), found = index.locate(offset);
      BOOST_TEST_REQUIRE(found.line == expected.line);
      BOOST_TEST_REQUIRE(found.column == expected.column);
      const std::size_t start = offset - (expected.column - 1);
      const std::size_t end = std::min(text.find_first_of("\r\n", start), text.size());
      BOOST_TEST_REQUIRE(index.line(expected.line) == text.substr(start, end - start));
    }
  }
}

BOOST_AUTO_TEST_CASE(an_empty_text_has_one_empty_line) {
  const LineIndex index("");
  BOOST_TEST(index.locate(0).line == 1u);
  BOOST_TEST(index.line(1) == "");
  BOOST_TEST(index.line(2) == "");
}

BOOST_AUTO_TEST_CASE(printable_escapes_and_cuts) {
  BOOST_TEST(printable("a\x1b[2Jb\xff") == "a\\x1B[2Jb\\xFF");
  BOOST_TEST(printable("abcdef", 3) == "abc...");
  BOOST_TEST(printable("abc", 3) == "abc");
  BOOST_TEST(printable(std::string_view("\0", 1)) == "\\x00");
}
