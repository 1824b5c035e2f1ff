#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "io/file.h"
#include "io/io.h"
#include "io/mesh/scene.h"
#include "tests/support/paths.h"

namespace {

using namespace trimloop;
namespace fs = std::filesystem;

// A folder that is gone afterwards.
struct Scratch {
  fs::path path = trimloop::test::binary_dir() / "scratch_io_files";
  Scratch() {
    fs::remove_all(path);
    fs::create_directories(path);
  }
  ~Scratch() { fs::remove_all(path); }
};

std::string content(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(files)

BOOST_AUTO_TEST_CASE(saved_bytes_come_back) {
  const Scratch scratch;
  const std::string bytes("a\0b\r\n", 5);
  BOOST_REQUIRE(io::save(scratch.path / "x", bytes, false));
  BOOST_TEST(content(scratch.path / "x") == bytes);
  const auto loaded = io::load(scratch.path / "x", 100);
  BOOST_REQUIRE(loaded);
  BOOST_TEST(*loaded == bytes);
}

BOOST_AUTO_TEST_CASE(an_existing_file_stays_unless_overwriting_is_asked_for) {
  const Scratch scratch;
  BOOST_REQUIRE(io::save(scratch.path / "x", "old", false));
  const auto refused = io::save(scratch.path / "x", "new", false);
  BOOST_REQUIRE(!refused);
  BOOST_TEST((refused.error().code == ErrorCode::Io));
  BOOST_TEST(content(scratch.path / "x") == "old");
  BOOST_REQUIRE(io::save(scratch.path / "x", "new", true));
  BOOST_TEST(content(scratch.path / "x") == "new");
}

BOOST_AUTO_TEST_CASE(a_failed_save_leaves_nothing_behind) {
  const Scratch scratch;
  BOOST_TEST(!io::save(scratch.path / "no" / "such" / "folder", "x", true));
  fs::create_directory(scratch.path / "folder");
  BOOST_TEST(!io::save(scratch.path / "folder", "x", true));  // a folder cannot be replaced by a file
  std::size_t left = 0;
  for (const auto& entry : fs::directory_iterator(scratch.path)) left += entry.path().filename() != "folder";
  BOOST_TEST(left == 0u);
}

BOOST_AUTO_TEST_CASE(loading_above_the_ceiling_is_a_limit_with_both_numbers) {
  const Scratch scratch;
  BOOST_REQUIRE(io::save(scratch.path / "x", std::string(1000, 'x'), false));
  const auto refused = io::load(scratch.path / "x", 999);
  BOOST_REQUIRE(!refused);
  BOOST_TEST((refused.error().code == ErrorCode::Limit));
  BOOST_TEST(refused.error().measured == 1000);
  BOOST_TEST(refused.error().limit == 999);
}

BOOST_AUTO_TEST_CASE(a_missing_file_and_a_folder_are_refusals_of_the_system) {
  const Scratch scratch;
  for (const fs::path& path : {scratch.path / "missing", scratch.path}) {
    const io::ReadResult in = io::read(path);
    BOOST_TEST(in.io_failed);
    BOOST_TEST(!in.usable);
    BOOST_TEST(in.report.has_fatal());
  }
}

BOOST_AUTO_TEST_CASE(content_decides_the_format_and_the_extension_only_breaks_a_tie) {
  BOOST_TEST((io::sniff("ISO-10303-21;") == io::Format::Step));
  BOOST_TEST((io::sniff("glTF....") == io::Format::Glb));
  BOOST_TEST((io::sniff("") == io::Format::Unknown));
  const io::ReadResult step = io::read_bytes("ISO-10303-21;\nHEADER;", "named.igs");
  BOOST_TEST((step.source.format == io::Format::Step));
  BOOST_TEST(step.report.has_fatal());
  const io::ReadResult empty = io::read_bytes("", "named.igs");
  BOOST_TEST((empty.source.format == io::Format::Iges));
  BOOST_TEST(empty.report.count("IG-F01") == 1u);
}

BOOST_AUTO_TEST_CASE(deflection_is_a_length_or_a_share_of_the_diagonal) {
  BOOST_TEST(io::parse_deflection("0.05", 1000).value() == 0.05);
  BOOST_TEST(io::parse_deflection("0.05mm", 1000).value() == 0.05);
  BOOST_TEST(io::parse_deflection("0.1%", 1000).value() == 1.0);
  for (const char* wrong : {"", "%", "mm", "-1", "0", "nan", "1..2", "0.1 %%"}) {
    BOOST_TEST(!io::parse_deflection(wrong, 1000), wrong);
  }
}

BOOST_AUTO_TEST_CASE(every_rule_can_be_found_by_id_and_slug_and_explains_itself) {
  const auto rules = io::all_rules();
  BOOST_TEST(rules.size() > 150u);
  std::set<std::string_view> ids;
  for (const Rule* rule : rules) {
    BOOST_TEST(ids.insert(rule->id).second, rule->id << " stands twice");
    BOOST_TEST(io::find_rule(rule->id) == rule);
    BOOST_TEST(io::find_rule(rule->slug) != nullptr);
    BOOST_TEST((!rule->checks.empty() && !rule->why.empty() && !rule->remedy.empty()), rule->id);
  }
  BOOST_TEST(io::find_rule("no-such-rule") == nullptr);
}

BOOST_AUTO_TEST_SUITE_END()
