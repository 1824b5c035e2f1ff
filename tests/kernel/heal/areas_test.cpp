// What each repair of a trimming loop changes, in numbers: the area before and after, and the step with its measure.

#include "tests/kernel/heal/helpers.h"

using namespace trimloop;
using namespace trimloop::heal;
using namespace trimloop::heal::test;

namespace {

const auto nearly = boost::test_tools::tolerance(1e-6);
const std::vector<Uv> rectangle{{0, 0}, {2, 0}, {2, 3}, {0, 3}};

// The rectangle by both copies.
TrimLoop both_copies() {
  TrimLoop loop;
  for (std::size_t i = 0; i < 4; ++i) {
    const Uv a = rectangle[i], b = rectangle[(i + 1) % 4];
    loop.segments.push_back(drawn(make_line2(a, b), curve(Line{{a.u, a.v, 0}, {b.u, b.v, 0}})));
  }
  return loop;
}

Made measured(FaceInput in) {
  in.measure_areas = true;
  return make(std::move(in));
}

void check_areas(const Made& m, double before, double after) {
  BOOST_TEST((m.face().status == FaceStatus::Healed));
  BOOST_TEST(m.face().area_before_mm2 == before, nearly);
  BOOST_TEST(m.outcome.area_after_mm2 == after, nearly);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(areas_before_and_after)

BOOST_AUTO_TEST_CASE(a_replaced_parameter_curve_gives_the_area_it_bounded) {
  TrimLoop loop = both_copies();
  loop.segments[1].pcurve = make_line2({2.5, 0}, {2.5, 3});
  check_areas(measured(input(Plane{}, {loop})), 7.5, 6);
}

BOOST_AUTO_TEST_CASE(a_dropped_model_curve_gives_the_area_it_bounded) {
  TrimLoop loop = both_copies();
  loop.segments[1].curve = curve(Line{{2.5, 0, 0}, {2.5, 3, 0}});
  check_areas(measured(input(Plane{}, {loop})), 7.5, 6);
}

BOOST_AUTO_TEST_CASE(a_gap_is_bridged_by_the_shortest_step_in_both) {
  const Made m = measured(input(Plane{}, {loop_of(drawn({0, 0}, {2, 0}), drawn({2, 0.5}, {2, 3}), drawn({2, 3}, {0, 3}),
                                                  drawn({0, 3}, {0, 0}))}));
  check_areas(m, 6, 6);
  BOOST_TEST(m.first(Step::GapClosed).before_mm == 0.5, nearly);
}

BOOST_AUTO_TEST_CASE(a_turned_segment_changes_no_area) {
  TrimLoop loop = polygon(rectangle);
  loop.segments[1].pcurve_reversed = true;
  check_areas(measured(input(Plane{}, {loop})), 6, 6);
}

BOOST_AUTO_TEST_CASE(a_repeated_segment_changes_no_area) {
  TrimLoop loop = polygon(rectangle);
  loop.segments.insert(loop.segments.begin() + 2, loop.segments[1]);
  const Made m = measured(input(Plane{}, {loop}));
  BOOST_TEST(m.count(Step::DuplicateRemoved) == 1);
  check_area(m, 6);
}

BOOST_AUTO_TEST_CASE(a_loop_that_touches_itself_keeps_its_area) {
  // Two squares of area 1 that share the corner (1, 1).
  const Made m = measured(input(Plane{}, {polygon({{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 1}, {0, 1}})}));
  check_area(m, 2);
}

BOOST_AUTO_TEST_CASE(a_loop_outside_the_surface_is_held_at_its_border) {
  const Made m = measured(input(nurbs_cylinder(2), {polygon({{0.1, 1}, {0.4, 1}, {0.4, 2.5}, {0.1, 2.5}})}));
  BOOST_TEST(m.first(Step::Clamped).before_mm == 0.5, nearly);
  BOOST_TEST(m.face().area_before_mm2 == m.outcome.area_after_mm2, nearly);  // there is no surface beyond
}

BOOST_AUTO_TEST_CASE(where_the_parameter_curves_bound_nothing_the_model_curves_do) {
  TrimLoop loop = both_copies();
  // Parameter curves at one place, far from the model curves.
  for (TrimSegment& s : loop.segments) s.pcurve = make_line2({50, 50}, {50.001, 50.001});
  const Made m = measured(input(Plane{}, {loop}));
  check_area(m, 6);
  BOOST_TEST(m.count(Step::PcurveReplaced) == 4);
  BOOST_TEST(m.face().area_before_mm2 < 0);
  BOOST_TEST(m.face().reason.find("area before cannot be said") != std::string::npos, m.face().reason);
}

BOOST_AUTO_TEST_CASE(the_projection_of_a_curve_off_its_surface_is_followed) {
  // A wavy circle up to 0.05 off a cylinder of radius 10: what bounds the face is its radial projection.
  constexpr int n = 400;
  std::vector<Point> points;
  std::vector<Uv> foot;
  for (int i = 0; i <= n; ++i) {
    const double t = two_pi * i / n, r = 10 + 0.05 * std::cos(7 * t), u = 0.3 * std::cos(t), z = 3 * std::sin(t);
    points.push_back({r * std::cos(u), r * std::sin(u), z});
    foot.push_back({u, z});
  }
  double expected = 0;  // of the polygon of the projected points; chords bulge outward by a little in between
  for (int i = 0; i < n; ++i) expected += 0.5 * 10 * cross(foot[i], foot[i + 1]);
  const Made m = measured(input(Cylinder{{}, 10}, {loop_of(in_space(curve(Polyline{points})))}));
  BOOST_TEST(m.area() == expected, boost::test_tools::tolerance(2e-6));
}

BOOST_AUTO_TEST_SUITE_END()
