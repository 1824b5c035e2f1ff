// Edits change one parameter's own text and no other byte.
#include "formats/step/edit.h"

#include <boost/test/unit_test.hpp>

#include "formats/step/tape.h"
#include "tests/support/paths.h"

#include <filesystem>
#include <fstream>
#include <iterator>

using namespace trimloop;
using namespace trimloop::step;

namespace {

const std::string sample =
    "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\n"
    "ENDSEC;\nDATA;\n"
    "#1 = CARTESIAN_POINT ( 'it''s, here' , ( 1. , /* a, ) comment */ 2.5,3.) ) ;\n"
    "#2=DIRECTION('',(0.,0.,1.));\n#3=VECTOR('',#2,1.E0);\n#4=LINE('',#1,#3);\n"
    "#5=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
    "#6=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-3),#5,$,\"0F\");\n#7=B_SPLINE_CURVE('',1,(#1,#1),.UNSPECIFIED.,.F.,.F.);\n"
    "ENDSEC;\nEND-ISO-10303-21;\n";

File parsed(std::string bytes) {
  Report report;
  return File::parse(std::move(bytes), {}, report);
}
std::string at(const File& f, std::uint64_t id, const char* path) {
  const auto text = parameter_at(f, {id}, *parameter_path(path));
  return text ? std::string(*text) : "! " + text.error().text;
}
// The sample with `old_text`, which it has once, replaced.
std::string replaced(const std::string& old_text, const std::string& text) {
  std::string out = sample;
  const std::size_t place = out.find(old_text);
  BOOST_REQUIRE((place != std::string::npos && out.find(old_text, place + 1) == std::string::npos));
  return out.replace(place, old_text.size(), text);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(step_edit)

BOOST_AUTO_TEST_CASE(parameters_are_found_among_blanks_comments_and_strings) {
  const File f = parsed(sample);
  BOOST_TEST(at(f, 1, "1") == "'it''s, here'");
  BOOST_TEST(at(f, 1, "2") == "( 1. , /* a, ) comment */ 2.5,3.)");
  BOOST_TEST(at(f, 1, "2.1") == "1.");
  BOOST_TEST(at(f, 1, "2.2") == "2.5");
  BOOST_TEST(at(f, 1, "2.3") == "3.");
  BOOST_TEST(at(f, 5, "SI_UNIT.2") == ".METRE.");
  BOOST_TEST(at(f, 5, "NAMED_UNIT.1") == "*");
  BOOST_TEST(at(f, 6, "1.1") == "1.E-3");
  BOOST_TEST(at(f, 6, "4") == "\"0F\"");
  for (const char* nowhere : {"3", "2.4", "1.1", "2.1.1", "POINT.1"}) BOOST_TEST(at(f, 1, nowhere).front() == '!', nowhere);
  BOOST_TEST(at(f, 5, "1").front() == '!');
  BOOST_TEST(at(f, 5, "LENGTH_UNIT.1").front() == '!');
  BOOST_TEST(at(f, 99, "1").front() == '!');
  for (const char* wrong : {"", "0", "-1", "1.", ".1", "1.A", "A", "A.B.1", "+1", "1..2"}) BOOST_TEST(!parameter_path(wrong), wrong);
}

BOOST_AUTO_TEST_CASE(a_parameter_changes_and_nothing_else) {
  const File f = parsed(sample);
  const auto set = [&](std::uint64_t id, const char* path, const char* text) {
    const auto changed = set_parameter(f, {id}, *parameter_path(path), text);
    return changed ? *changed : changed.error().text;
  };
  BOOST_TEST(set(1, "2.2", "0.125") == replaced("2.5", "0.125"));
  BOOST_TEST(set(1, "1", "'a;b'") == replaced("'it''s, here'", "'a;b'"));
  BOOST_TEST(set(3, "3", "$") == replaced("1.E0", "$"));
  BOOST_TEST(set(4, "3", "#2") == replaced("#1,#3)", "#1,#2)"));
  BOOST_TEST(set(5, "SI_UNIT.1", "$") == replaced(".MILLI.", "$"));
  BOOST_TEST(set(6, "1", "LENGTH_MEASURE(0.5)") == replaced("LENGTH_MEASURE(1.E-3)", "LENGTH_MEASURE(0.5)"));
  BOOST_TEST(set(7, "3", "()") == replaced("(#1,#1)", "()"));
}

BOOST_AUTO_TEST_CASE(setting_what_is_there_gives_the_same_bytes) {
  std::size_t parameters = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_dir() / "tests" / "data" / "step")) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    const File f = parsed(bytes);
    for (const Instance& i : f.instances()) {
      if (f.keyword(i).is_complex) continue;
      for (std::size_t k = 1;; ++k) {
        const ParameterPath path{"", {k}};
        const auto text = parameter_at(f, {i.id}, path);
        if (!text) break;
        const auto same = set_parameter(f, {i.id}, path, *text);
        BOOST_TEST((same && *same == bytes), entry.path().filename().string() << " #" << i.id << " parameter " << k);
        ++parameters;
      }
    }
  }
  BOOST_TEST(parameters > 1000u);
}

BOOST_AUTO_TEST_CASE(values_take_the_form_of_what_stands_there) {
  const File f = parsed(sample);
  const auto text = [&](std::uint64_t id, const char* path, const char* value) {
    const auto made = parameter_text(f, {id}, *parameter_path(path), value);
    return made ? *made : "! " + made.error().text;
  };
  BOOST_TEST(text(1, "2.2", "3") == "3.");
  BOOST_TEST(text(1, "2.2", "1e-20") == "1.E-20");
  BOOST_TEST(text(1, "1", "it's \xC3\xB6") == "'it''s \\X2\\00F6\\X0\\'");
  BOOST_TEST(text(7, "2", "3") == "3");
  BOOST_TEST(text(7, "4", "POLYLINE_FORM") == ".POLYLINE_FORM.");
  BOOST_TEST(text(7, "5", ".T.") == ".T.");
  BOOST_TEST(text(4, "2", "#1") == "#1");
  BOOST_TEST(text(1, "1", "$") == "$");
  BOOST_TEST(text(1, "2.2", "three").front() == '!');
  BOOST_TEST(text(7, "2", "3.5").front() == '!');
  BOOST_TEST(text(4, "2", "1").front() == '!');
}

BOOST_AUTO_TEST_CASE(what_is_no_parameter_or_names_nothing_is_refused) {
  const File f = parsed(sample);
  const auto refused = [&](std::uint64_t id, const char* path, const char* text) {
    return !set_parameter(f, {id}, *parameter_path(path), text);
  };
  for (const char* text : {"", "1.,2.", "1.)", "(1.", "'open", "1.;#8=X()", "#77", "(#1,#77)", "/*", "a b"}) {
    BOOST_TEST(refused(1, "2.2", text), text);
  }
}

BOOST_AUTO_TEST_SUITE_END()
