// The figures of docs/seeds.md are what samples/seeds draws, and its examples come out.

#include <boost/test/unit_test.hpp>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "tests/support/corpus.h"
#include "tests/support/paths.h"

using namespace trimloop;
namespace fs = std::filesystem;

namespace {

int run(const std::string& arguments) {
  const fs::path program = trimloop::test::binary_dir() / "samples/sample_seeds";
  return std::system(("'" + program.string() + "' " + arguments).c_str());
}

}  // namespace

BOOST_AUTO_TEST_SUITE(seeds)

BOOST_AUTO_TEST_CASE(the_pictures_are_what_the_program_draws) {
  const fs::path folder = fs::temp_directory_path() / ("trimloop_seeds_" + std::to_string(getpid()));
  BOOST_REQUIRE(run("'" + folder.string() + "'") == 0);
  const fs::path kept = trimloop::test::source_dir() / "docs/seeds";
  const std::string page = trimloop::test::read_file(trimloop::test::source_dir() / "docs/seeds.md");
  std::size_t drawn = 0, stored = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    BOOST_TEST_CONTEXT(name) {
      BOOST_TEST((trimloop::test::read_file(entry.path()) == trimloop::test::read_file(kept / name)));
      BOOST_TEST(page.find("seeds/" + name) != std::string::npos);
    }
    ++drawn;
  }
  for (const auto& entry : fs::directory_iterator(kept)) stored += entry.path().extension() == ".svg";
  BOOST_TEST(drawn == stored);
  BOOST_TEST(drawn >= 20u);
  fs::remove_all(folder);
}

BOOST_AUTO_TEST_CASE(the_worked_examples_come_out) { BOOST_TEST(run("--examples > /dev/null") == 0); }

BOOST_AUTO_TEST_SUITE_END()
