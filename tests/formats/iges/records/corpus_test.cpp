// Every typed record of the public files, decoded and encoded again without its original bytes, gives the same tokens:
// integers, strings and pointers equal, reals equal as doubles, empty and omitted fields as they were, groups included.
#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/formats/iges/records/decode.h"
#include "tests/support/paths.h"

using namespace trimloop;
using namespace trimloop::test;
namespace fs = std::filesystem;

namespace {

fs::path corpus_folder() {
  if (const char* named = std::getenv("TRIMLOOP_CORPUS")) return fs::path(named) / "iges";
  return trimloop::test::source_dir() / "../shared/corpus/iges";
}

struct Tally {
  std::size_t files = 0, typed = 0, by_table = 0, raw = 0, different = 0, odd_ends = 0;
};

void tally_file(const fs::path& path, Tally& tally) {
  std::ifstream stream(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  Report of_file;
  const iges::File file = iges::File::parse(std::move(bytes), {}, of_file);
  ++tally.files;
  for (const iges::DirectoryEntry& entry : file.directory()) {
    if (!entry.usable || !iges::is_typed(entry.type, entry.form)) continue;
    Report report;
    const iges::Parameters parameters = file.parameters(entry, report);
    const iges::AnyRecord record = iges::read_any(file, entry, parameters, {}, report);
    ++tally.typed;
    if (record.is_raw()) {
      ++tally.raw;
      BOOST_TEST_MESSAGE(path.filename() << " D" << entry.de << " " << entry.type << ": " << report.items()[0].text);
    }
    if (record.as<iges::TableRecord>()) {
      ++tally.by_table;
      if (report.count("IG-P03") + report.count("IG-P15") > 0) {
        ++tally.odd_ends;
        BOOST_TEST_MESSAGE(path.filename() << " D" << entry.de << " " << entry.type << ": " << report.items()[0].text);
      }
    }
    const std::size_t where = first_difference(parameters, iges::write_any(record));
    if (where == 0) continue;
    ++tally.different;
    BOOST_TEST_MESSAGE(path.filename() << " D" << entry.de << " " << entry.type << " parameter " << where);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(typed_records_of_public_files_go_back_with_the_same_tokens) {
  const fs::path folder = corpus_folder();
  if (!fs::is_directory(folder)) {
    BOOST_TEST_MESSAGE("skipped: the 191 public IGES files are not in " << folder);
    BOOST_TEST(true);
    return;
  }
  Tally tally;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) tally_file(entry.path(), tally);
  BOOST_TEST_MESSAGE(tally.files << " files, " << tally.typed << " typed records, " << tally.by_table << " of them by table, " << tally.odd_ends << " with odd ends, " << tally.raw << " unusable");
  BOOST_TEST(tally.different == 0u);
  BOOST_TEST(tally.raw == 0u);
  BOOST_TEST(tally.typed > tally.files);
}
