#include <boost/test/unit_test.hpp>

#include "kernel/subdivision/limit.h"
#include "kernel/subdivision/limit_surface.h"
#include "kernel/subdivision/schemes.h"
#include "tests/kernel/subdivision/meshes.h"

using namespace trimloop;
using namespace trimloop::subdivision;
using namespace trimloop::subdivision::test;

namespace {

// Every patch's corners and middle points, on the limit mesh that many rounds give: distance to the nearest point.
double worst_corner(const LimitSurface& s, const std::vector<LimitPoint>& limit) {
  double worst = 0;
  for (const LimitPatch& p : s.patches) {
    for (const Uv uv : {Uv{0, 0}, Uv{1, 0}, Uv{0, 1}, Uv{1, 1}}) {
      double nearest = infinity;
      const Point at = evaluate(p.surface, uv);
      for (const LimitPoint& q : limit) nearest = std::min(nearest, distance(at, q.point));
      worst = std::max(worst, nearest);
    }
  }
  return worst;
}

double area(const LimitSurface& s) {
  double sum = 0;
  constexpr int n = 12;
  for (const LimitPatch& p : s.patches)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        Point point;
        Vector su, sv;
        jet1(p.surface, {(i + 0.5) / n, (j + 0.5) / n}, point, su, sv);
        sum += norm(cross(su, sv)) / (n * n);
      }
  return sum;
}

double mesh_area(const ControlMesh& m) {
  double sum = 0;
  for (std::size_t f = 0; f < m.face_count(); ++f) {
    const auto c = m.face(f);
    for (std::size_t i = 1; i + 1 < c.size(); ++i)
      sum += norm(cross(m.points[c[i]] - m.points[c[0]], m.points[c[i + 1]] - m.points[c[0]])) / 2;
  }
  return sum;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(limit_surfaces)

BOOST_AUTO_TEST_CASE(a_regular_torus_is_exact_and_its_poles_are_the_control_points) {
  const ControlMesh m = torus(8, 6);
  const auto s = catmull_clark_limit(m);
  BOOST_REQUIRE(s.has_value());
  BOOST_TEST(s->exact == 48u);
  BOOST_TEST(s->caps == 0u);
  BOOST_TEST(s->bound == 0);
  const LimitPatch& p = s->patches[0];
  BOOST_TEST(distance(project(p.surface.pole(1, 1)), m.points[m.face(0)[0]]) == 0);
  BOOST_TEST(distance(project(p.surface.pole(2, 1)), m.points[m.face(0)[1]]) == 0);
  BOOST_TEST(distance(project(p.surface.pole(2, 2)), m.points[m.face(0)[2]]) == 0);
  // Refined meshes have the same limit: the patch of a refined face is a quarter of it, point by point.
  const auto fine = catmull_clark_limit(*refined(m, Scheme::CatmullClark));
  const LimitPatch& q = fine->patches[0];  // at corner 0
  for (const double u : {0.0, 0.4, 1.0})
    for (const double v : {0.2, 1.0})
      BOOST_TEST(distance(evaluate(p.surface, {u / 2, v / 2}), evaluate(q.surface, {u, v})) <= 1e-14);
}

BOOST_AUTO_TEST_CASE(a_grid_with_borders_is_the_b_spline_of_mirrored_rows) {
  const auto s = catmull_clark_limit(grid(4, 5));
  BOOST_REQUIRE(s.has_value());
  BOOST_TEST(s->exact == 12u);
  BOOST_TEST(s->caps == 0u);
  const auto limit = limit_points(grid(4, 5), Scheme::CatmullClark);
  BOOST_TEST(worst_corner(*s, *limit) <= 1e-14);
  BOOST_TEST(distance(evaluate(s->patches[0].surface, {0, 0}), grid(4, 5).points[0]) <= 1e-14);
}

BOOST_AUTO_TEST_CASE(caps_of_a_cube_keep_their_bound) {
  const ControlMesh m = cube();
  for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4}) {
    const auto s = catmull_clark_limit(m, {tolerance, 12, 100000});
    BOOST_REQUIRE(s.has_value());
    BOOST_TEST(s->bound <= tolerance);
    BOOST_TEST(s->caps == 24u);
    // The true distance: limit points of a fine mesh against the caps' own points of the same parameters are what the
    // bound compares; here the nearest point of any patch is enough to show that nothing exceeds it.
    const auto fine = refined_times(m, Scheme::CatmullClark, 5);
    const auto limit = limit_points(*fine, Scheme::CatmullClark);
    BOOST_TEST(worst_corner(*s, *limit) <= 0.08);  // corners of small rings lie between the fine mesh's points
    BOOST_TEST(std::abs(area(*s) - mesh_area(*refined_times(m, Scheme::CatmullClark, 6))) <= 0.01);
  }
}

BOOST_AUTO_TEST_CASE(the_bound_of_a_cap_is_not_exceeded_by_the_limit) {
  // A cap of one round is compared with the same region carried 6 rounds further, at equal parameters.
  for (const ControlMesh& m : {cube(), tetrahedron()}) {
    const auto coarse = catmull_clark_limit(m, {1e9, 0, 100000});
    const auto deep = catmull_clark_limit(m, {0, 6, 100000});
    BOOST_REQUIRE((coarse && deep));
    double measured = 0;
    std::size_t at = 0;
    for (const LimitPatch& cap : coarse->patches) {
      if (cap.bound == 0) continue;
      // The rings of the same corner come in the same order: 18 ring patches, then its cap.
      while (deep->patches[at].face != cap.face) ++at;
      double lo = 1;
      for (std::size_t k = 0; k < 6; ++k) {
        const double half = lo / 2;
        const Uv origin[3] = {{half, 0}, {half, half}, {0, half}};
        for (std::size_t q = 0; q < 3; ++q)
          for (const double u : {0.0, 0.3, 0.5, 0.9, 1.0})
            for (const double v : {0.0, 0.4, 0.7, 1.0})
              measured = std::max(measured, distance(evaluate(deep->patches[at + 3 * k + q].surface, {u, v}),
                                                     evaluate(cap.surface, {origin[q].u + half * u, origin[q].v + half * v})));
        lo = half;
      }
      at += 19;
    }
    BOOST_TEST(measured > 0);
    BOOST_TEST(measured <= coarse->bound);
    BOOST_TEST(coarse->bound <= 4 * measured);
  }
}

BOOST_AUTO_TEST_CASE(patches_meet_without_gaps) {
  // Corners and side middles of every patch of the same size are shared; caps share their sides pole by pole.
  const auto s = catmull_clark_limit(cube(), {1e-2, 12, 100000});
  BOOST_REQUIRE(s.has_value());
  std::size_t lonely = 0;
  for (std::size_t i = 0; i < s->patches.size(); ++i) {
    if (s->patches[i].bound == 0) continue;
    for (const auto& [a, b] : {std::pair{Uv{0, 0}, Uv{1, 0}}, std::pair{Uv{0, 0}, Uv{0, 1}}}) {
      const Point middle = evaluate(s->patches[i].surface, {0.5 * (a.u + b.u), 0.5 * (a.v + b.v)});
      double nearest = infinity;
      for (std::size_t j = 0; j < s->patches.size(); ++j) {
        if (j == i || s->patches[j].bound == 0) continue;
        for (const Uv uv : {Uv{0.5, 0}, Uv{0, 0.5}}) nearest = std::min(nearest, distance(middle, evaluate(s->patches[j].surface, uv)));
      }
      lonely += nearest > 1e-14;
    }
  }
  BOOST_TEST(lonely == 0u);
}

BOOST_AUTO_TEST_CASE(sharp_rims_are_exact_borders) {
  ControlMesh m = cube();
  m.creases = {{4, 5, infinity}, {5, 7, infinity}, {7, 6, infinity}, {6, 4, infinity}};
  const auto s = catmull_clark_limit(m, {1e-3, 12, 100000});
  BOOST_REQUIRE(s.has_value());
  BOOST_TEST(s->bound <= 1e-3);
  // The top face is the plane z = 1.
  std::size_t top = 0;
  for (const LimitPatch& p : s->patches) {
    bool plane = true;
    for (const Uv uv : {Uv{0, 0}, Uv{1, 0}, Uv{0.5, 0.5}, Uv{1, 1}}) plane = plane && std::abs(evaluate(p.surface, uv).z - 1) <= 1e-14;
    top += plane;
  }
  BOOST_TEST(top >= 4u);
  m.creases.resize(1);
  BOOST_TEST(!catmull_clark_limit(m).has_value());
}

BOOST_AUTO_TEST_CASE(doo_sabin_is_exact_where_regular_and_bounded_elsewhere) {
  const auto exact = doo_sabin_limit(torus(7, 5));
  BOOST_REQUIRE(exact.has_value());
  BOOST_TEST(exact->exact == 35u);
  BOOST_TEST(exact->caps == 0u);
  for (const double tolerance : {1e-1, 1e-3}) {
    const auto s = doo_sabin_limit(cube(), {tolerance, 14, 100000});
    BOOST_REQUIRE(s.has_value());
    BOOST_TEST(s->bound <= tolerance);
    if (tolerance < 0.01) BOOST_TEST(std::abs(area(*s) - mesh_area(*refined_times(cube(), Scheme::DooSabin, 6))) <= 0.02);
  }
  // Every corner of a patch is a face's centre of some finer mesh.
  const auto s = doo_sabin_limit(cube(), {1e9, 0, 100000});
  const auto fine = refined_times(cube(), Scheme::DooSabin, 2);
  BOOST_TEST(worst_corner(*s, *limit_points(*fine, Scheme::DooSabin)) <= 1e-14);
}

BOOST_AUTO_TEST_CASE(loops_regular_faces_are_quartic_triangles) {
  const ControlMesh m = triangle_grid(7, 7);
  const auto patches = loop_regular_patches(m);
  BOOST_REQUIRE(patches.has_value());
  BOOST_TEST(patches->patches.size() + patches->irregular.size() == m.face_count());
  BOOST_TEST(patches->patches.size() == 32u);  // faces between the 5 x 5 inner points
  const auto limit = limit_points(m, Scheme::Loop);
  const auto fine_mesh = refined(m, Scheme::Loop);
  const auto fine = limit_points(*fine_mesh, Scheme::Loop);
  const auto adj = adjacency(m);
  for (std::size_t i = 0; i < patches->patches.size(); ++i) {
    const std::uint32_t h = m.face_start[patches->faces[i]];
    const TriangleBezier& p = patches->patches[i];
    BOOST_TEST(distance(evaluate(p, {1, 0, 0}), (*limit)[m.corners[h]].point) <= 1e-14);
    BOOST_TEST(distance(evaluate(p, {0, 1, 0}), (*limit)[m.corners[h + 1]].point) <= 1e-14);
    // The middle of a side is the limit of the new vertex there.
    BOOST_TEST(distance(evaluate(p, {0.5, 0.5, 0}), (*fine)[m.points.size() + adj->edge[h]].point) <= 1e-14);
    BOOST_TEST(distance(evaluate(p, {0, 0.5, 0.5}), (*fine)[m.points.size() + adj->edge[h + 1]].point) <= 1e-14);
  }
}

BOOST_AUTO_TEST_SUITE_END()
