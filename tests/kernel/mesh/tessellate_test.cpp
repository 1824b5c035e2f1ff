#include "kernel/mesh/tessellate.h"

#include <boost/test/unit_test.hpp>

#include "tests/kernel/mesh/bodies.h"
#include "tests/kernel/mesh/mesh_checks.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

const Interval full_turn{0, two_pi}, latitudes{-pi / 2, pi / 2};

mesh::BodyMesh meshed(const Body& body, double deflection, double angle, int jobs = 1, bool prove = true) {
  mesh::TessellationOptions options;
  options.prove = prove;
  options.deflection_mm = deflection;
  options.angle_rad = angle;
  Execution execution;
  execution.jobs = jobs;
  auto result = mesh::tessellate(body, options, execution);
  BOOST_REQUIRE(result);
  return std::move(*result);
}

// Everything a sound mesh of a smooth body promises; `euler` of the body.
MeshFacts require_sound(const Body& body, const mesh::BodyMesh& mesh, double deflection, double angle, long euler) {
  const MeshFacts facts = measure(body, mesh);
  BOOST_CHECK_GT(facts.triangles, 0u);
  BOOST_CHECK_LE(facts.deviation_mm, deflection * 1.02);
  BOOST_CHECK_LE(facts.turn_rad, angle * 1.001);
  BOOST_CHECK_EQUAL(facts.turned_over, 0u);
  BOOST_CHECK_EQUAL(facts.degenerate, 0u);
  BOOST_CHECK_EQUAL(facts.duplicates, 0u);
  BOOST_CHECK_EQUAL(facts.euler, euler);
  for (const mesh::FaceMesh& face : mesh.faces) {
    BOOST_CHECK(face.deflection_met);
    BOOST_CHECK_MESSAGE(face.reason.empty(), face.reason);
    BOOST_CHECK_LE(facts.deviation_mm, std::max(deflection * 1.02, face.bound_mm));
  }
  return facts;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_box_has_twelve_triangles) {
  const Body body = box(1, 2, 3);
  const mesh::BodyMesh mesh = meshed(body, 0.1, 0.35);
  const MeshFacts facts = require_sound(body, mesh, 0.1, 0.35, 2);
  BOOST_CHECK_EQUAL(facts.triangles, 12u);
  BOOST_CHECK_EQUAL(mesh.points.size(), 8u);
  BOOST_CHECK_EQUAL(mesh.open_edges(), 0u);
  BOOST_CHECK_CLOSE(facts.volume_mm3, 6, 1e-9);
  for (const mesh::FaceMesh& face : mesh.faces) BOOST_CHECK(face.bound_kind == mesh::BoundKind::Proven);
}

BOOST_AUTO_TEST_CASE(a_sphere_closes_at_its_poles_and_seam) {
  const Body body = patch({Sphere{{}, 10}}, full_turn, latitudes);
  for (const double deflection : {1.0, 0.1, 0.01}) {
    const mesh::BodyMesh mesh = meshed(body, deflection, 0.4);
    const MeshFacts facts = require_sound(body, mesh, deflection, 0.4, 2);
    BOOST_CHECK_EQUAL(mesh.open_edges(), 0u);
    BOOST_CHECK_LT(std::abs(facts.volume_mm3 - 4.0 / 3 * pi * 1000), 400 * pi * deflection);
    BOOST_CHECK_LT(std::abs(facts.area_mm2 - 400 * pi), 80 * pi * deflection);
  }
}

BOOST_AUTO_TEST_CASE(a_sphere_needs_few_triangles) {
  const mesh::BodyMesh mesh = meshed(patch({Sphere{{}, 10}}, full_turn, latitudes), 0.01, 0.5);
  BOOST_CHECK_LT(mesh.triangle_count(), 1.8 * 4.84 * 10 / 0.01);  // 4.84 R / eps is the least possible
}

BOOST_AUTO_TEST_CASE(a_sphere_of_rational_patches_is_as_good) {
  const Body body = patch({nurbs_torus(0, 10, true)}, {0, 4}, {0, 2});
  const mesh::BodyMesh mesh = meshed(body, 0.02, 0.35);
  require_sound(body, mesh, 0.02, 0.35, 2);
  BOOST_CHECK_EQUAL(mesh.open_edges(), 0u);
}

BOOST_AUTO_TEST_CASE(a_torus_has_two_seams_and_one_hole) {
  const Body body = patch({Torus{{}, 10, 3}}, full_turn, full_turn);
  const mesh::BodyMesh mesh = meshed(body, 0.02, 0.35);
  const MeshFacts facts = require_sound(body, mesh, 0.02, 0.35, 0);
  BOOST_CHECK_EQUAL(mesh.open_edges(), 0u);
  BOOST_CHECK_CLOSE(facts.volume_mm3, 2 * pi * pi * 10 * 9, 0.5);
  BOOST_CHECK_CLOSE(facts.area_mm2, 4 * pi * pi * 10 * 3, 0.5);
}

BOOST_AUTO_TEST_CASE(a_thin_torus_stays_cheap) {
  const Body body = patch({nurbs_torus(100, 1)}, {0, 4}, {0, 4});
  const mesh::BodyMesh mesh = meshed(body, 0.1, 0.5);
  const MeshFacts facts = require_sound(body, mesh, 0.1, 0.5, 0);
  BOOST_CHECK_LT(facts.triangles, 4000u);
}

BOOST_AUTO_TEST_CASE(a_cone_ends_in_a_fan_around_its_apex) {
  const Body body = patch({Cone{{}, 0, 0.5}}, full_turn, {0, 10});
  const mesh::BodyMesh mesh = meshed(body, 0.05, 0.35);
  const MeshFacts facts = require_sound(body, mesh, 0.05, 0.35, 1);
  BOOST_CHECK_EQUAL(mesh.open_edges(), facts.triangles);  // the base ring
  std::uint32_t apex = 0;
  for (std::uint32_t i = 0; i < mesh.points.size(); ++i)
    if (norm(to_vector(mesh.points[i])) < 1e-9) apex = i;
  std::size_t fan = 0;
  for (const mesh::FaceVertex& v : mesh.faces[0].vertices) fan += v.point == apex;
  BOOST_CHECK_EQUAL(fan, facts.triangles);  // each with its own normal
}

BOOST_AUTO_TEST_CASE(a_capped_cylinder_shares_the_rings_of_its_caps) {
  const Body body = capped_cylinder(10, 2000);
  const mesh::BodyMesh mesh = meshed(body, 0.05, 0.35);
  const MeshFacts facts = require_sound(body, mesh, 0.05, 0.35, 2);
  BOOST_CHECK_EQUAL(mesh.open_edges(), 0u);
  BOOST_CHECK_CLOSE(facts.volume_mm3, pi * 100 * 2000, 1.5);
  BOOST_CHECK_LT(facts.triangles, 200u);  // long thin triangles along the axis are right
}

BOOST_AUTO_TEST_CASE(a_plate_keeps_its_holes) {
  const Body body = plate(100, 60, 6, 3);
  const mesh::BodyMesh mesh = meshed(body, 0.01, 0.2);
  const MeshFacts facts = require_sound(body, mesh, 0.01, 0.2, 1 - 36);
  BOOST_CHECK_LT(std::abs(facts.area_mm2 - (6000 - 36 * pi * 9)), 36 * 6 * pi * 0.01);
}

BOOST_AUTO_TEST_CASE(a_wavy_patch_meets_its_bound_with_few_triangles) {
  const NurbsSurface surface = wavy_patch(40, 100, 6);
  const Body body = patch({surface}, surface.range_u(), surface.range_v());
  const mesh::BodyMesh mesh = meshed(body, 0.1, 3);
  const MeshFacts facts = require_sound(body, mesh, 0.1, 3, 1);
  BOOST_CHECK_LT(facts.triangles, 3500u);
}

BOOST_AUTO_TEST_CASE(reversed_faces_look_the_other_way) {
  const Body body = patch({Sphere{{}, 10}}, full_turn, latitudes, true);
  const mesh::BodyMesh mesh = meshed(body, 0.1, 0.4);
  const MeshFacts facts = require_sound(body, mesh, 0.1, 0.4, 2);
  BOOST_CHECK_LT(facts.volume_mm3, 0);
}

BOOST_AUTO_TEST_CASE(the_angle_governs_where_the_deflection_is_generous) {
  const Body body = patch({Torus{{}, 10, 3}}, full_turn, full_turn);
  for (const double angle : {0.5, 0.25}) require_sound(body, meshed(body, 5, angle), 5, angle, 0);
}

BOOST_AUTO_TEST_CASE(the_number_of_jobs_does_not_matter) {
  Body body = capped_cylinder(10, 20);
  const NurbsSurface surface = wavy_patch(12, 30, 4);
  const Body other = patch({surface}, surface.range_u(), surface.range_v());
  BOOST_CHECK(same_bytes(meshed(body, 0.01, 0.3, 1), meshed(body, 0.01, 0.3, 4)));
  BOOST_CHECK(same_bytes(meshed(other, 0.01, 0.3, 1), meshed(other, 0.01, 0.3, 4)));
  BOOST_CHECK(!same_bytes(meshed(other, 0.01, 0.3, 1), meshed(other, 0.02, 0.3, 1)));
}

BOOST_AUTO_TEST_CASE(failed_faces_stay_with_their_reason) {
  Body body = box(1, 1, 1);
  Face failed;
  failed.surface = std::make_shared<const Surface>(Surface{Plane{}});
  failed.status = FaceStatus::Failed;
  failed.reason = "the loop is open by 3 mm";
  const FaceId id = body.add(failed);
  const mesh::BodyMesh mesh = meshed(body, 0.1, 0.35);
  BOOST_REQUIRE_EQUAL(mesh.faces.size(), 7u);
  BOOST_CHECK(mesh.faces[6].face == id);
  BOOST_CHECK(mesh.faces[6].triangles.empty());
  BOOST_CHECK_EQUAL(mesh.faces[6].reason, failed.reason);
  BOOST_CHECK(!mesh.faces[6].deflection_met);
  BOOST_CHECK_EQUAL(mesh.triangle_count(), 12u);
}

BOOST_AUTO_TEST_CASE(the_limit_of_triangles_holds_and_is_said) {
  const Body body = patch({Sphere{{}, 10}}, full_turn, latitudes);
  for (const std::size_t limit : {50u, 500u}) {
    mesh::TessellationOptions options;
    options.deflection_mm = 0.001;
    options.max_triangles_per_face = limit;
    const auto mesh = mesh::tessellate(body, options);
    BOOST_REQUIRE(mesh);
    BOOST_CHECK_LE(mesh->triangle_count(), limit);
    BOOST_CHECK(!mesh->faces[0].deflection_met);
    BOOST_CHECK(!mesh->faces[0].reason.empty());
  }
  Execution execution;
  execution.limits.triangles = 100;
  mesh::TessellationOptions options;
  options.deflection_mm = 0.01;
  const auto refused = mesh::tessellate(body, options, execution);
  BOOST_REQUIRE(!refused);
  BOOST_CHECK(refused.error().code == ErrorCode::Limit);
}

BOOST_AUTO_TEST_CASE(a_stop_ends_it_early) {
  std::stop_source source;
  source.request_stop();
  Execution execution;
  execution.stop = source.get_token();
  const auto result = mesh::tessellate(box(1, 1, 1), {}, execution);
  BOOST_REQUIRE(!result);
  BOOST_CHECK(result.error().code == ErrorCode::Cancelled);
}

BOOST_AUTO_TEST_CASE(bounds_that_are_no_lengths_are_refused) {
  for (const double deflection : {0.0, -1.0, infinity, not_measured}) {
    mesh::TessellationOptions options;
    options.deflection_mm = deflection;
    const auto result = mesh::tessellate(box(1, 1, 1), options);
    BOOST_REQUIRE(!result);
    BOOST_CHECK(result.error().code == ErrorCode::InvalidArgument);
  }
}

BOOST_AUTO_TEST_CASE(extremes_of_shape_end_quickly) {
  // A fillet a kilometre long, a sphere far below the deflection, a nearly flat patch.
  for (const double deflection : {1.0, 1e-2}) {
    const Body fillet = patch({Cylinder{{}, 1}}, {0, pi / 2}, {0, 1e6});
    BOOST_CHECK_LT(meshed(fillet, deflection, 0.35).triangle_count(), 100u);
    const Body speck = patch({Sphere{{}, 1e-6}}, full_turn, latitudes);
    const MeshFacts facts = measure(speck, meshed(speck, deflection, 0.35));
    BOOST_CHECK_EQUAL(facts.euler, 2);
    BOOST_CHECK_LT(facts.triangles, 2000u);
    const NurbsSurface flat = wavy_patch(40, 1e5, 1e-9);
    const Body sheet = patch({flat}, flat.range_u(), flat.range_v());
    BOOST_CHECK_EQUAL(meshed(sheet, deflection, 0.35, 1, false).triangle_count(), 2u);
    BOOST_CHECK_LE(meshed(sheet, deflection, 0.35).triangle_count(), 8u);  // 2, and what halved sides add before the proof is given up
  }
}

BOOST_AUTO_TEST_CASE(hostile_numbers_give_a_reason_and_no_crash) {
  Body body = patch({Cylinder{{}, 1}}, {0, 1}, {0, 1});
  body.loops[0].coedges[0].pcurve = make_line2({0, 0}, {not_measured, 0});
  const mesh::BodyMesh mesh = meshed(body, 0.1, 0.35);
  BOOST_CHECK(mesh.faces[0].triangles.empty());
  BOOST_CHECK(!mesh.faces[0].reason.empty());
}
