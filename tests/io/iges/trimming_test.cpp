// Trimmed surfaces: 144/142, 143/141, bounded planes, and each choice of docs/trim-policy.md.

#include <fmt/format.h>

#include "tests/io/iges/imported.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

const auto nearly = boost::test_tools::tolerance(1e-6);

// The plane x 0 to 8, y 0 to 4 over u, v in [0,1].
int add_plate(IgesText& file) {
  return file.add(128,
                  "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,8.,0.,0.,0.,4.,0.,8.,4.,0.,0.,1.,0.,1.",
                  {.status = dependent});
}

std::string polyline(std::initializer_list<Point> points) {
  std::string out = "2," + std::to_string(points.size());
  for (const Point p : points)
    out += "," + std::to_string(p.x) + "," + std::to_string(p.y) + "," + std::to_string(p.z);
  return out;
}

// A closed path round a rectangle, in the plane's parameters or in space.
int add_rectangle(IgesText& file, double x0, double y0, double x1, double y1, const char* status, bool clockwise = false) {
  const Point a{x0, y0, 0}, b{x1, y0, 0}, c{x1, y1, 0}, d{x0, y1, 0};
  return file.add(106, clockwise ? polyline({a, d, c, b, a}) : polyline({a, b, c, d, a}),
                  {.form = 12, .status = status});
}

int add_142(IgesText& file, int surface, int pcurve, int curve, int preference) {
  return file.add(142, "1,{},{},{}," + std::to_string(preference), {.status = dependent}, {surface, pcurve, curve});
}

}  // namespace

BOOST_AUTO_TEST_SUITE(trimming)

BOOST_AUTO_TEST_CASE(a_surface_is_trimmed_by_both_curves) {
  IgesText file;
  const int s = add_plate(file);
  const int b = add_rectangle(file, 0.25, 0.25, 0.75, 0.75, parametric);
  const int c = add_rectangle(file, 2, 1, 6, 3, dependent);
  file.add(144, "{},1,0,{}", {}, {s, add_142(file, s, b, c, 3)});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(in.area() == 4 * 2, nearly);
  BOOST_TEST((in.face().status == FaceStatus::Ok));
  BOOST_TEST(!in.has("IG-E142-04"));
  BOOST_TEST(in.root().curves.empty());  // trimming curves are not free curves
  BOOST_REQUIRE_EQUAL(in.face().source.size(), 2u);
  BOOST_TEST(in.face().source[0].id == 9u);
  BOOST_TEST(in.face().source[1].id == 1u);
}

BOOST_AUTO_TEST_CASE(one_of_the_curves_is_enough) {
  for (const bool flat : {true, false}) {
    IgesText file;
    const int s = add_plate(file);
    const int b = flat ? add_rectangle(file, 0.25, 0.25, 0.75, 0.75, parametric) : 0;
    const int c = flat ? 0 : add_rectangle(file, 2, 1, 6, 3, dependent);
    file.add(144, "{},1,0,{}", {}, {s, add_142(file, s, b, c, 0)});
    const Imported in = imported(file);
    in.check_sound();
    BOOST_TEST(in.area() == 8, nearly);
    BOOST_TEST(in.has("SQ-252") == !flat);  // the missing parameter curve was fitted
  }
}

BOOST_AUTO_TEST_CASE(the_stated_preference_decides_between_contradicting_curves) {
  for (const int preference : {1, 2}) {
    IgesText file;
    const int s = add_plate(file);
    const int b = add_rectangle(file, 0.25, 0.25, 0.75, 0.75, parametric);  // 4 x 2 in space
    const int c = add_rectangle(file, 1, 1, 7, 3, dependent);               // 6 x 2
    file.add(144, "{},1,0,{}", {}, {s, add_142(file, s, b, c, preference)});
    const Imported in = imported(file);
    in.check_sound();
    BOOST_TEST(in.area() == (preference == 1 ? 8 : 12), nearly);
    const Diagnostic& d = in.finding("IG-E142-04");
    BOOST_TEST(d.entity == "D7");
    BOOST_REQUIRE(!d.path.empty());
    BOOST_TEST(d.path[0] == "D9");
    BOOST_TEST(d.measured == 1, boost::test_tools::tolerance(1e-3));
    BOOST_TEST(d.limit == in.model.resolution_mm);
  }
}

BOOST_AUTO_TEST_CASE(a_healed_face_states_its_area_before_and_after) {
  IgesText file;
  const int s = add_plate(file);
  const int b = add_rectangle(file, 0.25, 0.25, 0.75, 0.75, parametric);  // 4 x 2 in space
  const int c = add_rectangle(file, 1, 1, 7, 3, dependent);               // 6 x 2
  file.add(144, "{},1,0,{}", {}, {s, add_142(file, s, b, c, 0)});         // no preference: healing decides
  Report report;
  const auto parsed = iges::File::parse(file.text(), {}, report);
  const Model model = io::iges_import::import(parsed, {}, {}, report, true);
  const Face& face = model.parts[0].bodies[0].faces[0];
  BOOST_TEST((face.status == FaceStatus::Healed));
  BOOST_TEST(report.count("MD-30") == 1u);
  for (const Diagnostic& d : report.items()) {
    if (d.rule->id != "MD-30") continue;
    BOOST_TEST(d.entity == "D9");
    BOOST_TEST(d.measured == 8, nearly);  // after: by the parameter curve
    BOOST_TEST(d.limit == 12, nearly);    // before: by the model curve
    BOOST_TEST((d.severity == Severity::Warning));
  }
  BOOST_TEST(!imported(file).has("MD-30"));  // measured only when asked for
}

BOOST_AUTO_TEST_CASE(the_preference_of_a_141_counts_the_other_way_round) {
  for (const int preference : {1, 2}) {
    IgesText file;
    const int s = add_plate(file);
    const int b = add_rectangle(file, 0.25, 0.25, 0.75, 0.75, parametric);
    const int c = add_rectangle(file, 1, 1, 7, 3, dependent);
    const int boundary = file.add(141, "1," + std::to_string(preference) + ",{},1,{},1,1,{}", {.status = dependent}, {s, c, b});
    file.add(143, "1,{},1,{}", {}, {s, boundary});
    const Imported in = imported(file);
    in.check_sound();
    BOOST_TEST(in.area() == (preference == 2 ? 8 : 12), nearly);
    BOOST_TEST(in.finding("IG-E141-04").entity == "D7");
  }
}

BOOST_AUTO_TEST_CASE(items_of_a_141_are_taken_in_their_sense) {
  IgesText file;
  const int s = add_plate(file);
  const int a = file.add(110, "2.,1.,0.,6.,1.,0.", {.status = dependent});
  const int b = file.add(110, "6.,3.,0.,6.,1.,0.", {.status = dependent});  // against the boundary
  const int c = file.add(110, "6.,3.,0.,2.,3.,0.", {.status = dependent});
  const int d = file.add(110, "2.,3.,0.,2.,1.,0.", {.status = dependent});
  const int boundary = file.add(141, "0,1,{},4,{},1,0,{},2,0,{},1,0,{},1,0", {.status = dependent}, {s, a, b, c, d});
  file.add(143, "0,{},1,{}", {}, {s, boundary});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(in.area() == 8, nearly);
  BOOST_TEST((in.face().status == FaceStatus::Ok), in.face().reason);
  BOOST_TEST(!in.has("IG-E141-03"));
}

// Row 10 of the list of faults seen elsewhere.
BOOST_AUTO_TEST_CASE(a_141_without_curves_leaves_the_natural_border) {
  IgesText file;
  const int s = add_plate(file);
  const int boundary = file.add(141, "0,0,{},0", {.status = dependent}, {s});
  file.add(143, "0,{},1,{}", {}, {s, boundary});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(in.area() == 32, nearly);
  BOOST_TEST(in.has("IG-E141-03"));
}

BOOST_AUTO_TEST_CASE(without_an_outer_boundary_the_domain_is_it) {
  IgesText file;
  const int s = add_plate(file);
  const int b = add_rectangle(file, 0.25, 0.25, 0.75, 0.75, parametric, true);
  const int hole = add_142(file, s, b, 0, 1);
  file.add(144, "{},0,1,0,{}", {}, {s, hole});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(in.area() == 32 - 8, nearly);
}

BOOST_AUTO_TEST_CASE(loops_are_turned_by_what_they_enclose) {
  IgesText file;
  const int s = add_plate(file);
  const int outer = add_142(file, s, add_rectangle(file, 0.125, 0.25, 0.875, 0.75, parametric, true), 0, 1);
  const int hole = add_142(file, s, add_rectangle(file, 0.25, 0.4, 0.5, 0.6, parametric), 0, 1);
  file.add(144, "{},1,1,{},{}", {}, {s, outer, hole});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(in.area() == 6 * 2 - 2 * 0.8, nearly);
  BOOST_TEST(in.report.count("IG-E144-05") == 2u);
}

BOOST_AUTO_TEST_CASE(composites_are_paired_member_by_member) {
  IgesText file;
  const int s = add_plate(file);
  const auto path = [&](const char* status, std::initializer_list<const char*> lines) {
    std::string members = std::to_string(lines.size());
    for (const char* line : lines) members += fmt::format(",{}", file.add(110, line, {.status = status}));
    return file.add(102, members, {.status = status});
  };
  const int b = path(parametric, {"0.25,0.25,0.,0.75,0.25,0.", "0.75,0.25,0.,0.75,0.75,0.", "0.75,0.75,0.,0.25,0.75,0.",
                                  "0.25,0.75,0.,0.25,0.25,0."});
  const int c = path(dependent, {"2.,1.,0.,6.,1.,0.", "6.,1.,0.,6.,3.,0.", "6.,3.,0.,2.,3.,0.", "2.,3.,0.,2.,1.,0."});
  file.add(144, "{},1,0,{}", {}, {s, add_142(file, s, b, c, 1)});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(in.area() == 8, nearly);
  BOOST_REQUIRE_EQUAL(in.face().loops.size(), 1u);
  const Body& body = in.root().bodies.at(0);
  BOOST_TEST(body[in.face().loops[0]].coedges.size() == 4u);
  for (const Edge& e : body.edges) BOOST_TEST((e.curve != nullptr));  // the model curves are kept
  BOOST_TEST(!in.has("IG-E102-03"));  // parameter curves are not read as curves in space
}

BOOST_AUTO_TEST_CASE(composites_of_different_length_are_taken_whole) {
  IgesText file;
  const int s = add_plate(file);
  const int b = add_rectangle(file, 0.25, 0.25, 0.75, 0.75, parametric);
  const int half = file.add(106, "2,3,2.,1.,0.,6.,1.,0.,6.,3.,0.", {.form = 12, .status = dependent});
  const int rest = file.add(106, "2,3,6.,3.,0.,2.,3.,0.,2.,1.,0.", {.form = 12, .status = dependent});
  const int c = file.add(102, "2,{},{}", {.status = dependent}, {half, rest});
  file.add(144, "{},1,0,{}", {}, {s, add_142(file, s, b, c, 0)});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(in.area() == 8, nearly);
}

BOOST_AUTO_TEST_CASE(gaps_are_closed_and_measured) {
  IgesText file;
  const int s = add_plate(file);
  const int b = file.add(106, polyline({{0.25, 0.25, 0}, {0.75, 0.25, 0}, {0.75, 0.75, 0}, {0.25, 0.75, 0}, {0.25, 0.27, 0}}),
                         {.form = 12, .status = parametric});
  file.add(144, "{},1,0,{}", {}, {s, add_142(file, s, b, 0, 1)});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(in.area() == 8, nearly);
  BOOST_TEST((in.face().status == FaceStatus::Healed));
  BOOST_TEST(in.finding("IG-E144-02").measured == 0.08, boost::test_tools::tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE(a_curve_beyond_the_surface_is_held_at_its_border) {
  IgesText file;
  const int s = add_plate(file);
  const int b = add_rectangle(file, 0.5, 0.25, 1.125, 0.75, parametric);
  file.add(144, "{},1,0,{}", {}, {s, add_142(file, s, b, 0, 1)});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(in.area() == 4 * 2, nearly);
  BOOST_TEST(in.finding("IG-E142-03").measured == 1, boost::test_tools::tolerance(1e-2));
}

BOOST_AUTO_TEST_CASE(pcurves_are_not_scaled_by_the_unit) {
  IgesText file;
  file.global = "4Htest,8Htest.igs,8Htrimloop,8Htrimloop,32,38,6,308,15,4Htest,1.,1,4HINCH,1,1.,15H20260101.000000,1.E-6,"
                "1000.,6Hauthor,3Horg,11,0,15H20260101.000000,";
  const int s = add_plate(file);
  const int b = add_rectangle(file, 0.25, 0.25, 0.75, 0.75, parametric);
  const int c = add_rectangle(file, 2, 1, 6, 3, dependent);
  file.add(144, "{},1,0,{}", {}, {s, add_142(file, s, b, c, 3)});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(in.area() == 8 * 25.4 * 25.4, nearly);
  BOOST_TEST(!in.has("IG-E142-04"));
}

BOOST_AUTO_TEST_CASE(parameters_of_a_revolution_are_swapped) {
  IgesText file;
  const int axis = file.add(110, "0.,0.,0.,0.,0.,1.", {.status = dependent});
  const int line = file.add(110, "2.,0.,0.,2.,0.,3.", {.status = dependent});
  const int s = file.add(120, "{},{},0.,6.283185307179586", {.status = dependent}, {axis, line});
  // u along the line 0 to 1, v the angle: a third of the height, one radian wide.
  const int b = add_rectangle(file, 1.0 / 3, 0.5, 2.0 / 3, 1.5, parametric);
  file.add(144, "{},1,0,{}", {}, {s, add_142(file, s, b, 0, 1)});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(in.area() == 2 * 1 * 1, boost::test_tools::tolerance(1e-5));
  const Box box = bounding_box(in.root().bodies[0], FaceId{0});
  BOOST_TEST(box.lo.z == 1, boost::test_tools::tolerance(1e-5));
  BOOST_TEST(box.hi.y == 2 * std::sin(1.5), boost::test_tools::tolerance(1e-5));
}

BOOST_AUTO_TEST_CASE(parameters_of_a_tabulated_cylinder_run_from_0_to_1) {
  IgesText file;
  const int arc = file.add(100, "0.,0.,0.,5.,0.,0.,5.", {.status = dependent});  // its own parameter: 0 to pi / 2
  const int s = file.add(122, "{},5.,0.,7.", {.status = dependent}, {arc});
  const int b = add_rectangle(file, 0.5, 0, 1, 0.5, parametric);
  file.add(144, "{},1,0,{}", {}, {s, add_142(file, s, b, 0, 1)});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(in.area() == 5 * (pi / 4) * 3.5, nearly);
}

BOOST_AUTO_TEST_CASE(angles_are_degrees_unless_radians_fit) {
  for (const bool degrees : {true, false}) {
    IgesText file;
    const int centre = file.add(116, "0.,0.,0.,0", {.status = dependent});
    const int axis = file.add(123, "0.,0.,1.", {.status = dependent});
    const int x = file.add(123, "1.,0.,0.", {.status = dependent});
    const int s = file.add(192, "{},{},5.,{}", {.form = 1, .status = dependent}, {centre, axis, x});
    const double quarter = degrees ? 90 : pi / 2;
    std::string b = "4", c = "4";
    const Uv corners[] = {{0, 0}, {quarter, 0}, {quarter, 3}, {0, 3}, {0, 0}};
    for (int i = 0; i < 4; ++i)
      b += "," + std::to_string(file.add(110,
                                         std::to_string(corners[i].u) + "," + std::to_string(corners[i].v) + ",0.," +
                                             std::to_string(corners[i + 1].u) + "," + std::to_string(corners[i + 1].v) + ",0.",
                                         {.status = parametric}));
    const int top = file.add(124, "1.,0.,0.,0.,0.,-1.,0.,0.,0.,0.,-1.,3.");  // turned about x: clockwise seen from +z
    c += "," + std::to_string(file.add(100, "0.,0.,0.,5.,0.,0.,5.", {.status = dependent}));
    c += "," + std::to_string(file.add(110, "0.,5.,0.,0.,5.,3.", {.status = dependent}));
    c += "," + std::to_string(file.add(100, "0.,0.,0.,0.,-5.,5.,0.", {.status = dependent, .transform = top}));
    c += "," + std::to_string(file.add(110, "5.,0.,3.,5.,0.,0.", {.status = dependent}));
    const int flat = file.add(102, b, {.status = parametric}), model = file.add(102, c, {.status = dependent});
    file.add(144, "{},1,0,{}", {}, {s, add_142(file, s, flat, model, 3)});
    const Imported in = imported(file);
    in.check_sound();
    BOOST_TEST(in.area() == 5 * (pi / 2) * 3, boost::test_tools::tolerance(1e-5));
    BOOST_TEST((in.report.count("MD-13") > 0) == !degrees);
    BOOST_TEST(!in.has("IG-E142-07"));
  }
}

BOOST_AUTO_TEST_CASE(a_bounded_plane_is_a_face_and_may_have_holes) {
  IgesText file;
  const int rim = file.add(100, "5.,0.,0.,3.,0.,3.,0.", {.status = dependent});
  const int plane = file.add(108, "0.,0.,2.,10.,{},0.,0.,0.,0.", {.form = 1}, {rim});
  const int inner = file.add(100, "5.,0.,0.,1.,0.,1.,0.", {.status = dependent});
  const int hole = file.add(108, "0.,0.,2.,10.,{},0.,0.,0.,0.", {.form = -1, .status = dependent}, {inner});
  file.add(402, "1,1,{},{}", {.form = 9}, {plane, hole});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_REQUIRE_EQUAL(in.faces().size(), 1u);
  BOOST_TEST(in.area() == pi * (9 - 1), nearly);
  BOOST_TEST(bounding_box(in.root().bodies[0], FaceId{0}).lo.z == 5, nearly);
}

BOOST_AUTO_TEST_CASE(an_outer_boundary_that_cannot_be_used_fails_the_face_with_its_reason) {
  IgesText file;
  const int s = add_plate(file);
  const int none = add_142(file, s, 0, 0, 1);
  file.add(144, "{},1,0,{}", {}, {s, none});
  const Imported in = imported(file);
  BOOST_REQUIRE_EQUAL(in.faces().size(), 1u);  // and the surface is no second face
  BOOST_TEST((in.face().status == FaceStatus::Failed));
  BOOST_TEST(!in.face().reason.empty());
  BOOST_TEST(in.has("IG-E142-02"));
  BOOST_TEST(in.finding("MD-12").entity == "D5");
}

BOOST_AUTO_TEST_CASE(a_hole_that_cannot_be_used_is_left_out_and_said) {
  IgesText file;
  const int s = add_plate(file);
  const int outer = add_142(file, s, add_rectangle(file, 0.25, 0.25, 0.75, 0.75, parametric), 0, 1);
  const int none = add_142(file, s, 0, 0, 1);
  file.add(144, "{},1,1,{},{}", {}, {s, outer, none});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(in.area() == 8, nearly);
  BOOST_TEST(in.has("IG-E144-03"));
}

BOOST_AUTO_TEST_CASE(a_boundary_of_another_surface_is_reported) {
  IgesText file;
  const int s = add_plate(file), other = add_plate(file);
  const int b = add_rectangle(file, 0.25, 0.25, 0.75, 0.75, parametric);
  file.add(144, "{},1,0,{}", {}, {s, add_142(file, other, b, 0, 1)});
  const Imported in = imported(file);
  BOOST_TEST(in.area() == 8, nearly);
  BOOST_TEST(in.has("IG-E142-06"));
}

BOOST_AUTO_TEST_CASE(an_unbounded_surface_without_border_is_listed_as_failed) {
  IgesText file;
  const int centre = file.add(116, "0.,0.,0.,0", {.status = dependent});
  const int axis = file.add(123, "0.,0.,1.", {.status = dependent});
  file.add(192, "{},{},5.", {}, {centre, axis});
  const Imported in = imported(file);
  BOOST_REQUIRE_EQUAL(in.faces().size(), 1u);
  BOOST_TEST((in.face().status == FaceStatus::Failed));
  BOOST_TEST(in.has("IG-E144-06"));
  BOOST_TEST(in.area() == 0.0);
}

BOOST_AUTO_TEST_CASE(a_plane_without_end_is_no_face) {
  IgesText file;
  file.add(108, "0.,0.,1.,5.,0,0.,0.,0.,0.");
  const Imported in = imported(file);
  BOOST_TEST(in.faces().empty());
  BOOST_TEST(in.finding("MD-13").entity == "D1");
}

BOOST_AUTO_TEST_SUITE_END()
