#include <boost/test/unit_test.hpp>

#include "kernel/subdivision/limit.h"
#include "kernel/subdivision/schemes.h"
#include "tests/kernel/subdivision/meshes.h"

using namespace trimloop;
using namespace trimloop::subdivision;
using namespace trimloop::subdivision::test;

namespace {

const Scheme all[] = {Scheme::CatmullClark, Scheme::DooSabin, Scheme::DooSabinMidpoint, Scheme::MidEdge,
                      Scheme::Loop,         Scheme::Butterfly, Scheme::Sqrt3};

bool takes_quads(Scheme s) { return s == Scheme::CatmullClark || s == Scheme::DooSabin || s == Scheme::DooSabinMidpoint || s == Scheme::MidEdge; }

long euler(const ControlMesh& m) {
  const auto adj = adjacency(m);
  BOOST_REQUIRE(adj.has_value());
  return static_cast<long>(m.points.size()) - static_cast<long>(adj->edge_half.size()) + static_cast<long>(m.face_count());
}

}  // namespace

BOOST_AUTO_TEST_SUITE(schemes)

BOOST_AUTO_TEST_CASE(a_cube_has_the_known_counts) {
  struct Row {
    Scheme scheme;
    std::size_t points, faces;
  };
  for (const Row& row : {Row{Scheme::CatmullClark, 26, 24}, Row{Scheme::DooSabin, 24, 26}, Row{Scheme::DooSabinMidpoint, 24, 26},
                         Row{Scheme::MidEdge, 12, 14}}) {
    const auto m = refined(cube(), row.scheme);
    BOOST_REQUIRE(m.has_value());
    BOOST_TEST(m->points.size() == row.points);
    BOOST_TEST(m->face_count() == row.faces);
  }
  for (const Row& row : {Row{Scheme::Loop, 18, 32}, Row{Scheme::Butterfly, 18, 32}, Row{Scheme::Sqrt3, 14, 24}}) {
    const auto m = refined(octahedron(), row.scheme);
    BOOST_REQUIRE(m.has_value());
    BOOST_TEST(m->points.size() == row.points);
    BOOST_TEST(m->face_count() == row.faces);
  }
}

BOOST_AUTO_TEST_CASE(closed_meshes_stay_closed_with_the_same_genus) {
  for (const Scheme s : all) {
    const ControlMesh start = takes_quads(s) ? torus(4, 5) : octahedron();
    const long genus = euler(start);
    auto m = refined_times(start, s, 3);
    BOOST_REQUIRE(m.has_value());
    BOOST_TEST(euler(*m) == genus);
    const auto adj = adjacency(*m);
    for (const std::uint32_t t : adj->twin) BOOST_REQUIRE(t != Adjacency::none);
  }
}

BOOST_AUTO_TEST_CASE(refinement_commutes_with_affine_maps) {
  const auto map = [](Point p) { return Point{2 * p.x - p.y + 3, 0.5 * p.z + p.x - 1, p.y - p.z + 7}; };
  for (const Scheme s : all) {
    const ControlMesh start = takes_quads(s) ? grid(4, 5) : triangle_grid(4, 5);
    ControlMesh moved = start;
    for (Point& p : moved.points) p = map(p);
    const auto a = refined_times(start, s, 2), b = refined_times(moved, s, 2);
    BOOST_REQUIRE((a && b));
    for (std::size_t i = 0; i < a->points.size(); ++i) BOOST_TEST(distance(map(a->points[i]), b->points[i]) <= 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(a_plane_grid_stays_plane_and_evenly_spaced_inside) {
  for (const Scheme s : all) {
    ControlMesh start = takes_quads(s) ? grid(7, 7) : triangle_grid(7, 7);
    for (Point& p : start.points) p.z = 2 * p.x - p.y + 1;
    const auto m = refined_times(start, s, 2);
    BOOST_REQUIRE(m.has_value());
    for (const Point& p : m->points) BOOST_TEST(std::abs(p.z - (2 * p.x - p.y + 1)) <= 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(catmull_clark_moves_a_vertex_by_the_seeds_rule) {
  const auto m = refined(cube(), Scheme::CatmullClark);
  // (F + 2R + (3 - 3)P) / 3 with F = (1/3, ...) and R = (2/3, ...) of corner (1,1,1).
  BOOST_TEST(distance(m->points[7], {5.0 / 9, 5.0 / 9, 5.0 / 9}) <= 1e-15);
}

BOOST_AUTO_TEST_CASE(doo_sabins_true_weights_and_the_seeds_own) {
  const auto weights = [](Scheme s) {
    std::array<double, 4> w{};
    for (std::size_t k = 0; k < 4; ++k) {
      ControlMesh m = grid(2, 2);
      for (Point& p : m.points) p = {};
      m.points[m.face(0)[k]].x = 16;
      w[k] = refined(m, s)->points[0].x;
    }
    return w;
  };
  BOOST_TEST((weights(Scheme::DooSabin) == std::array<double, 4>{9, 3, 1, 3}));
  BOOST_TEST((weights(Scheme::DooSabinMidpoint) == std::array<double, 4>{10, 2, 2, 2}));
}

BOOST_AUTO_TEST_CASE(loop_keeps_its_masks) {
  BOOST_TEST(loop_beta(6) == 1.0 / 16);
  BOOST_TEST(loop_beta(3) == 3.0 / 16);
  const double c = 3.0 / 8 + std::cos(two_pi / 6) / 4;
  BOOST_TEST(std::abs((5.0 / 8 - c * c) / 6 - 1.0 / 16) <= 1e-16);
}

BOOST_AUTO_TEST_CASE(butterfly_interpolates_and_reproduces_cubics_on_a_regular_grid) {
  ControlMesh start = triangle_grid(9, 9);
  for (Point& p : start.points) p.z = p.x * p.x * p.x - 2 * p.x * p.y * p.y + p.y * p.y + p.x;
  const auto m = refined(start, Scheme::Butterfly);
  BOOST_REQUIRE(m.has_value());
  for (std::size_t i = 0; i < start.points.size(); ++i) BOOST_TEST(distance(m->points[i], start.points[i]) == 0);
  for (const Point& p : m->points) {
    if (p.x < 2 || p.y < 2 || p.x > 6 || p.y > 6) continue;  // away from the borders' rules
    BOOST_TEST(std::abs(p.z - (p.x * p.x * p.x - 2 * p.x * p.y * p.y + p.y * p.y + p.x)) <= 1e-10);
  }
}

BOOST_AUTO_TEST_CASE(sqrt3_borders_refine_in_threes_every_second_round) {
  const auto border = [](const ControlMesh& m) {
    const auto adj = adjacency(m);
    return std::count(adj->twin.begin(), adj->twin.end(), Adjacency::none);
  };
  const ControlMesh start = triangle_grid(3, 3);
  BOOST_TEST(border(start) == 8);
  BOOST_TEST(border(*refined(start, Scheme::Sqrt3, 0)) == 8);
  BOOST_TEST(border(*refined_times(start, Scheme::Sqrt3, 2)) == 24);
}

BOOST_AUTO_TEST_CASE(limit_points_are_where_refinement_goes) {
  for (const Scheme s : {Scheme::CatmullClark, Scheme::Loop, Scheme::Butterfly}) {
    for (const ControlMesh& start : {takes_quads(s) ? cube() : tetrahedron(), takes_quads(s) ? grid(4, 4) : triangle_grid(4, 4)}) {
      const auto limit = limit_points(start, s);
      const auto fine = refined_times(start, s, 7);
      BOOST_REQUIRE((limit && fine));
      for (std::size_t v = 0; v < start.points.size(); ++v) BOOST_TEST(distance((*limit)[v].point, fine->points[v]) <= 3e-3);
      // The closed form is a fixed point: the limit of a refined mesh is the limit.
      const auto again = limit_points(*fine, s);
      for (std::size_t v = 0; v < start.points.size(); ++v) BOOST_TEST(distance((*limit)[v].point, (*again)[v].point) <= 1e-13);
    }
  }
}

BOOST_AUTO_TEST_CASE(limit_normals_of_symmetric_meshes_are_known) {
  for (const auto& [mesh, scheme] : {std::pair{cube(), Scheme::CatmullClark}, std::pair{octahedron(), Scheme::Loop}}) {
    const auto limit = limit_points(mesh, scheme);
    BOOST_REQUIRE(limit.has_value());
    for (std::size_t v = 0; v < mesh.points.size(); ++v) BOOST_TEST(norm((*limit)[v].normal - normalized(to_vector(mesh.points[v]))) <= 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(creases_hold_for_their_rounds) {
  ControlMesh m = cube();
  m.creases = {{4, 5, infinity}, {5, 7, infinity}, {7, 6, infinity}, {6, 4, infinity}};
  auto fine = refined_times(m, Scheme::CatmullClark, 4);
  BOOST_REQUIRE(fine.has_value());
  // The top's rim becomes a cubic B-spline in the plane z = 1; its corners lie at (1, 4, 1) / 6 in the limit.
  const auto limit = limit_points(m, Scheme::CatmullClark);
  BOOST_TEST(distance((*limit)[7].point, {2.0 / 3, 2.0 / 3, 1}) <= 1e-15);
  BOOST_TEST(std::abs(fine->points[7].z - 1) == 0);
  for (Crease& c : m.creases) c.sharpness = 1;
  fine = refined(m, Scheme::CatmullClark);
  BOOST_TEST(fine->creases.empty());
  BOOST_TEST(fine->points[7].z == 1);
  m.fixed = {7};
  BOOST_TEST(distance(refined(m, Scheme::CatmullClark)->points[7], m.points[7]) == 0);
}

BOOST_AUTO_TEST_CASE(bad_meshes_are_refused_with_their_place) {
  const auto error = [](ControlMesh m, Scheme s = Scheme::CatmullClark) {
    const auto out = refined(m, s);
    BOOST_REQUIRE(!out);
    return out.error().text;
  };
  ControlMesh m = cube();
  m.corners[5] = 99;
  BOOST_TEST(error(m).find("face 1 names point 99") != std::string::npos);
  m = cube();
  m.corners[1] = m.corners[0];
  BOOST_TEST(error(m).find("face 0 names point 0 twice") != std::string::npos);
  m = cube();
  m.add_face(std::array<std::uint32_t, 3>{0, 2, 7});
  BOOST_TEST(error(m).find("3 faces") != std::string::npos);
  m = cube();
  std::swap(m.corners[1], m.corners[3]);
  BOOST_TEST(error(m).find("the same way") != std::string::npos);
  m = cube();
  m.points[3].x = std::nan("");
  BOOST_TEST(error(m).find("point 3 is not finite") != std::string::npos);
  m = ControlMesh{};
  m.points.resize(5);
  m.add_face(std::array<std::uint32_t, 3>{0, 1, 2});
  m.add_face(std::array<std::uint32_t, 3>{0, 3, 4});
  BOOST_TEST(error(m).find("point 0") != std::string::npos);
  m = cube();
  m.creases = {{0, 7, 1}};
  BOOST_TEST(error(m).find("crease 0-7") != std::string::npos);
  BOOST_TEST(error(cube(), Scheme::Loop).find("loop takes triangles") != std::string::npos);
  const auto out = refined_times(cube(), Scheme::CatmullClark, 30, 1000);
  BOOST_REQUIRE(!out);
  BOOST_TEST((out.error().code == ErrorCode::Limit));
}

BOOST_AUTO_TEST_SUITE_END()
