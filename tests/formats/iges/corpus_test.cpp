// The file layer on real files: each is understood, goes back byte for byte, and its tokens survive our own writer.

#include "tests/support/corpus.h"

#include <boost/test/unit_test.hpp>

#include "formats/iges/file.h"
#include "formats/iges/write.h"

using namespace trimloop;
using namespace trimloop::iges;
using namespace trimloop::test;

namespace {

std::string spelled(const Token& token) {
  std::string text(token.text);
  if (token.kind != Token::Kind::Hollerith) return text;
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == '\x7f') c = ' ';  // as the writer does
  return std::to_string(text.size()) + "H" + text;
}

std::vector<std::string> tokens_of(const File& file, const DirectoryEntry& entry, Report& report) {
  std::vector<std::string> out;
  const Parameters parameters = file.parameters(entry, report);
  for (const Token& token : parameters.tokens) out.push_back(spelled(token));
  return out;
}

}  // namespace

BOOST_AUTO_TEST_CASE(real_files_are_understood_and_go_back_byte_for_byte) {
  std::size_t entities = 0, refused = 0;
  for (const auto& path : corpus_files("iges")) {
    const std::string bytes = read_file(path);
    Report report;
    const File file = File::parse(bytes, {}, report);
    BOOST_TEST((file.write() == bytes), path);
    if (report.has_fatal()) {
      BOOST_TEST(path.filename() == "first_line_82_cols.iges");  // one Start card and nothing else
      ++refused;
      continue;
    }
    BOOST_TEST(!file.directory().empty(), path);
    for (const DirectoryEntry& entry : file.directory()) {
      const Parameters parameters = file.parameters(entry, report);
      BOOST_TEST((entry.usable && parameters.terminated), path << " D" << entry.de);
      ++entities;
    }
  }
  BOOST_TEST_MESSAGE(entities << " entities, " << refused << " files refused");
}

BOOST_AUTO_TEST_CASE(tokens_of_real_files_survive_being_written_anew) {
  for (const auto& path : corpus_files("iges")) {
    Report report;
    const File file = File::parse(read_file(path), {}, report);
    if (file.directory().empty()) continue;
    Writer writer(file.global());
    std::vector<std::vector<std::string>> before;
    for (const DirectoryEntry& entry : file.directory()) {
      before.push_back(tokens_of(file, entry, report));
      writer.add(entry, {before.back().begin() + 1, before.back().end()});
    }
    const auto bytes = writer.finish();
    BOOST_TEST_REQUIRE(bytes.has_value(), path);
    Report again;
    const File back = File::parse(*bytes, {}, again);
    BOOST_TEST_REQUIRE(back.directory().size() == before.size(), path);
    BOOST_TEST(again.count(Severity::Error) == 0u, path);
    bool same = true;
    for (std::size_t i = 0; i < before.size(); ++i)
      same = same && tokens_of(back, back.directory()[i], again) == before[i] &&
             back.directory()[i].form == file.directory()[i].form;
    BOOST_TEST(same, path);
  }
}
