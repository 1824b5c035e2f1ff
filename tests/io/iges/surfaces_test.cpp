// Surface entities on their own: closed-form areas and points, natural borders, parameter ranges.

#include "tests/io/iges/imported.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

const auto nearly = boost::test_tools::tolerance(1e-6);

}  // namespace

BOOST_AUTO_TEST_SUITE(surfaces)

// Row 1 and 2 of the list of faults seen elsewhere: the order U0, U1, V0, V1, and that the range counts at all.
BOOST_AUTO_TEST_CASE(a_spline_surface_is_restricted_to_its_range) {
  IgesText file;
  file.add(128,
           "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,8.,0.,0.,0.,4.,0.,8.,4.,0.,0.,0.5,0.25,0.75");
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(in.area() == 4 * 2, nearly);  // x 0 to 4, y 1 to 3
  const Box box = bounding_box(in.root().bodies[0], FaceId{0});
  check_point(box.lo, {0, 1, 0}, 1e-9);
  check_point(box.hi, {4, 3, 0}, 1e-9);
}

BOOST_AUTO_TEST_CASE(the_first_index_of_a_spline_surface_runs_fastest) {
  IgesText file;  // 3 poles along u (x), 2 along v (y)
  file.add(128,
           "2,1,2,1,0,0,1,0,0,0.,0.,0.,1.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,2.,0.,0.,0.,5.,0.,1.,5.,"
           "0.,2.,5.,3.,0.,1.,0.,1.");
  const Imported in = imported(file);
  check_point(evaluate(in.surface(), {1, 0}), {2, 0, 0});
  check_point(evaluate(in.surface(), {1, 1}), {2, 5, 3});
  check_point(evaluate(in.surface(), {0, 1}), {0, 5, 0});
}

// Row 3: small weights are data.
BOOST_AUTO_TEST_CASE(a_tiny_weight_stays_what_it_is) {
  IgesText file;
  file.add(128,
           "1,1,1,1,0,0,0,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.E-10,1.,1.,1.,0.,0.,0.,8.,0.,0.,0.,4.,0.,8.,4.,0.,0.,1.,0.,1.");
  const Imported in = imported(file);
  const auto* nurbs = std::get_if<NurbsSurface>(&in.surface().shape);
  BOOST_REQUIRE(nurbs);
  BOOST_TEST(nurbs->pole(0, 0).w == 1e-10);
  BOOST_TEST(nurbs->pole(1, 1).w == 1.0);
  BOOST_TEST(in.report.count(Severity::Error) == 0u);
}

BOOST_AUTO_TEST_CASE(a_power_surface_skips_its_placeholders) {
  // One patch x = 2 s, y = 3 t, z = s t on [0,1] x [1,2]; then 3 placeholder patches of zeros.
  std::string p = "3,1,1,1,0.,1.,1.,2.,";
  std::string zeros;
  for (int i = 0; i < 48 * 3; ++i) zeros += ",0.";
  p += "0.,2.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,";   // x
  p += "0.,0.,0.,0.,3.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,";   // y
  p += "0.,0.,0.,0.,0.,1.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.";    // z
  IgesText file;
  file.add(114, p + zeros);
  const Imported in = imported(file);
  in.check_sound();
  BOOST_REQUIRE_EQUAL(in.faces().size(), 1u);
  check_point(evaluate(in.surface(), {0.5, 1.5}), {1, 1.5, 0.25});
  check_point(evaluate(in.surface(), {1, 2}), {2, 3, 1});
}

// Row 13: rulings of form 0 join equal shares of arc length.
BOOST_AUTO_TEST_CASE(rulings_go_by_arc_length_or_by_parameter) {
  for (const int form : {0, 1}) {
    IgesText file;
    // A straight line with uneven speed: quadratic with poles x = 0, 3, 10; at its middle parameter x = 4.
    const int uneven = file.add(126, "2,2,1,0,1,0,0.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,3.,0.,0.,10.,0.,0.,0.,1.,0.,0.,1.",
                                {.status = dependent});
    const int line = file.add(110, "0.,4.,0.,10.,4.,0.", {.status = dependent});
    file.add(118, "{},{},0,0", {.form = form}, {uneven, line});
    const Imported in = imported(file);
    in.check_sound();
    BOOST_TEST(in.area() == 40, nearly);
    check_point(evaluate(in.surface(), {0.5, 0}), {form == 0 ? 5.0 : 4.0, 0, 0}, 1e-6);
    check_point(evaluate(in.surface(), {0.5, 1}), {5, 4, 0}, 1e-6);
  }
}

BOOST_AUTO_TEST_CASE(the_second_rail_may_run_backwards) {
  IgesText file;
  const int a = file.add(110, "0.,0.,0.,10.,0.,0.", {.status = dependent});
  const int b = file.add(110, "10.,4.,0.,0.,4.,0.", {.status = dependent});
  file.add(118, "{},{},1,0", {.form = 1}, {a, b});
  BOOST_TEST(imported(file).area() == 40, nearly);
}

BOOST_AUTO_TEST_CASE(a_revolution_turns_right_handed_about_its_line) {
  IgesText file;
  const int axis = file.add(110, "0.,0.,0.,0.,0.,1.", {.status = dependent});
  const int line = file.add(110, "2.,0.,0.,2.,0.,3.", {.status = dependent});
  file.add(120, "{},{},1.5707963267948966,3.141592653589793", {}, {axis, line});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(in.area() == 2 * (pi / 2) * 3, nearly);
  const Box box = bounding_box(in.root().bodies[0], FaceId{0});
  BOOST_TEST(box.lo.x == -2, nearly);
  BOOST_TEST(box.hi.y == 2, nearly);
  BOOST_TEST(box.lo.y > -1e-6);
}

BOOST_AUTO_TEST_CASE(the_normal_of_a_revolution_is_that_of_the_file) {
  IgesText file;
  const int axis = file.add(110, "0.,0.,0.,0.,0.,1.", {.status = dependent});
  const int line = file.add(110, "2.,0.,0.,2.,0.,3.", {.status = dependent});
  file.add(120, "{},{},0.,6.283185307179586", {}, {axis, line});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(in.area() == 2 * two_pi * 3, nearly);
  // In the file u runs up and v around: u x v at angle 0 is z x y = -x. Ours is turned, and so is the face.
  const Vector n = normal(in.surface(), {0, 0.5});
  BOOST_TEST(n.x == 1, nearly);
  BOOST_TEST(in.face().reversed);
}

BOOST_AUTO_TEST_CASE(angles_that_are_clearly_degrees_are_read_so) {
  IgesText file;
  const int axis = file.add(110, "0.,0.,0.,0.,0.,1.", {.status = dependent});
  const int line = file.add(110, "2.,0.,0.,2.,0.,3.", {.status = dependent});
  file.add(120, "{},{},0.,90.", {}, {axis, line});
  const Imported in = imported(file);
  BOOST_TEST(in.area() == 2 * (pi / 2) * 3, nearly);
  BOOST_TEST(in.has("IG-E120-03"));
}

BOOST_AUTO_TEST_CASE(an_arc_turned_about_its_diameter_is_a_sphere) {
  IgesText file;
  const int axis = file.add(110, "0.,-3.,0.,0.,3.,0.", {.status = dependent});
  const int arc = file.add(100, "0.,0.,0.,0.,-3.,0.,3.", {.status = dependent});
  file.add(120, "{},{},0.,6.283185307179586", {}, {axis, arc});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(in.area() == 4 * pi * 9, nearly);
}

BOOST_AUTO_TEST_CASE(the_terminate_point_of_a_tabulated_cylinder_is_a_point) {
  IgesText file;
  const int arc = file.add(100, "0.,0.,0.,5.,0.,0.,5.", {.status = dependent});
  file.add(122, "{},5.,0.,7.", {}, {arc});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(in.area() == 5 * (pi / 2) * 7, nearly);
  const Box box = bounding_box(in.root().bodies[0], FaceId{0});
  check_point(box.hi, {5, 5, 7}, 1e-6);
}

// Row 8: the indicator decides the side.
BOOST_AUTO_TEST_CASE(the_indicator_of_an_offset_surface_decides_the_side) {
  for (const double side : {1.0, -1.0}) {
    IgesText file;
    const int base = file.add(128,
                              "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,8.,0.,0.,0.,4.,0.,8.,4.,"
                              "0.,0.,1.,0.,1.",
                              {.status = dependent});
    file.add(140, std::string("0.,0.,") + (side > 0 ? "1." : "-1.") + ",2.5,{}", {}, {base});
    const Imported in = imported(file);
    in.check_sound();
    BOOST_REQUIRE_EQUAL(in.faces().size(), 1u);
    BOOST_TEST(in.area() == 32, nearly);
    BOOST_TEST(evaluate(in.surface(), {0.5, 0.5}).z == side * 2.5, nearly);
    BOOST_TEST(!in.has("IG-E140-01"));
  }
}

// Row 9: an offset of an offset.
BOOST_AUTO_TEST_CASE(offsets_add_up) {
  IgesText file;
  const int axis = file.add(110, "0.,0.,0.,0.,0.,1.", {.status = dependent});
  const int line = file.add(110, "2.,0.,0.,2.,0.,3.", {.status = dependent});
  const int base = file.add(120, "{},{},0.,3.141592653589793", {.status = dependent}, {axis, line});
  const int once = file.add(140, "0.,1.,0.,1.,{}", {.status = dependent}, {base});  // outwards at the middle
  file.add(140, "0.,1.,0.,0.5,{}", {}, {once});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(in.area() == 3.5 * pi * 3, nearly);
}

BOOST_AUTO_TEST_CASE(an_offset_of_itself_is_named) {
  IgesText file;
  file.add(140, "0.,0.,1.,1.,1");
  const Imported in = imported(file);
  BOOST_TEST(in.has("IG-R04"));
}

// Row 15: a sphere without its reference direction.
BOOST_AUTO_TEST_CASE(elementary_surfaces_need_no_reference_direction) {
  IgesText file;
  const int centre = file.add(116, "1.,2.,3.,0", {.status = dependent});
  const int axis = file.add(123, "0.,0.,2.", {.status = dependent});
  file.add(196, "{},4.", {.form = 0}, {centre});
  file.add(198, "{},{},5.,2.", {.form = 0}, {centre, axis});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_REQUIRE_EQUAL(in.faces().size(), 2u);
  BOOST_TEST(in.area() == 4 * pi * 16 + 4 * pi * pi * 5 * 2, nearly);
  BOOST_TEST(in.root().points.empty());
}

BOOST_AUTO_TEST_CASE(the_half_angle_of_a_cone_is_in_degrees) {
  IgesText file;
  const int apex = file.add(116, "0.,0.,0.,0", {.status = dependent});
  const int axis = file.add(123, "0.,0.,1.", {.status = dependent});
  const int x = file.add(123, "1.,0.,0.", {.status = dependent});
  const int cone = file.add(194, "{},{},3.,45.,{}", {.form = 1, .status = dependent}, {apex, axis, x});
  const int rim = file.add(100, "2.,0.,0.,5.,0.,5.,0.", {.status = dependent});
  const int hole = file.add(100, "1.,0.,0.,4.,0.,4.,0.", {.status = dependent});
  const int rim_on = file.add(142, "1,{},0,{},2", {.status = dependent}, {cone, rim});
  const int hole_on = file.add(142, "1,{},0,{},2", {.status = dependent}, {cone, hole});
  file.add(144, "{},1,1,{},{}", {}, {cone, rim_on, hole_on});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(in.area() == pi * (4 + 5) * std::sqrt(2.0), nearly);
}

BOOST_AUTO_TEST_CASE(surfaces_follow_their_matrices) {
  IgesText file;
  const int mirror = file.add(124, "-1.,0.,0.,10.,0.,1.,0.,0.,0.,0.,1.,0.", {.form = 1});
  const int axis = file.add(110, "0.,0.,0.,0.,0.,1.", {.status = dependent});
  const int line = file.add(110, "2.,0.,0.,2.,0.,3.", {.status = dependent});
  file.add(120, "{},{},0.,1.5707963267948966", {.transform = mirror}, {axis, line});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(in.area() == 2 * (pi / 2) * 3, nearly);
  const Box box = bounding_box(in.root().bodies[0], FaceId{0});
  check_point(box.lo, {8, 0, 0}, 1e-6);
  check_point(box.hi, {10, 2, 3}, 1e-6);
  // The file's normal before the mirror is -x at angle 0 (see above). With the parameters carried along by the mirror,
  // u x v is still z x y = -x there.
  const Point at = evaluate(in.surface(), {in.surface().shape.index() == 5 ? domain(in.surface()).u.lo : 0, 1.5});
  const Vector n = (in.face().reversed ? -1.0 : 1.0) * normal(in.surface(), {domain(in.surface()).u.lo, 1.5});
  const double towards_axis = dot(n, Vector{10 - at.x, -at.y, 0});
  BOOST_TEST(towards_axis < 0);
}

BOOST_AUTO_TEST_SUITE_END()
