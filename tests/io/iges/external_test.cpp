// 416: other files come from the caller's resolver or not at all.
#include <map>

#include "io/io.h"
#include "tests/io/iges/imported.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

// Two definitions, "bolt" (a line) and "nut" (two points), and a point of its own in the root.
std::string library(std::string_view name_of_point_file = {}) {
  IgesText file;
  const int line = file.add(110, "0.,0.,0.,1.,0.,0.", {.status = dependent});
  file.add(308, "0,4Hbolt,1,{}", {.status = "00000200"}, {line});
  const int a = file.add(116, "1.,0.,0.,0", {.status = dependent}), b = file.add(116, "2.,0.,0.,0", {.status = dependent});
  file.add(308, "0,3Hnut,2,{},{}", {.status = "00000200"}, {a, b});
  file.add(116, "5.,0.,0.,0");
  if (!name_of_point_file.empty()) file.add(416, hollerith(name_of_point_file), {.form = 1});
  return file.text();
}

struct Answers {
  std::map<std::string, std::string> files;
  std::vector<io::ExternalReference> asked;
};

io::ReadResult read(const IgesText& file, Answers& answers) {
  io::ReadOptions options;
  options.resolve = [&](const io::ExternalReference& r) -> std::optional<std::string> {
    answers.asked.push_back(r);
    const auto found = answers.files.find(r.file);
    return found == answers.files.end() ? std::nullopt : std::optional(found->second);
  };
  return io::read_bytes(file.text(), "main.igs", options);
}

std::size_t points(const io::ReadResult& in) { return count(in.model)->points; }
std::size_t curves(const io::ReadResult& in) { return count(in.model)->curves; }

}  // namespace

BOOST_AUTO_TEST_SUITE(external)

BOOST_AUTO_TEST_CASE(without_a_resolver_the_reference_is_named_and_left_out) {
  IgesText file;
  file.add(416, "8Hpart.igs", {.form = 1});
  file.add(110, "0.,0.,0.,1.,0.,0.");
  const Imported in = imported(file);
  BOOST_TEST(in.root().instances.empty());
  BOOST_TEST(in.finding("IG-R12").entity == "D1");
  BOOST_TEST(in.finding("IG-R12").text.find("part.igs") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_whole_file_stands_where_its_matrix_puts_it) {
  IgesText file;
  const int matrix = file.add(124, "1.,0.,0.,10.,0.,1.,0.,0.,0.,0.,1.,0.");
  file.add(416, "8Hpart.igs", {.form = 1, .transform = matrix});
  Answers answers{{{"part.igs", library()}}, {}};
  const auto in = read(file, answers);
  BOOST_REQUIRE(answers.asked.size() == 1u);
  BOOST_TEST(answers.asked[0].is_plain);
  BOOST_TEST(points(in) == 1u);  // its root, not its definitions
  const auto all = occurrences(in.model, 10, 10);
  BOOST_REQUIRE(all->size() == 2u);
  check_point(apply((*all)[1].transform, in.model.parts[(*all)[1].part].points.at(0).point), {15, 0, 0});
}

BOOST_AUTO_TEST_CASE(copies_of_a_definition_in_another_file_are_read_once) {
  IgesText file;
  const int bolt = file.add(416, "8Hpart.igs,4Hbolt", {.form = 0, .status = dependent});
  const int nut = file.add(416, "8Hpart.igs,3Hnut", {.form = 0, .status = dependent});
  for (int i = 0; i < 3; ++i) file.add(408, "{},0.,0.,0.,1.", {}, {bolt});
  file.add(408, "{},0.,0.,0.,1.", {}, {nut});
  Answers answers{{{"part.igs", library()}}, {}};
  const auto in = read(file, answers);
  BOOST_TEST(answers.asked.size() == 2u);
  BOOST_TEST(curves(in) == 3u);
  BOOST_TEST(points(in) == 2u);
  BOOST_TEST(in.report.count("IG-R12") == 0u);
}

BOOST_AUTO_TEST_CASE(what_is_not_there_is_said) {
  IgesText file;
  const int none = file.add(416, "8Hpart.igs,6Hwasher", {.form = 0, .status = dependent});
  const int lost = file.add(416, "8Hlost.igs", {.form = 1, .status = dependent});
  file.add(408, "{},0.,0.,0.,1.", {}, {none});
  file.add(408, "{},0.,0.,0.,1.", {}, {lost});
  file.add(116, "0.,0.,0.,0");
  Answers answers{{{"part.igs", library()}}, {}};
  const auto in = read(file, answers);
  BOOST_TEST(in.report.count("IG-R12") == 2u);
  BOOST_TEST(points(in) == 1u);
}

BOOST_AUTO_TEST_CASE(a_name_that_leaves_the_folder_is_handed_on_as_such) {
  IgesText file;
  for (const char* name : {"../../etc/passwd", "\\\\host\\share\\a.igs", "C:a.igs", "/a.igs", "..", ""})
    file.add(416, *name ? hollerith(name) : std::string(), {.form = 1});
  Answers answers;
  read(file, answers);
  BOOST_REQUIRE(answers.asked.size() == 6u);
  for (std::size_t i = 0; i < 5; ++i) BOOST_TEST(!answers.asked[i].is_plain, answers.asked[i].file);
}

BOOST_AUTO_TEST_CASE(files_that_name_each_other_end) {
  IgesText file;
  file.add(416, "5Ha.igs", {.form = 1});
  Answers answers{{{"a.igs", library("b.igs")}, {"b.igs", library("a.igs")}}, {}};
  const auto in = read(file, answers);
  BOOST_TEST(answers.asked.size() == io::deepest_external_file);
  BOOST_TEST(in.report.count("IG-R12") + in.report.count("IG-R07") > 0u);
  BOOST_TEST(points(in) == io::deepest_external_file);
}

BOOST_AUTO_TEST_SUITE_END()
