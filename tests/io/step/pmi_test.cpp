// Product manufacturing information of STEP files: listed, and kept on writing as it stands, its references led to what was
// written. tests/data/step/pmi.stp: a cylinder with a datum, two tolerances, a dimension, an annotation and a view.

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "formats/step/file.h"
#include "io/io.h"
#include "tests/support/paths.h"

using namespace trimloop;

namespace {

std::string text_of_fixture() {
  std::ifstream in(test::source_dir() / "tests/data/step/pmi.stp");
  return {std::istreambuf_iterator<char>(in), {}};
}
io::ReadResult read(std::string text) { return io::read_bytes(std::move(text), "pmi.stp"); }

io::WriteResult write(const io::ReadResult& in, io::WriteOptions options = {}) {
  options.format = io::Format::Step;
  auto written = io::encode(in.model, in.source, options);
  BOOST_REQUIRE_MESSAGE(written, (written ? std::string() : written.error().text));
  return std::move(*written);
}

// Names of the faces, and "edge" for edges, that a piece of PMI speaks of.
std::vector<std::string> spoken_of(const io::ReadResult& in, const io::PmiItem& item) {
  std::vector<std::string> out;
  for (const std::uint64_t id : item.shapes) {
    std::string name = "?";
    for (const Part& part : in.model.parts)
      for (const Body& body : part.bodies) {
        for (const Face& f : body.faces)
          if (!f.source.empty() && f.source.front().id == id) name = in.model[f.attributes].name;
        for (const Edge& e : body.edges)
          if (!e.source.empty() && e.source.front().id == id) name = "edge";
      }
    out.push_back(name);
  }
  std::sort(out.begin(), out.end());
  return out;
}

struct Row {
  std::string kind, entity, name;
  std::vector<std::string> shapes;
  bool operator==(const Row& o) const { return kind == o.kind && entity == o.entity && name == o.name && shapes == o.shapes; }
};
std::ostream& operator<<(std::ostream& out, const Row& r) {
  out << r.kind << ' ' << r.entity << " '" << r.name << "':";
  for (const std::string& s : r.shapes) out << ' ' << s;
  return out;
}
std::vector<Row> rows(const io::ReadResult& in) {
  std::vector<Row> out;
  for (const io::PmiItem& item : io::list_pmi(in.source)) out.push_back({std::string(item.kind), item.entity, item.name, spoken_of(in, item)});
  return out;
}

const std::vector<Row> expected = {
    {"datums", "DATUM", "datum", {"bottom"}},
    {"tolerances", "GEOMETRIC_TOLERANCE+GEOMETRIC_TOLERANCE_WITH_DATUM_REFERENCE+PARALLELISM_TOLERANCE", "Parallelism.1", {"top"}},
    {"tolerances", "FLATNESS_TOLERANCE", "Flatness.1", {"top"}},
    {"dimensions", "DIMENSIONAL_SIZE", "diameter", {"edge", "side"}},
    {"annotations", "TESSELLATED_ANNOTATION_OCCURRENCE", "Ebenheit \xC2\xB1 '1'", {"top"}},
    {"views", "CAMERA_MODEL_D3", "front", {}}};

bool contains(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }
bool names(const std::vector<std::string>& losses, const std::string& what) {
  return std::any_of(losses.begin(), losses.end(), [&](const std::string& l) { return contains(l, what); });
}

// How many references of the file lead to nothing in it.
std::size_t dangling(const std::string& bytes) {
  Report report;
  const step::File file = step::File::parse(bytes, {}, report);
  std::size_t n = 0;
  for (const step::Instance& i : file.instances()) {
    const std::string_view text = file.value(i);
    bool in_string = false;
    for (std::size_t at = 0; at < text.size(); ++at) {
      if (text[at] == '\'') in_string = !in_string;
      if (text[at] == '#' && !in_string) n += !file.find({std::stoull(std::string(text.substr(at + 1, 20)))});
    }
  }
  return n;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(pmi)

BOOST_AUTO_TEST_CASE(it_is_listed_with_what_it_speaks_of) {
  const io::ReadResult in = read(text_of_fixture());
  BOOST_TEST(rows(in) == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(it_is_kept_on_writing_and_its_faces_are_those_that_were_written) {
  const io::ReadResult in = read(text_of_fixture());
  const io::WriteResult out = write(in);
  BOOST_TEST(out.losses.empty());
  const io::ReadResult again = read(out.bytes);
  BOOST_TEST(again.report.items().empty());
  BOOST_TEST(rows(again) == expected, boost::test_tools::per_element());
  BOOST_TEST(dangling(out.bytes) == 0u);
  const io::WriteResult second = write(again);
  const io::ReadResult third = read(second.bytes);
  BOOST_TEST(rows(third) == expected, boost::test_tools::per_element());
  BOOST_TEST(write(third).bytes.size() == second.bytes.size());  // nothing grows
  // Values with the characters they came with; what is tied to them from outside.
  for (const char* piece : {"LENGTH_MEASURE(5.0E-2)", "LENGTH_MEASURE(0.010)", "POSITIVE_LENGTH_MEASURE(2.)", "'NR2 1.2'", "MEASURE_QUALIFICATION(",
                            "'polyline curve length',POSITIVE_LENGTH_MEASURE(1.6)", "DESCRIPTIVE_REPRESENTATION_ITEM('steel','1.4301')",
                            "MECHANICAL_DESIGN_AND_DRAUGHTING_RELATIONSHIP(", "((2.,0.,2.),(3.,0.,2.5),(3.,0.,3.))",
                            "DRAUGHTING_MODEL_ITEM_ASSOCIATION(", "'pmi validation property'",
                            "PRESENTATION_LAYER_ASSIGNMENT('notes'"})
    BOOST_TEST(contains(out.bytes, piece), piece);
}

BOOST_AUTO_TEST_CASE(in_another_unit_it_keeps_its_own) {
  const io::ReadResult in = read(text_of_fixture());
  io::WriteOptions options;
  options.unit = LengthUnit::Inch;
  const io::WriteResult out = write(in, options);
  const io::ReadResult again = read(out.bytes);
  BOOST_TEST(again.source.unit == "inch");
  BOOST_TEST(rows(again) == expected, boost::test_tools::per_element());
  BOOST_TEST(contains(out.bytes, "((2.,0.,2.),(3.,0.,2.5),(3.,0.,3.))"));  // in millimetres, in a context of its own
  BOOST_TEST(dangling(out.bytes) == 0u);
  options.unit = LengthUnit::Millimetre;
  BOOST_TEST(rows(read(write(again, options).bytes)) == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(what_speaks_of_a_face_that_was_not_written_is_named) {
  io::ReadResult in = read(text_of_fixture());
  Body& body = in.model.parts[0].bodies[0];
  const auto top = std::find_if(body.faces.begin(), body.faces.end(), [&](const Face& f) { return in.model[f.attributes].name == "top"; });
  BOOST_REQUIRE((top != body.faces.end()));
  top->status = FaceStatus::Failed;
  top->reason = "for the test";
  top->loops.clear();
  const io::WriteResult out = write(in);
  BOOST_TEST(names(out.losses, "product manufacturing information: 1 references to shapes"));
  BOOST_TEST(dangling(out.bytes) == 0u);
  const auto left = rows(read(out.bytes));
  BOOST_REQUIRE(left.size() == expected.size());
  BOOST_TEST(left[1].shapes.empty());  // the tolerance stays, without its face
  BOOST_TEST(left[3] == expected[3]);
}

BOOST_AUTO_TEST_CASE(without_a_home_it_is_a_loss) {
  const io::ReadResult in = read(text_of_fixture());
  io::WriteOptions options;
  options.step_schema = io::StepSchema::Ap214;
  const io::WriteResult old = write(in, options);
  BOOST_TEST(names(old.losses, "product manufacturing information: 2 tolerances"));
  BOOST_TEST(!contains(old.bytes, "FLATNESS"));
  options.format = io::Format::Iges;
  const auto iges = io::encode(in.model, in.source, options);
  BOOST_REQUIRE(iges.has_value());
  BOOST_TEST(names(iges->losses, "product manufacturing information: 1 dimensions"));
}

// References to what is not there, to themselves, of the wrong kind: nothing is written that leads nowhere.
BOOST_AUTO_TEST_CASE(broken_information_is_left_out_as_far_as_it_is_broken) {
  const std::string whole = text_of_fixture();
  std::size_t broken = 0;
  for (std::size_t at = whole.find("/* datum A"); (at = whole.find('#', at + 1)) != std::string::npos;) {
    const std::size_t end = whole.find_first_not_of("0123456789", at + 1);
    if (whole[end] == '=') continue;
    for (const char* other : {"#9999", "#83", "#52", "#65"}) {
      const io::ReadResult in = read(whole.substr(0, at) + other + whole.substr(end));
      if (!in.usable) continue;
      const std::size_t nowhere = dangling(write(in).bytes);
      if (nowhere > 0) BOOST_TEST(nowhere == 0u, whole.substr(at, 20) << " -> " << other);
      ++broken;
    }
  }
  BOOST_TEST(broken > 300u);
}

BOOST_AUTO_TEST_SUITE_END()
