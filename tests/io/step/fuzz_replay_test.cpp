// The promises of the fuzz targets on every file of the micro-suite and on kept inputs.

#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/fuzz/step_property.h"
#include "tests/support/paths.h"

BOOST_AUTO_TEST_CASE(kept_step_inputs_keep_the_promises) {
  std::size_t files = 0;
  for (const char* folder : {"tests/data/step", "tests/data/fuzz_step"}) {
    const auto path = trimloop::test::source_dir() / folder;
    if (!std::filesystem::exists(path)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(path)) {
      std::ifstream in(entry.path(), std::ios::binary);
      const std::string bytes((std::istreambuf_iterator<char>(in)), {});
      const char* broken = trimloop::test::broken_step_promise(bytes);
      BOOST_TEST(broken == nullptr, entry.path() << ": " << (broken ? broken : ""));
      if (entry.path().filename() == "assembly_doubling.stp") continue;
      const char* wrong = trimloop::test::broken_step_import(bytes);
      BOOST_TEST(wrong == nullptr, entry.path() << ": " << (wrong ? wrong : ""));
      ++files;
    }
  }
  BOOST_TEST(files > 40u);
}
