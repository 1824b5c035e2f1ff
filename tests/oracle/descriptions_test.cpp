// Every shape of the sample descriptions, written as IGES and as STEP, as it is and as NURBS: OpenCASCADE finds the faces
// and areas that we do, and the lengths of the curves.

#include <boost/test/unit_test.hpp>

#include <fmt/format.h>
#include <unistd.h>

#include "io/io.h"
#include "kernel/check/measure.h"
#include "kernel/geometry/arc_length.h"
#include "tests/oracle/occt.h"
#include "tests/oracle/step_occt.h"
#include "tests/support/paths.h"

using namespace trimloop;
namespace fs = std::filesystem;

namespace {

struct Figures {
  std::size_t faces = 0;
  double area = 0, length = 0;
};

Figures ours_of(const Part& part) {
  Figures out;
  for (const Body& body : part.bodies)
    for (std::uint32_t f = 0; f < body.faces.size(); ++f, ++out.faces) out.area += area(body, FaceId{f}, 1e-11).value;
  for (const FreeCurve& c : part.curves) {
    const auto length = measured_length(c.curve, 1e-11);
    BOOST_REQUIRE(length);
    out.length += length->value;
  }
  return out;
}

std::optional<Figures> theirs_of(const Model& model, io::Format format, bool to_nurbs) {
  io::WriteOptions how;
  how.format = format;
  how.to_nurbs = to_nurbs;
  const auto written = io::encode(model, {}, how);
  BOOST_REQUIRE_MESSAGE(written, (written ? std::string() : written.error().text));
  BOOST_TEST(written->losses.empty());
  const fs::path path = fs::temp_directory_path() / ("trimloop_described_" + std::to_string(getpid()) + (format == io::Format::Iges ? ".igs" : ".stp"));
  BOOST_REQUIRE(io::save(path, written->bytes, true));
  std::optional<Figures> out;
  if (format == io::Format::Iges) {
    if (const auto r = test::read_with_occt(path, true, 60)) out = Figures{static_cast<std::size_t>(r->faces), r->area_fine, r->length};
  } else if (const auto r = test::read_step_with_occt(path, false, 60)) {
    out = Figures{r->faces.size(), r->area(), r->length};
  }
  fs::remove(path);
  return out;
}

void compare(Model model, std::string_view name) {
  const Figures ours = ours_of(model.parts[0]);
  for (const io::Format format : {io::Format::Iges, io::Format::Step})
    for (const bool to_nurbs : {false, true}) {
      if (to_nurbs && model.parts[0].curves.empty()) continue;  // described surfaces are NURBS already
      BOOST_TEST_CONTEXT(name << (format == io::Format::Iges ? " in IGES" : " in STEP") << (to_nurbs ? " as NURBS" : "")) {
        const auto theirs = theirs_of(model, format, to_nurbs);
        BOOST_REQUIRE_MESSAGE(theirs, "OpenCASCADE does not read it");
        BOOST_TEST(theirs->faces == ours.faces);
        BOOST_TEST(std::abs(theirs->area - ours.area) <= 1e-9 * ours.area, fmt::format("{:.15g} and {:.15g}", ours.area, theirs->area));
        BOOST_TEST(std::abs(theirs->length - ours.length) <= 1e-9 * ours.length, fmt::format("{:.15g} and {:.15g}", ours.length, theirs->length));
      }
    }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(descriptions)

BOOST_AUTO_TEST_CASE(every_shape_is_the_same_to_opencascade) {
  std::size_t shapes = 0;
  for (const char* file : {"curves.json", "surfaces.json", "exercises.json", "families.json"}) {
    const auto in = io::read(trimloop::test::source_dir() / "samples/descriptions" / file);
    BOOST_REQUIRE(in.usable);
    Model one = in.model;
    const Part all = in.model.parts[0];
    for (const FreeCurve& c : all.curves) {
      one.parts[0] = {};
      one.parts[0].curves = {c};
      compare(one, in.model[c.attributes].name);
      ++shapes;
    }
    for (const Body& b : all.bodies) {
      one.parts[0] = {};
      one.parts[0].bodies = {b};
      compare(one, in.model[b.attributes].name);
      ++shapes;
    }
  }
  BOOST_TEST(shapes >= 50u);
}

BOOST_AUTO_TEST_SUITE_END()
