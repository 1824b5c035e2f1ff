// Curve entities: closed-form lengths and ends, every trap of section 7.6 of the facts page.

#include "tests/io/iges/imported.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

Imported one(int type, std::string_view parameters, IgesOptions options = {}) {
  IgesText file;
  file.add(type, parameters, options);
  return imported(file);
}

const auto nearly = boost::test_tools::tolerance(1e-9);

}  // namespace

BOOST_AUTO_TEST_SUITE(curves)

BOOST_AUTO_TEST_CASE(an_arc_runs_counter_clockwise_from_start_to_end) {
  const Imported in = one(100, "3.,1.,2.,6.,2.,1.,7.");  // centre (1,2,3), radius 5, a quarter
  BOOST_TEST(length(in.curve()) == 5 * pi / 2, nearly);
  check_point(start_point(in.curve()), {6, 2, 3});
  check_point(end_point(in.curve()), {1, 7, 3});
  BOOST_TEST(length(one(100, "0.,0.,0.,0.,5.,5.,0.").curve()) == 5 * 1.5 * pi, nearly);
}

BOOST_AUTO_TEST_CASE(equal_ends_of_an_arc_are_the_whole_circle) {
  BOOST_TEST(length(one(100, "0.,0.,0.,2.,0.,2.,0.").curve()) == 4 * pi, nearly);
  // Ends apart by less than the resolution, on the short side.
  const Imported in = one(100, "0.,0.,0.,2.,0.,2.,0.0000001");
  BOOST_TEST(length(in.curve()) == 4 * pi, nearly);
  BOOST_TEST(in.has("IG-E100-03"));
}

BOOST_AUTO_TEST_CASE(an_ellipse_is_found_from_its_coefficients) {
  // x^2/4 + y^2/1 = 1, the quarter from (2,0) to (0,1): complete elliptic integral of m = 1 - 1/4.
  const Imported in = one(104, "0.25,0.,1.,0.,0.,-1.,5.,2.,0.,0.,1.", {.form = 1});
  BOOST_TEST(length(in.curve()) == 2.422112055137, boost::test_tools::tolerance(1e-8));
  check_point(start_point(in.curve()), {2, 0, 5});
  check_point(end_point(in.curve()), {0, 1, 5});
}

BOOST_AUTO_TEST_CASE(equal_ends_of_an_ellipse_are_the_whole_of_it) {
  const Imported in = one(104, "0.25,0.,1.,0.,0.,-1.,0.,2.,0.,2.,0.", {.form = 1});
  BOOST_TEST(length(in.curve()) == 4 * 2.422112055137, boost::test_tools::tolerance(1e-8));
}

BOOST_AUTO_TEST_CASE(a_parabola_runs_from_its_start_whichever_way) {
  // x^2 - 4 y = 0 from (-2,1) to (4,4) and back.
  for (const bool back : {false, true}) {
    const Imported in = one(104, back ? "1.,0.,0.,0.,-4.,0.,0.,4.,4.,-2.,1." : "1.,0.,0.,0.,-4.,0.,0.,-2.,1.,4.,4.",
                            {.form = 3});
    check_point(start_point(in.curve()), back ? Point{4, 4, 0} : Point{-2, 1, 0});
    check_point(end_point(in.curve()), back ? Point{-2, 1, 0} : Point{4, 4, 0});
    const auto arc = [](double x) { return 0.5 * x * std::sqrt(1 + x * x / 4) + std::asinh(x / 2); };
    BOOST_TEST(length(in.curve()) == arc(4) - arc(-2), nearly);
  }
}

BOOST_AUTO_TEST_CASE(a_hyperbola_keeps_to_the_branch_of_its_ends) {
  // x^2/4 - y^2 = 1, the branch x < 0, from y = -1 to y = 2.
  const double x1 = -2 * std::sqrt(2.0), x2 = -2 * std::sqrt(5.0);
  IgesText file;
  file.add(104, "0.25,0.,-1.,0.,0.,-1.,0.,-2.8284271247461903,-1.,-4.47213595499958,2.", {.form = 2});
  file.add(104, "0.25,0.,-1.,0.,0.,-1.,0.,2.8284271247461903,-1.,-4.47213595499958,2.", {.form = 2});
  const Imported in = imported(file);
  BOOST_TEST(in.root().curves.size() == 1u);  // the second has its ends on two branches
  check_point(start_point(in.curve()), {x1, -1, 0});
  check_point(end_point(in.curve()), {x2, 2, 0});
  const Point middle = evaluate(in.curve(), range(in.curve()).mid());
  BOOST_TEST(middle.x < 0);
  BOOST_TEST(middle.x * middle.x / 4 - middle.y * middle.y == 1, nearly);
  BOOST_TEST(in.has("IG-E104-05"));
}

BOOST_AUTO_TEST_CASE(a_hyperbola_may_open_upwards) {
  const Imported in = one(104, "-1.,0.,0.25,0.,0.,-1.,0.,-1.,2.8284271247461903,1.,2.8284271247461903", {.form = 2});
  check_point(evaluate(in.curve(), range(in.curve()).mid()), {0, 2, 0});
}

BOOST_AUTO_TEST_CASE(a_turned_and_shifted_conic_is_read_as_it_is) {
  // The circle of radius 2 about (3,4), with coefficients doubled.
  const Imported in = one(104, "2.,0.,2.,-12.,-16.,42.,0.,5.,4.,3.,6.");
  BOOST_TEST(length(in.curve()) == pi, nearly);
  BOOST_TEST(in.has("IG-E104-04"));
  // x y = 1 is a hyperbola turned by 45 degrees.
  const Imported turned = one(104, "0.,1.,0.,0.,0.,-1.,0.,0.5,2.,2.,0.5");
  const Point p = evaluate(turned.curve(), range(turned.curve()).at(0.3));
  BOOST_TEST(p.x * p.y == 1, nearly);
  check_point(start_point(turned.curve()), {0.5, 2, 0});
}

BOOST_AUTO_TEST_CASE(ends_of_a_conic_are_projected) {
  const Imported in = one(104, "0.25,0.,1.,0.,0.,-1.,0.,2.001,0.,0.,1.002", {.form = 1});
  check_point(start_point(in.curve()), {2, 0, 0});
  check_point(end_point(in.curve()), {0, 1, 0});
  BOOST_TEST(in.finding("IG-E104-03").measured == 0.002, boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(copious_data_are_points_or_paths_by_form) {
  BOOST_TEST(one(106, "1,2,7.,0.,0.,3.,4.", {.form = 1}).root().points.size() == 2u);
  BOOST_TEST(one(106, "2,3,0.,0.,0.,1.,1.,1.,2.,2.,2.", {.form = 2}).root().points.size() == 3u);
  BOOST_TEST(length(one(106, "1,3,7.,0.,0.,3.,4.,3.,5.", {.form = 11}).curve()) == 6, nearly);
  BOOST_TEST(length(one(106, "2,2,0.,0.,0.,1.,2.,2.", {.form = 12}).curve()) == 3, nearly);
  BOOST_TEST(length(one(106, "3,2,0.,0.,0.,1.,0.,0.,1.,2.,2.,0.,0.,1.", {.form = 13}).curve()) == 3, nearly);
  const Imported closed = one(106, "1,4,7.,0.,0.,3.,0.,3.,4.,0.,0.", {.form = 63});
  BOOST_TEST(length(closed.curve()) == 12, nearly);
  check_point(start_point(closed.curve()), {0, 0, 7});
}

BOOST_AUTO_TEST_CASE(lines_may_be_rays_or_unbounded) {
  BOOST_TEST(length(one(110, "0.,0.,0.,1.,2.,2.").curve()) == 3, nearly);
  const Interval ray = range(one(110, "0.,0.,0.,1.,2.,2.", {.form = 1}).curve());
  BOOST_TEST(ray.lo == 0);
  BOOST_TEST(std::isinf(ray.hi));
  const Interval both = range(one(110, "0.,0.,0.,1.,2.,2.", {.form = 2}).curve());
  BOOST_TEST((std::isinf(both.lo) && std::isinf(both.hi)));
}

BOOST_AUTO_TEST_CASE(a_power_spline_keeps_its_parameter) {
  // x = t^3 on [1,2] then 1 + 3 s + 3 s^2 + s^3 on [2,3], s = t - 2: the same cubic twice over; y = 2, z = t - 1.
  const Imported in = one(112,
                          "3,0,3,2,1.,2.,3.,0.,0.,0.,1.,2.,0.,0.,0.,0.,1.,0.,0.,1.,3.,3.,1.,2.,0.,0.,0.,1.,1.,0.,0.,"
                          "8.,12.,6.,1.,2.,0.,0.,0.,2.,1.,0.,0.");
  BOOST_TEST(range(in.curve()).lo == 1);
  BOOST_TEST(range(in.curve()).hi == 3);
  check_point(evaluate(in.curve(), 1.5), {0.125, 2, 0.5});
  check_point(evaluate(in.curve(), 2.5), {1.5 * 1.5 * 1.5, 2, 1.5});
  check_point(end_point(in.curve()), {8, 2, 2});
  BOOST_TEST(!in.has("SQ-400"));
}

BOOST_AUTO_TEST_CASE(segments_of_a_power_spline_that_do_not_meet_are_reported) {
  const Imported in = one(112,
                          "3,0,3,2,0.,1.,2.,0.,1.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,1.5,1.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,"
                          "2.5,1.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.");
  BOOST_TEST(in.finding("SQ-400").measured == 0.5, nearly);
}

BOOST_AUTO_TEST_CASE(the_sub_range_of_a_spline_stays_an_interval) {
  const Imported in = one(126, "1,1,0,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,8.,0.,0.,0.25,0.75,0.,0.,1.");
  BOOST_TEST(length(in.curve()) == 4, nearly);
  const auto* nurbs = std::get_if<NurbsCurve>(&in.curve().shape);
  BOOST_REQUIRE(nurbs);
  BOOST_TEST(nurbs->knots().size() == 4u);
  BOOST_TEST(nurbs->range().lo == 0.25);
}

BOOST_AUTO_TEST_CASE(a_composite_runs_through_its_members_and_skips_points) {
  IgesText file;
  const int a = file.add(110, "0.,0.,0.,3.,0.,0.", {.status = dependent});
  const int p = file.add(116, "3.,0.,0.,0", {.status = dependent});
  const int b = file.add(100, "0.,3.,1.,3.,0.,4.,1.", {.status = dependent});
  file.add(102, "3,{},{},{}", {}, {a, p, b});
  const Imported in = imported(file);
  BOOST_TEST(in.root().curves.size() == 1u);  // members of a composite are not free
  BOOST_TEST(in.root().points.empty());
  BOOST_TEST(length(in.curve()) == 3 + pi / 2, nearly);
  check_point(end_point(in.curve()), {4, 1, 0});
  // The parameter starts at 0 and adds each member's own span: 1 of the line, a quarter turn of the arc.
  BOOST_TEST(range(in.curve()).hi == 1 + pi / 2, nearly);
}

BOOST_AUTO_TEST_CASE(gaps_and_turned_members_of_a_composite_are_measured) {
  IgesText file;
  const int a = file.add(110, "0.,0.,0.,3.,0.,0.", {.status = dependent});
  const int b = file.add(110, "3.,1.,0.,3.,0.,0.", {.status = dependent});
  const int c = file.add(110, "3.5,1.,0.,9.,1.,0.", {.status = dependent});
  file.add(102, "3,{},{},{}", {}, {a, b, c});
  const Imported in = imported(file);
  BOOST_TEST(in.finding("IG-E102-04").entity == "D3");
  BOOST_TEST(in.finding("IG-E102-03").measured == 0.5, nearly);
  check_point(evaluate(in.curve(), 1.5), {3, 0.5, 0});
}

BOOST_AUTO_TEST_CASE(a_composite_of_composites_is_taken_apart) {
  IgesText file;
  const int a = file.add(110, "0.,0.,0.,1.,0.,0.", {.status = dependent});
  const int b = file.add(110, "1.,0.,0.,2.,0.,0.", {.status = dependent});
  const int inner = file.add(102, "2,{},{}", {.status = dependent}, {a, b});
  const int c = file.add(110, "2.,0.,0.,3.,0.,0.", {.status = dependent});
  file.add(102, "2,{},{}", {}, {inner, c});
  const Imported in = imported(file);
  BOOST_TEST(in.root().curves.size() == 1u);
  BOOST_TEST(length(in.curve()) == 3, nearly);
  BOOST_TEST(in.has("IG-E102-02"));
}

BOOST_AUTO_TEST_CASE(a_composite_that_contains_itself_is_named) {
  IgesText file;
  file.add(102, "1,1");                 // D1: itself
  file.add(102, "1,5");                 // D3 -> D5 -> D3
  file.add(102, "1,3");
  const Imported in = imported(file);
  BOOST_TEST(in.root().curves.empty());
  BOOST_TEST(in.report.count("IG-R04") >= 2u);
}

BOOST_AUTO_TEST_CASE(composites_nested_beyond_the_limit_are_refused) {
  IgesText file;
  int member = file.add(110, "0.,0.,0.,1.,0.,0.", {.status = dependent});
  for (int i = 0; i < 3000; ++i) member = file.add(102, "1,{}", {}, {member});
  const Imported in = imported(file);
  BOOST_TEST(in.has("LM-05"));
}

BOOST_AUTO_TEST_CASE(composites_that_double_are_cut_off) {
  IgesText file;
  int member = file.add(110, "0.,0.,0.,1.,0.,0.", {.status = dependent});
  for (int i = 0; i < 40; ++i) member = file.add(102, "2,{},{}", {}, {member, member});
  Limits limits;
  limits.instances = 1000;
  BOOST_TEST(imported(file, limits).has("LM-06"));
}

BOOST_AUTO_TEST_CASE(an_offset_curve_goes_along_v_cross_t) {
  IgesText file;
  const int line = file.add(110, "0.,0.,0.,10.,0.,0.", {.status = dependent});
  file.add(130, "{},1,0,0,0,2.,0.,0.,0.,0.,0.,1.,0.,1.", {}, {line});
  const Imported in = imported(file);
  BOOST_TEST(length(in.curve()) == 10, nearly);  // all of the base: TT 0 to 1 are its parameters
  check_point(start_point(in.curve()), {0, 2, 0});
  check_point(end_point(in.curve()), {10, 2, 0});
}

BOOST_AUTO_TEST_CASE(an_offset_curve_takes_the_stated_part_of_its_base) {
  IgesText file;
  const int arc = file.add(100, "0.,0.,0.,4.,0.,-4.,0.", {.status = dependent});
  file.add(130, "{},1,0,0,0,1.,0.,0.,0.,0.,0.,1.,0.,1.5707963267948966", {}, {arc});
  const Imported in = imported(file);
  BOOST_TEST(length(in.curve()) == 3 * pi / 2, nearly);  // inwards: V x T points to the centre
}

BOOST_AUTO_TEST_CASE(a_tapered_offset_of_a_line_is_a_line) {
  for (const char* by : {"2,2.,0.,3.,1.", "1,2.,0.,3.,10."}) {  // by parameter, by arc length
    IgesText file;
    const int line = file.add(110, "0.,0.,0.,10.,0.,0.", {.status = dependent});
    file.add(130, "{},2,0,0," + std::string(by) + ",0.,0.,1.,0.,1.", {}, {line});
    const Imported in = imported(file);
    check_point(start_point(in.curve()), {0, 2, 0});
    check_point(evaluate(in.curve(), 0.25), {2.5, 2.25, 0});
    check_point(end_point(in.curve()), {10, 3, 0});
    BOOST_TEST(!in.has("MD-31"));
  }
}

BOOST_AUTO_TEST_CASE(a_functional_offset_follows_a_coordinate_of_its_law) {
  IgesText file;
  const int line = file.add(110, "0.,0.,0.,10.,0.,0.", {.status = dependent});
  // y = s^2 over s in 0..1: the second coordinate of a parabola given as a spline.
  const int law = file.add(126, "2,2,1,0,1,0,0.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,.5,0.,0.,1.,1.,0.,0.,1.,0.,0.,1.", {.status = dependent});
  file.add(130, "{},3,{},2,2,0.,0.,0.,0.,0.,0.,1.,0.,1.", {}, {line, law});
  const Imported in = imported(file);
  for (const double t : {0.0, 0.3, 0.5, 1.0}) check_point(evaluate(in.curve(), t), {10 * t, t * t, 0}, 1e-8);
  BOOST_TEST(in.finding("MD-31").measured <= 1e-8);
}

BOOST_AUTO_TEST_CASE(a_tapered_offset_of_an_arc_is_a_spiral_near_it) {
  IgesText file;
  const int arc = file.add(100, "0.,0.,0.,4.,0.,-4.,0.", {.status = dependent});
  file.add(130, "{},2,0,0,2,0.,0.,1.,3.141592653589793,0.,0.,-1.,0.,3.141592653589793", {}, {arc});
  const Imported in = imported(file);
  for (const double t : {0.0, 1.0, 2.0, 3.0}) {
    const double r = 4 + t / pi;  // outwards: -z x T
    check_point(evaluate(in.curve(), t), {r * std::cos(t), r * std::sin(t), 0}, 2e-9);
  }
  BOOST_TEST(in.finding("MD-31").limit <= 1e-9);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_read_is_reported_and_the_rest_stays) {
  IgesText file;
  file.add(126, "1,3,0,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,8.,0.,0.,0.,1.,0.,0.,1.");  // degree above upper index
  file.add(110, "0.,0.,0.,1.,0.,0.");
  const Imported in = imported(file);
  BOOST_TEST(in.root().curves.size() == 1u);
  BOOST_TEST(in.has("IG-E126-01"));
  BOOST_TEST(in.has("MD-12"));
}

BOOST_AUTO_TEST_SUITE_END()
