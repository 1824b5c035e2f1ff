// Nothing is lost: every real of the public files keeps its bits through text and back, and writing and reading a hundred
// times changes nothing after the first.

#include <boost/test/unit_test.hpp>
#include <cstring>

#include "base/number.h"
#include "formats/iges/records/any.h"
#include "formats/iges/write.h"
#include "tests/support/corpus.h"
#include "tests/support/paths.h"

using namespace trimloop;
using namespace trimloop::iges;
using namespace trimloop::test;

namespace {

std::uint64_t bits(double value) {
  std::uint64_t out;
  std::memcpy(&out, &value, sizeof out);
  return out;
}

// All entities, decoded, encoded and written as a new file. The Directory's pointers keep their numbers: null entities are
// written as well.
std::string rewritten(const std::string& bytes) {
  Report report;
  const File file = File::parse(bytes, {}, report);
  Writer writer(file.global());
  for (const DirectoryEntry& entry : file.directory()) {
    while (2 * writer.entities() + 1 < static_cast<std::size_t>(entry.de)) writer.add(DirectoryEntry{}, std::vector<std::string>{});
    writer.add(entry, entry.usable ? write_any(read_any(file, entry, Limits{}, report)) : std::vector<std::string>{});
  }
  return writer.finish().value_or("");
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_real_of_the_public_files_keeps_its_bits) {
  std::size_t reals = 0, longest = 0, files = 0;
  for (const auto& path : corpus_files("iges")) {
    Report report;
    const File file = File::parse(read_file(path), {}, report);
    ++files;
    Parameters p;
    std::size_t wrong = 0;
    for (const DirectoryEntry& entry : file.directory()) {
      if (!entry.usable) continue;
      file.parameters(entry, p, report);
      for (std::size_t i = 1; i < p.tokens.size(); ++i) {
        const Token& token = p.tokens[i];
        if (token.kind != Token::Kind::Text || token.text.find_first_of(".EDed") == std::string_view::npos) continue;
        const NumberText<double> first = read_real(token.text);
        if (!first) continue;
        const std::string text = iges_real(first.value);
        const NumberText<double> second = read_real(text);
        ++reals;
        longest = std::max(longest, text.size());
        if (!second || bits(second.value) != bits(first.value)) ++wrong;
      }
    }
    BOOST_TEST(wrong == 0u, path.string());
  }
  BOOST_TEST_MESSAGE(reals << " reals of " << files << " public files: token, double, text, double, the same bits; the longest text has " << longest << " characters");
}

// TRIMLOOP_LONG_TESTS=1 takes all files; else those of less than 20 kB.
BOOST_AUTO_TEST_CASE(a_hundred_cycles_of_writing_and_reading_change_nothing) {
  const bool all = std::getenv("TRIMLOOP_LONG_TESTS") != nullptr;
  const std::size_t most = all ? std::size_t{1} << 30 : 20'000;
  std::size_t files = 0, cycles = 0;
  for (const auto& path : corpus_files("iges")) {
    if (std::filesystem::file_size(path) > most) continue;
    std::string first = rewritten(read_file(path));
    if (first.empty()) continue;
    std::string now = first;
    bool same = true;
    for (int i = 0; i < 100 && same; ++i, ++cycles) {
      std::string next = rewritten(now);
      same = next == first;
      now = std::move(next);
    }
    BOOST_TEST(same, path.string());
    ++files;
  }
  BOOST_TEST_MESSAGE(files << " public files, " << cycles << " cycles, every file byte for byte the first one written");
}
