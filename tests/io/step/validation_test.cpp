// Validation properties of assemblies, faces and bodies against what is measured.

#include <boost/test/unit_test.hpp>

#include <fstream>
#include <iterator>

#include "io/io.h"
#include "tests/support/builders.h"
#include "tests/support/paths.h"

using namespace trimloop;

namespace {

std::vector<std::string> findings(const std::string& bytes) {
  std::vector<std::string> out;
  const io::ReadResult in = io::read_bytes(bytes, "file.stp");
  for (const Diagnostic& d : in.report.items()) out.emplace_back(d.rule->id);
  return out;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  BOOST_REQUIRE_MESSAGE(at != std::string::npos, from);
  return text.replace(at, from.size(), to);
}

// The cylinder of the fixture (radius 1, height 2) with more instances behind it.
std::string with(const std::string& instances) {
  std::ifstream in(test::source_dir() / "tests/data/step/pmi.stp");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return replaced(text, "ENDSEC;\nEND-ISO", instances + "ENDSEC;\nEND-ISO");
}

const std::string area_unit = "#200=DERIVED_UNIT_ELEMENT(#54,2.);\n#201=DERIVED_UNIT((#200));\n";

std::string area_of(const std::string& owner, const std::string& value) {
  return area_unit + "#202=PROPERTY_DEFINITION('geometric validation property','',#" + owner +
         ");\n#203=MEASURE_REPRESENTATION_ITEM('surface area measure',AREA_MEASURE(" + value +
         "),#201);\n#204=REPRESENTATION('surface area',(#203),#58);\n#205=PROPERTY_DEFINITION_REPRESENTATION(#202,#204);\n";
}
std::string centre_of(const std::string& owner, const std::string& name, const std::string& point) {
  return "#202=PROPERTY_DEFINITION('geometric validation property','',#" + owner + ");\n#203=CARTESIAN_POINT('" + name + "'," + point +
         ");\n#204=REPRESENTATION('centroid',(#203),#58);\n#205=PROPERTY_DEFINITION_REPRESENTATION(#202,#204);\n";
}

const std::vector<std::string> none, wrong_area{"SP-V06"}, wrong_centre{"SP-V07"}, wrong_volume{"SP-V05"};

}  // namespace

BOOST_AUTO_TEST_SUITE(validation)

BOOST_AUTO_TEST_CASE(the_area_of_faces_is_compared) {
  BOOST_TEST(findings(with(area_of("80", "3.14159265"))) == none);  // the top, pi
  BOOST_TEST(findings(with(area_of("80", "3.2"))) == wrong_area);
  BOOST_TEST(findings(with(area_of("70", "3.14159265"))) == none);  // the bottom, through a datum feature
  BOOST_TEST(findings(with(area_of("70", "6.28"))) == wrong_area);
}

BOOST_AUTO_TEST_CASE(of_an_aspect_that_is_the_solid_all_is_compared) {
  const std::string whole = "#206=SHAPE_ASPECT('','',#66,.T.);\n#207=GEOMETRIC_ITEM_SPECIFIC_USAGE('','',#206,#59,#53);\n";
  BOOST_TEST(findings(with(whole + area_of("206", "18.8495559"))) == none);  // 6 pi
  BOOST_TEST(findings(with(whole + area_of("206", "12.5663706"))) == wrong_area);
  BOOST_TEST(findings(with(whole + centre_of("206", "centre point", "(0.,0.,1.)"))) == none);
  BOOST_TEST(findings(with(whole + centre_of("206", "centre point", "(0.,0.,1.5)"))) == wrong_centre);
}

BOOST_AUTO_TEST_CASE(centres_of_other_things_are_not_that_of_the_solid) {
  BOOST_TEST(findings(with(centre_of("66", "centre point", "(0.,0.,9.)"))) == wrong_centre);
  for (const char* other : {"curve centre point", "independent points centre point", "bounding box corner point", "surface centre point"})
    BOOST_TEST(findings(with(centre_of("66", other, "(0.,0.,9.)"))) == none, other);
}

// Two boxes 1 x 2 x 3 in an assembly: it states 12, 44 and the centre of both.
BOOST_AUTO_TEST_CASE(assemblies_are_written_with_theirs_and_compared) {
  Model model;
  model.name = "pair";
  model.parts.resize(2);
  model.parts[0].name = "pair";
  model.parts[1].name = "box";
  model.parts[1].bodies = {test::box({0, 0, 0}, {1, 2, 3})};
  model.parts[0].instances = {{1, {}, {}, {}}, {1, Transform::translation({10, 0, 0}), {}, {}}};
  io::WriteOptions options;
  options.format = io::Format::Step;
  const auto written = io::encode(model, {}, options);
  BOOST_REQUIRE(written.has_value());
  BOOST_TEST(findings(written->bytes) == none);
  BOOST_TEST(findings(replaced(written->bytes, "VOLUME_MEASURE(12.", "VOLUME_MEASURE(12.5")) == wrong_volume);
  BOOST_TEST(findings(replaced(written->bytes, "AREA_MEASURE(44.", "AREA_MEASURE(45.")) == wrong_area);
  BOOST_TEST(findings(replaced(written->bytes, "'centre point',(5.5,", "'centre point',(6.5,")) == wrong_centre);
}

BOOST_AUTO_TEST_SUITE_END()
