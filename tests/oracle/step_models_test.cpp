// Models as we write them in STEP: OpenCASCADE finds the same faces, areas, volumes, names, colours and tree.

#include <boost/test/unit_test.hpp>

#include <unistd.h>

#include <cmath>

#include "io/io.h"
#include "kernel/check/measure.h"
#include "tests/oracle/step_occt.h"
#include "tests/support/builders.h"
#include "tests/support/paths.h"

using namespace trimloop;
namespace fs = std::filesystem;

namespace {

test::OcctStep through_occt(const Model& model, const io::SourceInfo& source, io::WriteOptions options, bool with_boxes) {
  options.format = io::Format::Step;
  const auto written = io::encode(model, source, options);
  BOOST_REQUIRE_MESSAGE(written, (written ? std::string() : written.error().text));
  const fs::path path = fs::temp_directory_path() / ("trimloop_step_" + std::to_string(getpid()) + ".stp");
  BOOST_REQUIRE(io::save(path, written->bytes, true));
  const auto read = test::read_step_with_occt(path, with_boxes);
  fs::remove(path);
  BOOST_REQUIRE_MESSAGE(read, "OpenCASCADE does not read what was written");
  return *read;
}

void check_samples(const io::WriteOptions& options) {
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(trimloop::test::binary_dir() / "samples" / "models")) {
    if (entry.path().extension() != ".igs") continue;
    BOOST_TEST_CONTEXT(entry.path().filename().string()) {
      ++files;
      const io::ReadResult in = io::read(entry.path());
      BOOST_REQUIRE(in.usable);
      const auto counts = count(in.model);
      const auto ours = measure(in.model, {});
      BOOST_REQUIRE((counts && ours));
      const test::OcctStep theirs = through_occt(in.model, in.source, options, false);
      BOOST_TEST(theirs.faces.size() == counts->faces);
      BOOST_TEST(theirs.area() == ours->area_mm2, boost::test_tools::tolerance(1e-9));
    }
  }
  BOOST_TEST(files >= 7u);
}

Model one_of_each() {
  Model model;
  model.name = "assembly";
  model.parts.resize(3);
  model.parts[1].name = "block";
  Body block = test::box({0, 0, 0}, {10, 20, 30});
  block.attributes = model.add({"the block", Colour{0.25, 0.5, 0.75}, 0, true});
  block.faces[2].attributes = model.add({"red side", Colour{1, 0, 0}, 0, true});
  model.parts[1].bodies.push_back(block);
  model.parts[2].name = "rounds";
  model.parts[2].bodies = {test::cylinder({0, 0, 0}, 2, 5), test::cone({10, 0, 0}, 2, 5), test::sphere({20, 0, 0}, 3),
                           test::torus({40, 0, 0}, 5, 1)};
  const auto place = [&](std::uint32_t part, const Transform& t) { model.parts[0].instances.push_back({part, t, {}, {}}); };
  place(1, Transform::translation({100, 0, 0}));
  place(1, Transform::translation({0, 50, 0}) * Transform::rotation({0, 0, 0}, {1, 2, 3}, 0.7));
  Transform mirror;
  mirror.r[0][0] = -1;
  place(2, mirror);
  place(2, Transform::translation({0, 0, 200}) * Transform::scale(2.5));
  return model;
}

// A body with a void: the shells of two boxes.
Body hollow() {
  Body body = test::box({0, 0, 0}, {10, 10, 10});
  const Body inner = test::box({2, 2, 2}, {5, 6, 7});
  const auto v0 = static_cast<std::uint32_t>(body.vertices.size()), e0 = static_cast<std::uint32_t>(body.edges.size()),
             l0 = static_cast<std::uint32_t>(body.loops.size()), f0 = static_cast<std::uint32_t>(body.faces.size());
  for (const Vertex& v : inner.vertices) body.add(v);
  for (Edge e : inner.edges) {
    e.start.index += v0, e.end.index += v0;
    body.add(e);
  }
  for (Loop l : inner.loops) {
    for (Coedge& c : l.coedges) c.edge.index += e0;
    body.add(l);
  }
  for (Face f : inner.faces) {
    for (LoopId& l : f.loops) l.index += l0;
    f.reversed = !f.reversed;  // looks into the void
    body.add(f);
  }
  Shell shell = inner.shells[0];
  for (Shell::Use& use : shell.faces) use.face.index += f0;
  shell.is_void = true;
  body.add(shell);
  return body;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(step_models)

BOOST_AUTO_TEST_CASE(samples_are_the_same_to_opencascade) { check_samples({}); }

BOOST_AUTO_TEST_CASE(samples_are_the_same_in_ap214) {
  io::WriteOptions options;
  options.step_schema = io::StepSchema::Ap214;
  check_samples(options);
}

BOOST_AUTO_TEST_CASE(samples_are_the_same_as_nurbs) {
  io::WriteOptions options;
  options.to_nurbs = true;
  check_samples(options);
}

BOOST_AUTO_TEST_CASE(samples_are_the_same_in_inches) {
  io::WriteOptions options;
  options.unit = LengthUnit::Inch;
  check_samples(options);
}

BOOST_AUTO_TEST_CASE(an_assembly_has_its_tree_volumes_boxes_names_and_colours) {
  const Model model = one_of_each();
  const auto ours = measure(model, {});
  BOOST_REQUIRE((ours && ours->volume_mm3));
  const test::OcctStep theirs = through_occt(model, {}, {}, true);
  BOOST_TEST(theirs.faces.size() == 2u * 6 + 2 * (3 + 2 + 1 + 1));
  BOOST_TEST(theirs.volumes.size() == 2u + 2 * 4);
  BOOST_TEST(theirs.area() == ours->area_mm2, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(theirs.volume() == *ours->volume_mm3, boost::test_tools::tolerance(1e-9));
  for (const double v : theirs.volumes) BOOST_TEST(v > 0);

  std::vector<std::string> paths;
  for (const test::OcctOccurrence& o : theirs.tree) paths.push_back(o.path);
  const std::vector<std::string> expected{"assembly", "assembly/block", "assembly/block", "assembly/rounds mirrored",
                                          "assembly/rounds x 2.5"};
  BOOST_TEST(paths == expected, boost::test_tools::per_element());
  const test::OcctOccurrence& first = theirs.tree[1];
  BOOST_TEST(distance(first.lo, {100, 0, 0}) < 1e-6);
  BOOST_TEST(distance(first.hi, {110, 20, 30}) < 1e-6);
  BOOST_TEST(distance(theirs.tree[3].lo, {-46, -6, -3}) < 1e-4);  // mirrored: torus first along x
  BOOST_TEST(distance(theirs.tree[0].lo, ours->box.lo) < 1e-4);
  BOOST_TEST(distance(theirs.tree[0].hi, ours->box.hi) < 1e-4);

  std::size_t red = 0, named = 0;
  for (const test::OcctFace& f : theirs.faces) {
    named += f.name == "red side";
    red += f.has_colour && f.colour[0] > 0.99 && f.colour[1] < 0.01;
  }
  BOOST_TEST(red == 2u);
}

BOOST_AUTO_TEST_CASE(a_void_is_a_void) {
  Model model;
  model.parts.resize(1);
  model.parts[0].bodies.push_back(hollow());
  const test::OcctStep theirs = through_occt(model, {}, {}, false);
  BOOST_TEST(theirs.faces.size() == 12u);
  BOOST_REQUIRE(theirs.volumes.size() == 1u);
  BOOST_TEST(theirs.volumes[0] == 1000 - 60, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(free_curves_have_their_length) {
  Model model;
  model.parts.resize(1);
  Part& part = model.parts[0];
  part.curves.push_back({Curve{Line{{0, 0, 0}, {3, 4, 0}}}, {}, {}});
  Circle arc;
  arc.radius = 2;
  arc.range = {0.5, 2};
  part.curves.push_back({Curve{arc}, {}, {}});
  Ellipse upright;
  upright.a = 1, upright.b = 3;
  upright.range = {0.25, 1.5};
  part.curves.push_back({Curve{upright}, {}, {}});
  part.curves.push_back({Curve{Parabola{{}, 2, {-1, 2}}}, {}, {}});
  part.curves.push_back({Curve{Hyperbola{{}, 2, 1, {-1, 2}}}, {}, {}});
  part.curves.push_back({Curve{Polyline{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}}}, {}, {}});
  const std::vector<FreeCurve> all = part.curves;
  for (const FreeCurve& c : all) {
    part.curves = {c};
    for (const LengthUnit unit : {LengthUnit::Millimetre, LengthUnit::Inch, LengthUnit::Metre}) {
      io::WriteOptions options;
      options.unit = unit;
      BOOST_TEST_CONTEXT("curve of kind " << c.curve.shape.index() << " in " << to_string(unit)) {
        BOOST_TEST(through_occt(model, {}, options, false).length == length(c.curve), boost::test_tools::tolerance(1e-9));
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
