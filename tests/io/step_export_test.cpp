// Model -> STEP: what is written, instance by instance, and that the same model gives the same bytes.

#include <boost/test/unit_test.hpp>

#include <algorithm>

#include "io/io.h"
#include "kernel/heal/make_face.h"
#include "kernel/topology/transform_body.h"
#include "kernel/check/measure.h"
#include "tests/support/builders.h"
#include "tests/support/paths.h"

using namespace trimloop;

namespace {

Model model_of(std::vector<Body> bodies) {
  Model model;
  model.name = "test";
  model.parts.emplace_back();
  model.parts[0].bodies = std::move(bodies);
  return model;
}

io::WriteResult write(const Model& model, io::WriteOptions options = {}) {
  options.format = io::Format::Step;
  auto written = io::encode(model, {}, options);
  BOOST_REQUIRE_MESSAGE(written, (written ? std::string() : written.error().text));
  return std::move(*written);
}

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size())) ++n;
  return n;
}
// Instances of an entity: "#12=NAME(" or a partial "NAME(" in a complex one.
std::size_t instances(const io::WriteResult& r, const std::string& name) {
  return count_of(r.bytes, "=" + name + "(") + count_of(r.bytes, "(" + name + "(") + count_of(r.bytes, ")" + name + "(");
}

}  // namespace

BOOST_AUTO_TEST_SUITE(step_export)

BOOST_AUTO_TEST_CASE(a_box_is_a_solid_with_shared_edges) {
  const io::WriteResult r = write(model_of({test::box({0, 0, 0}, {1, 2, 3})}));
  BOOST_TEST(r.losses.empty());
  BOOST_TEST(instances(r, "MANIFOLD_SOLID_BREP") == 1u);
  BOOST_TEST(instances(r, "CLOSED_SHELL") == 1u);
  BOOST_TEST(instances(r, "ADVANCED_FACE") == 6u);
  BOOST_TEST(instances(r, "EDGE_CURVE") == 12u);
  BOOST_TEST(instances(r, "ORIENTED_EDGE") == 24u);
  BOOST_TEST(instances(r, "VERTEX_POINT") == 8u);
  BOOST_TEST(instances(r, "PLANE") == 6u);
  BOOST_TEST(instances(r, "ADVANCED_BREP_SHAPE_REPRESENTATION") == 1u);
  BOOST_TEST(count_of(r.bytes, "VOLUME_MEASURE(6.") == 1u);
  BOOST_TEST(count_of(r.bytes, "AREA_MEASURE(22.") == 1u);
  BOOST_TEST(count_of(r.bytes, "'centre point',(") == 1u);
}

BOOST_AUTO_TEST_CASE(round_solids_keep_their_surfaces_seams_and_poles) {
  const io::WriteResult r = write(model_of({test::cylinder({0, 0, 0}, 2, 5), test::cone({10, 0, 0}, 2, 5),
                                            test::sphere({20, 0, 0}, 3), test::torus({40, 0, 0}, 5, 1)}));
  BOOST_TEST(instances(r, "MANIFOLD_SOLID_BREP") == 4u);
  BOOST_TEST(instances(r, "CYLINDRICAL_SURFACE") == 1u);
  BOOST_TEST(instances(r, "CONICAL_SURFACE") == 1u);
  BOOST_TEST(instances(r, "SPHERICAL_SURFACE") == 1u);
  BOOST_TEST(instances(r, "TOROIDAL_SURFACE") == 1u);
  // Edges: two circles and a seam; one circle and a seam; a seam; two seams. Poles have none.
  BOOST_TEST(instances(r, "EDGE_CURVE") == 3u + 2u + 1u + 2u);
}

BOOST_AUTO_TEST_CASE(the_schema_is_chosen) {
  const Model model = model_of({test::box({0, 0, 0}, {1, 1, 1})});
  BOOST_TEST(count_of(write(model).bytes, "AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF") == 1u);
  io::WriteOptions options;
  options.step_schema = io::StepSchema::Ap214;
  BOOST_TEST(count_of(write(model, options).bytes, "AUTOMOTIVE_DESIGN") == 1u);
}

BOOST_AUTO_TEST_CASE(units_keep_the_digits_of_their_file) {
  Model model = model_of({test::box({0, 0, 0}, {25.4 * 0.3, 25.4, 25.4})});
  model.source_unit = LengthUnit::Inch;
  const io::WriteResult inch = write(model);
  BOOST_TEST(count_of(inch.bytes, "CONVERSION_BASED_UNIT('INCH'") == 1u);
  BOOST_TEST(count_of(inch.bytes, "(0.3,1.,1.)") >= 1u);
  io::WriteOptions options;
  options.unit = LengthUnit::Metre;
  model.parts[0].bodies = {test::box({0, 0, 0}, {7.62, 25.4, 25.4})};
  const io::WriteResult metre = write(model, options);
  BOOST_TEST(count_of(metre.bytes, "SI_UNIT($,.METRE.)") == 1u);
  BOOST_TEST(count_of(metre.bytes, "(0.00762,0.0254,0.0254)") >= 1u);
}

BOOST_AUTO_TEST_CASE(the_time_stamp_is_fixed_or_given) {
  const Model model = model_of({test::box({0, 0, 0}, {1, 1, 1})});
  BOOST_TEST(write(model).bytes == write(model).bytes);
  BOOST_TEST(count_of(write(model).bytes, "'0001-01-01T00:00:00'") == 1u);
  io::WriteOptions options;
  options.timestamp = "20240131.235958";
  BOOST_TEST(count_of(write(model, options).bytes, "'2024-01-31T23:59:58'") == 1u);
  options.timestamp = "940131.235958";
  BOOST_TEST(count_of(write(model, options).bytes, "'1994-01-31T23:59:58'") == 1u);
}

BOOST_AUTO_TEST_CASE(assemblies_share_their_parts_and_scales_are_definitions_of_their_own) {
  Model model = model_of({});
  model.parts.emplace_back();
  model.parts[1].name = "bolt";
  model.parts[1].bodies.push_back(test::cylinder({1, 2, 3}, 2, 5));
  const auto place = [&](Transform t) { model.parts[0].instances.push_back({1, t, {}, {}}); };
  place(Transform::translation({10, 0, 0}));
  place(Transform::rotation({0, 0, 0}, {0, 0, 1}, 1));
  Transform mirror;
  mirror.r[0][0] = -1;
  place(mirror);
  place(Transform::scale(2));
  const io::WriteResult r = write(model);
  BOOST_TEST(r.losses.empty());
  BOOST_TEST(instances(r, "NEXT_ASSEMBLY_USAGE_OCCURRENCE") == 4u);
  BOOST_TEST(instances(r, "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION") == 4u);
  BOOST_TEST(instances(r, "ITEM_DEFINED_TRANSFORMATION") == 4u);
  BOOST_TEST(instances(r, "PRODUCT") == 4u);  // the root, the bolt, the bolt mirrored, the bolt at twice its size
  BOOST_TEST(instances(r, "MANIFOLD_SOLID_BREP") == 3u);
  BOOST_TEST(count_of(r.bytes, "'bolt mirrored'") >= 1u);
}

BOOST_AUTO_TEST_CASE(names_colours_layers_and_hidden_things_are_written) {
  Model model = model_of({test::box({0, 0, 0}, {1, 1, 1})});
  Attributes red;
  red.name = "Deckel \xC3\xB6";
  red.colour = Colour{1, 0.25, 0};
  red.layer = 7;
  model.parts[0].bodies[0].faces[0].attributes = model.add(red);
  Attributes hidden;
  hidden.visible = false;
  model.parts[0].bodies[0].faces[1].attributes = model.add(hidden);
  const io::WriteResult r = write(model);
  BOOST_TEST(count_of(r.bytes, "ADVANCED_FACE('Deckel \\X2\\00F6\\X0\\'") == 1u);
  BOOST_TEST(count_of(r.bytes, "COLOUR_RGB('',1.,0.25,0.)") == 1u);
  BOOST_TEST(instances(r, "STYLED_ITEM") == 2u);
  BOOST_TEST(instances(r, "INVISIBILITY") == 1u);
  BOOST_TEST(count_of(r.bytes, "PRESENTATION_LAYER_ASSIGNMENT('7'") == 1u);
}

BOOST_AUTO_TEST_CASE(free_curves_and_points_stand_in_a_curve_set) {
  Model model = model_of({});
  Part& part = model.parts[0];
  part.curves.push_back({Curve{Line{{0, 0, 0}, {3, 4, 0}}}, {}, {}});
  Circle arc;
  arc.range = {0.5, 2};
  part.curves.push_back({Curve{arc}, {}, {}});
  part.curves.push_back({Curve{Circle{}}, {}, {}});
  Ellipse upright;  // short axis first
  upright.a = 1, upright.b = 3;
  part.curves.push_back({Curve{upright}, {}, {}});
  part.curves.push_back({Curve{Polyline{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}}}, {}, {}});
  part.points.push_back({{1, 2, 3}, {}, {}});
  const io::WriteResult r = write(model);
  BOOST_TEST(r.losses.empty());
  BOOST_TEST(instances(r, "GEOMETRIC_CURVE_SET") == 1u);
  BOOST_TEST(instances(r, "TRIMMED_CURVE") == 2u);
  BOOST_TEST(count_of(r.bytes, "PARAMETER_VALUE(5.)") == 1u);
  BOOST_TEST(count_of(r.bytes, ",3.,1.)") == 1u);  // the long axis first
  BOOST_TEST(instances(r, "POLYLINE") == 1u);

  Line ray;
  ray.end = {1, 0, 0};
  ray.range = {0, infinity};
  part.curves.push_back({Curve{ray}, {}, {}});
  BOOST_TEST(write(model).losses.size() == 1u);
}

BOOST_AUTO_TEST_CASE(splines_are_clamped_and_stay_where_they_were) {
  const std::vector<Point> poles{{0, 0, 0}, {1, 2, 0}, {3, 2, 1}, {4, 0, 0}};
  const auto loose = NurbsCurve::from_cartesian(2, {0, 1, 2, 3, 4, 5, 6}, poles, {});
  BOOST_REQUIRE(loose);
  Model model = model_of({});
  model.parts[0].curves.push_back({Curve{*loose}, {}, {}});
  const io::WriteResult r = write(model);
  BOOST_TEST(count_of(r.bytes, "(3,1,3),(2.,3.,4.)") == 1u);
  const io::ReadResult back = io::read_bytes(r.bytes, "back.stp");
  BOOST_REQUIRE(back.model.parts[0].curves.size() == 1u);
  for (const double t : {2.0, 2.4, 3.0, 3.7, 4.0}) {
    BOOST_TEST(distance(evaluate(*loose, t), evaluate(back.model.parts[0].curves[0].curve, t)) < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(meshes_come_back_with_their_links_names_and_volume) {
  for (const char* name : {"tessellated_hybrid.stp", "tessellated_cube.stp", "tessellated_sets.stp"}) {
    BOOST_TEST_CONTEXT(name) {
      const io::ReadResult in = io::read(test::source_dir() / "tests" / "data" / "step" / name);
      const io::WriteResult written = write(in.model);
      BOOST_TEST(written.losses.empty());
      const io::ReadResult back = io::read_bytes(written.bytes, "back.stp");
      BOOST_REQUIRE(back.model.parts.size() == in.model.parts.size());
      for (std::size_t p = 0; p < in.model.parts.size(); ++p) {
        const auto &before = in.model.parts[p].meshes, &after = back.model.parts[p].meshes;
        BOOST_REQUIRE(before.size() == after.size());
        for (std::size_t m = 0; m < before.size(); ++m) {
          BOOST_TEST((before[m].kind == after[m].kind));
          BOOST_TEST((before[m].stands_for == after[m].stands_for));
          BOOST_TEST(before[m].lines.size() == after[m].lines.size());
          BOOST_TEST(area(before[m]) == area(after[m]), boost::test_tools::tolerance(1e-12));
          BOOST_TEST(open_sides(before[m]) == open_sides(after[m]));
          BOOST_REQUIRE(before[m].faces.size() == after[m].faces.size());
          for (std::size_t f = 0; f < before[m].faces.size(); ++f) {
            BOOST_TEST((before[m].faces[f].stands_for == after[m].faces[f].stands_for));
            BOOST_TEST(in.model[before[m].faces[f].attributes].name == back.model[after[m].faces[f].attributes].name);
          }
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_mirrored_mesh_keeps_its_outside) {
  const io::ReadResult in = io::read(test::source_dir() / "tests" / "data" / "step" / "tessellated_cube.stp");
  Model model = in.model;
  model.parts.insert(model.parts.begin(), Part{});
  model.parts[1].name = "cube";
  const PolygonMesh& cube = in.model.parts[0].meshes.at(0);
  Transform mirror = Transform::scale(2);
  mirror.r[0][0] = -2;
  model.parts[0].instances.push_back({1, mirror, {}, {}});
  const io::ReadResult back = io::read_bytes(write(model).bytes, "back.stp");
  BOOST_REQUIRE(back.model.parts.size() == 2u);
  BOOST_REQUIRE(back.model.parts[1].meshes.size() == 1u);
  const auto inside = volume(back.model.parts[1].meshes[0]), before = volume(cube);
  BOOST_REQUIRE((inside && before && *before > 0));
  BOOST_TEST(*inside == 8 * *before, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(a_number_that_is_not_finite_is_refused) {
  Model model = model_of({});
  model.parts[0].points.push_back({{1, infinity, 3}, {}, {}});
  io::WriteOptions options;
  options.format = io::Format::Step;
  BOOST_TEST(!io::encode(model, {}, options));
}

BOOST_AUTO_TEST_CASE(bodies_move_with_their_outside_outside) {
  Transform mirror;
  mirror.r[1][1] = -3, mirror.r[0][0] = 3, mirror.r[2][2] = 3;
  mirror.t = {5, 6, 7};
  for (const Body& body : {test::box({0, 0, 0}, {1, 2, 3}), test::cylinder({0, 1, 0}, 2, 5), test::cone({1, 0, 0}, 2, 5),
                           test::sphere({2, 0, 0}, 3), test::torus({0, 3, 0}, 5, 1)}) {
    const auto moved = transformed(body, mirror);
    BOOST_REQUIRE(moved);
    const auto broken = broken_promises(*moved, 1e-9);
    BOOST_TEST(broken.empty(), (broken.empty() ? std::string() : broken.front()));
    const double before = volume(body, ShellId{0})->value, after = volume(*moved, ShellId{0})->value;
    BOOST_TEST(after == 27 * before, boost::test_tools::tolerance(1e-8));
  }
}

// Three occurrences of a part with two bodies and a free curve: one as the part is, one of another colour on a layer, one hidden.
BOOST_AUTO_TEST_CASE(what_an_occurrence_says_of_itself_holds_for_it_alone) {
  Model model = model_of({});
  model.layer_names = {"", "tools"};
  model.parts.emplace_back();
  model.parts[1].name = "pin";
  model.parts[1].bodies = {test::cylinder({0, 0, 0}, 1, 2), test::plate(10, 10, {})};
  model.parts[1].bodies[0].attributes = model.add({"", Colour{0, 0, 1}, 0, true});
  model.parts[1].curves.push_back({Curve{Line{{0, 0, 0}, {3, 4, 0}}}, {}, {}});
  const auto place = [&](double x, const Attributes& a) { model.parts[0].instances.push_back({1, Transform::translation({x, 0, 0}), model.add(a), {}}); };
  place(0, {"plain", {}, 0, true});
  place(20, {"red", Colour{1, 0, 0}, 2, true});
  place(40, {"hidden", {}, 0, false});
  for (const io::StepSchema schema : {io::StepSchema::Ap242, io::StepSchema::Ap214}) {
    io::WriteOptions options;
    options.step_schema = schema;
    const io::WriteResult r = write(model, options);
    BOOST_TEST(r.losses.empty());
    const io::ReadResult again = io::read_bytes(r.bytes, "again.stp");
    BOOST_TEST(again.report.items().empty());
    BOOST_REQUIRE(again.model.parts[0].instances.size() == 3u);
    const auto of = [&](std::size_t i) { return again.model[again.model.parts[0].instances[i].attributes]; };
    BOOST_TEST((!of(0).colour && of(0).layer == 0 && of(0).visible && of(0).name == "plain"));
    BOOST_REQUIRE(of(1).colour.has_value());
    BOOST_TEST((of(1).colour->r == 1 && of(1).colour->b == 0 && of(1).visible));
    BOOST_REQUIRE(of(1).layer > 0);
    BOOST_TEST(again.model.layer_names.at(static_cast<std::size_t>(of(1).layer) - 1) == "tools");
    BOOST_TEST((!of(2).colour && !of(2).visible));
    const Part& pin = again.model.parts[again.model.parts[0].instances[0].part];
    BOOST_REQUIRE(pin.bodies.size() == 2u);
    for (const Body& body : pin.bodies) {  // the part itself is as it was
      const bool solid = body.kind == BodyKind::Solid;
      const Attributes& own = again.model[body.attributes];
      BOOST_TEST((own.visible && own.layer == 0 && own.colour.has_value() == solid));
      if (solid) BOOST_TEST(own.colour->b == 1);
    }
    const io::WriteResult second = write(again.model, options);
    BOOST_TEST(write(io::read_bytes(second.bytes, "third.stp").model, options).bytes.size() == second.bytes.size());  // nothing grows
  }
}

BOOST_AUTO_TEST_CASE(several_products_stay_roots_and_equal_names_stay_equal) {
  Model model = model_of({});
  for (int i = 0; i < 2; ++i) {
    model.parts.emplace_back();
    model.parts.back().name = "pin";
    model.parts.back().bodies = {test::box({0, 0, 0}, {1, 1, 1.0 + i})};
    model.parts[0].instances.push_back({static_cast<std::uint32_t>(i + 1), {}, {}, {}});
  }
  const io::WriteResult r = write(model);
  BOOST_TEST(instances(r, "PRODUCT") == 2u);
  BOOST_TEST(instances(r, "NEXT_ASSEMBLY_USAGE_OCCURRENCE") == 0u);
  const io::ReadResult again = io::read_bytes(r.bytes, "again.stp");
  BOOST_REQUIRE(again.model.parts.size() == 3u);
  BOOST_TEST((again.model.parts[1].name == "pin" && again.model.parts[2].name == "pin"));
  model.parts[0].instances[1].transform = Transform::translation({5, 0, 0});  // a placement needs something to be placed in
  BOOST_TEST(instances(write(model), "PRODUCT") == 3u);
}

BOOST_AUTO_TEST_CASE(a_vertex_off_all_its_edges_is_written_where_these_meet) {
  Body body = test::cylinder({0, 0, 0}, 1, 2);
  for (Vertex& v : body.vertices)
    if (v.point.z > 1) v.point = {5, 5, 2};
  const io::WriteResult r = write(model_of({body}));
  BOOST_TEST(count_of(r.bytes, "CARTESIAN_POINT('',(5.,5.,2.))") == 0u);
  const auto m = measure(io::read_bytes(r.bytes, "again.stp").model, {});
  BOOST_REQUIRE((m && m->volume_mm3));
  BOOST_TEST(std::abs(*m->volume_mm3 - 2 * pi) < 1e-9);
}

BOOST_AUTO_TEST_CASE(the_date_of_a_step_file_is_one_in_iges_too) {
  const Model model = model_of({test::box({0, 0, 0}, {1, 1, 1})});
  const auto date = [&](const std::string& stamp) {
    io::WriteOptions options;
    options.format = io::Format::Iges;
    options.timestamp = stamp;
    const io::ReadResult again = io::read_bytes(io::encode(model, {}, options)->bytes, "again.igs");
    for (const Diagnostic& d : again.report.items()) BOOST_TEST(d.rule->id != "IG-G20");
    return again.source.date;
  };
  BOOST_TEST(date("2026-11-25T04:05:06+01:00") == "20261125.040506");
  BOOST_TEST(date("20261125.040506") == "20261125.040506");
  BOOST_TEST(date("261125.040506") == "261125.040506");
  BOOST_TEST(date("last Tuesday") == "00010101.000000");
  BOOST_TEST(date("2026-11-25") == "00010101.000000");
}

// A closed sheet that lies on a solid is not a second solid.
BOOST_AUTO_TEST_CASE(closed_sheets_add_nothing_to_the_volume_of_solids) {
  Model model = model_of({test::box({0, 0, 0}, {1, 2, 3}), test::box({0, 0, 0}, {1, 2, 3})});
  model.parts[0].bodies[0].kind = BodyKind::Solid;
  model.parts[0].bodies[1].kind = BodyKind::Sheet;
  BOOST_TEST(*measure(model, {})->volume_mm3 == 6, boost::test_tools::tolerance(1e-12));
  model.parts[0].bodies.erase(model.parts[0].bodies.begin());
  BOOST_TEST(*measure(model, {})->volume_mm3 == 6, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
