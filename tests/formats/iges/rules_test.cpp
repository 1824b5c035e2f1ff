#include "formats/iges/rules.h"
#include "tests/support/paths.h"

#include <boost/test/unit_test.hpp>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

using namespace trimloop;

namespace {

std::size_t declared_in(const char* header) {
  std::ifstream file(trimloop::test::source_dir().string() + "/formats/iges/" + header);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find("inline constexpr Rule ", at)) != std::string::npos; ++at) ++count;
  return count;
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_declared_rule_is_listed_once) {
  std::set<std::string_view> ids;
  for (const Rule* rule : iges::rules::all()) BOOST_TEST(ids.insert(rule->id).second, rule->id);
  BOOST_TEST(ids.size() == declared_in("rules.h") + declared_in("rules_entities.h"));
}

BOOST_AUTO_TEST_CASE(every_rule_says_what_why_and_what_to_do) {
  for (const Rule* rule : iges::rules::all()) {
    BOOST_TEST(rule->id.substr(0, 3) == "IG-");
    BOOST_TEST(!rule->slug.empty());
    BOOST_TEST(!rule->checks.empty());
    BOOST_TEST(!rule->why.empty());
    BOOST_TEST(!rule->remedy.empty());
  }
}
