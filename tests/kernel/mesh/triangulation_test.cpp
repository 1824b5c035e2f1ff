#include "kernel/mesh/triangulation.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <random>

#include "tests/fuzz/triangulation_property.h"

using namespace trimloop;
using namespace trimloop::mesh;

namespace {

constexpr auto none = Triangulation::none;

struct Random {
  std::mt19937_64 engine{42};
  double unit() { return std::ldexp(static_cast<double>(engine() >> 11), -53); }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine() % n); }
};

// A closed loop through points that it appends.
struct Drawing {
  std::vector<Uv> points;
  std::vector<Segment> constraints;

  void loop(const std::vector<Uv>& corners) {
    const auto first = static_cast<std::uint32_t>(points.size()), n = static_cast<std::uint32_t>(corners.size());
    points.insert(points.end(), corners.begin(), corners.end());
    for (std::uint32_t i = 0; i < n; ++i) constraints.push_back({first + i, first + (i + 1) % n});
  }
  void segment(Uv a, Uv b) {
    const auto first = static_cast<std::uint32_t>(points.size());
    points.insert(points.end(), {a, b});
    constraints.push_back({first, first + 1});
  }
};

std::vector<Uv> ring(Uv centre, double radius, int n, bool clockwise = false, double wobble = 0) {
  std::vector<Uv> out;
  for (int i = 0; i < n; ++i) {
    const double angle = (clockwise ? -1 : 1) * two_pi * i / n;
    const double r = radius * (1 + wobble * std::sin(7 * angle));
    out.push_back(centre + r * Uv{std::cos(angle), std::sin(angle)});
  }
  return out;
}

double polygon_area(const std::vector<Uv>& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    sum += cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  }
  return sum / 2;
}

double inside_area(const Triangulation& t) {
  double sum = 0;
  for (auto [a, b, c] : t.inside_triangles()) {
    sum += cross(t.points()[b] - t.points()[a], t.points()[c] - t.points()[a]) / 2;
  }
  return sum;
}

Triangulation built(const Drawing& d, Inside rule = Inside::Nonzero) {
  Triangulation t;
  BOOST_REQUIRE(t.build(d.points, d.constraints).has_value());
  t.classify(rule);
  BOOST_TEST(broken_invariant(t, d.points, d.constraints) == "");
  return t;
}

bool is_close(double a, double b, double tol = 1e-12) { return std::abs(a - b) <= tol * std::abs(b); }

using Corners = std::array<std::pair<double, double>, 3>;
// The inside triangles by their coordinates, in an order that does not know of vertex numbers.
std::vector<Corners> by_coordinates(const Triangulation& t) {
  std::vector<Corners> out;
  for (auto v : t.inside_triangles()) {
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = {t.points()[v[i]].u, t.points()[v[i]].v};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    out.push_back(corners);
  }
  std::sort(out.begin(), out.end());
  return out;
}

Drawing shuffled(const Drawing& d, Random& r) {
  std::vector<std::uint32_t> place(d.points.size());
  for (std::uint32_t i = 0; i < place.size(); ++i) place[i] = i;
  std::shuffle(place.begin(), place.end(), r.engine);
  Drawing out;
  out.points.resize(d.points.size());
  for (std::size_t i = 0; i < place.size(); ++i) out.points[place[i]] = d.points[i];
  for (Segment s : d.constraints) out.constraints.push_back({place[s.a], place[s.b]});
  std::shuffle(out.constraints.begin(), out.constraints.end(), r.engine);
  return out;
}

// Every constraint of `d` as a chain of constrained edges through its crossings in order.
void check_chains(const Triangulation& t, const Drawing& d) {
  std::size_t next = 0;
  for (std::uint32_t c = 0; c < d.constraints.size(); ++c) {
    std::uint32_t from = t.vertex_of(d.constraints[c].a);
    const auto step = [&](std::uint32_t to) {
      const auto edge = t.find_edge(from, to);
      BOOST_REQUIRE(edge.t != none);
      BOOST_REQUIRE(t.is_constrained(edge.t, edge.i));
      from = to;
    };
    for (; next < t.crossings().size() && t.crossings()[next].constraint == c; ++next) step(t.crossings()[next].vertex);
    if (from != t.vertex_of(d.constraints[c].b)) step(t.vertex_of(d.constraints[c].b));
  }
  BOOST_TEST(next == t.crossings().size());
}

}  // namespace

BOOST_AUTO_TEST_CASE(fewer_than_three_distinct_points_make_no_triangle) {
  Triangulation t;
  for (const std::vector<Uv>& points : {std::vector<Uv>{},
                                        {{1, 1}},
                                        {{1, 1}, {2, 2}},
                                        {{1, 1}, {2, 2}, {1, 1}, {2, 2}, {1, 1}},
                                        {{3, 3}, {3, 3}, {3, 3}}}) {
    BOOST_REQUIRE(t.build(points, {}).has_value());
    t.classify(Inside::Nonzero);
    BOOST_TEST(t.triangle_count() == 0u);
    BOOST_TEST(t.inside_triangles().empty());
    BOOST_TEST(t.locate({0, 0}, 0) == none);
    BOOST_TEST(broken_invariant(t, points, {}) == "");
  }
}

BOOST_AUTO_TEST_CASE(collinear_points_make_no_triangle_and_are_still_merged) {
  Drawing d;
  for (int i = 0; i < 50; ++i) d.points.push_back({i % 10 * 0.5, i % 10 * 1.0});
  d.constraints = {{0, 9}, {3, 3}, {12, 40}};
  const auto t = built(d);
  BOOST_TEST(t.triangle_count() == 0u);
  BOOST_TEST(t.vertex_of(43) == 3u);
}

BOOST_AUTO_TEST_CASE(points_that_are_not_finite_and_constraints_to_nowhere_are_refused) {
  Triangulation t;
  BOOST_TEST(!t.build(std::vector<Uv>{{0, 0}, {1, 0}, {infinity, 0}}, {}));
  BOOST_TEST(!t.build(std::vector<Uv>{{0, 0}, {1, 0}, {0, std::nan("")}}, {}));
  BOOST_TEST(!t.build(std::vector<Uv>{{0, 0}, {1, 0}, {0, 1}}, std::vector<Segment>{{0, 3}}));
}

BOOST_AUTO_TEST_CASE(random_points_make_the_delaunay_triangulation) {
  Random r;
  for (std::size_t n : {3, 4, 5, 17, 100, 3000}) {
    Drawing d;
    for (std::size_t i = 0; i < n; ++i) d.points.push_back({r.unit(), r.unit()});
    built(d);
  }
}

BOOST_AUTO_TEST_CASE(a_square_with_a_hole_with_an_island_has_the_right_area_by_every_rule) {
  Drawing d;
  d.loop({{0, 0}, {10, 0}, {10, 10}, {0, 10}});
  d.loop({{2, 2}, {2, 8}, {8, 8}, {8, 2}});
  d.loop({{4, 4}, {6, 4}, {6, 6}, {4, 6}});
  for (Inside rule : {Inside::Nonzero, Inside::Odd, Inside::Positive}) BOOST_TEST(inside_area(built(d, rule)) == 68);
  // Every loop the same way round: the orientation is irrelevant to one rule and means everything to the other.
  std::swap(d.points[5], d.points[7]);
  BOOST_TEST(inside_area(built(d, Inside::Odd)) == 68);
  BOOST_TEST(inside_area(built(d, Inside::Nonzero)) == 100);
}

BOOST_AUTO_TEST_CASE(repeated_loops_add_up) {
  Drawing d;
  d.loop({{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  d.loop({{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  BOOST_TEST(inside_area(built(d, Inside::Nonzero)) == 16);
  BOOST_TEST(inside_area(built(d, Inside::Positive)) == 16);
  BOOST_TEST(inside_area(built(d, Inside::Odd)) == 0);
  d.loop({{0, 4}, {4, 4}, {4, 0}, {0, 0}});  // and once back
  BOOST_TEST(inside_area(built(d, Inside::Odd)) == 16);
  const auto t = built(d);
  BOOST_TEST(t.constrained_edges().winding(0, 1) == 1);
  BOOST_TEST(t.constrained_edges().winding(1, 0) == -1);
}

BOOST_AUTO_TEST_CASE(polygons_with_holes_and_islands_keep_their_area) {
  Random r;
  for (int round = 0; round < 40; ++round) {
    Drawing d;
    double expected = 0;
    const Uv at{r.unit() * 100, r.unit() * 100};
    const auto outer = ring(at, 10, 20 + static_cast<int>(r.below(300)), false, 0.3 * r.unit());
    d.loop(outer);
    expected += polygon_area(outer);
    for (int k = 0; k < 5; ++k) {  // holes around a circle, each with an island
      const Uv centre = at + 4.5 * Uv{std::cos(two_pi * k / 5), std::sin(two_pi * k / 5)};
      const auto hole = ring(centre, 2, 5 + static_cast<int>(r.below(40)), true, 0.2 * r.unit());
      const auto island = ring(centre, 1, 5 + static_cast<int>(r.below(20)), false, 0.2 * r.unit());
      d.loop(hole);
      d.loop(island);
      expected += polygon_area(hole) + polygon_area(island);
    }
    for (int k = 0; k < 50; ++k) d.points.push_back(at + Uv{r.unit() * 24 - 12, r.unit() * 24 - 12});
    for (Inside rule : {Inside::Nonzero, Inside::Odd, Inside::Positive}) {
      BOOST_TEST(is_close(inside_area(built(d, rule)), expected));
    }
    BOOST_TEST((by_coordinates(built(d)) == by_coordinates(built(shuffled(d, r)))));
  }
}

BOOST_AUTO_TEST_CASE(cocircular_points_give_the_same_triangles_in_any_order) {
  Random r;
  Drawing grid, odd_grid, circle;
  for (int i = 0; i < 30; ++i) {
    for (int j = 0; j < 30; ++j) {
      grid.points.push_back({double(i), double(j)});
      odd_grid.points.push_back({i * 0.1, j * 0.3});
    }
  }
  for (auto* g : {&grid, &odd_grid}) g->constraints = {{0, 29}, {29, 899}, {899, 870}, {870, 0}};
  circle.loop(
      {{5, 0}, {4, 3}, {3, 4}, {0, 5}, {-3, 4}, {-4, 3}, {-5, 0}, {-4, -3}, {-3, -4}, {0, -5}, {3, -4}, {4, -3}});
  for (const Drawing& d : {grid, odd_grid, circle}) {
    const auto once = by_coordinates(built(d));
    BOOST_TEST(!once.empty());
    for (int k = 0; k < 5; ++k) BOOST_TEST((by_coordinates(built(shuffled(d, r))) == once));
  }
}

BOOST_AUTO_TEST_CASE(crossing_constraints_meet_in_a_new_vertex) {
  Drawing d;
  d.segment({0, 0}, {4, 4});
  d.segment({0, 4}, {4, 0});
  const auto t = built(d);
  BOOST_REQUIRE(t.points().size() == 5u);
  BOOST_TEST(t.points()[4].u == 2);
  BOOST_TEST(t.points()[4].v == 2);
  BOOST_REQUIRE(t.crossings().size() == 2u);
  for (std::uint32_t c : {0u, 1u}) {
    BOOST_TEST(t.crossings()[c].vertex == 4u);
    BOOST_TEST(t.crossings()[c].constraint == c);
    BOOST_TEST(t.crossings()[c].fraction == 0.5);
  }
  check_chains(t, d);
}

BOOST_AUTO_TEST_CASE(a_pentagram_has_a_core_of_winding_two) {
  Drawing d;
  const auto tips = ring({0, 0}, 1, 5);
  d.loop({tips[0], tips[2], tips[4], tips[1], tips[3]});
  const auto all = built(d, Inside::Nonzero), odd = built(d, Inside::Odd);
  BOOST_TEST(all.points().size() == 10u);
  const double inner = std::sin(pi / 10) / std::cos(pi / 5);  // radius of the core
  const double core = 2.5 * inner * inner * std::sin(two_pi / 5);
  const double star = 5 * inner * std::sin(pi / 5);
  BOOST_TEST(is_close(inside_area(all), star));
  BOOST_TEST(is_close(inside_area(odd), star - core));
  check_chains(all, d);
}

BOOST_AUTO_TEST_CASE(points_on_a_constraint_split_it_and_overlaps_share_edges) {
  Drawing d;
  d.loop({{0, 0}, {9, 0}, {9, 9}, {0, 9}});
  d.points.insert(d.points.end(), {{3, 0}, {6, 0}, {9, 5}, {4, 4}});
  d.segment({2, 0}, {7, 0});   // overlaps the bottom
  d.segment({3, 0}, {-1, 0});  // and beyond it
  d.segment({1, 1}, {8, 8});   // through (4, 4)
  d.segment({3, 3}, {5, 5});   // within that
  d.segment({4, 0}, {4, 2});   // ends on the bottom
  const auto t = built(d);
  check_chains(t, d);
  BOOST_TEST(t.diverted() == 0u);
  const auto on = [&](std::uint32_t constraint) {
    return std::count_if(t.crossings().begin(), t.crossings().end(),
                         [&](auto& c) { return c.constraint == constraint; });
  };
  BOOST_TEST(on(0) == 5);  // (2,0) (3,0) (4,0) (6,0) (7,0)
  BOOST_TEST(on(1) == 1);
  BOOST_TEST(on(4) == 3);  // (3,0) (4,0) (6,0)
  BOOST_TEST(t.points().size() == d.points.size());
}

BOOST_AUTO_TEST_CASE(many_segments_through_each_other_are_all_there) {
  Random r;
  Drawing d;
  for (int k = 0; k < 60; ++k) d.segment({r.unit(), r.unit()}, {r.unit(), r.unit()});
  for (int k = 0; k < 20; ++k) {  // and a bundle through one point
    const Uv w{std::cos(pi * k / 20), std::sin(pi * k / 20)};
    d.segment(Uv{1.0 / 3, 1.0 / 3} - 0.3 * w, Uv{1.0 / 3, 1.0 / 3} + 0.2 * w);
  }
  const auto t = built(d);
  BOOST_TEST(t.diverted() == 0u);
  BOOST_TEST(t.crossings().size() > 500u);
}

BOOST_AUTO_TEST_CASE(open_constraints_do_not_leak_or_fill) {
  Drawing d;
  d.loop({{0, 0}, {9, 0}, {9, 9}, {0, 9}});
  d.segment({2, 2}, {7, 7});    // a dangling line inside
  d.segment({20, 2}, {27, 7});  // and one outside
  for (Inside rule : {Inside::Nonzero, Inside::Odd, Inside::Positive}) BOOST_TEST(inside_area(built(d, rule)) == 81);
}

BOOST_AUTO_TEST_CASE(huge_and_tiny_coordinates_are_as_good_as_others) {
  for (double scale : {1e100, 1e-100, 1e150, 1e-150}) {
    Drawing d;
    d.loop(ring({0, 0}, 3 * scale, 100));
    d.loop(ring({scale, 0}, 0.5 * scale, 30, true));
    d.segment({-2 * scale, -2 * scale}, {2 * scale, 1 * scale});
    const auto t = built(d);
    check_chains(t, d);
    std::size_t inside = t.inside_triangles().size();
    BOOST_TEST(inside > 130u);
    Drawing same;  // the same in ordinary numbers: a power of two may differ, so only the counts are equal
    same.loop(ring({0, 0}, 3, 100));
    same.loop(ring({1, 0}, 0.5, 30, true));
    same.segment({-2, -2}, {2, 1});
    BOOST_TEST(built(same).inside_triangles().size() == inside);
  }
  Drawing mixed;  // one call of a predicate may see both ends of the range
  mixed.loop({{0, 0}, {1e300, 0}, {1e300, 1e300}, {0, 1e300}});
  mixed.loop({{1e-300, 1e-300}, {1e-300, 2e-300}, {2e-300, 2e-300}, {2e-300, 1e-300}});
  BOOST_TEST(built(mixed).inside_triangles().size() == 8u);
}

BOOST_AUTO_TEST_CASE(spikes_and_needles_keep_every_triangle_positive) {
  Drawing d;
  std::vector<Uv> comb{{0, -1}};
  for (int i = 0; i < 200; ++i) comb.insert(comb.end(), {{double(i), 0}, {i + 0.5, 1e6}, {i + 0.5 + 1e-9, 0}});
  comb.push_back({200, -1});
  std::reverse(comb.begin(), comb.end());
  d.loop(comb);
  d.loop({{1000, 0}, {2000, 1e-12}, {3000, 0}, {2000, -1e-12}});  // a needle
  d.segment({0.25, -0.5}, {199, -0.5000000001});
  d.loop({{300, 0}, {400, 0}, {300, 0}});  // there and back
  const auto t = built(d);
  check_chains(t, d);
}

BOOST_AUTO_TEST_CASE(duplicates_are_merged_everywhere) {
  Random r;
  Drawing d;
  d.loop({{0, 0}, {9, 0}, {9, 0}, {9, 9}, {9, 9}, {0, 9}, {0, 0}});
  for (int k = 0; k < 500; ++k) d.points.push_back({double(r.below(10)), double(r.below(10))});
  for (std::uint32_t k = 0; k < 100; ++k) d.constraints.push_back({k, k});
  const auto t = built(d, Inside::Odd);
  BOOST_TEST(inside_area(t) == 81);
  BOOST_TEST(t.vertex_of(2) == 1u);
  BOOST_TEST(t.vertex_of(6) == 0u);
}

BOOST_AUTO_TEST_CASE(a_loop_of_a_hundred_thousand_points) {
  Drawing d;
  const auto outline = ring({0, 0}, 100, 100'000, false, 0.1);
  d.loop(outline);
  Triangulation t;
  BOOST_REQUIRE(t.build(d.points, d.constraints).has_value());
  t.classify(Inside::Nonzero);
  BOOST_TEST(t.inside_triangles().size() == 99'998u);
  BOOST_TEST(is_close(inside_area(t), polygon_area(outline), 1e-10));
  // A spiral: convex order for a thousand turns, where insertion along the curve alone would flip without end.
  Drawing spiral;
  for (int i = 0; i < 100'000; ++i) {
    const double angle = two_pi * i / 100;
    spiral.points.push_back((1 + 1e-4 * i) * Uv{std::cos(angle), std::sin(angle)});
  }
  for (std::uint32_t i = 1; i < 100'000; ++i) spiral.constraints.push_back({i - 1, i});
  BOOST_REQUIRE(t.build(spiral.points, spiral.constraints).has_value());
  BOOST_TEST(t.triangle_count() == 2 * spiral.points.size() - 2);
}

BOOST_AUTO_TEST_CASE(ten_thousand_holes) {
  Drawing d;
  d.loop({{-1, -1}, {100, -1}, {100, 100}, {-1, 100}});
  double expected = 101 * 101;
  for (int i = 0; i < 100; ++i) {
    for (int j = 0; j < 100; ++j) {
      const auto hole = ring({double(i), double(j)}, 0.4, 6, true);
      d.loop(hole);
      expected += polygon_area(hole);
    }
  }
  Triangulation t;
  for (Inside rule : {Inside::Odd, Inside::Positive, Inside::Nonzero}) {
    BOOST_REQUIRE(t.build(d.points, d.constraints).has_value());
    t.classify(rule);
    BOOST_TEST(is_close(inside_area(t), expected, 1e-10));
  }
}

BOOST_AUTO_TEST_CASE(insertion_keeps_everything_and_names_the_star) {
  Random r;
  Drawing d;
  d.loop(ring({0, 0}, 1, 40, false, 0.2));
  d.loop(ring({0.1, 0}, 0.3, 12, true));
  auto t = built(d);
  const double area = inside_area(t);
  std::vector<std::uint32_t> touched;
  std::uint32_t near = 0;
  int inserted = 0;
  for (int k = 0; k < 400; ++k) {
    const Uv p{2.6 * r.unit() - 1.3, 2.6 * r.unit() - 1.3};
    const std::uint32_t home = t.locate(p, near);
    BOOST_REQUIRE(home != none);
    const bool was_inside = t.is_inside(home);
    const std::uint32_t v = t.insert(p, near, touched);
    BOOST_REQUIRE((v != none) == was_inside);
    if (v == none) continue;
    ++inserted;
    near = touched.front();
    for (std::uint32_t k2 : touched) BOOST_REQUIRE((t.index_of(k2, v) >= 0 && t.is_inside(k2)));
    std::size_t around = 0;
    std::uint32_t k2 = t.triangle_at(v);
    do ++around, k2 = t.next_around(k2, v);
    while (k2 != t.triangle_at(v));
    BOOST_REQUIRE(around == touched.size());
    BOOST_REQUIRE(t.insert(p, near, touched) == none);  // there already
  }
  BOOST_TEST(inserted > 100);
  BOOST_TEST(broken_invariant(t, d.points, d.constraints) == "");
  BOOST_TEST(is_close(inside_area(t), area));
  // The same as if all points had been given at once.
  Drawing all = d;
  all.points = t.points();
  BOOST_TEST((by_coordinates(built(all)) == by_coordinates(t)));
  // Not on a constraint.
  Drawing square;
  square.loop({{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  auto s = built(square);
  BOOST_TEST(s.insert({2, 0}, 0, touched) == none);
  BOOST_TEST(s.insert({infinity, 0}, 0, touched) == none);
  BOOST_TEST(s.insert({2, 2}, 0, touched) == 4u);
  BOOST_TEST(touched.size() == 4u);
}

BOOST_AUTO_TEST_CASE(a_constraint_is_split_beside_its_line_too) {
  Drawing d;
  d.loop({{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  d.loop({{1, 1}, {1, 3}, {3, 3}, {3, 1}});
  std::vector<std::uint32_t> touched;
  for (double off : {0.0, 1e-3, -1e-3}) {
    for (Segment side : {Segment{0, 1}, Segment{1, 0}, Segment{4, 7}, Segment{7, 4}}) {
      auto t = built(d);
      const auto edge = t.find_edge(side.a, side.b);
      BOOST_REQUIRE(edge.t != none);
      const Uv p = Uv{0, off} + 0.5 * (d.points[side.a] + d.points[side.b]);
      const std::uint32_t v = t.split_constraint(edge.t, edge.i, p, touched);
      BOOST_REQUIRE(v == 8u);
      for (std::uint32_t end : {side.a, side.b}) {
        const auto half = t.find_edge(end, v);
        BOOST_REQUIRE(half.t != none);
        BOOST_TEST(t.is_constrained(half.t, half.i));
        BOOST_TEST(t.constraint_of(half.t, half.i) == (side.a < 4 ? 0u : 7u));
      }
      BOOST_TEST(broken_invariant(t, d.points, d.constraints) == "");
      const double change = side.a < 4 ? -2 * off : off;
      BOOST_TEST(is_close(inside_area(t), 12 + change, 1e-9));
      BOOST_TEST(t.split_constraint(edge.t, edge.i, {50, 50}, touched) == none);
    }
  }
}

BOOST_AUTO_TEST_CASE(location_agrees_with_orientation_everywhere) {
  Random r;
  Drawing d;
  for (int k = 0; k < 30; ++k) d.segment({r.unit(), r.unit()}, {r.unit(), r.unit()});
  const auto t = built(d);
  for (int k = 0; k < 3000; ++k) {
    const Uv p{r.unit() * 1.4 - 0.2, r.unit() * 1.4 - 0.2};
    const std::uint32_t home = t.locate(p, static_cast<std::uint32_t>(r.below(t.triangle_count())));
    BOOST_REQUIRE(home != none);
    const auto& v = t.triangle(home).v;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = v[(i + 1) % 3], b = v[(i + 2) % 3];
      if (a != none && b != none) BOOST_REQUIRE(orient2d(t.points()[a], t.points()[b], p) >= 0);
    }
  }
}

BOOST_AUTO_TEST_CASE(random_bytes_make_good_triangulations) {
  Random r;
  for (int round = 0; round < 300; ++round) {
    std::vector<std::uint8_t> bytes(20 + r.below(400));
    for (auto& b : bytes) b = static_cast<std::uint8_t>(r.engine());
    if (bytes[0] % 8 == 5 && round % 4 != 0) ++bytes[0];  // the slow kind less often
    BOOST_TEST_INFO("round " << round);
    BOOST_REQUIRE_EQUAL(broken_by(bytes.data(), bytes.size()), "");
  }
}
