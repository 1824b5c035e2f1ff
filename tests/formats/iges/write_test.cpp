#include "formats/iges/write.h"

#include <fmt/format.h>

#include <boost/test/unit_test.hpp>
#include <random>

#include "base/number.h"
#include "formats/iges/card_writer.h"

using namespace trimloop;
using namespace trimloop::iges;

namespace {

Global millimetres() {
  Global g;
  g.sender_product = "part; with, delimiters";
  g.file_name = "part.igs";
  g.native_system = g.preprocessor = "trimloop";
  g.unit_flag = 2;
  g.unit_name = "MM";
  g.max_line_width = 0.1;
  g.resolution = 1.0 / 3 * 1e-5;
  g.max_coordinate = 1234.5678901234567;
  g.author = std::string(150, 'a');
  g.organization = "org";
  g.date = g.modified = "20260101.000000";
  g.version_flag = 11;
  return g;
}

std::vector<std::string> random_tokens(std::mt19937& random) {
  std::vector<std::string> tokens;
  for (std::size_t i = random() % 60; i > 0; --i) {
    switch (random() % 5) {
      case 0:
        tokens.emplace_back();
        break;
      case 1:
        tokens.push_back(std::to_string(static_cast<int>(random())));
        break;
      case 2: {
        std::string text(random() % 9 == 0 ? random() % 300 : 1 + random() % 20, 'x');
        for (char& c : text) c = ",;'H1 abc"[random() % 9];
        if (text.empty()) text = "t";
        tokens.push_back(std::to_string(text.size()) + "H" + text);
        break;
      }
      default:
        tokens.push_back(iges_real(std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 200) - 100)));
    }
  }
  if (!tokens.empty() && tokens.back().empty()) tokens.back() = "0";
  return tokens;
}

std::string spelled(const Token& token) {
  const std::string text(token.text);
  return token.kind == Token::Kind::Hollerith ? std::to_string(text.size()) + "H" + text : text;
}

}  // namespace

BOOST_AUTO_TEST_CASE(what_is_written_reads_back_token_for_token) {
  std::mt19937 random(5);
  Writer writer(millimetres(), {"first line", std::string(100, 's')});
  std::vector<std::vector<std::string>> written;
  for (int i = 0; i < 300; ++i) {
    DirectoryEntry entry;
    entry.type = 110;
    entry.form = i % 3;
    entry.colour = i % 9;
    entry.level = i;
    entry.status = {0, 1, 5, 2};
    entry.label = fmt::format("L{}", i);
    entry.subscript = i;
    written.push_back(random_tokens(random));
    BOOST_TEST(writer.add(entry, written.back()).de == 2 * i + 1);
  }
  const auto bytes = writer.finish();
  BOOST_TEST_REQUIRE(bytes.has_value());
  BOOST_TEST(bytes->size() % 81 == 0u);

  Report report;
  const File file = File::parse(*bytes, {}, report);
  BOOST_TEST(report.items().empty(), (report.items().empty() ? "" : report.items()[0].text));
  BOOST_TEST_REQUIRE(file.directory().size() == written.size());
  for (std::size_t i = 0; i < written.size(); ++i) {
    const DirectoryEntry& entry = file.directory()[i];
    BOOST_TEST(entry.form == static_cast<int>(i % 3));
    BOOST_TEST(entry.level == static_cast<int>(i));
    BOOST_TEST(entry.status.use == 5);
    BOOST_TEST(entry.label == fmt::format("L{}", i));
    const Parameters parameters = file.parameters(entry, report);
    BOOST_TEST(parameters.terminated);
    BOOST_TEST_REQUIRE(parameters.tokens.size() == written[i].size() + 1);
    BOOST_TEST(parameters.tokens[0].text == "110");
    for (std::size_t k = 0; k < written[i].size(); ++k) BOOST_TEST(spelled(parameters.tokens[k + 1]) == written[i][k]);
  }
  BOOST_TEST(report.items().empty());
}

BOOST_AUTO_TEST_CASE(global_values_survive_to_the_last_bit) {
  const Global g = millimetres();
  const auto bytes = Writer(g).finish();
  BOOST_TEST_REQUIRE(bytes.has_value());
  Report report;
  const Global back = File::parse(*bytes, {}, report).global();
  BOOST_TEST(back.sender_product == g.sender_product);
  BOOST_TEST(back.author == g.author);
  BOOST_TEST(back.resolution == g.resolution);
  BOOST_TEST(back.max_coordinate == g.max_coordinate);
  BOOST_TEST(back.unit_flag == 2);
  BOOST_TEST(back.modified == g.modified);
  BOOST_TEST(back.fields_present == 26u);
}

BOOST_AUTO_TEST_CASE(other_delimiters_are_written_and_read) {
  Global g = millimetres();
  g.parameter_delimiter = '/';
  g.record_delimiter = '#';
  Writer writer(g);
  DirectoryEntry entry;
  entry.type = 116;
  writer.add(entry, {"1.", "2.", "3.", "0"});
  Report report;
  const File file = File::parse(*writer.finish(), {}, report);
  BOOST_TEST(report.items().empty());
  BOOST_TEST(file.parameters(file.directory()[0], report).tokens.size() == 5u);
}

BOOST_AUTO_TEST_CASE(pointer_groups_follow_the_own_parameters) {
  Writer writer(millimetres());
  DirectoryEntry entry;
  entry.type = 116;
  writer.add(entry, {"1.", "2.", "3.", "0"}, {{Ref{7}}, {Ref{9}, Ref{11}}});
  Report report;
  const File file = File::parse(*writer.finish(), {}, report);
  const Parameters p = file.parameters(file.directory()[0], report);
  std::string all;
  for (const Token& token : p.tokens) all += spelled(token) + " ";
  BOOST_TEST(all == "116 1. 2. 3. 0 1 7 2 9 11 ");
}

BOOST_AUTO_TEST_CASE(control_characters_cannot_break_the_cards) {
  Writer writer(millimetres());
  DirectoryEntry entry;
  entry.type = 406;
  entry.label = "a\nb";
  writer.add(entry, {"1", "5Ha\nb\rc"});
  Report report;
  const File file = File::parse(*writer.finish(), {}, report);
  BOOST_TEST(report.items().empty());
  BOOST_TEST(file.parameters(file.directory()[0], report).tokens[2].text == "a b c");
}

BOOST_AUTO_TEST_CASE(what_has_no_place_in_the_columns_is_refused) {
  Writer writer(millimetres());
  DirectoryEntry entry;
  entry.type = 116;
  entry.level = 123456789;
  writer.add(entry, {"0", "0", "0"});
  const auto bytes = writer.finish();
  BOOST_TEST_REQUIRE(!bytes.has_value());
  BOOST_TEST((bytes.error().code == ErrorCode::InvalidArgument));

  Global g = millimetres();
  g.record_delimiter = ',';
  BOOST_TEST(!Writer(g).finish().has_value());
}

// Refused rather than wrapped: sequence numbers have seven digits, tried here with three.
BOOST_AUTO_TEST_CASE(more_cards_than_can_be_numbered_are_refused) {
  const auto written = [](int entities, int tokens) {
    iges::Writer writer(Global{}, {}, 999);
    for (int i = 0; i < entities; ++i) writer.add(DirectoryEntry{}, std::vector<std::string>(static_cast<std::size_t>(tokens), "123456789."));
    return writer.finish();
  };
  BOOST_TEST(written(499, 1).has_value());  // 998 Directory cards
  const auto directory = written(500, 1);
  BOOST_REQUIRE(!directory);
  BOOST_TEST((directory.error().code == ErrorCode::Limit));
  BOOST_TEST(written(1, 4000).has_value());
  const auto parameters = written(1, 6000);
  BOOST_REQUIRE(!parameters);
  BOOST_TEST((parameters.error().code == ErrorCode::Limit));
}

BOOST_AUTO_TEST_CASE(a_section_never_wraps_around) {
  CardWriter cards('P', 64, 3);
  for (int i = 0; i < 3; ++i) cards.line("data");
  BOOST_TEST(!cards.full());
  std::string before, after;
  cards.append_to(before);
  BOOST_TEST(before.size() == cards.size());
  cards.line("one too many");
  cards.append_to(after);
  BOOST_TEST(cards.full());
  BOOST_TEST(cards.cards() == 3u);
  BOOST_TEST(after == before);
}
