// The triangulation fuzzer's kept inputs, without the fuzzer: every one once broke something.

#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/fuzz/triangulation_property.h"
#include "tests/support/paths.h"

BOOST_AUTO_TEST_CASE(kept_fuzzer_inputs_make_good_triangulations) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(trimloop::test::source_dir() / "tests/data/fuzz_triangulation")) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    BOOST_TEST_INFO(entry.path().filename().string());
    BOOST_TEST(trimloop::mesh::broken_by(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()) == "");
    ++count;
  }
  BOOST_TEST(count > 0u);
}
