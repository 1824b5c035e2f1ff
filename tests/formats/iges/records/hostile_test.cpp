// Counts that lie, numbers that do not fit: the right rule, no large allocation, never a crash.
#include <boost/test/unit_test.hpp>

#include "tests/formats/iges/records/decode.h"
#include "tests/support/allocations.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

struct Attack {
  int type, form;
  const char* text;
  const char* rule;
};

}  // namespace

BOOST_AUTO_TEST_CASE(lying_counts_are_refused_before_anything_is_allocated) {
  const Attack attacks[] = {
      {126, 0, "2147483647,1,0,0,1,0,0.,0.,1.,1.", "IG-E126-02"},
      {126, 0, "2147483647,1,0,0,1,0,0.,0.,1.,1.", "IG-P17"},
      {126, 0, "-1,1,0,0,1,0,0.,0.,1.,1.", "IG-E126-01"},
      {126, 0, "2147483647,2147483647,0,0,1,0,0.,0.,1.,1.", "IG-P17"},
      {126, 0, "9223372036854775807,1,0,0,1,0,0.,0.,1.,1.", "IG-P09"},
      {126, 0, "1,0,0,0,1,0,0.,0.,1.,1.", "IG-E126-01"},
      {126, 0, "1,2,0,0,1,0,0.,0.,1.,1.", "IG-E126-01"},
      {126, 0, "1000000,1000000,0,0,1,0,0.,0.,1.,1.", "IG-P17"},
      {126, 0, "5,1000000,0,0,1,0,0.,0.,1.,1.", "IG-E126-01"},
      {128, 0, "2147483647,2147483647,1,1,0,0,1,0,0,0.,0.,1.,1.", "IG-E128-02"},
      {128, 0, "2147483647,2147483647,1,1,0,0,1,0,0,0.,0.,1.,1.", "IG-P17"},
      {128, 0, "2147483647,2147483647,2147483647,2147483647,0,0,1,0,0,0.,0.,1.,1.", "IG-P17"},
      {128, 0, "1,-1,1,1,0,0,1,0,0,0.,0.,1.,1.", "IG-E128-01"},
      {112, 0, "3,2,3,0,0.", "IG-E112-03"},
      {112, 0, "3,2,3,1000000000,0.,1.", "IG-P17"},
      {114, 0, "3,1,1000000000,1000000000,0.,1.", "IG-P17"},
      {114, 0, "3,1,1,1,0.,1.,0.,1.,5.", "IG-P17"},
      {114, 0, "3,1,0,1,0.,0.,1.", "IG-E114-02"},
      {106, 12, "2,2147483648,0.,0.,0.", "IG-P17"},
      {106, 12, "2,-1,0.,0.,0.", "IG-P18"},
      {106, 12, "1000000,1,0.,0.,0.", "IG-E106-01"},
      {102, 0, "2147483647,5", "IG-P17"},
      {141, 0, "0,1,9,1000000000,5,1,0", "IG-P17"},
      {141, 0, "0,1,9,1,5,1,1000000000", "IG-P17"},
      {143, 0, "0,9,1000000000,13", "IG-P17"},
      {144, 0, "9,1,1000000000,11", "IG-P17"},
      {144, 0, "9,1,2,11,11", "IG-P17"},
      {186, 0, "23,1,1000000000", "IG-P17"},
      {308, 0, "0,1Ha,1000000000,5", "IG-P17"},
      {402, 1, "2147483647,5", "IG-P17"},
      {402, 9, "1,2147483647,5", "IG-P17"},
      {406, 11, "1000000000,5", "IG-P17"},
      {502, 1, "1000000000,0.,0.,0.", "IG-P17"},
      {504, 1, "1000000000,5,15,1,15,2", "IG-P17"},
      {508, 1, "1,0,17,1,1,1000000000", "IG-P17"},
      {508, 1, "1000000000,0,17,1,1,0", "IG-P17"},
      {510, 1, "9,1000000000,1,19", "IG-P17"},
      {514, 1, "1000000000,21,1", "IG-P17"},
  };
  for (const Attack& attack : attacks) {
    const IgesText text = [&] {
      IgesText file = stock_file();
      file.add(attack.type, attack.text, {.form = attack.form});
      return file;
    }();
    Report of_file, report;
    const iges::File file = iges::File::parse(text.text(), {}, of_file);
    const iges::DirectoryEntry* entry = file.find(iges::Ref{stock::subject});
    BOOST_REQUIRE(entry);
    const iges::Parameters parameters = file.parameters(*entry, report);

    forget_allocations();
    const iges::AnyRecord record = iges::read_any(file, *entry, parameters, {}, report);
    BOOST_TEST_CONTEXT(attack.type << " " << attack.text) {
      BOOST_TEST(largest_allocation() < 100'000u);
      BOOST_TEST(record.is_raw());
      BOOST_TEST(report.count(attack.rule) > 0u);
      BOOST_TEST(first_difference(parameters, iges::write_any(record)) == 0u);
    }
  }
}

BOOST_AUTO_TEST_CASE(lists_over_the_limit_are_refused) {
  Limits limits;
  limits.list_count = 3;
  BOOST_TEST(decode(102, 0, "4,5,7,5,7", limits).has("IG-P17"));
  BOOST_TEST(decode(102, 0, "4,5,7,5,7", limits).record.is_raw());
  BOOST_TEST(!decode(102, 0, "3,5,7,5", limits).record.is_raw());
}

BOOST_AUTO_TEST_CASE(a_record_full_of_rubbish_makes_few_findings) {
  std::string text = "2,1000";
  for (int i = 0; i < 3000; ++i) text += ",--";
  const Decoded decoded = decode(106, 12, text);
  BOOST_TEST(decoded.record.is_raw());
  BOOST_TEST(decoded.report.items().size() < 100u);
  BOOST_TEST(first_difference(decoded.parameters, decoded.written()) == 0u);
}

namespace {

// The stock and one record more for types that it lacks.
IgesText all_sorts() {
  IgesText text = stock_file();
  text.add(104, "1.,0.,1.,0.,0.,-1.,0.,1.,0.,0.,1.", {.form = 1});
  text.add(106, "1,2,0.5,1.,2.,3.,4.", {.form = 11});
  text.add(106, "3,1,1.,2.,3.,0.,0.,1.", {.form = 3});
  text.add(108, "0.,0.,1.,5.,7,0.,0.,5.,1.", {.form = 1});
  text.add(112, "3,2,3,1,0.,2.,1.,1.,0.,0.,0.,2.,0.,0.,0.,0.,3.,0.,3.,1.,0.,0.,4.,2.,0.,0.,24.,36.,18.,3.,0,1,27");
  text.add(118, "5,7,1,0", {.form = 1});
  text.add(120, "5,7,0.,1.");
  text.add(122, "7,0.,0.,10.,1,29,1,27");
  text.add(124, "1.,0.,0.,5.,0.,0.6,-0.8,6.,0.,0.8,0.6,7.");
  text.add(130, "7,1,0,0,0,2.,0.,0.,0.,0.,0.,1.,0.,1.");
  text.add(140, "0.,0.,1.,0.5,9");
  text.add(141, "1,2,9,2,5,1,1,31,7,2,2,31,31");
  text.add(143, "0,9,2,13,13");
  text.add(144, "9,1,2,11,11,11,0,1,27");
  text.add(186, "23,1,1,33,0");
  text.add(190, "1,3,3", {.form = 1});
  text.add(192, "1,3,2.5,3,0,0", {.form = 1});
  text.add(194, "1,3,2.5,30.", {.form = 0});
  text.add(196, "1,2.5,3,3", {.form = 1});
  text.add(198, "1,3,2.5,1.,3", {.form = 1});
  text.add(402, "1,2,5,7,31", {.form = 9});
  text.add(406, "3,1,2,3", {.form = 11});
  text.add(408, "25,1.,2.,3.,0.5");
  text.add(508, "2,0,17,1,1,2,1,31,0,31,1,15,2,0,0", {.form = 1});
  text.add(114, [] {
    std::string patches = "3,1,1,1,0.,1.,0.,1.";
    for (int i = 0; i < 4 * 48; ++i) patches += ",1.";
    return patches;
  }());
  return text;
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts(1);
  for (char c : text) {
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

}  // namespace

// I75: never a crash or a large allocation, whatever comes out goes back with the tokens it came with.
BOOST_AUTO_TEST_CASE(every_integer_may_be_replaced_by_nonsense) {
  const IgesText original = all_sorts();
  std::size_t tried = 0;
  for (std::size_t entity = 0; entity < original.entities.size(); ++entity) {
    const std::vector<std::string> parts = split(original.entities[entity].parameters);
    for (std::size_t part = 0; part < parts.size(); ++part) {
      if (!read_integer(parts[part])) continue;
      for (const char* nonsense : {"0", "-1", "2147483647", "2147483648", "9223372036854775808", "2", "1000000", ""}) {
        IgesText text = original;
        std::vector<std::string> damaged = parts;
        damaged[part] = nonsense;
        text.entities[entity].parameters = joined(damaged);
        forget_allocations();
        const Decoded decoded = decode(text, static_cast<int>(2 * entity + 1));
        ++tried;
        BOOST_TEST_CONTEXT(text.entities[entity].type << " " << text.entities[entity].parameters) {
          BOOST_TEST(largest_allocation() < 1'000'000u);
          BOOST_TEST(first_difference(decoded.parameters, decoded.written()) == 0u);
        }
      }
    }
  }
  BOOST_TEST(tried > 1000u);
}

// I76 for records.
BOOST_AUTO_TEST_CASE(every_real_may_be_replaced_by_nonsense) {
  const IgesText original = all_sorts();
  for (std::size_t entity = 0; entity + 1 < original.entities.size(); ++entity) {
    const std::vector<std::string> parts = split(original.entities[entity].parameters);
    for (std::size_t part = 0; part < parts.size(); ++part) {
      if (parts[part].find('.') == std::string::npos) continue;
      for (const char* nonsense : {"0.", "-0.", "1.E-320", "1.E308", "-1.E308", "NAN", "INF", "1.E400", ""}) {
        IgesText text = original;
        std::vector<std::string> damaged = parts;
        damaged[part] = nonsense;
        text.entities[entity].parameters = joined(damaged);
        const Decoded decoded = decode(text, static_cast<int>(2 * entity + 1));
        BOOST_TEST_CONTEXT(text.entities[entity].type << " " << text.entities[entity].parameters)
        BOOST_TEST(first_difference(decoded.parameters, decoded.written()) == 0u);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(every_record_may_end_at_any_token) {
  const IgesText original = all_sorts();
  for (std::size_t entity = 0; entity + 1 < original.entities.size(); ++entity) {
    std::vector<std::string> parts = split(original.entities[entity].parameters);
    while (!parts.empty()) {
      parts.pop_back();
      IgesText text = original;
      text.entities[entity].parameters = joined(parts);
      const Decoded decoded = decode(text, static_cast<int>(2 * entity + 1));
      BOOST_TEST_CONTEXT(text.entities[entity].type << " " << text.entities[entity].parameters)
      BOOST_TEST(first_difference(decoded.parameters, decoded.written()) == 0u);
    }
  }
}
