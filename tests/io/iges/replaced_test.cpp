// I75 to I77 of the catalogue of bad inputs: every integer, real and pointer of small files replaced in turn. What comes of
// it is a model whose promises hold, or a finding; never a crash, never a loop.
#include <cctype>

#include "formats/iges/cards.h"
#include "tests/fuzz/iges_property.h"
#include "tests/io/iges/imported.h"
#include "tests/support/corpus.h"
#include "tests/support/paths.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

enum class Kind { Integer, Real };

// Replaces the parameter tokens of one kind in turn by each of `values`. Both are padded with blanks to the larger size and
// stay on their card; where a card has no room the value is skipped.
template <class Use>
void each_replacement(const std::string& bytes, Kind kind, const std::vector<std::string>& values, Use use) {
  Report report;
  const iges::File file = iges::File::parse(bytes, {}, report);
  for (const iges::DirectoryEntry& entry : file.directory()) {
    if (!entry.usable) continue;
    const iges::Parameters p = file.parameters(entry, report);
    for (std::size_t i = 1; i < p.tokens.size(); ++i) {
      const iges::Token& token = p.tokens[i];
      if (token.kind != iges::Token::Kind::Text) continue;
      const bool real = token.text.find_first_of(".ED") != std::string_view::npos;
      if (real != (kind == Kind::Real)) continue;
      for (const std::string& value : values) {
        std::string changed = bytes;
        if (value.size() <= token.text.size()) {
          changed.replace(token.offset, token.text.size(), std::string(token.text.size() - value.size(), ' ') + value);
        } else {  // room is made from the blanks at the end of the data columns
          const std::size_t line = changed.rfind('\n', token.offset), start = line == std::string::npos ? 0 : line + 1;
          const std::size_t more = value.size() - token.text.size();
          if (token.offset + token.text.size() > start + 64 || changed.substr(start + 64 - more, more).find_first_not_of(' ') != std::string::npos) continue;
          changed.erase(start + 64 - more, more);
          changed.replace(token.offset, token.text.size(), value);
        }
        use(std::move(changed));
      }
    }
  }
}

// The same for every numeric field of the Directory.
template <class Use>
void each_directory_field(const std::string& bytes, const std::vector<std::string>& values, Use use) {
  Report report;
  const iges::File file = iges::File::parse(bytes, {}, report);
  for (const iges::Card& card : file.cards().directory.cards)
    for (std::size_t field = 0; field < 9; ++field)
      for (const std::string& value : values) {
        std::string changed = bytes;
        changed.replace(card.offset + 8 * field, 8, std::string(8 - value.size(), ' ') + value);
        use(std::move(changed));
      }
}

// The seeds of the fuzzer: curves, trimmed surfaces, a solid; and small public files where there are any.
std::vector<std::string> samples() {
  std::vector<std::string> out;
  for (const char* name : {"seed_brep.igs", "seed_curves.igs", "seed_small.igs", "seed_trimmed.igs"})
    out.push_back(read_file(source_dir() / "tests/data/fuzz_iges" / name));
  constexpr std::size_t most_files = 24, most_bytes = 4000;
  for (const auto& path : corpus_files("iges"))
    if (out.size() < most_files && std::filesystem::file_size(path) < most_bytes) out.push_back(read_file(path));
  return out;
}

std::size_t run(Kind kind, const std::vector<std::string>& values) {
  std::size_t count = 0;
  for (const std::string& bytes : samples())
    each_replacement(bytes, kind, values, [&](std::string changed) {
      ++count;
      const std::string kept = changed;
      const char* broken = broken_iges_import(std::move(changed));
      BOOST_TEST_REQUIRE(broken == nullptr, (broken ? broken : "") << "\n" << kept);
    });
  return count;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(replaced)

BOOST_AUTO_TEST_CASE(i75_every_integer) {
  std::size_t n = run(Kind::Integer, {"0", "-1", "2147483647", "2147483648", "9223372036854775808"});
  for (const std::string& bytes : samples())
    each_directory_field(bytes, {"0", "-1", "1", "99999999"}, [&](std::string changed) {
      ++n;
      const char* broken = broken_iges_import(std::move(changed));
      BOOST_TEST_REQUIRE(broken == nullptr, (broken ? broken : ""));
    });
  BOOST_TEST(n > 3000u);
  BOOST_TEST_MESSAGE(n << " files with another integer");
}

BOOST_AUTO_TEST_CASE(i76_every_real) {
  const std::size_t n = run(Kind::Real, {"0.", "-0.", "1E-320", "1E308", "NAN", "INF"});
  BOOST_TEST(n > 700u);
  BOOST_TEST_MESSAGE(n << " files with another real");
}

BOOST_AUTO_TEST_CASE(i77_every_pointer_by_every_other) {
  std::size_t count = 0;
  for (const std::string& bytes : samples()) {
    Report report;
    const iges::File file = iges::File::parse(bytes, {}, report);
    std::vector<std::string> names;
    for (const iges::DirectoryEntry& e : file.directory()) names.push_back(std::to_string(e.de));
    // Whatever small odd integer stands there may be a pointer.
    each_replacement(bytes, Kind::Integer, names, [&](std::string changed) {
      ++count;
      const char* broken = broken_iges_import(std::move(changed));
      BOOST_TEST_REQUIRE(broken == nullptr, (broken ? broken : ""));
    });
  }
  BOOST_TEST(count > 700u);
  BOOST_TEST_MESSAGE(count << " files with another pointer");
}

BOOST_AUTO_TEST_CASE(kept_inputs_of_the_fuzzer_break_no_promise_of_the_import) {
  for (const auto& entry : std::filesystem::directory_iterator(source_dir() / "tests/data/fuzz_iges")) {
    const char* broken = broken_iges_import(read_file(entry.path()));
    BOOST_TEST(broken == nullptr, entry.path() << ": " << (broken ? broken : ""));
  }
}

BOOST_AUTO_TEST_SUITE_END()
