// The malformed files I01 to I36 of the catalogue of bad inputs, and what must become of each:
// rejected (a fatal finding, no entities), partial (the bad entity is unusable, the rest goes on) or accepted with a
// finding.

#include <boost/test/unit_test.hpp>
#include <chrono>

#include "base/number.h"
#include "formats/iges/file.h"
#include "formats/iges/records/any.h"
#include "tests/support/iges_text.h"

using namespace trimloop;
using namespace trimloop::iges;
using namespace trimloop::test;

namespace {

struct Read {
  Report report;
  File file;
  explicit Read(std::string bytes) : file(File::parse(std::move(bytes), {}, report)) {}

  // Lexes and decodes all records; their findings join the others.
  Read& records() {
    for (const DirectoryEntry& entry : file.directory()) read_any(file, entry, Limits{}, report);
    return *this;
  }
  bool rejected() const { return report.has_fatal() && file.directory().empty(); }
  bool has(std::string_view rule) const { return report.count(rule) > 0; }
  const DirectoryEntry& entry(int de) const { return *file.find(Ref{de}); }
};

// Three lines (1, 3, 5), a matrix (7) and a point in it (9).
IgesText sample() {
  IgesText text;
  for (int i = 0; i < 3; ++i) text.add(110, std::to_string(i) + ".,0.,0.,1.,1.,1.");
  const int matrix = text.add(124, "1.,0.,0.,5.,0.,1.,0.,6.,0.,0.,1.,7.");
  text.add(116, "1.,2.,3.,0", {.transform = matrix});
  return text;
}

std::vector<std::string> cards_of(char section, std::vector<std::string> cards = sample().cards()) {
  std::erase_if(cards, [section](const std::string& card) { return card[72] != section; });
  return cards;
}

std::size_t first_of(char section, const std::vector<std::string>& cards) {
  std::size_t i = 0;
  while (cards[i][72] != section) ++i;
  return i;
}

// The sample with something done to its cards.
template <class Change>
Read with_cards(Change change) {
  auto cards = sample().cards();
  change(cards);
  return Read(join_cards(cards));
}

// The sample with one Directory field (1 to 20) of an entry replaced.
Read with_field(int de, int field, std::string_view value) {
  return with_cards([&](std::vector<std::string>& cards) {
    std::string& card = cards[first_of('D', cards) + static_cast<std::size_t>(de - 1 + (field > 10))];
    std::string text(8 - std::min<std::size_t>(8, value.size()), ' ');
    text += value;
    card.replace(static_cast<std::size_t>((field - 1) % 10) * 8, 8, text);
  });
}

// The sample with another Global section, whole or one field (3 to 26) of it.
Read with_global_text(const std::string& global) {
  return with_cards([&](std::vector<std::string>& cards) {
    const std::size_t at = first_of('G', cards);
    std::erase_if(cards, [](const std::string& card) { return card[72] == 'G'; });
    std::size_t n = 0;
    for (std::size_t i = 0; i < global.size(); i += 72, ++n)
      cards.insert(cards.begin() + static_cast<std::ptrdiff_t>(at + n), iges_card(global.substr(i, 72), 'G', n + 1));
  });
}
Read with_global(int field, std::string_view value) {
  IgesText text = sample();
  std::size_t from = 0;
  for (int i = 3; i < field; ++i) from = text.global.find(',', from) + 1;
  text.global.replace(from, text.global.find(',', from) - from, value);
  return Read(text.text());
}

double seconds_of(const std::string& bytes) {
  const auto start = std::chrono::steady_clock::now();
  Read(bytes).records();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

BOOST_AUTO_TEST_CASE(i01_i02_i03_what_is_no_iges_is_rejected) {
  const std::string png = "\x89PNG\r\n\x1a\n" + std::string(3000, '\x7f') + "IHDR" + std::string(500, '\0');
  for (const std::string& bytes :
       {std::string(), std::string(80, ' '), std::string(80, '\0'), std::string(8000, '\xff'), png,
        "PK\x03\x04" + std::string(200000, 'z'), std::string("\n"), std::string("S")}) {
    const Read read(bytes);
    BOOST_TEST(read.rejected());
    BOOST_TEST(read.has("IG-F01"));
    BOOST_TEST(read.file.write() == bytes);
  }
}

BOOST_AUTO_TEST_CASE(i04_every_prefix_is_survived_and_reported) {
  IgesText text = sample();
  text.add(406, "1," + hollerith("a string, long enough to run; over the end of a card, which a cut may split"),
           {.form = 15});
  const std::string whole = text.text();
  for (std::size_t length = 0; length < whole.size(); ++length) {
    Read read(whole.substr(0, length));
    read.records();
    const bool complete = length + 1 >= whole.size();  // only the last line end is missing
    BOOST_TEST_REQUIRE(read.report.items().empty() == complete, "cut at " << length);
    BOOST_TEST_REQUIRE(read.file.directory().size() <= text.entities.size());
    BOOST_TEST_REQUIRE(read.file.write().size() == length);
    if (complete) continue;
    const bool says_so =
        read.has("IG-F01") || read.has("IG-F18") || read.has("IG-F13") || read.has("IG-F06") || read.has("IG-F03");
    BOOST_TEST_REQUIRE(says_so, "cut at " << length);
  }
}

BOOST_AUTO_TEST_CASE(i04_a_cut_within_a_record_is_called_truncated) {
  const auto cards = sample().cards();
  const std::string in_card = join_cards(cards).substr(0, (cards.size() - 2) * 81 + 30);
  BOOST_TEST(Read(in_card).has("IG-F18"));
  const std::string between_cards = join_cards(cards).substr(0, (cards.size() - 2) * 81);
  BOOST_TEST(Read(between_cards).has("IG-F18"));
}

BOOST_AUTO_TEST_CASE(i05_i06_terminate_missing_or_wrong) {
  const Read missing = with_cards([](auto& cards) { cards.pop_back(); });
  BOOST_TEST(missing.has("IG-F13"));
  BOOST_TEST(!missing.has("IG-F18"));
  BOOST_TEST(missing.file.directory().size() == 5u);
  for (const char* counts : {"S      1G      3D     11P      5", "S9999999G9999999D9999999P9999999",
                             "S       G       D       P", "garbage"}) {
    const Read read = with_cards([&](auto& cards) { cards.back() = iges_card(counts, 'T', 1); });
    BOOST_TEST(read.has("IG-F14"));
    BOOST_TEST(read.file.directory().size() == 5u);
    BOOST_TEST(!read.report.has_fatal());
  }
}

BOOST_AUTO_TEST_CASE(i07_nothing_behind_the_first_terminate_is_read) {
  const std::string whole = sample().text();
  const Read read(whole + whole);
  BOOST_TEST(read.has("IG-F15"));
  BOOST_TEST(read.has("IG-F12"));
  BOOST_TEST(read.file.directory().size() == 5u);
}

BOOST_AUTO_TEST_CASE(i08_directory_before_global_is_rejected) {
  const Read read = with_cards([](auto& cards) {
    std::vector<std::string> out;
    for (char section : {'S', 'D', 'G', 'P', 'T'})
      for (const std::string& card : cards_of(section, cards)) out.push_back(card);
    cards = out;
  });
  BOOST_TEST(read.rejected());
  BOOST_TEST(read.has("IG-F05"));
  // Interleaved later sections can be told apart.
  const Read late = with_cards([](auto& cards) { std::swap(cards[cards.size() - 2], cards[cards.size() - 8]); });
  BOOST_TEST(late.has("IG-F05"));
  BOOST_TEST(!late.report.has_fatal());
}

BOOST_AUTO_TEST_CASE(i09_unknown_section_letters) {
  const Read read = with_cards([](auto& cards) { cards[first_of('P', cards) + 1][72] = 'X'; });
  BOOST_TEST(read.has("IG-F04"));
  BOOST_TEST(read.file.directory().size() == 5u);
  BOOST_TEST(!read.entry(3).usable);
  for (int de : {1, 5, 7, 9}) BOOST_TEST(read.entry(de).usable);
  // Small letters: see layout_test.
}

BOOST_AUTO_TEST_CASE(i10_sequence_numbers_zero_repeated_or_descending) {
  for (int kind = 0; kind < 3; ++kind) {
    const Read read = with_cards([kind](auto& cards) {
      for (std::size_t i = 0; i < cards.size(); ++i)
        cards[i] = iges_card(cards[i].substr(0, 72), cards[i][72], kind == 0 ? 0 : kind == 1 ? 3 : cards.size() - i);
    });
    BOOST_TEST(read.has("IG-F06"));
    BOOST_TEST(read.file.directory().size() == 5u);
    for (const DirectoryEntry& entry : read.file.directory()) BOOST_TEST(entry.usable);
  }
}

BOOST_AUTO_TEST_CASE(i10_gaps_in_sequence_numbers_keep_their_meaning) {
  // A lost Parameter card takes one entity with it, not all that follow.
  const Read read = with_cards(
      [](auto& cards) { cards.erase(cards.begin() + static_cast<std::ptrdiff_t>(first_of('P', cards)) + 1); });
  BOOST_TEST(!read.entry(3).usable);
  for (int de : {1, 5, 7, 9}) BOOST_TEST(read.entry(de).usable);
}

BOOST_AUTO_TEST_CASE(i11_an_endless_line_costs_little) {
  const std::string endless(10 << 20, 'x');
  BOOST_TEST(Read(endless).rejected());
  const auto cards = sample().cards();
  std::string within;
  for (std::size_t i = 0; i < cards.size(); ++i) within += cards[i] + "\n" + (i == 6 ? endless + "\n" : "");
  const Read read(within);
  BOOST_TEST(read.has("IG-F03"));
  BOOST_TEST(read.file.directory().size() == 5u);
  BOOST_TEST(seconds_of(within) < 2.0);
  // The same as one card after another on a line.
  std::string stream;
  for (int i = 0; i < 50000; ++i) stream += iges_card("text", 'S', static_cast<std::size_t>(i) + 1);
  for (const std::string& card : sample().cards())
    if (card[72] != 'S') stream += card;
  BOOST_TEST(Read(stream).file.directory().size() == 5u);
  BOOST_TEST(seconds_of(stream) < 2.0);
}

BOOST_AUTO_TEST_CASE(i15_cards_of_72_columns_are_rejected) {
  const Read read = with_cards([](auto& cards) {
    for (std::string& card : cards) card.resize(72);
  });
  BOOST_TEST(read.rejected());
  BOOST_TEST(read.has("IG-F01"));
}

BOOST_AUTO_TEST_CASE(i16_rubbish_behind_terminate) {
  const Read read(sample().text() + "\x1a" + std::string(4096, '\xf3'));
  BOOST_TEST(read.has("IG-F12"));
  BOOST_TEST(read.file.directory().size() == 5u);
  BOOST_TEST(!read.has("IG-F09"));
}

BOOST_AUTO_TEST_CASE(i17_i18_other_representations_are_refused_by_name) {
  const std::string compressed = iges_card("", 'C', 1) + "\n" + "trimloop test S 1@110,0.,0.,0.,1.,1.,1.;\n";
  const Read ascii(compressed);
  BOOST_TEST(ascii.rejected());
  BOOST_TEST_REQUIRE(ascii.has("IG-F02"));
  BOOST_TEST(ascii.report.items()[0].text.find("compressed ASCII") != std::string::npos);
  BOOST_TEST((sniff(compressed) == Sniff::CompressedAscii));

  const std::string binary = std::string("B\x7f\xff\xff\xff", 5) + std::string(75, '\0') + std::string(400, '\x11');
  const Read bits(binary);
  BOOST_TEST(bits.rejected());
  BOOST_TEST_REQUIRE(bits.has("IG-F02"));
  BOOST_TEST(bits.report.items()[0].text.find("binary") != std::string::npos);
  BOOST_TEST((sniff(binary) == Sniff::Binary));

  BOOST_TEST((sniff(sample().text()) == Sniff::FixedAscii));
  BOOST_TEST((sniff("ISO-10303-21;\nHEADER;\n") == Sniff::No));
}

BOOST_AUTO_TEST_CASE(i19_an_odd_directory_card) {
  const Read last = with_cards(
      [](auto& cards) { cards.erase(cards.begin() + static_cast<std::ptrdiff_t>(first_of('P', cards)) - 1); });
  BOOST_TEST(last.has("IG-F17"));
  BOOST_TEST(last.file.directory().size() == 4u);
  // In the middle: the numbers keep the later entries where they were.
  const Read middle = with_cards(
      [](auto& cards) { cards.erase(cards.begin() + static_cast<std::ptrdiff_t>(first_of('D', cards)) + 3); });
  BOOST_TEST(middle.has("IG-F17"));
  BOOST_TEST(middle.has("IG-D31"));
  BOOST_TEST(middle.file.find(Ref{3}) == nullptr);
  for (int de : {1, 5, 7, 9}) BOOST_TEST(middle.entry(de).usable);
}

BOOST_AUTO_TEST_CASE(i20_i21_delimiters_that_cannot_be_used) {
  const std::string rest = "4Htest,8Htest.igs,1Hx,1Hx,32,38,6,308,15,,1.,2,2HMM,1,1.,,1.E-6,0.,,,11,0,,;";
  BOOST_TEST(with_global_text("1H,,1H,," + rest).rejected());
  BOOST_TEST(with_global_text("1H,,1H,," + rest).has("IG-G04"));
  for (const char* bad : {"1H551H;5", "1H  1H; ", "1HHH1H;H", "1H--1H;-"}) {
    const Read read = with_global_text(bad + rest);
    BOOST_TEST(read.rejected(), bad);
    BOOST_TEST(read.has("IG-G02"), bad);
  }
  BOOST_TEST(with_global_text("1H,,1H7," + rest).has("IG-G03"));
  BOOST_TEST(with_global_text("1H,,1H7," + rest).rejected());
  BOOST_TEST(with_global_text("this is no Global section;").has("IG-G01"));
  BOOST_TEST(with_global_text("this is no Global section;").rejected());
  const Read none =
      with_cards([](auto& cards) { std::erase_if(cards, [](const std::string& card) { return card[72] == 'G'; }); });
  BOOST_TEST(none.has("IG-G01"));
  BOOST_TEST(none.rejected());
}

BOOST_AUTO_TEST_CASE(i22_i23_string_counts_in_the_global_section) {
  const Read huge = with_global(3, "999999999H");
  BOOST_TEST(huge.rejected());
  BOOST_TEST(huge.has("IG-G07"));
  const Read huge_last = with_global(26, "99999999999999999999999999Habc");
  BOOST_TEST(huge_last.has("IG-G07"));

  for (const char* odd : {"0H", "3Habcd", "9Habc"}) {
    const Read read = with_global(3, odd);
    BOOST_TEST(read.has("IG-G07"), odd);
    BOOST_TEST(!read.report.has_fatal(), odd);
    BOOST_TEST(read.file.global().file_name == "test.igs", odd);
    BOOST_TEST(read.file.directory().size() == 5u);
  }
  BOOST_TEST(with_global(3, "3Habcd").file.global().sender_product == "abc");
  BOOST_TEST(with_global(3, "9Habc").file.global().sender_product == "abc");
  const Read negative = with_global(3, "-1H");
  BOOST_TEST(negative.has("IG-G08"));
  BOOST_TEST(negative.file.global().file_name == "test.igs");
}

BOOST_AUTO_TEST_CASE(i23_string_counts_in_records) {
  IgesText text;
  text.add(406, "1,0H", {.form = 15});
  text.add(406, "1,-1H", {.form = 15});
  text.add(406, "1,3Habcd", {.form = 15});
  text.add(406, "1,99999999999Habc", {.form = 15});
  text.add(116, "1.,2.,3.,0");
  Read read(text.text());
  read.records();
  BOOST_TEST(read.report.count("IG-P11") >= 3u);
  Report report;
  BOOST_TEST(read.file.parameters(read.entry(5), report).tokens[2].text == "abc");
  BOOST_TEST(read.file.parameters(read.entry(7), report).tokens[2].text == "abc");
  BOOST_TEST(read_any(read.file, read.entry(9), Limits{}, report).as<PointRecord>() != nullptr);
}

BOOST_AUTO_TEST_CASE(i24_a_global_section_cut_short) {
  const Read ended = with_global_text("1H,,1H;,4Htest,8Htest.igs,1Hx;");
  BOOST_TEST(ended.has("IG-G05"));
  BOOST_TEST(!ended.report.has_fatal());
  BOOST_TEST(ended.file.global().unit_flag == 1);
  const Read cut = with_global_text("1H,,1H;,4Htest,8Htest.igs,1Hx,");
  BOOST_TEST(cut.has("IG-G06"));
  BOOST_TEST(cut.rejected());
}

BOOST_AUTO_TEST_CASE(i25_i26_units) {
  const Read absent = with_global(14, "");
  BOOST_TEST(!absent.has("IG-G15"));
  BOOST_TEST(absent.file.global().unit_flag == 1);
  BOOST_TEST(absent.file.global().unit_known);
  BOOST_TEST(unit_in_mm(absent.file.global()) == 25.4);
  for (const char* bad : {"0", "12", "-1", "2HMM", "1073837920", "MM"}) {
    const Read read = with_global(14, bad);
    BOOST_TEST(read.has("IG-G15"), bad);
    BOOST_TEST(!read.file.global().unit_known);
    BOOST_TEST(unit_in_mm(read.file.global()) == 1.0);
    BOOST_TEST(read.file.directory().size() == 5u);
  }
  const Read conflict = with_global(14, "6");
  BOOST_TEST(conflict.has("IG-G16"));
  BOOST_TEST(unit_in_mm(conflict.file.global()) == 1000.0);

  IgesText text = sample();
  text.global.replace(text.global.find("2,2HMM"), 6, "3,7HFURLONG");
  const Read unknown(text.text());
  BOOST_TEST(unknown.has("IG-G17"));
  BOOST_TEST(!unknown.file.global().unit_known);
  text.global.replace(text.global.find("7HFURLONG"), 9, "2Hcm");
  const Read named(text.text());
  BOOST_TEST(!named.has("IG-G17"));
  BOOST_TEST(unit_in_mm(named.file.global()) == 10.0);
}

BOOST_AUTO_TEST_CASE(i27_i28_resolution_and_scale) {
  for (const char* bad : {"0", "-1.", "NAN", ""}) {
    const Read read = with_global(19, bad);
    BOOST_TEST(read.has("IG-G22"), bad);
    BOOST_TEST(resolution_in_mm(read.file.global()) == 0.001);
  }
  BOOST_TEST(with_global(19, "NAN").has("IG-G08"));
  for (const char* odd : {"1E+300", "1.E-200", "5."}) {
    const Read read = with_global(19, odd);
    BOOST_TEST(read.has("IG-G23"), odd);
    BOOST_TEST(resolution_in_mm(read.file.global()) == 0.001);
  }
  BOOST_TEST(resolution_in_mm(with_global(19, "1.D-4").file.global()) == 1e-4);
  for (const char* bad : {"0.", "1E-320", "-2."}) {
    const Read read = with_global(13, bad);
    BOOST_TEST(read.has("IG-G14"), bad);
    BOOST_TEST(read.file.global().model_scale == 1.0);
  }
  BOOST_TEST(with_global(13, "0.5").has("IG-G14"));
  BOOST_TEST(with_global(13, "0.5").report.count(Severity::Error) == 0u);
}

BOOST_AUTO_TEST_CASE(other_global_fields_out_of_range) {
  const struct {
    int field;
    const char *value, *rule;
  } cases[] = {{7, "4", "IG-G09"},
               {8, "-1", "IG-G10"},
               {9, "0", "IG-G10"},
               {10, "0", "IG-G11"},
               {11, "-3", "IG-G11"},
               {16, "0", "IG-G18"},
               {17, "0.", "IG-G19"},
               {18, "8Htomorrow", "IG-G20"},
               {18, "13H991301.000000", "IG-G20"},
               {23, "134523424", "IG-G26"},
               {23, "0", "IG-G26"},
               {24, "9", "IG-G28"},
               {25, "15H20270101.000000", "IG-G21"},
               {21, "", "IG-G29"},
               {7, "x", "IG-G08"}};
  for (const auto& c : cases) {
    const Read read = with_global(c.field, c.value);
    BOOST_TEST(read.has(c.rule), c.field << " " << c.value);
    BOOST_TEST(read.report.items().size() == 1u, c.field << " " << c.value);
    BOOST_TEST(read.file.directory().size() == 5u);
  }
  BOOST_TEST(with_global(23, "134523424").file.global().version_flag == 11);
  BOOST_TEST(with_global(23, "-5").file.global().version_flag == 3);
}

BOOST_AUTO_TEST_CASE(i29_a_comma_as_decimal_mark) {
  IgesText text;
  text.global =
      "4Htest,8Htest.igs,1Hx,1Hx,32,38,6,308,15,4Htest,1,0,2,2HMM,1,1,0,15H20260101.000000,1,0E-6,1000,0,,,11,0,,";
  text.add(110, "0,0,0,0,0,0,1,5,0,0,0,0");
  Read read(text.text());
  read.records();
  BOOST_TEST(read.report.count(Severity::Error) > 0u);  // nothing of it can be believed, and it says so
}

BOOST_AUTO_TEST_CASE(i30_i31_numbers_that_are_none) {
  for (const char* bad : {"1.D", ".D0", "1D+", "--1", "1E99999"}) {
    IgesText text;
    text.add(110, std::string(bad) + ",0.,0.,1.,1.,1.");
    text.add(110, "0.,0.,0.,1.,1.,1.");
    Read read(text.text());
    read.records();
    BOOST_TEST((read.has("IG-P06") || read.has("IG-P07")), bad);
    Report report;
    BOOST_TEST(read_any(read.file, read.entry(1), Limits{}, report).is_raw());
    BOOST_TEST(!read_any(read.file, read.entry(3), Limits{}, report).is_raw());
  }
  IgesText text;
  text.add(102, "99999999999999999999,1");
  Read read(text.text());
  read.records();
  BOOST_TEST(read.has("IG-P09"));
}

BOOST_AUTO_TEST_CASE(i32_parameter_pointers_that_lead_nowhere) {
  // The cards name their entity back, so its data are found all the same; without that name the entity is lost.
  for (const char* bad : {"0", "-3", "99", "9999999", "4"}) {
    const Read found = with_field(3, 2, bad);
    BOOST_TEST(found.has("IG-D05"), bad);
    BOOST_TEST(found.entry(3).usable, bad);
    Report report;
    BOOST_TEST(found.file.parameters(found.entry(3), report).tokens[1].text == "1.");
  }
  const Read lost = with_cards([](auto& cards) {
    cards[first_of('D', cards) + 2].replace(8, 8, "      99");
    cards[first_of('P', cards) + 1].replace(64, 8, "        ");
  });
  BOOST_TEST(lost.has("IG-D05"));
  BOOST_TEST(lost.has("IG-D09"));
  BOOST_TEST(!lost.entry(3).usable);
  BOOST_TEST(lost.entry(5).usable);
  Report report;  // found by fuzzing: a record without a single token
  BOOST_TEST(read_any(lost.file, lost.entry(3), Limits{}, report).is_raw());
}

BOOST_AUTO_TEST_CASE(i33_line_counts_and_overlaps) {
  for (const char* bad : {"0", "9999999", "2", "-1"}) {
    const Read read = with_field(3, 14, bad);
    BOOST_TEST(read.has("IG-D06"), bad);
    for (const DirectoryEntry& entry : read.file.directory()) BOOST_TEST(entry.usable);
    Report report;
    BOOST_TEST(read.file.parameters(read.entry(3), report).tokens.size() == 7u);
  }
  // No back pointers: the counts alone make the ranges, and one runs into the next.
  const Read overlap = with_cards([](auto& cards) {
    for (std::string& card : cards)
      if (card[72] == 'P') card.replace(64, 8, "        ");
    cards[first_of('D', cards) + 3].replace(24, 8, "       3");
  });
  BOOST_TEST(overlap.has("IG-D06"));
  BOOST_TEST(overlap.has("IG-D08"));
  BOOST_TEST(overlap.has("IG-D07"));
  for (const DirectoryEntry& entry : overlap.file.directory()) BOOST_TEST(entry.usable);
  // Two entries with one record: the one that the card names keeps it.
  const Read shared = with_cards([](auto& cards) {
    cards[first_of('D', cards) + 2].replace(8, 8, "       1");
    cards.erase(cards.begin() + static_cast<std::ptrdiff_t>(first_of('P', cards)) + 1);
  });
  BOOST_TEST(shared.has("IG-D08"));
  BOOST_TEST(shared.entry(1).usable);
  BOOST_TEST(!shared.entry(3).usable);
}

BOOST_AUTO_TEST_CASE(i33_huge_counts_everywhere_stay_linear) {
  IgesText text;
  for (int i = 0; i < 20000; ++i) text.add(116, "1.,2.,3.,0");
  auto cards = text.cards();
  const std::size_t d = first_of('D', cards);
  for (std::size_t i = 0; i < 40000; i += 2) {
    cards[d + i].replace(8, 8, "       1");
    cards[d + i + 1].replace(24, 8, " 9999999");
  }
  for (std::string& card : cards)
    if (card[72] == 'P') card.replace(64, 8, "        ");
  BOOST_TEST(seconds_of(join_cards(cards)) < 5.0);
}

BOOST_AUTO_TEST_CASE(i34_data_of_another_type) {
  const Read read = with_cards([](auto& cards) { cards[first_of('P', cards) + 1].replace(0, 3, "116"); });
  BOOST_TEST(read.has("IG-D10"));
  BOOST_TEST(!read.entry(3).usable);
  BOOST_TEST(read.entry(5).usable);
  // Found by fuzzing: a first parameter beyond any integer.
  const Read endless =
      with_cards([](auto& cards) { cards[first_of('P', cards) + 1].replace(0, 20, std::string(20, '9')); });
  BOOST_TEST(endless.has("IG-D10"));
  BOOST_TEST(!endless.entry(3).usable);
  // When one of the two types that the Directory states is that of the data, it is believed.
  const Read twice = with_field(3, 1, "116");
  BOOST_TEST(twice.has("IG-D01"));
  BOOST_TEST(twice.entry(3).type == 110);
  BOOST_TEST(twice.entry(3).usable);
}

BOOST_AUTO_TEST_CASE(i35_directory_pointers) {
  const struct {
    int field;
    const char *value, *rule;
  } cases[] = {{7, "8", "IG-R02"},  {7, "99", "IG-R01"},  {7, "-7", "IG-D32"},  {7, "1", "IG-D15"},
               {6, "3", "IG-D14"},  {8, "3", "IG-D16"},   {4, "-3", "IG-D12"},  {4, "9", "IG-D12"},
               {5, "-3", "IG-D13"}, {13, "-3", "IG-D25"}, {13, "99", "IG-D25"}, {13, "-99", "IG-R01"},
               {3, "5", "IG-D11"},  {12, "5", "IG-D24"}};
  for (const auto& c : cases) {
    const Read read = with_field(9, c.field, c.value);
    BOOST_TEST(read.has(c.rule), c.field << " " << c.value);
    BOOST_TEST(read.report.items().size() == 1u, c.field << " " << c.value);
    const DirectoryEntry& e = read.entry(9);
    BOOST_TEST(e.usable);
    if (c.field == 7) BOOST_TEST(e.transform == 0);
    if (c.field == 13) BOOST_TEST(e.colour == 0);
    BOOST_TEST(read.report.items()[0].entity == "D9");
    BOOST_TEST(read.report.items()[0].location.section == 'D');
  }
}

BOOST_AUTO_TEST_CASE(i36_status_fields) {
  const struct {
    const char *value, *rule;
    Status status;
  } cases[] = {{"99999999", "IG-D18", {0, 0, 0, 0}}, {"99999999", "IG-D19", {0, 0, 0, 0}},
               {"99999999", "IG-D20", {0, 0, 0, 0}}, {"99999999", "IG-D21", {0, 0, 0, 0}},
               {"0X010500", "IG-D17", {0, 1, 5, 0}}, {"0 01050 ", "IG-D17", {0, 1, 5, 0}},
               {"10600", "", {0, 1, 6, 0}},          {"", "", {0, 0, 0, 0}},
               {"01030602", "", {1, 3, 6, 2}}};
  for (const auto& c : cases) {
    const Read read = with_field(1, 9, c.value);
    const Status& s = read.entry(1).status;
    BOOST_TEST((s.blank == c.status.blank && s.subordinate == c.status.subordinate && s.use == c.status.use &&
                s.hierarchy == c.status.hierarchy),
               c.value);
    if (*c.rule)
      BOOST_TEST(read.has(c.rule), c.value);
    else
      BOOST_TEST(read.report.items().empty(), c.value);
  }
}

BOOST_AUTO_TEST_CASE(letters_in_numeric_directory_fields) {
  for (int field : {3, 4, 5, 6, 7, 8, 12, 13, 15}) {
    const Read read = with_field(1, field, "12A");
    BOOST_TEST(read.has("IG-D30"), field);
    BOOST_TEST(read.entry(1).usable);
  }
  BOOST_TEST(with_field(1, 19, "12A").has("IG-D28"));
  BOOST_TEST(with_field(1, 16, "12A").has("IG-D26"));
  BOOST_TEST(with_field(1, 1, "11O").entry(1).type == 110);
}

BOOST_AUTO_TEST_CASE(records_that_do_not_end) {
  Read read = with_cards([](auto& cards) {
    std::string& card = cards[first_of('P', cards) + 1];
    card[card.find(';')] = ' ';
  });
  Report report;
  const Parameters p = read.file.parameters(read.entry(3), report);
  BOOST_TEST(!p.terminated);
  BOOST_TEST(p.tokens.size() == 7u);
  BOOST_TEST(report.count("IG-P01") == 1u);
  BOOST_TEST(report.items()[0].entity == "D3");
  BOOST_TEST(report.items()[0].location.line > 0u);
}

BOOST_AUTO_TEST_CASE(records_with_other_delimiters) {
  Read read = with_cards([](auto& cards) {
    std::string& card = cards[first_of('P', cards) + 1];
    for (char& c : card) c = c == ',' ? '/' : c == ';' ? '#' : c;
  });
  Report report;
  read.file.parameters(read.entry(3), report);
  BOOST_TEST(report.count("IG-P19") == 1u);
}

BOOST_AUTO_TEST_CASE(a_number_over_the_end_of_a_card_is_read_and_reported) {
  Read read = with_cards([](auto& cards) {
    const std::size_t p = first_of('P', cards);
    cards[p] = iges_card("110,0.,0.,0.," + std::string(48, ' ') + "1.2       1", 'P', 1);
    cards.insert(cards.begin() + static_cast<std::ptrdiff_t>(p) + 1,
                 iges_card("5,1.,1.;" + std::string(56, ' ') + "       1", 'P', 2));
    for (std::size_t i = p + 2, n = 3; cards[i][72] == 'P'; ++i, ++n)
      cards[i] = iges_card(cards[i].substr(0, 72), 'P', n);
  });
  Report report;
  const Parameters parameters = read.file.parameters(read.entry(1), report);
  BOOST_TEST(parameters.tokens[4].text == "1.25");
  BOOST_TEST(report.count("IG-P13") == 1u);
  BOOST_TEST(report.items()[0].parameter == 4);
}
