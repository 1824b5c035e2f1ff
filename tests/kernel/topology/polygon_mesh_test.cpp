#include "kernel/topology/polygon_mesh.h"

#include <boost/test/unit_test.hpp>

#include "kernel/check/measure.h"
#include "base/limits.h"
#include "kernel/model/model.h"

using namespace trimloop;

namespace {

// The corner of a block cut off at a, b, c along the axes.
PolygonMesh tetrahedron(Point at, double a, double b, double c) {
  PolygonMesh mesh;
  mesh.kind = BodyKind::Solid;
  mesh.points = {at, at + Vector{a, 0, 0}, at + Vector{0, b, 0}, at + Vector{0, 0, c}};
  MeshFace face;
  for (std::uint32_t i = 0; i < 4; ++i) face.vertices.push_back({i, {}});
  face.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  mesh.faces.push_back(face);
  return mesh;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(polygon_mesh)

BOOST_AUTO_TEST_CASE(tetrahedron_has_its_closed_forms) {
  const PolygonMesh mesh = tetrahedron({1000, -200, 30}, 3, 4, 12);
  BOOST_TEST(broken_promises(mesh).empty());
  BOOST_TEST(open_sides(mesh) == 0u);
  // Three right triangles and the one across: half the root of a²b² + b²c² + c²a².
  BOOST_TEST(area(mesh) == 0.5 * (12 + 48 + 36) + 0.5 * std::sqrt(144. + 2304. + 1296.), boost::test_tools::tolerance(1e-14));
  BOOST_TEST(volume(mesh).value() == 3. * 4 * 12 / 6, boost::test_tools::tolerance(1e-13));
  const Point centre = centroid(mesh).value();
  BOOST_TEST(distance(centre, Point{1000.75, -199, 33}) < 1e-11);
  BOOST_TEST(bounding_box(mesh).diagonal() == 13.0, boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(a_side_used_once_or_twice_in_one_direction_is_open) {
  PolygonMesh mesh = tetrahedron({}, 1, 1, 1);
  std::swap(mesh.faces[0].triangles[3][0], mesh.faces[0].triangles[3][1]);
  BOOST_TEST(open_sides(mesh) == 6u);
  BOOST_TEST(!volume(mesh));
  mesh.faces[0].triangles.pop_back();
  BOOST_TEST(open_sides(mesh) == 3u);
}

BOOST_AUTO_TEST_CASE(indices_out_of_range_are_told) {
  PolygonMesh mesh = tetrahedron({}, 1, 1, 1);
  mesh.faces[0].vertices.push_back({4, {}});
  mesh.faces[0].triangles.push_back({0, 0, 5});
  BOOST_TEST(broken_promises(mesh).size() == 3u);
}

BOOST_AUTO_TEST_CASE(placed_twice_it_is_measured_twice_and_apart_from_bodies) {
  Model model;
  model.parts.resize(2);
  model.parts[1].meshes.push_back(tetrahedron({}, 1, 1, 1));
  model.parts[1].meshes.push_back(tetrahedron({5, 5, 5}, 1, 1, 1));
  model.parts[1].meshes.back().stands_for = BodyIndex{0};  // repeats a body: not measured
  Transform twice;
  for (std::size_t i = 0; i < 3; ++i) twice.r[i][i] = 2;
  model.parts[0].instances = {{1, Transform{}, {}, {}}, {1, twice, {}, {}}};
  const auto m = measure(model, Limits{}).value();
  BOOST_TEST(m.area_mm2 == 0);
  BOOST_TEST(!m.volume_mm3.has_value());
  BOOST_TEST(m.mesh_volume_mm3.value() == 9. / 6, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(m.box.hi.x == 2);
  const auto n = count(model).value();
  BOOST_TEST(n.meshes == 4u);
  BOOST_TEST(n.mesh_triangles == 16u);
}

BOOST_AUTO_TEST_SUITE_END()
