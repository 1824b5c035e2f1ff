#include "tests/kernel/heal/helpers.h"

using namespace trimloop;
using namespace trimloop::heal;
using namespace trimloop::heal::test;

BOOST_AUTO_TEST_CASE(a_square_on_a_plane_is_taken_as_it_is) {
  const Made m = make(input(Plane{}, {polygon({{0, 0}, {2, 0}, {2, 3}, {0, 3}})}));
  check_ok(m);
  check_area(m, 6);
  BOOST_TEST(m.outcome.steps.empty());
  BOOST_TEST(m.body.vertices.size() == 4u);
}

BOOST_AUTO_TEST_CASE(a_clockwise_outer_loop_is_turned_around) {
  const Made m = make(input(Plane{}, {polygon({{0, 0}, {0, 3}, {2, 3}, {2, 0}})}));
  check_ok(m);
  check_area(m, 6);
  BOOST_TEST(m.count(Step::LoopReoriented) == 1);
}

BOOST_AUTO_TEST_CASE(a_hole_given_before_the_outer_loop_is_a_hole) {
  TrimLoop hole = loop_of(drawn(circle2({5, 5}, 2)));
  hole.claimed_outer = true;
  const Made m = make(input(Plane{}, {hole, polygon({{0, 0}, {10, 0}, {10, 10}, {0, 10}})}));
  check_ok(m);
  check_area(m, 100 - 4 * pi);
  BOOST_TEST(m.body[m.face().loops[0]].coedges.size() == 4u);  // outer first
  BOOST_TEST(m.count(Step::LoopReoriented) == 1);              // the hole ran counter-clockwise
}

BOOST_AUTO_TEST_CASE(an_island_in_a_hole_is_outside_again) {
  const Made m = make(input(Plane{}, {loop_of(drawn(circle2({5, 5}, 1))), loop_of(drawn(circle2({5, 5}, 2))),
                                      polygon({{0, 0}, {10, 0}, {10, 10}, {0, 10}})}));
  check_area(m, 100 - 4 * pi + pi);
}

BOOST_AUTO_TEST_CASE(segments_that_run_backwards_are_turned) {
  TrimLoop loop = polygon({{0, 0}, {2, 0}, {2, 3}, {0, 3}});
  loop.segments[1].pcurve_reversed = true;
  loop.segments[2].pcurve_reversed = true;
  const Made m = make(input(Plane{}, {loop}));
  check_area(m, 6);
  BOOST_TEST(m.count(Step::SegmentReversed) == 2);
  BOOST_TEST((m.face().status == FaceStatus::Healed));
}

BOOST_AUTO_TEST_CASE(segments_out_of_order_are_chained) {
  TrimLoop loop = polygon({{0, 0}, {2, 0}, {2, 3}, {1, 4}, {0, 3}});
  std::swap(loop.segments[1], loop.segments[3]);
  const Made m = make(input(Plane{}, {loop}));
  check_area(m, 7);
  BOOST_TEST(m.count(Step::SegmentsReordered) == 1);
}

BOOST_AUTO_TEST_CASE(a_repeated_segment_is_left_out) {
  TrimLoop loop = polygon({{0, 0}, {2, 0}, {2, 3}, {0, 3}});
  loop.segments.push_back(loop.segments[1]);
  const Made m = make(input(Plane{}, {loop}));
  check_area(m, 6);
  BOOST_TEST(m.count(Step::DuplicateRemoved) == 1);
  BOOST_TEST(m.coedges() == 4u);
}

BOOST_AUTO_TEST_CASE(a_gap_is_closed_and_measured) {
  TrimLoop loop = polygon({{0, 0}, {2, 0}, {2, 3}, {0, 3}});
  loop.segments[1] = drawn({2, 0.13}, {2, 3});
  const Made m = make(input(Plane{}, {loop}));
  check_area(m, 6);
  BOOST_TEST(m.first(Step::GapClosed).before_mm == 0.13, boost::test_tools::tolerance(1e-9));
  BOOST_TEST((m.face().status == FaceStatus::Healed));
  BOOST_TEST(m.face().reason == "gap of 0.13 mm closed in loop 1, segment 1");
  BOOST_TEST(m.coedges() == 5u);
}

BOOST_AUTO_TEST_CASE(a_gap_below_the_tolerance_is_no_finding) {
  TrimLoop loop = polygon({{0, 0}, {2, 0}, {2, 3}, {0, 3}});
  loop.segments[1] = drawn({2, 0.0004}, {2, 3});
  const Made m = make(input(Plane{}, {loop}));
  check_ok(m);
  check_area(m, 6, 1e-7);
  BOOST_TEST(m.coedges() == 4u);
}

BOOST_AUTO_TEST_CASE(a_loop_there_and_back_is_dropped) {
  const Made m = make(input(Plane{}, {polygon({{0, 0}, {10, 0}, {10, 10}, {0, 10}}),
                                      loop_of(drawn({1, 1}, {5, 5}), drawn({5, 5}, {1, 1}))}));
  check_area(m, 100);
  BOOST_TEST(m.count(Step::LoopDropped) == 1);
  const Made alone = make(input(Plane{}, {loop_of(drawn({1, 1}, {5, 5}), drawn({5, 5}, {1, 1}))}));
  BOOST_TEST((alone.face().status == FaceStatus::Failed));
  BOOST_TEST(!alone.face().reason.empty());
}

BOOST_AUTO_TEST_CASE(curves_in_space_get_exact_pcurves_on_a_plane) {
  Frame tilted = make_frame({3, 2, 1}, {1, 1, 1}, {1, -1, 0});
  Circle circle;
  circle.frame = tilted;
  circle.radius = 2;
  Circle moved = circle;
  moved.frame.origin = tilted.origin + 0.5 * tilted.x;
  const Made m = make(input(Plane{tilted}, {loop_of(in_space(curve(moved)))}));
  check_ok(m);
  check_area(m, 4 * pi, 1e-9);
  BOOST_TEST(m.first(Step::PcurveFitted).after_mm < 1e-12);
  BOOST_TEST(m.body.edges[0].curve != nullptr);
}

BOOST_AUTO_TEST_CASE(a_curve_off_its_plane_is_projected_and_said) {
  const Made m = make(input(Plane{}, {loop_of(in_space(curve(horizontal_circle({0, 0, 0.25}, 2))))}));
  check_area(m, 4 * pi, 1e-9);
  BOOST_TEST((m.face().status == FaceStatus::Healed));
  BOOST_TEST(m.first(Step::PcurveFitted).after_mm == 0.25, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(a_circle_projected_across_the_seam_of_a_cylinder_is_a_hole_free_patch) {
  // The part of the cylinder x^2 + y^2 = 4 within distance 1 of the x axis, seen along x: y^2 + z^2 = 1, x > 0.
  const double r = 2;
  std::vector<Point> points;
  constexpr int n = 400;
  for (int i = 0; i <= n; ++i) {
    const double t = two_pi * i / n, y = std::cos(t), z = std::sin(t);
    points.push_back({std::sqrt(r * r - y * y), i == n ? std::cos(0.0) : y, i == n ? 0 : z});
  }
  const Made m = make(input(Cylinder{{}, r}, {loop_of(in_space(curve(Polyline{points})))}));
  // Area: integral over z of r * 2 asin(y / r).
  double expected = 0;
  constexpr int k = 200000;
  for (int i = 0; i < k; ++i) {
    const double z = -1 + 2 * (i + 0.5) / k;
    expected += r * 2 * std::asin(std::sqrt(1 - z * z) / r) * 2 / k;
  }
  check_area(m, expected, 2e-4);  // the polyline is that coarse
  BOOST_TEST(m.face().loops.size() == 1u);
}

BOOST_AUTO_TEST_CASE(a_circle_in_space_bounds_the_cap_of_a_sphere) {
  const double r = 3, z = 1;
  const Made m = make(input(Sphere{{}, r}, {loop_of(in_space(curve(horizontal_circle({0, 0, z}, std::sqrt(r * r - z * z)))))}));
  check_ok(m);
  check_area(m, 2 * pi * r * (r - z), 1e-9);
  BOOST_TEST(m.count(Step::SeamInserted) == 1);
  BOOST_TEST(m.count(Step::PoleInserted) == 1);
  FaceInput other = input(Sphere{{}, r}, {loop_of(in_space(curve(horizontal_circle({0, 0, z}, std::sqrt(r * r - z * z)))))});
  other.loops[0].segments[0].curve_reversed = true;  // the other side is on its left
  check_area(make(other), 2 * pi * r * (r + z), 1e-9);
}

BOOST_AUTO_TEST_CASE(a_circle_on_a_cone_bounds_the_side_with_the_apex) {
  for (const bool reversed : {false, true}) {
    FaceInput in = input(Cone{{}, 3, -std::atan2(3.0, 4.0)}, {loop_of(in_space(curve(horizontal_circle({0, 0, 0}, 3))))});
    in.loops[0].segments[0].curve_reversed = reversed;
    const Made m = make(in);
    check_ok(m);
    check_area(m, pi * 3 * 5, 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(two_winding_loops_bound_the_band_between_them) {
  for (const int turned : {0, 1, 2, 3}) {
    FaceInput in = input(Cylinder{{}, 2}, {loop_of(in_space(curve(horizontal_circle({0, 0, 1}, 2)))),
                                           loop_of(in_space(curve(horizontal_circle({0, 0, 4}, 2))))});
    in.loops[0].segments[0].curve_reversed = turned & 1;
    in.loops[1].segments[0].curve_reversed = turned & 2;
    const Made m = make(in);
    check_ok(m);
    check_area(m, 2 * pi * 2 * 3, 1e-9);
    BOOST_TEST(m.count(Step::SeamInserted) == 1);
    BOOST_TEST(m.face().loops.size() == 1u);
    BOOST_TEST(m.coedges() == 4u);
  }
}

BOOST_AUTO_TEST_CASE(a_band_between_circles_that_start_at_different_angles_is_cut_too) {
  Circle upper = horizontal_circle({0, 0, 4}, 2);
  upper.range = {1, 1 + two_pi};
  const Made m = make(input(Cylinder{{}, 2}, {loop_of(in_space(curve(horizontal_circle({0, 0, 1}, 2)))),
                                              loop_of(in_space(curve(upper)))}));
  check_ok(m);
  check_area(m, 2 * pi * 2 * 3, 1e-9);
}

BOOST_AUTO_TEST_CASE(holes_stay_holes_when_a_band_is_cut) {
  TrimLoop hole = polygon({{-0.2, 2}, {0.2, 2}, {0.2, 3}, {-0.2, 3}});  // over the angle where both circles start
  const Made m = make(input(Cylinder{{}, 2}, {loop_of(drawn({0, 1}, {two_pi, 1})), hole, loop_of(drawn({0, 4}, {two_pi, 4}))}));
  check_ok(m);
  check_area(m, 2 * pi * 2 * 3 - 2 * 0.4 * 1, 1e-9);
}

BOOST_AUTO_TEST_CASE(a_pcurve_shifted_by_a_period_is_brought_back) {
  TrimLoop loop = polygon({{6, 0}, {7, 0}, {7, 1}, {6, 1}});
  loop.segments[1] = drawn({7 - two_pi, 0}, {7 - two_pi, 1});
  loop.segments[2] = drawn({7 + two_pi, 1}, {6 + two_pi, 1});
  const Made m = make(input(Cylinder{{}, 2}, {loop}));
  check_ok(m);
  check_area(m, 2, 1e-9);
}

BOOST_AUTO_TEST_CASE(a_hole_in_another_turn_lies_in_its_face) {
  TrimLoop hole = polygon({{6.2 - two_pi, 0.2}, {6.8 - two_pi, 0.2}, {6.8 - two_pi, 0.8}, {6.2 - two_pi, 0.8}});
  const Made m = make(input(Cylinder{{}, 2}, {polygon({{6, 0}, {7, 0}, {7, 1}, {6, 1}}), hole}));
  check_ok(m);
  check_area(m, 2 * (1 - 0.36), 1e-9);
}

BOOST_AUTO_TEST_CASE(a_loop_over_the_seam_of_a_closed_nurbs_surface_is_cut_there) {
  // u runs from 0.875 over the seam to 1.125.
  const Made m = make(input(nurbs_cylinder(4), {polygon({{0.875, 1}, {1.125, 1}, {1.125, 3}, {0.875, 3}})}));
  check_ok(m);
  BOOST_TEST(m.count(Step::SeamInserted) == 1);
  BOOST_TEST(m.face().loops.size() == 2u);
  check_area(m, 0.5 * pi * 2, 1e-9);  // the middle of each quarter's parameter is the middle of its angle
  const Made jumping = make(input(nurbs_cylinder(4), {loop_of(drawn({0.875, 1}, {1, 1}), drawn({0, 1}, {0.125, 1}),
                                                              drawn({0.125, 1}, {0.125, 3}), drawn({0.125, 3}, {0, 3}),
                                                              drawn({1, 3}, {0.875, 3}), drawn({0.875, 3}, {0.875, 1}))}));
  check_ok(jumping);
  check_area(jumping, m.area(), 1e-9);
  const Made inner = make(input(nurbs_cylinder(4), {polygon({{0.375, 1}, {0.625, 1}, {0.625, 3}, {0.375, 3}})}));
  check_area(m, inner.area(), 1e-9);  // the same patch, half a turn away
}

BOOST_AUTO_TEST_CASE(two_winding_loops_on_a_closed_nurbs_surface_are_joined_at_its_seam) {
  const Made m = make(input(nurbs_cylinder(4), {loop_of(in_space(curve(horizontal_circle({0, 0, 1}, 1)))),
                                                loop_of(in_space(curve(horizontal_circle({0, 0, 3}, 1))))}));
  check_ok(m);
  check_area(m, 2 * pi * 2, 1e-6);
  for (const LoopId l : m.face().loops)
    for (const Coedge& c : m.body[l].coedges) {
      const Uv a = start_uv(m.body, c);
      BOOST_TEST(a.u >= -1e-9);
      BOOST_TEST(a.u <= 1 + 1e-9);
    }
}

BOOST_AUTO_TEST_CASE(the_trusted_parameter_curve_wins) {
  TrimLoop loop = polygon({{0, 0}, {2, 0}, {2, 3}, {0, 3}});
  loop.trust = Trust::Parameter;
  loop.segments[1].curve = curve(Line{{2.5, 0, 0}, {2.5, 3, 0}});
  const Made m = make(input(Plane{}, {loop}));
  check_area(m, 6);
  BOOST_TEST(m.first(Step::CurveDropped).before_mm == 0.5, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(the_trusted_model_curve_wins) {
  TrimLoop loop;
  const std::vector<Uv> corners{{0, 0}, {2, 0}, {2, 3}, {0, 3}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Uv a = corners[i], b = corners[(i + 1) % 4];
    loop.segments.push_back(drawn(make_line2(a, b), curve(Line{{a.u, a.v, 0}, {b.u, b.v, 0}})));
  }
  loop.segments[1].pcurve = make_line2({2.5, 0}, {2.5, 3});
  loop.trust = Trust::Model;
  const Made m = make(input(Plane{}, {loop}));
  check_area(m, 6);
  BOOST_TEST(m.first(Step::PcurveReplaced).before_mm == 0.5, boost::test_tools::tolerance(1e-9));
  loop.trust = Trust::Either;  // the neighbours agree with the model curve
  check_area(make(input(Plane{}, {loop})), 6);
  loop.segments[1] = drawn(make_line2({2, 0}, {2, 3}), curve(Line{{2.5, 0, 0}, {2.5, 3, 0}}));
  const Made other = make(input(Plane{}, {loop}));  // and here with the parameter curve
  check_area(other, 6);
  BOOST_TEST(other.count(Step::CurveDropped) == 1);
}

BOOST_AUTO_TEST_CASE(copies_with_different_speed_or_direction_agree_through_a_map) {
  // x = s^2 in space, u = t in the parameter plane.
  auto fast = NurbsCurve::from_cartesian(2, {0, 0, 0, 1, 1, 1}, std::vector<Point>{{0, 0, 0}, {0, 0, 0}, {2, 0, 0}}, {});
  BOOST_REQUIRE(fast.has_value());
  TrimLoop loop = polygon({{0, 0}, {2, 0}, {2, 3}, {0, 3}});
  loop.segments[0].curve = curve(*fast);
  loop.segments[1].curve = curve(Line{{2, 3, 0}, {2, 0, 0}});
  const Made m = make(input(Plane{}, {loop}));
  check_ok(m);
  check_area(m, 6);
  const Coedge& c = m.body[m.face().loops[0]].coedges[0];
  BOOST_TEST(c.map.size() > 2u);
  BOOST_TEST(c.gap_mm <= 1e-3);
  BOOST_TEST(m.body[c.edge].curve != nullptr);
}

BOOST_AUTO_TEST_CASE(a_pcurve_beyond_the_border_is_held_there) {
  auto bilinear = NurbsSurface::from_cartesian(1, 1, {0, 0, 1, 1}, {0, 0, 1, 1},
                                               std::vector<Point>{{0, 0, 0}, {0, 10, 0}, {10, 0, 0}, {10, 10, 0}}, {});
  BOOST_REQUIRE(bilinear.has_value());
  const Made m = make(input(*bilinear, {polygon({{0.5, 0.2}, {1.02, 0.2}, {1.02, 0.8}, {0.5, 0.8}})}));
  check_area(m, 5 * 6, 1e-9);
  BOOST_TEST(m.first(Step::Clamped).before_mm == 0.2, boost::test_tools::tolerance(1e-6));
  const Made by_rounding = make(input(*bilinear, {polygon({{0, 0}, {1 + 1e-12, 0}, {1 + 1e-12, 1}, {0, 1}})}));
  check_ok(by_rounding);
  BOOST_TEST(by_rounding.outcome.steps.empty());
  check_area(by_rounding, 100);
}

BOOST_AUTO_TEST_CASE(no_loops_mean_the_whole_surface) {
  const Made sphere = make(input(Sphere{{}, 2}, {}));
  check_ok(sphere);
  check_area(sphere, 4 * pi * 4, 1e-9);
  check_area(make(input(Torus{{}, 5, 2}, {})), 4 * pi * pi * 10, 1e-9);
  check_area(make(input(nurbs_cylinder(4), {})), 2 * pi * 4, 1e-9);
  FaceInput cone = input(Cone{{}, 3, -std::atan2(3.0, 4.0)}, {});
  cone.range_v = Interval{0, 4};
  check_area(make(cone), pi * 15, 1e-9);
  FaceInput patch = input(Sphere{{}, 2}, {});
  patch.range_u = Interval{0, 1};
  patch.range_v = Interval{0, 1};
  check_area(make(patch), 4 * std::sin(1.0), 1e-9);
  const Made plane = make(input(Plane{}, {}));
  BOOST_TEST((plane.face().status == FaceStatus::Failed));
  BOOST_TEST(plane.face().loops.empty());
}

BOOST_AUTO_TEST_CASE(a_seam_from_pole_to_pole_and_back_is_the_whole_surface) {
  // A meridian of the sphere, up and down again, as STEP writers bound a whole sphere; either way round, at any angle.
  for (const double turn : {0.0, 1.0, 4.0}) {
    Frame upright;  // x towards the meridian's side, y along the axis
    upright.x = {std::cos(turn), std::sin(turn), 0};
    upright.y = {0, 0, 1};
    upright.z = cross(upright.x, upright.y);
    const CurvePtr meridian = curve(Circle{upright, 2, {-pi / 2, pi / 2}});
    for (const bool down_first : {false, true}) {
      TrimSegment there = in_space(meridian), back = in_space(meridian);
      (down_first ? there : back).curve_reversed = true;
      const Made m = make(input(Sphere{{}, 2}, {loop_of(there, back)}));
      BOOST_TEST((m.face().status != FaceStatus::Failed));
      check_area(m, 4 * pi * 4, 1e-9);
    }
  }
}

BOOST_AUTO_TEST_CASE(holes_in_the_natural_boundary) {
  FaceInput in = input(nurbs_cylinder(4), {polygon({{0.9, 1}, {1.1, 1}, {1.1, 3}, {0.9, 3}})});
  const double patch = make(in).area();
  in.outer_is_domain = true;
  const Made m = make(in);
  check_ok(m);
  check_area(m, 2 * pi * 4 - patch, 1e-9);
  FaceInput sphere = input(Sphere{{}, 2}, {polygon({{-0.1, -0.1}, {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}})});
  sphere.outer_is_domain = true;
  check_area(make(sphere), 16 * pi - 4 * 0.2 * 2 * std::sin(0.1), 1e-9);
}

BOOST_AUTO_TEST_CASE(a_reliable_clockwise_loop_on_a_closed_surface_is_a_hole) {
  FaceInput in = input(Sphere{{}, 2}, {polygon({{3, -0.1}, {3, 0.1}, {3.2, 0.1}, {3.2, -0.1}})});
  const double patch = 4 * 0.2 * 2 * std::sin(0.1);
  check_area(make(in), patch, 1e-9);
  in.brep_sense = true;
  check_area(make(in), 16 * pi - patch, 1e-9);
}

BOOST_AUTO_TEST_CASE(a_loop_of_nothing_but_the_seam_is_given_its_circles) {
  const Made m = make(input(Cylinder{{}, 2}, {loop_of(drawn({0, 0}, {0, 3}), drawn({two_pi, 3}, {two_pi, 0}))}));
  check_area(m, 2 * pi * 2 * 3, 1e-9);
  BOOST_TEST(m.count(Step::GapClosed) == 2);
}

BOOST_AUTO_TEST_CASE(an_octant_gets_its_pole) {
  const Made m = make(input(Sphere{{}, 2}, {loop_of(drawn({0, 0}, {pi / 2, 0}), drawn({pi / 2, 0}, {pi / 2, pi / 2}),
                                                    drawn({0, pi / 2}, {0, 0}))}));
  check_ok(m);
  check_area(m, 4 * pi * 4 / 8, 1e-9);
  BOOST_TEST(m.count(Step::PoleInserted) == 1);
}

BOOST_AUTO_TEST_CASE(an_octant_known_by_its_curves_in_space) {
  const auto quarter = [](Vector x, Vector y) {
    Circle c;
    c.frame = {{0, 0, 0}, x, y, cross(x, y)};
    c.radius = 2;
    c.range = {0, pi / 2};
    return in_space(curve(c));
  };
  const Vector x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const Made m = make(input(Sphere{{}, 2}, {loop_of(quarter(x, y), quarter(y, z), quarter(z, x))}));
  check_ok(m);
  check_area(m, 4 * pi * 4 / 8, 1e-6);
}

BOOST_AUTO_TEST_CASE(shared_edges_keep_their_identity) {
  // Two squares side by side in one body: the edge between them is one edge.
  Body body;
  const VertexId a = body.add(Vertex{{1, 0, 0}, 0}), b = body.add(Vertex{{1, 1, 0}, 0});
  Edge e;
  e.curve = curve(Line{{1, 0, 0}, {1, 1, 0}});
  e.range = {0, 1};
  e.start = a, e.end = b;
  const EdgeId shared = body.add(e);
  const auto square = [&](double u, bool shared_is_right) {
    TrimLoop loop = polygon({{u, 0}, {u + 1, 0}, {u + 1, 1}, {u, 1}});
    TrimSegment s;
    s.edge = shared;
    s.curve_reversed = !shared_is_right;
    loop.segments[shared_is_right ? 1 : 3] = s;
    return input(Plane{}, {loop});
  };
  const FaceOutcome left = add_face(body, square(0, true)), right = add_face(body, square(1, false));
  check_sound(body, 1e-3);
  BOOST_TEST((body[left.face].status == FaceStatus::Ok));
  BOOST_TEST((body[right.face].status == FaceStatus::Ok));
  BOOST_TEST(body.edges.size() == 7u);
  BOOST_TEST(std::abs(area(body, right.face).value - 1) < 1e-12);
}

BOOST_AUTO_TEST_CASE(hostile_numbers_fail_and_say_so) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  TrimLoop loop = polygon({{0, 0}, {nan, 0}, {2, 3}});
  const Made m = make(input(Plane{}, {loop}));
  BOOST_TEST((m.face().status == FaceStatus::Failed));
  FaceInput none;
  Body body;
  const FaceOutcome o = add_face(body, none);
  BOOST_TEST((body[o.face].status == FaceStatus::Failed));
  FaceInput zero = input(Plane{}, {polygon({{0, 0}, {1e300, 0}, {1e300, 1e300}})});
  zero.tolerance_mm = nan;
  Body other;
  add_face(other, zero);
}

BOOST_AUTO_TEST_CASE(a_hundred_thousand_shuffled_segments_chain_in_time) {
  constexpr std::size_t n = 100'000;
  TrimLoop loop;
  std::vector<TrimSegment> segments(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = [&](std::size_t k) {
      const double t = two_pi * double(k % n) / n;
      return Uv{1000 * std::cos(t), 1000 * std::sin(t)};
    };
    segments[(i * 7919) % n] = drawn(at(i), at(i + 1));
  }
  loop.segments = std::move(segments);
  const Made m = make(input(Plane{}, {loop}));
  check_area(m, pi * 1e6, 1e-6);
  BOOST_TEST(m.count(Step::SegmentsReordered) == 1);
}
