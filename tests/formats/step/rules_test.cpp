// Every rule that the header declares is in the table, once, under its own id.

#include "formats/step/rules.h"

#include <boost/test/unit_test.hpp>
#include <fstream>
#include <iterator>
#include <set>

#include "tests/support/paths.h"

BOOST_AUTO_TEST_CASE(rules_of_step_are_all_listed) {
  std::ifstream in(trimloop::test::source_dir() / "formats/step/rules.h");
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  std::size_t declared = 0;
  for (std::size_t at = text.find("inline constexpr Rule "); at != std::string::npos; at = text.find("inline constexpr Rule ", at + 1)) ++declared;
  std::set<std::string_view> ids, slugs;
  for (const trimloop::Rule* rule : trimloop::step::rules::all()) {
    ids.insert(rule->id);
    slugs.insert(rule->slug);
    BOOST_TEST(!rule->why.empty());
    BOOST_TEST(!rule->remedy.empty());
  }
  BOOST_TEST(declared > 60u);
  BOOST_TEST(ids.size() == declared);
  BOOST_TEST(slugs.size() == declared);
}
