#include "base/report.h"

#include <boost/test/unit_test.hpp>

using namespace trimloop;

namespace {
constexpr Rule first{"IG-X01", "first", Severity::Warning, "", "", "", "", ""};
constexpr Rule second{"IG-X02", "second", Severity::Fatal, "", "", "", "", ""};
}  // namespace

BOOST_AUTO_TEST_CASE(a_full_rule_goes_on_counting) {
  Report report;
  for (std::size_t i = 0; i < Report::stored_per_rule + 5; ++i) report.add(first, "again").parameter = 3;
  report.add(second, "once");
  BOOST_TEST(report.items().size() == Report::stored_per_rule + 1);
  BOOST_TEST(report.count("IG-X01") == Report::stored_per_rule + 5);
  BOOST_TEST(report.count(Severity::Warning) == Report::stored_per_rule + 5);
  BOOST_TEST(report.count("IG-X03") == 0u);
  BOOST_TEST(report.has_fatal());
}

BOOST_AUTO_TEST_CASE(a_finding_may_be_graded_away_from_its_rule) {
  Report report;
  report.add(second, Severity::Info, "harmless here");
  BOOST_TEST(!report.has_fatal());
  BOOST_TEST(report.count(Severity::Info) == 1u);
  Diagnostic whole;
  whole.rule = &first;
  whole.severity = Severity::Error;
  whole.entity = "D7";
  report.add(whole);
  BOOST_TEST(report.items().back().entity == "D7");
  BOOST_TEST(report.count(Severity::Error) == 1u);
}

BOOST_AUTO_TEST_CASE(appending_adds_the_counts_and_keeps_the_ceiling) {
  Report a, b;
  for (std::size_t i = 0; i < Report::stored_per_rule - 1; ++i) a.add(first, "a");
  for (std::size_t i = 0; i < Report::stored_per_rule + 7; ++i) b.add(first, "b");
  a.append(std::move(b));
  BOOST_TEST(a.items().size() == Report::stored_per_rule);
  BOOST_TEST(a.items().back().text == "b");
  BOOST_TEST(a.count("IG-X01") == 2 * Report::stored_per_rule + 6);
}

BOOST_AUTO_TEST_CASE(sorting_is_by_place_then_rule) {
  Report report;
  report.add(first, "nowhere");
  report.add(second, "late").location.offset = 9;
  report.add(second, "early, second rule").location.offset = 2;
  report.add(first, "early, first rule").location.offset = 2;
  report.sort();
  BOOST_TEST(report.items()[0].text == "early, first rule");
  BOOST_TEST(report.items()[1].text == "early, second rule");
  BOOST_TEST(report.items()[2].text == "late");
  BOOST_TEST(report.items()[3].text == "nowhere");
}
