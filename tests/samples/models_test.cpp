// What the sample models promise: a teapot whose parts end where they meet, a hull that unrolls.

#include <boost/test/unit_test.hpp>

#include "io/io.h"
#include "kernel/check/measure.h"
#include "kernel/geometry/differential.h"
#include "kernel/heal/sew.h"
#include "kernel/patches/developable.h"
#include "tests/support/paths.h"

using namespace trimloop;

namespace {

io::ReadResult sample(const char* name) {
  io::ReadResult in = io::read(trimloop::test::binary_dir() / "samples/models" / (std::string(name) + ".igs"));
  BOOST_REQUIRE(in.usable);
  BOOST_TEST(in.report.count(Severity::Warning) == 0u);
  BOOST_TEST(in.report.count(Severity::Error) == 0u);
  return in;
}

const Body& body_named(const Model& model, std::string_view name) {
  for (const Body& b : model.parts[0].bodies)
    if (model[b.attributes].name == name) return b;
  BOOST_FAIL("no body " << name);
  return model.parts[0].bodies[0];
}

// Edges that no second face of the body uses, when everything has been joined that can be.
std::size_t open_edges(const Body& body) {
  heal::SewOptions how;
  how.tolerance_mm = 1e-5;
  std::size_t open = 0;
  for (const heal::SewReport& r : heal::sew({body}, how).reports) {
    BOOST_TEST(r.joined == 0u);
    open += r.open.size();
  }
  return open;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(models)

BOOST_AUTO_TEST_CASE(the_teapots_spout_and_handle_end_at_the_body) {
  const auto in = sample("teapot");
  const Body &pot = body_named(in.model, "pot"), &lid = body_named(in.model, "lid");
  BOOST_TEST(pot.faces.size() == 24u);
  BOOST_TEST(lid.faces.size() == 8u);
  BOOST_TEST(pot.shells.size() == 1u);
  BOOST_TEST(open_edges(pot) == 6u);  // four of the rim, two of the spout's mouth: nothing is open where parts meet
  BOOST_TEST(open_edges(lid) == 4u);
  for (const Face& f : pot.faces) BOOST_TEST((f.status == FaceStatus::Ok));
  // Nothing of spout and handle is left inside: their faces are those that stay within 14 mm of the middle plane, and the
  // body is more than 31 mm from its axis where they leave it.
  std::size_t outside = 0;
  for (const Face& f : pot.faces) {
    double nearest = infinity, widest = 0;
    for (const Coedge& c : pot[f.loops[0]].coedges)
      for (int i = 0; i <= 16 && pot[c.edge].curve; ++i) {
        const Point p = evaluate(*pot[c.edge].curve, pot[c.edge].range.at(i / 16.0));
        nearest = std::min(nearest, std::hypot(p.x, p.y));
        widest = std::max(widest, std::abs(p.y));
      }
    if (widest > 14) continue;
    ++outside;
    BOOST_TEST(nearest > 31);
  }
  BOOST_TEST(outside == 8u);
}

BOOST_AUTO_TEST_CASE(the_teapot_goes_to_step_and_back_and_to_triangles) {
  const auto in = sample("teapot");
  io::WriteOptions how;
  how.format = io::Format::Step;
  const auto step = io::encode(in.model, in.source, how);
  BOOST_REQUIRE(step.has_value());
  const auto back = io::read_bytes(step->bytes, "x.stp");
  BOOST_REQUIRE(back.usable);
  BOOST_TEST(back.report.count(Severity::Warning) == 0u);
  const auto before = measure(in.model, {}), after = measure(back.model, {});
  BOOST_REQUIRE((before && after));
  BOOST_TEST(after->area_mm2 == before->area_mm2, boost::test_tools::tolerance(1e-9));
  how.format = io::Format::Glb;
  how.deflection = "0.05mm";
  const auto mesh = io::encode(in.model, in.source, how);
  BOOST_REQUIRE(mesh.has_value());
  BOOST_TEST(mesh->triangles > 5000u);
  BOOST_TEST(mesh->max_bound_mm <= 0.1);
}

BOOST_AUTO_TEST_CASE(the_hull_is_a_solid_of_strips_that_unroll) {
  const auto in = sample("hull");
  const Body& hull = body_named(in.model, "hull");
  BOOST_TEST(hull.faces.size() == 6u);
  BOOST_REQUIRE(hull.shells.size() == 1u);
  BOOST_TEST(hull.shells[0].closed);
  std::size_t strips = 0;
  for (const Face& face : hull.faces) {
    const auto* strip = std::get_if<NurbsSurface>(&face.surface->shape);
    if (!strip || strip->degree_v() != 1 || strip->degree_u() < 2) continue;
    ++strips;
    BOOST_TEST(ruling_twist(*strip) <= 1e-9);
    double largest = 0;  // Gaussian curvature, in units of the larger principal curvature squared
    for (int i = 1; i < 40; ++i)
      for (const double v : {0.2, 0.5, 0.8}) {
        const auto k = curvature(*face.surface, {strip->range_u().at(i / 40.0), strip->range_v().at(v)});
        if (k) largest = std::max(largest, std::abs(k->gaussian) / std::max(1e-12, k->k1 * k->k1 + k->k2 * k->k2));
      }
    BOOST_TEST(largest <= 1e-9);
  }
  BOOST_TEST(strips == 4u);
}

BOOST_AUTO_TEST_SUITE_END()
