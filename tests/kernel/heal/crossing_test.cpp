// Loops that cross or touch themselves, what is remembered of a repair, and which repairs may be forbidden.

#include "kernel/heal/crossings.h"
#include "tests/kernel/heal/helpers.h"

using namespace trimloop;
using namespace trimloop::heal;
using namespace trimloop::heal::test;

namespace {

Curve2 arc2(Uv centre, double radius, double from, double to) {
  return Curve2{Curve{Circle{frame_at({centre.u, centre.v, 0}), radius, {from, to}}}};
}

TrimLoop polyline_loop(std::vector<Uv> corners) {
  corners.push_back(corners.front());
  return loop_of(drawn(make_polyline2(corners)));
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_bow_tie_is_two_triangles) {
  const Made m = make(input(Plane{}, {polygon({{0, 0}, {2, 2}, {2, 0}, {0, 2}})}));
  check_area(m, 2);
  BOOST_TEST((m.face().status == FaceStatus::Healed));
  BOOST_TEST(m.face().loops.size() == 2u);
  const StepRecord& s = m.first(Step::LoopSplit);
  BOOST_TEST(distance(s.at, {1, 1, 0}) < 1e-12);
  BOOST_TEST(s.before_mm == std::sqrt(5), boost::test_tools::tolerance(1e-12));  // 1 x 2
  BOOST_TEST(m.count(Step::LoopReoriented) == 0);  // one of the parts runs the other way round by itself
}

BOOST_AUTO_TEST_CASE(a_bow_tie_drawn_as_one_polyline_is_the_same) {
  check_area(make(input(Plane{}, {polyline_loop({{0, 0}, {2, 2}, {2, 0}, {0, 2}})})), 2);
}

BOOST_AUTO_TEST_CASE(a_crossing_at_corners_counts_once) {
  for (const std::vector<Uv>& corners : {std::vector<Uv>{{0, 0}, {1, 1}, {2, 2}, {2, 0}, {1, 1}, {0, 2}},
                                         std::vector<Uv>{{0, 0}, {1, 1}, {2, 2}, {2, 0}, {0, 2}}}) {
    for (const TrimLoop& loop : {polygon(corners), polyline_loop(corners)}) {
      const Made m = make(input(Plane{}, {loop}));
      check_area(m, 2);
      BOOST_TEST(m.count(Step::LoopSplit) == 1);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_line_that_crosses_an_arc) {
  // Three quarters of the unit circle, up the y axis over its top to (0, 2), round to its start: half a disk and 3 - pi/4.
  const Made m = make(input(Plane{}, {loop_of(drawn(arc2({0, 0}, 1, 0, 1.5 * pi)), drawn({0, -1}, {0, 2}), drawn({0, 2}, {2, 2}),
                                              drawn({2, 2}, {1, 0}))}));
  check_area(m, pi / 2 + 3 - pi / 4, 1e-9);
  BOOST_TEST(distance(m.first(Step::LoopSplit).at, {0, 1, 0}) < 1e-9);
}

BOOST_AUTO_TEST_CASE(what_is_gone_round_twice_is_outside) {
  // The pentagram: its tips are inside once, its middle twice.
  std::vector<Uv> star;
  for (int i = 0; i < 5; ++i) star.push_back({std::cos(i * 0.8 * pi), std::sin(i * 0.8 * pi)});
  const double golden = (1 + std::sqrt(5)) / 2, r = 1 / (golden * golden);
  const double outline = 5 * r * std::sin(pi / 5), middle = 2.5 * r * r * std::sin(0.4 * pi);
  const Made m = make(input(Plane{}, {polygon(star)}));
  check_area(m, outline - middle, 1e-9);
  BOOST_TEST(m.count(Step::LoopSplit) > 0);
}

BOOST_AUTO_TEST_CASE(circles_that_touch_in_a_loop_of_no_area) {
  // A figure of eight whose strands only touch where they meet.
  const Made m = make(input(Plane{}, {loop_of(drawn(arc2({-1, 0}, 1, 0, two_pi)), [] {
    TrimSegment s = drawn(arc2({1, 0}, 1, pi, 3 * pi));
    s.pcurve_reversed = true;
    return s;
  }())}));
  check_area(m, 2 * pi, 1e-9);
}

BOOST_AUTO_TEST_CASE(touching_without_crossing_stays_one_loop) {
  const Made m = make(input(Plane{}, {polygon({{0, 0}, {2, 0}, {1, 1}, {2, 2}, {0, 2}, {1, 1}})}));
  check_ok(m);
  check_area(m, 2);
  // A bridge to a hole, there and back.
  const Made key = make(input(Plane{}, {polygon({{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 3}, {3, 6}, {6, 6}, {6, 3}, {3, 3}})}));
  check_ok(key);
  check_area(key, 81 - 9);
}

BOOST_AUTO_TEST_CASE(crossings_below_the_tolerance_are_left_alone) {
  const Made m = make(input(Plane{}, {polygon({{0, 0}, {2, 0}, {2, 3}, {-2e-4, 3}, {0, 3.0002}, {0, 2.9998}, {-1e-4, 3}, {-1e-4, 0}})}));
  check_ok(m);
  check_area(m, 6, 1e-3);
}

BOOST_AUTO_TEST_CASE(a_crossing_on_a_sphere) {
  // Two triangles in longitude and latitude. An element there has the area r^2 cos(lat) dlon dlat:

  const double r = 2;
  const Made m = make(input(Sphere{Frame{}, r}, {polygon({{0, -1}, {1, 1}, {1, -1}, {0, 1}})}));
  // |lat| <= 1 - 2 lon up to the middle, and its mirror image: 2 * 2 r^2 int_0^1/2 sin(1 - 2 x) dx = 2 r^2 (1 - cos 1).
  check_area(m, 2 * r * r * (1 - std::cos(1.0)), 1e-9);
}

BOOST_AUTO_TEST_CASE(too_many_crossings_fail_with_a_place) {
  std::vector<Uv> corners{{0, 0}};
  for (int i = 0; i < 400; ++i) corners.push_back({double(i), i % 2 ? 1.0 : -1.0});
  corners.push_back({400, 0});
  const Made m = make(input(Plane{}, {polyline_loop(corners)}));
  BOOST_TEST((m.face().status == FaceStatus::Failed));
  BOOST_TEST(m.face().reason.find("crosses itself at more than 256 places") != std::string::npos, m.face().reason);
}

BOOST_AUTO_TEST_CASE(the_search_is_near_linear_and_bounded) {
  const auto searched = [](std::vector<Uv> corners) {
    corners.push_back(corners.front());
    Ring ring;
    Piece p;
    p.pcurve = make_polyline2(corners);
    p.t1 = range(p.pcurve).hi;
    BOOST_REQUIRE(take_samples(p));
    ring.pieces.push_back(p);
    const Surface plane{Plane{}};
    return self_crossings(Sheet(plane, 1e-3), ring, 1e-3);
  };
  const std::size_t n = 100'000;
  std::vector<Uv> round, comb;
  for (std::size_t i = 0; i < n; ++i) {
    round.push_back({std::cos(two_pi * double(i) / double(n)), std::sin(two_pi * double(i) / double(n))});
    comb.push_back({double(i), i % 2 ? 1e6 + double(i) : double(i)});  // slanting teeth: their boxes all meet
  }
  comb.push_back({double(n), -10});
  const Crossings a = searched(round), b = searched(comb);
  BOOST_TEST(a.found.empty());
  BOOST_TEST(a.complete);
  BOOST_TEST(a.tests < 64 * n);
  BOOST_TEST(b.tests <= most_tests(n + 1) + 1);
}

BOOST_AUTO_TEST_CASE(a_forbidden_step_fails_the_face_and_says_which) {
  TrimLoop loop = polygon({{0, 0}, {2, 0}, {2, 3}, {0, 3}});
  loop.segments[1] = drawn({2, 0.13}, {2, 3});
  FaceInput in = input(Plane{}, {loop});
  in.forbidden = StepSet{}.with(Step::GapClosed);
  const Made m = make(in);
  BOOST_TEST((m.face().status == FaceStatus::Failed));
  BOOST_TEST(m.face().reason == "gap of 0.13 mm closed in loop 1, segment 1: needed, but not allowed");
  in.forbidden = StepSet{}.with(Step::LoopSplit);
  check_area(make(in), 6);  // not needed
  in.loops = {polygon({{0, 0}, {2, 2}, {2, 0}, {0, 2}})};
  BOOST_TEST((make(in).face().status == FaceStatus::Failed));
}

BOOST_AUTO_TEST_CASE(a_repair_can_be_taken_back) {
  // What is remembered gives the same face again, and with the step forbidden the refusal; the curves given are untouched.
  FaceInput in = input(Plane{}, {loop_of(drawn(arc2({0, 0}, 1, 0, two_pi), curve(horizontal_circle({0, 0, 0}, 1.5))))});
  in.loops[0].trust = Trust::Model;
  const Made m = make(in);
  check_area(m, 2.25 * pi, 1e-6);
  BOOST_TEST(m.first(Step::PcurveReplaced).before_mm == 0.5, boost::test_tools::tolerance(1e-6));
  BOOST_REQUIRE(m.face().repair);
  const Repair& repair = *m.face().repair;
  BOOST_TEST(repair.steps.size() == m.outcome.steps.size());
  BOOST_TEST(distance(evaluate(repair.loops[0].segments[0].pcurve->curve, 0.5), {std::cos(0.5), std::sin(0.5), 0}) == 0);
  FaceInput again = in;
  again.loops = repair.loops;
  BOOST_TEST(make(again).area() == m.area());
  again.loops[0].segments[0].curve = nullptr;  // the other choice
  check_area(make(again), pi, 1e-9);
  again.loops = repair.loops;
  again.forbidden = StepSet{}.with(Step::PcurveReplaced);
  BOOST_TEST((make(again).face().status == FaceStatus::Failed));
}

BOOST_AUTO_TEST_CASE(ten_thousand_holes_are_placed) {
  FaceInput in = input(Plane{}, {polygon({{0, 0}, {300, 0}, {300, 300}, {0, 300}})});
  for (int i = 0; i < 100; ++i)
    for (int k = 0; k < 100; ++k) in.loops.push_back(loop_of(drawn(circle2({3.0 * i + 1.5, 3.0 * k + 1.5}, 1))));
  const Made m = make(in);
  BOOST_TEST(m.face().loops.size() == 10'001u);
  double sum = 0;
  for (const LoopId l : m.face().loops) sum += double(m.body[l].coedges.size());
  BOOST_TEST(sum == 10'004);
  const Measured area = trimloop::area(m.body, m.outcome.face);
  BOOST_TEST(std::abs(area.value - (90'000 - 10'000 * pi)) <= area.error + 1e-7 * area.value, area.value << " +- " << area.error);
}
