// Loops whose ends meet in space and not in parameters: singular sides and pieces that go round by themselves; loops that
// leave nothing between them.

#include "tests/kernel/heal/helpers.h"

namespace trimloop::heal::test {

BOOST_AUTO_TEST_SUITE(closing)

namespace {

NurbsCurve parabola(Point a, Point b, Point c) { return *NurbsCurve::from_cartesian(2, {0, 0, 0, 1, 1, 1}, std::vector<Point>{a, b, c}, {}); }

}  // namespace

BOOST_AUTO_TEST_CASE(from_one_singular_side_to_the_other_round_their_corner) {
  // A biquadratic patch in the plane whose sides u = 0 and v = 0 are the origin. Its other two sides are parabolas from the
  // origin to (1, 0): two segments of area 1/6 each.
  const Point o{0, 0, 0};
  const std::vector<Point> net{o, o, o, o, {0.25, 0, 0}, {0.5, -0.5, 0}, o, {0.5, 0.5, 0}, {1, 0, 0}};
  const auto patch = NurbsSurface::from_cartesian(2, 2, {0, 0, 0, 1, 1, 1}, {0, 0, 0, 1, 1, 1}, net, {});
  BOOST_REQUIRE(patch.has_value());
  const CurvePtr up = curve(parabola(o, {0.5, 0.5, 0}, {1, 0, 0})), down = curve(parabola(o, {0.5, -0.5, 0}, {1, 0, 0}));
  for (const bool turned : {false, true}) {
    TrimLoop loop = loop_of(in_space(up), in_space(down));
    loop.segments[turned ? 0 : 1].curve_reversed = true;
    const Made m = make(input(*patch, {loop}));
    check_area(m, 1.0 / 3, 1e-6);
    BOOST_TEST(m.count(Step::GapClosed) == 0);
    BOOST_TEST(m.count(Step::PoleInserted) == 1);
    BOOST_TEST(m.coedges() == 4u);
  }
}

BOOST_AUTO_TEST_CASE(a_circle_that_makes_its_loop_wind_twice_is_turned) {
  // A band of a cylinder by one loop: round below, up, round above, down. Both circles are given the same way round.
  const auto circle = [](double z) { return in_space(curve(horizontal_circle({0, 0, z}, 2))); };
  const CurvePtr seam = curve(Line{{2, 0, 0}, {2, 0, 3}});
  TrimSegment down = in_space(seam);
  down.curve_reversed = true;
  const Made m = make(input(Cylinder{{}, 2}, {loop_of(circle(0), in_space(seam), circle(3), down)}));
  BOOST_TEST((m.face().status == FaceStatus::Healed));
  BOOST_TEST(m.count(Step::SegmentReversed) == 1);
  check_area(m, 2 * pi * 2 * 3);
}

BOOST_AUTO_TEST_CASE(a_lune_and_the_rest_of_the_sphere_are_one_ring_each) {
  // Up the meridian 0 and down the meridian 1 encloses what is left of it: all but one radian. The other way round, that one.
  const auto meridian = [](double angle) {
    Circle c;
    c.frame.x = {std::cos(angle), std::sin(angle), 0};
    c.frame.y = {0, 0, 1};
    c.frame.z = cross(c.frame.x, c.frame.y);
    c.radius = 2;
    c.range = {-pi / 2, pi / 2};
    return curve(c);
  };
  for (const double width : {1.0, 3.0, 5.0}) {
    TrimLoop loop = loop_of(in_space(meridian(0)), in_space(meridian(width)));
    loop.segments[1].curve_reversed = true;
    for (const bool turned : {false, true}) {
      FaceInput in = input(Sphere{{}, 2}, {loop});
      if (turned) turn(in.loops[0]);
      in.brep_sense = true;
      const Made m = make(in);
      check_ok(m);
      check_area(m, 8 * (turned ? width : two_pi - width), 1e-7);
      BOOST_TEST(m.face().loops.size() == 1u);
      BOOST_TEST(m.coedges() == 4u);
    }
  }
}

BOOST_AUTO_TEST_CASE(two_borders_in_one_place_leave_nothing_between_them) {
  const auto circle = [] { return in_space(curve(horizontal_circle({0, 0, 1}, 2))); };
  const Made m = make(input(Cylinder{{}, 2}, {loop_of(circle()), loop_of(circle())}));
  BOOST_TEST((m.face().status == FaceStatus::Failed));
  BOOST_TEST(m.outcome.bounds_nothing);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace trimloop::heal::test
