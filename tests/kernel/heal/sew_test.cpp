// Sewing: closed solids from loose faces, whatever their order and direction; what is open stays open and is listed.

#include "kernel/heal/sew.h"

#include <array>
#include <numeric>

#include "kernel/mesh/tessellate.h"
#include "tests/kernel/heal/helpers.h"

using namespace trimloop;
using namespace trimloop::heal;
using namespace trimloop::heal::test;

namespace {

// A rectangle of its own: origin, and two sides.
void add_rectangle(Body& body, Point o, Vector a, Vector b, bool reversed = false) {
  Frame frame;
  frame.origin = o;
  frame.x = normalized(a);
  frame.z = normalized(cross(a, b));
  frame.y = cross(frame.z, frame.x);
  FaceInput in = input(Plane{frame}, {polygon({{0, 0}, {norm(a), 0}, {norm(a), norm(b)}, {0, norm(b)}})});
  in.reversed = reversed;
  in.source = {{body.faces.size() * 2 + 1, 0}};
  add_face(body, in);
}

// The six sides of a box; `jitter` moves each by so much, some are turned inside out.
Body loose_box(Point o, double dx, double dy, double dz, double jitter = 0, std::vector<int> order = {0, 1, 2, 3, 4, 5}) {
  Body body;
  const Vector x{dx, 0, 0}, y{0, dy, 0}, z{0, 0, dz};
  for (const int side : order) {
    const Vector j = jitter * Vector{side % 2 ? 1.0 : -1.0, side % 3 ? -0.5 : 0.5, side > 2 ? 0.7 : -0.7};
    if (side == 0) add_rectangle(body, o + j, x, y, true);
    if (side == 1) add_rectangle(body, o + z + j, x, y, true);
    if (side == 2) add_rectangle(body, o + j, x, z);
    if (side == 3) add_rectangle(body, o + y + j, x, z);
    if (side == 4) add_rectangle(body, o + j, y, z, true);
    if (side == 5) add_rectangle(body, o + x + j, y, z);
  }
  return body;
}

SewResult sewn(Body body, double tolerance) {
  SewResult r = sew({std::move(body)}, {tolerance});
  BOOST_REQUIRE(r.bodies.size() == r.reports.size());
  for (const Body& b : r.bodies) check_sound(b, 2 * tolerance);
  return r;
}

void check_watertight(const Body& body) {
  const auto mesh = mesh::tessellate(body, {});
  BOOST_REQUIRE(mesh.has_value());
  BOOST_TEST(mesh->triangle_count() > 0u);
  BOOST_TEST(mesh->open_edges() == 0u);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(sewing)

BOOST_AUTO_TEST_CASE(six_loose_sides_are_a_solid) {
  const SewResult r = sewn(loose_box({1, 2, 3}, 2, 3, 4), 1e-6);
  BOOST_REQUIRE(r.bodies.size() == 1u);
  const Body& b = r.bodies[0];
  BOOST_TEST((b.kind == BodyKind::Solid));
  BOOST_TEST(b.edges.size() == 12u);
  BOOST_TEST(b.vertices.size() == 8u);
  BOOST_TEST(r.reports[0].joined == 12u);
  BOOST_TEST(r.reports[0].open.empty());
  BOOST_TEST(volume(b, ShellId{0})->value == 24, boost::test_tools::tolerance(1e-9));
  check_watertight(b);
  std::vector<std::uint64_t> sources;
  for (const Face& f : b.faces) sources.push_back(f.source.at(0).id);
  std::sort(sources.begin(), sources.end());
  BOOST_TEST((sources == std::vector<std::uint64_t>{1, 3, 5, 7, 9, 11}));
}

BOOST_AUTO_TEST_CASE(gaps_within_the_tolerance_are_measured_and_beyond_it_listed) {
  const double jitter = 1e-3;
  const SewResult closed = sewn(loose_box({}, 2, 3, 4, jitter), 1e-2);
  BOOST_REQUIRE(closed.bodies.size() == 1u);
  BOOST_TEST((closed.bodies[0].kind == BodyKind::Solid));
  BOOST_TEST(closed.reports[0].max_gap_mm > jitter);
  BOOST_TEST(closed.reports[0].max_gap_mm < 4 * jitter);
  double largest = 0;
  for (const Loop& l : closed.bodies[0].loops)
    for (const Coedge& c : l.coedges) largest = std::max(largest, c.gap_mm);
  BOOST_TEST(largest == closed.reports[0].max_gap_mm, boost::test_tools::tolerance(0.5));
  check_watertight(closed.bodies[0]);

  const SewResult open = sewn(loose_box({}, 2, 3, 4, jitter), 1e-5);
  std::size_t listed = 0;
  for (const SewReport& rep : open.reports) {
    listed += rep.open.size();
    for (const OpenEdge& o : rep.open) BOOST_TEST((o.gap_mm > 1e-5 && o.gap_mm < 4 * jitter), "gap " << o.gap_mm);
  }
  BOOST_TEST(listed >= 24u);  // two of them are cut where another ends on them, and stay open all the same
  for (const Body& b : open.bodies) BOOST_TEST((b.kind == BodyKind::Sheet));
}

BOOST_AUTO_TEST_CASE(the_order_of_the_faces_does_not_matter) {
  std::vector<int> order{0, 1, 2, 3, 4, 5};
  double first = 0;
  for (int k = 0; k < 12; ++k) {
    const SewResult r = sewn(loose_box({}, 2, 3, 4, 1e-4, order), 1e-3);
    BOOST_REQUIRE(r.bodies.size() == 1u);
    BOOST_TEST(r.bodies[0].edges.size() == 12u);
    if (k == 0) first = r.reports[0].max_gap_mm;
    BOOST_TEST(r.reports[0].max_gap_mm == first);
    std::rotate(order.begin(), order.begin() + 1, order.end());
    if (k % 2) std::swap(order[0], order[3]);
  }
}

BOOST_AUTO_TEST_CASE(edges_that_overlap_in_part_are_joined_in_part) {
  // The top is two rectangles: the side walls' edges are cut where the two meet.
  Body body = loose_box({}, 2, 3, 4, 0, {0, 2, 3, 4, 5});
  add_rectangle(body, {0, 0, 4}, {0.5, 0, 0}, {0, 3, 0});
  add_rectangle(body, {0.5, 0, 4}, {1.5, 0, 0}, {0, 3, 0});
  const SewResult r = sewn(std::move(body), 1e-6);
  BOOST_REQUIRE(r.bodies.size() == 1u);
  BOOST_TEST((r.bodies[0].kind == BodyKind::Solid));
  BOOST_TEST(r.reports[0].splits == 2u);
  BOOST_TEST(r.bodies[0].edges.size() == 15u);
  BOOST_TEST(volume(r.bodies[0], ShellId{0})->value == 24, boost::test_tools::tolerance(1e-9));
  check_watertight(r.bodies[0]);
}

BOOST_AUTO_TEST_CASE(a_missing_side_leaves_four_open_edges) {
  const SewResult r = sewn(loose_box({}, 2, 3, 4, 0, {0, 2, 3, 4, 5}), 1e-6);
  BOOST_REQUIRE(r.bodies.size() == 1u);
  BOOST_TEST((r.bodies[0].kind == BodyKind::Sheet));
  BOOST_TEST(r.reports[0].open.size() == 4u);
  for (const OpenEdge& o : r.reports[0].open) BOOST_TEST(o.at.z == 4);
}

BOOST_AUTO_TEST_CASE(equal_ends_do_not_make_edges_equal) {
  // Two half discs of the same chord, one bulging up and one down, and between their arcs nothing.
  Body body;
  for (const double side : {1.0, -1.0}) {
    Circle arc = horizontal_circle({}, 1);
    arc.range = side > 0 ? Interval{0, pi} : Interval{pi, two_pi};
    const double a = side > 0 ? -1 : 1;
    FaceInput in = input(Plane{}, {loop_of(in_space(curve(arc)), in_space(curve(Line{{a, 0, 0}, {-a, 0, 0}})))});
    add_face(body, in);
  }
  const SewResult r = sewn(std::move(body), 1e-3);
  BOOST_TEST(r.reports[0].joined == 1u);
  BOOST_TEST(r.reports[0].open.size() == 2u);
}

BOOST_AUTO_TEST_CASE(circles_that_start_at_different_angles_are_joined) {
  // A cylinder's side and its two caps, whose circles start elsewhere.
  Body body;
  add_face(body, input(Cylinder{{}, 1}, {loop_of(in_space(curve(horizontal_circle({0, 0, 0}, 1)))),
                                         loop_of(in_space(curve(horizontal_circle({0, 0, 2}, 1))))}));
  for (const double z : {0.0, 2.0}) {
    Circle c = horizontal_circle({0, 0, z}, 1);
    c.range = {1.3, 1.3 + two_pi};
    Frame f = frame_at({0, 0, z});
    add_face(body, input(Plane{f}, {loop_of(in_space(curve(c)))}));
  }
  const SewResult r = sewn(std::move(body), 1e-6);
  BOOST_REQUIRE(r.bodies.size() == 1u);
  BOOST_TEST((r.bodies[0].kind == BodyKind::Solid));
  BOOST_TEST(volume(r.bodies[0], ShellId{0})->value == 2 * pi, boost::test_tools::tolerance(1e-7));
  check_watertight(r.bodies[0]);
}

BOOST_AUTO_TEST_CASE(boxes_that_touch_stay_two_solids) {
  Body body = loose_box({}, 1, 1, 1);
  const std::vector<Body> both{std::move(body), loose_box({1, 0, 0}, 1, 1, 1)};
  const SewResult r = sew(both, {1e-6});
  double sum = 0;
  std::size_t solids = 0;
  for (const Body& b : r.bodies) {
    check_sound(b, 1e-6);
    if (b.kind != BodyKind::Solid) continue;
    ++solids;
    sum += volume(b, ShellId{0})->value;
    check_watertight(b);
  }
  BOOST_TEST(solids == 2u);
  BOOST_TEST(sum == 2, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(a_shell_inside_another_that_looks_the_other_way_is_a_void) {
  const auto turned = [](Body b) {
    for (Face& f : b.faces) f.reversed = !f.reversed;
    return b;
  };
  const Body casing = loose_box({0, 0, 0}, 10, 10, 10), hollow = loose_box({1, 1, 1}, 8, 8, 8), ball = loose_box({3, 3, 3}, 2, 2, 2);
  const auto volume_of = [](const SewResult& r) {
    double sum = 0;
    for (const Body& b : r.bodies)
      for (std::uint32_t i = 0; i < b.shells.size(); ++i) sum += volume(b, ShellId{i})->value;
    return sum;
  };
  for (const bool inside_out : {false, true}) {  // which way the outer one looks does not matter, only that they differ
    const auto given = [&](const Body& b, bool other) { return inside_out != other ? turned(b) : b; };
    const SewResult r = sew({given(hollow, true), given(casing, false)}, {1e-6});
    BOOST_REQUIRE(r.bodies.size() == 1u);
    BOOST_REQUIRE(r.bodies[0].shells.size() == 2u);
    BOOST_TEST(!r.bodies[0].shells[0].is_void);
    BOOST_TEST(r.bodies[0].shells[1].is_void);
    BOOST_TEST(r.reports[0].voids == 1u);
    BOOST_TEST(r.reports[0].joined == 24u);
    BOOST_TEST(volume_of(r) == 1000 - 512, boost::test_tools::tolerance(1e-9));
    check_sound(r.bodies[0], 1e-6);
    check_watertight(r.bodies[0]);
    const SewResult three = sew({given(ball, false), given(hollow, true), given(casing, false)}, {1e-6});
    BOOST_TEST(three.bodies.size() == 2u);
    BOOST_TEST(volume_of(three) == 1000 - 512 + 8, boost::test_tools::tolerance(1e-9));
  }
  const SewResult same = sew({hollow, casing}, {1e-6});
  BOOST_TEST(same.bodies.size() == 2u);
  BOOST_TEST(volume_of(same) == 1512, boost::test_tools::tolerance(1e-9));
  const SewResult beside = sew({turned(loose_box({20, 0, 0}, 8, 8, 8)), casing}, {1e-6});
  BOOST_TEST(beside.bodies.size() == 2u);
}

BOOST_AUTO_TEST_CASE(sewing_ends_when_it_is_told_to) {
  std::stop_source source;
  source.request_stop();
  SewOptions options;
  options.stop = source.get_token();
  const SewResult r = sew({loose_box({0, 0, 0}, 1, 1, 1)}, options);
  BOOST_TEST(r.stopped);
  BOOST_TEST(r.bodies.empty());
}

BOOST_AUTO_TEST_CASE(an_edge_below_the_tolerance_becomes_a_pole) {
  // A rectangle with one corner cut off by 1e-5.
  Body body = loose_box({}, 2, 3, 4, 0, {0, 2, 3, 4, 5});
  Frame top = frame_at({0, 0, 4});
  const double cut = 1e-5;
  FaceInput in = input(Plane{top}, {polygon({{cut, 0}, {2, 0}, {2, 3}, {0, 3}, {0, cut}})});
  in.tolerance_mm = 1e-7;
  add_face(body, in);
  const SewResult r = sewn(std::move(body), 1e-3);
  BOOST_REQUIRE(r.bodies.size() == 1u);
  BOOST_TEST((r.bodies[0].kind == BodyKind::Solid));
  BOOST_TEST(r.reports[0].collapsed == 1u);
  check_watertight(r.bodies[0]);
}

BOOST_AUTO_TEST_CASE(two_thousand_tiles_take_little_time) {
  Body body;
  constexpr int n = 45;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) add_rectangle(body, {double(i), double(j), 0}, {1, 0, 0}, {0, 1, 0});
  const SewResult r = sewn(std::move(body), 1e-6);
  BOOST_REQUIRE(r.bodies.size() == 1u);
  BOOST_TEST(r.reports[0].joined == 2u * n * (n - 1));
  BOOST_TEST(r.reports[0].open.size() == 4u * n);
}

BOOST_AUTO_TEST_SUITE_END()
