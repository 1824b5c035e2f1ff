// Chords that cross, and those that no further sample can part.

#include <boost/test/unit_test.hpp>

#include "kernel/mesh/tessellate.h"
#include "tests/kernel/mesh/bodies.h"
#include "tests/kernel/mesh/mesh_checks.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

mesh::BodyMesh meshed(const Body& body, double deflection) {
  mesh::TessellationOptions options;
  options.deflection_mm = deflection;
  auto result = mesh::tessellate(body, options);
  BOOST_REQUIRE(result);
  return std::move(*result);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_hole_that_nearly_touches_the_rim_is_parted_from_it) {
  // Chords of the rim bow 0.06; the hole comes as near as `gap`, so that its samples lie beyond them at first.
  for (const double gap : {1e-2, 1e-4, 1e-6}) {
    const Body body = disc(10, 5, 5 - gap, 1.234);
    const mesh::BodyMesh mesh = meshed(body, 0.1);
    const MeshFacts facts = measure(body, mesh);
    BOOST_CHECK_MESSAGE(mesh.faces[0].reason.empty(), mesh.faces[0].reason);
    BOOST_CHECK_EQUAL(facts.euler, 0);  // a ring
    BOOST_CHECK_EQUAL(facts.turned_over, 0u);
    BOOST_CHECK_LT(std::abs(facts.area_mm2 - 75 * pi), 30 * pi * 0.1);
    BOOST_CHECK_LT(mesh.points.size(), 120u);  // only the place where they are near is cut
  }
}

BOOST_AUTO_TEST_CASE(loops_that_run_along_each_other_are_not_cut_in_vain) {
  Body square = disc(10, 0, 0, 0);
  square[FaceId{0}].loops.clear();
  add_polygon_loop(square, {0}, {{0, 0}, {10, 0}, {10, 10}, {0, 10}});
  add_polygon_loop(square, {0}, {{4, 0}, {10, 0}, {10, 10}, {4, 10}});
  const mesh::BodyMesh flat = meshed(square, 0.1);
  for (std::size_t i = 1; i < flat.edges.size(); ++i) BOOST_CHECK_EQUAL(flat.edges[i].points.size(), 2u);
  BOOST_CHECK_CLOSE(measure(square, flat).area_mm2, 40, 1e-9);
  BOOST_CHECK(!flat.faces[0].reason.empty());

  const Body whole = disc(10, 0, 0, 0);
  Body half = whole;
  add_segment_loop(half, {0}, 10, {0.3, 0.3 + pi});
  const std::size_t alone = meshed(whole, 0.1).points.size();
  const mesh::BodyMesh both = meshed(half, 0.1);
  BOOST_CHECK_LT(both.edges[0].points.size(), alone + 8);  // where the arcs end, chord and arc can still be parted
  BOOST_CHECK_LT(std::abs(measure(half, both).area_mm2 - 50 * pi), 20 * pi * 0.1);
  BOOST_CHECK(!both.faces[0].reason.empty());
}
