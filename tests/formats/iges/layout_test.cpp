// Every card layout seen in practice gives the same file as the plain one.

#include <boost/test/unit_test.hpp>

#include "formats/iges/file.h"
#include "tests/support/iges_text.h"

using namespace trimloop;
using namespace trimloop::iges;
using namespace trimloop::test;

namespace {

IgesText sample() {
  IgesText text;
  const int line = text.add(110, "0.,0.,0.,1.,2.5,3.D0");
  text.add(406,
           "1," + hollerith("a name, with; delimiters and so long that it runs over the end of two cards, " +
                            std::string(60, 'x')),
           {.form = 15});
  text.add(126, "2,2,0,0,1,0,0.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.25,1.5,0.,2.,0.,0.,0.,1.,0.,0.,1.",
           {.label = "CURVE"});
  text.add(402, "2,{},{}", {.form = 7}, {line, 5});
  return text;
}

struct Read {
  Report report;
  File file;
  explicit Read(std::string bytes) : file(File::parse(std::move(bytes), {}, report)) {}
};

// All tokens of all entities as one text.
std::string contents(const File& file) {
  std::string out;
  for (const DirectoryEntry& entry : file.directory()) {
    Report report;
    const Parameters parameters = file.parameters(entry, report);
    out += std::to_string(entry.de) + (entry.usable ? ": " : " unusable: ") + std::to_string(entry.form) + " " +
           entry.label + " ";
    for (const Token& token : parameters.tokens)
      (out += token.text) += token.kind == Token::Kind::Hollerith ? "$|" : "|";
    out += "\n";
  }
  return out;
}

const std::string& expected() {
  static const std::string text = contents(Read(sample().text()).file);
  return text;
}

void check_same(const std::string& bytes) {
  const Read read(bytes);
  BOOST_TEST(contents(read.file) == expected());
  BOOST_TEST(read.file.write() == bytes);
  BOOST_TEST(!read.report.has_fatal());
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_plain_file_has_no_findings) {
  const Read read(sample().text());
  for (const Diagnostic& d : read.report.items()) BOOST_ERROR(std::string(d.rule->id) + " " + d.text);
  BOOST_TEST(read.file.directory().size() == 4u);
  BOOST_TEST(read.file.start_text() == "trimloop test file\n");
  BOOST_TEST(read.file.global().unit_flag == 2);
  BOOST_TEST(contents(read.file).find("a name, with; delimiters") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(line_ends_of_every_kind_and_none) {
  for (const char* end : {"\n", "\r\n", "\r", "", "\r\r\n", "\n\n"}) check_same(sample().text(end));
  BOOST_TEST(Read(sample().text("")).report.count("IG-F08") == 1u);
  std::string mixed;
  std::size_t i = 0;
  for (const std::string& card : sample().cards()) (mixed += card) += i++ % 3 == 0 ? "\r\n" : i % 3 == 0 ? "\n" : "\r";
  check_same(mixed);
  BOOST_TEST(Read(mixed).report.count("IG-F08") == 1u);
}

BOOST_AUTO_TEST_CASE(a_missing_last_line_end_is_no_fault) {
  std::string bytes = sample().text();
  bytes.pop_back();
  check_same(bytes);
  BOOST_TEST(Read(bytes).report.items().empty());
}

BOOST_AUTO_TEST_CASE(several_cards_on_a_line) {
  std::string bytes;
  std::size_t i = 0;
  for (const std::string& card : sample().cards()) (bytes += card) += ++i % 4 == 0 ? "\n" : "";
  check_same(bytes);
  BOOST_TEST(Read(bytes).report.count("IG-F21") == 1u);
}

BOOST_AUTO_TEST_CASE(long_cards_with_blanks_or_text_behind_column_80) {
  for (const char* tail : {" ", "  ", "\x1a", " some text of the sender"}) {
    std::string bytes;
    for (const std::string& card : sample().cards()) ((bytes += card) += tail) += "\n";
    check_same(bytes);
  }
}

BOOST_AUTO_TEST_CASE(sequence_numbers_missing_zero_left_justified_or_padded) {
  const auto renumber = [](auto number) {
    auto cards = sample().cards();
    for (std::size_t i = 0; i < cards.size(); ++i) cards[i].replace(73, 7, number(cards[i].substr(73, 7)));
    return join_cards(cards);
  };
  check_same(renumber([](const std::string&) { return std::string(7, ' '); }));
  check_same(renumber([](const std::string&) { return std::string("      0"); }));
  check_same(renumber([](const std::string&) { return std::string("      7"); }));
  const auto left = renumber([](std::string n) {
    n.erase(0, n.find_first_not_of(' '));
    n.resize(7, ' ');
    return n;
  });
  check_same(left);
  BOOST_TEST(Read(left).report.count("IG-F07") == 1u);
  BOOST_TEST(Read(left).report.count("IG-F06") == 0u);
  check_same(renumber([](std::string n) {
    for (char& c : n)
      if (c == ' ') c = '0';
    return n;
  }));
}

BOOST_AUTO_TEST_CASE(cards_without_any_sequence_columns) {
  std::string bytes;
  for (const std::string& card : sample().cards()) bytes += card.substr(0, 73) + "\n";
  check_same(bytes);
}

BOOST_AUTO_TEST_CASE(tabs_in_place_of_blanks) {
  // Eight blanks up to a tab stop become one tab, as an editor does.
  std::string bytes;
  for (const std::string& card : sample().cards()) {
    for (std::size_t at = 0; at < card.size(); at += 8) {
      std::string piece = card.substr(at, 8);
      const std::size_t end = piece.find_last_not_of(' ') + 1;
      if (end + 1 < 8 && at < 72) piece = piece.substr(0, end) + "\t";
      bytes += piece;
    }
    bytes += "\n";
  }
  check_same(bytes);
  BOOST_TEST(Read(bytes).report.count("IG-F10") == 1u);

  // One tab for one blank.
  std::string single = sample().text();
  for (std::size_t i = 0; i < single.size(); ++i)
    if (single[i] == ' ' && i % 81 < 72 && i % 7 == 0) single[i] = '\t';
  const Read read(single);
  BOOST_TEST(read.file.directory().size() == 4u);
  BOOST_TEST(read.report.count("IG-F10") == 1u);
}

BOOST_AUTO_TEST_CASE(cards_shifted_to_the_right) {
  std::string bytes;
  for (const std::string& card : sample().cards())
    bytes += (card[72] == 'D' || card[72] == 'P' ? " " : "") + card + "\n";
  check_same(bytes);
  BOOST_TEST(Read(bytes).report.count("IG-F20") == 1u);
}

BOOST_AUTO_TEST_CASE(small_section_letters) {
  auto cards = sample().cards();
  for (std::string& card : cards) card[72] = static_cast<char>(card[72] - 'A' + 'a');
  check_same(join_cards(cards));
  BOOST_TEST(Read(join_cards(cards)).report.count("IG-F04") == 1u);
}

BOOST_AUTO_TEST_CASE(junk_before_and_behind) {
  check_same("\xEF\xBB\xBF" + sample().text());
  check_same("From: somebody\nSubject: your part\n\n" + sample().text());
  BOOST_TEST(Read("From: somebody\n" + sample().text()).report.count("IG-F11") == 1u);
  check_same(sample().text() + "\x1a");
  BOOST_TEST(Read(sample().text() + "\x1a").report.count(Severity::Warning) == 0u);
  BOOST_TEST(Read(sample().text() + "\x1a").report.count("IG-F12") == 1u);
  check_same(sample().text() + "\x1a" + std::string(4096, '\xe5'));
  check_same(sample().text() + "\n\n  \n");
  BOOST_TEST(Read(sample().text() + "\n\n  \n").report.items().empty());
}

BOOST_AUTO_TEST_CASE(comments_behind_the_record_delimiter) {
  IgesText text;
  text.add({.type = 116,
            .parameters = "1.,2.,3.,0",
            .comment = "first; comment, that runs on over several cards " + std::string(100, 'c')});
  text.add(116, "4.,5.,6.,0");
  const Read read(text.text());
  BOOST_TEST(read.report.items().empty());
  Report report;
  const Parameters first = read.file.parameters(read.file.directory()[0], report);
  BOOST_TEST(first.tokens.size() == 5u);
  BOOST_TEST(first.comment.substr(0, 16) == "first; comment, ");
  BOOST_TEST(first.card_count > 1u);
  BOOST_TEST(read.file.parameters(read.file.directory()[1], report).tokens[1].text == "4.");
  BOOST_TEST(report.items().empty());
}

BOOST_AUTO_TEST_CASE(delimiters_in_all_four_openings) {
  const std::string rest =
      "4Htest,8Htest.igs,8Htrimloop,8Htrimloop,32,38,6,308,15,4Htest,1.,2,2HMM,1,1.,15H20260101.000000,1.E-6,"
      "1000.,6Hauthor,3Horg,11,0,15H20260101.000000,";
  const struct {
    const char* opening;
    char parameter, record;
  } cases[] = {{",,", ',', ';'},    {"1H,,1H;,", ',', ';'}, {"1H///", '/', ';'},
               {",1H#,", ',', '#'}, {"1H//1H#/", '/', '#'}, {" 1H, , 1H; , ", ',', ';'}};
  for (const auto& c : cases) {
    std::string global = c.opening + rest + c.record;
    for (char& byte : global)
      if (byte == ',' && &byte >= global.data() + std::string(c.opening).size()) byte = c.parameter;
    auto cards = sample().cards();
    std::erase_if(cards, [](const std::string& card) { return card[72] == 'G'; });
    std::vector<std::string> g;
    for (std::size_t at = 0; at < global.size(); at += 72)
      g.push_back(iges_card(global.substr(at, 72), 'G', g.size() + 1));
    cards.insert(cards.begin() + 1, g.begin(), g.end());
    const Read read(join_cards(cards));
    BOOST_TEST(read.file.global().parameter_delimiter == c.parameter, c.opening);
    BOOST_TEST(read.file.global().record_delimiter == c.record, c.opening);
    BOOST_TEST(read.file.global().file_name == "test.igs", c.opening);
    BOOST_TEST(read.file.global().fields_present == 26u, c.opening);
  }
}

BOOST_AUTO_TEST_CASE(a_string_is_counted_in_bytes_across_cards) {
  // Records laid out at hand: the string starts in column 60 of its first card.
  std::string record = "406,1," + std::string(53, ' ') + hollerith("abc,;defgh") + ";";
  auto cards = IgesText{}.cards();
  cards.pop_back();
  cards.push_back(iges_card("     406       1       0       0       0       0       0       000000000", 'D', 1));
  cards.push_back(iges_card("     406       0       0       2      15                               0", 'D', 2));
  cards.push_back(iges_card(record.substr(0, 64) + "       1", 'P', 1));
  cards.push_back(iges_card(record.substr(64) + std::string(64 - (record.size() - 64), ' ') + "       1", 'P', 2));
  cards.push_back(iges_card("S      1G      4D      2P      2", 'T', 1));
  const Read read(join_cards(cards));
  BOOST_TEST_REQUIRE(read.file.directory().size() == 1u);
  Report report;
  const Parameters p = read.file.parameters(read.file.directory()[0], report);
  BOOST_TEST_REQUIRE(p.tokens.size() == 3u);
  BOOST_TEST(p.tokens[2].text == "abc,;defgh");
  BOOST_TEST((p.tokens[2].kind == Token::Kind::Hollerith));
  BOOST_TEST(report.items().empty());
  // Its place in the file is that of its count.
  BOOST_TEST(read.file.bytes().substr(p.tokens[2].offset, 3) == "10H");
}

BOOST_AUTO_TEST_CASE(empty_fields_and_blanks_are_told_apart_from_values) {
  IgesText text;
  text.add(116, " 1. ,,   , 0 ,,");
  const Read read(text.text());
  Report report;
  const Parameters p = read.file.parameters(read.file.directory()[0], report);
  BOOST_TEST_REQUIRE(p.tokens.size() == 7u);
  BOOST_TEST(p.tokens[1].text == "1.");
  for (std::size_t empty : {2u, 3u, 5u, 6u}) BOOST_TEST((p.tokens[empty].kind == Token::Kind::Empty));
  BOOST_TEST(p.tokens[4].text == "0");
}

BOOST_AUTO_TEST_CASE(places_are_told_in_lines_and_columns) {
  IgesText text;
  text.add(116, "1.,2.,3.,0");
  for (const char* end : {"\n", "\r\n", "\r"}) {
    const Read read(text.text(end));
    Report report;
    const Parameters p = read.file.parameters(read.file.directory()[0], report);
    const Location place = read.file.locate(p.tokens[2].offset);
    BOOST_TEST(place.line == 7u);
    BOOST_TEST(place.column == 8u);
    BOOST_TEST(place.section == 'P');
  }
  const Read mixed("junk of another length\n" + text.text());
  Report report;
  const Location place = mixed.file.locate(mixed.file.parameters(mixed.file.directory()[0], report).tokens[2].offset);
  BOOST_TEST(place.line == 8u);
  BOOST_TEST(place.column == 8u);
}
