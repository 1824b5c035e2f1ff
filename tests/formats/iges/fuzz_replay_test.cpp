// Inputs that once broke the reader, and the fuzzer's seeds, replayed on every run; then each seed with every byte damaged.

#include <boost/test/unit_test.hpp>
#include <random>

#include "tests/fuzz/iges_property.h"
#include "tests/support/corpus.h"
#include "tests/support/paths.h"

using namespace trimloop::test;

namespace {

std::vector<std::filesystem::path> kept_inputs() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(trimloop::test::source_dir() / "tests/data/fuzz_iges"))
    files.push_back(entry.path());
  return files;
}

}  // namespace

BOOST_AUTO_TEST_CASE(kept_inputs_break_no_promise) {
  const auto files = kept_inputs();
  BOOST_TEST_REQUIRE(!files.empty());
  for (const auto& path : files) {
    const char* broken = broken_iges_promise(read_file(path));
    BOOST_TEST(broken == nullptr, path << ": " << (broken ? broken : ""));
  }
}

BOOST_AUTO_TEST_CASE(any_single_damaged_byte_is_survived) {
  std::mt19937 random(17);
  for (const auto& path : kept_inputs()) {
    std::string bytes = read_file(path);
    for (std::size_t i = 0; i < std::min<std::size_t>(bytes.size(), 6000); ++i) {
      const char before = bytes[i];
      bytes[i] = random() % 2 ? static_cast<char>(random()) : " ,;H0129-+.ED\n\r\tPDGST"[random() % 21];
      const char* broken = broken_iges_promise(bytes);
      BOOST_TEST_REQUIRE(broken == nullptr, path << " byte " << i << ": " << (broken ? broken : ""));
      bytes[i] = before;
    }
  }
}
