// What is written is checked against a table of entities of its own (tests/support/step_schema.h).

#include <boost/test/unit_test.hpp>

#include <filesystem>

#include "io/io.h"
#include "tests/support/builders.h"
#include "tests/support/paths.h"
#include "tests/support/step_schema.h"

using namespace trimloop;
namespace fs = std::filesystem;

namespace {

void check(const Model& model, const io::SourceInfo& source, const std::string& what) {
  for (const io::StepSchema schema : {io::StepSchema::Ap242, io::StepSchema::Ap214}) {
    for (const bool to_nurbs : {false, true}) {
      io::WriteOptions options;
      options.format = io::Format::Step;
      options.step_schema = schema;
      options.to_nurbs = to_nurbs;
      if (to_nurbs) options.unit = LengthUnit::Inch;
      const auto written = io::encode(model, source, options);
      BOOST_REQUIRE_MESSAGE(written, what << ": " << (written ? std::string() : written.error().text));
      const auto faults = test::schema_faults(written->bytes);
      BOOST_TEST(faults.empty(), what << ": " << faults.size() << ", " << (faults.empty() ? std::string() : faults.front()));
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(step_schema)

BOOST_AUTO_TEST_CASE(what_is_written_of_every_fixture_keeps_the_schema) {
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(test::source_dir() / "tests" / "data" / "step")) {
    if (entry.path().extension() != ".stp" || entry.path().filename() == "assembly_doubling.stp") continue;
    if (entry.path().filename() == "pmi.stp") continue;  // is copied as it stands, and the table is of what we make
    const io::ReadResult in = io::read(entry.path());
    if (!in.usable) continue;
    check(in.model, in.source, entry.path().filename().string());
    ++files;
  }
  BOOST_TEST(files >= 40u);
}

BOOST_AUTO_TEST_CASE(what_is_written_of_every_kind_of_body_keeps_the_schema) {
  Model model;
  model.parts.resize(2);
  model.parts[1].name = "rounds";
  model.parts[1].bodies = {test::cylinder({0, 0, 0}, 2, 5), test::cone({10, 0, 0}, 2, 5), test::sphere({20, 0, 0}, 3),
                           test::torus({40, 0, 0}, 5, 1), test::plate(10, 10, {})};
  model.parts[1].bodies[0].attributes = model.add({"red", Colour{1, 0, 0}, 3, true});
  model.parts[1].bodies[1].attributes = model.add({"hidden", {}, 0, false});
  model.parts[0].points.push_back({{1, 2, 3}, model.parts[1].bodies[0].attributes, {}});
  model.parts[0].curves.push_back({Curve{Line{{0, 0, 0}, {3, 4, 0}}}, model.parts[1].bodies[0].attributes, {}});
  model.parts[0].instances.push_back({1, Transform::translation({1, 2, 3}), {}, {}});
  model.parts[0].instances.push_back({1, Transform::scale(2), {}, {}});
  model.parts[0].instances.push_back({1, Transform::translation({5, 0, 0}), model.add({"there", Colour{0, 1, 0}, 2, false}), {}});
  check(model, {}, "bodies");
}

BOOST_AUTO_TEST_CASE(the_checker_finds_what_is_wrong) {
  Model model;
  model.parts.resize(1);
  model.parts[0].bodies = {test::cylinder({0, 0, 0}, 2, 5)};
  io::WriteOptions options;
  options.format = io::Format::Step;
  const std::string good = io::encode(model, {}, options)->bytes;
  BOOST_REQUIRE(test::schema_faults(good).empty());
  const auto broken = [&](const std::string& from, const std::string& to) {
    std::string bytes = good;
    const std::size_t at = bytes.find(from);
    BOOST_REQUIRE_MESSAGE(at != std::string::npos, from);
    return !test::schema_faults(bytes.replace(at, from.size(), to)).empty();
  };
  BOOST_TEST(broken("CYLINDRICAL_SURFACE(''", "CYLINDRICAL_SURFACE('',1"));       // one attribute too many
  BOOST_TEST(broken("DIRECTION('',(0.,0.,1.))", "DIRECTION('',(0.,0.,2.))"));     // length
  BOOST_TEST(broken("DIRECTION('',(0.,0.,1.))", "DIRECTION('',(1.,0.,0.))"));     // axes
  BOOST_TEST(broken(",2.);", ",-2.);"));                                          // radius
  BOOST_TEST(broken("VERTEX_POINT('',#", "VERTEX_POINT('',#9"));                  // another entity, or none
  BOOST_TEST(broken("EDGE_CURVE(", "EDGE_CURBE("));                               // unknown
  BOOST_TEST(broken("(NAMED_UNIT(*)", "("));                                      // a part left out
}

BOOST_AUTO_TEST_SUITE_END()
