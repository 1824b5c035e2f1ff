// Bodies, subfigures, groups, ownership, attributes; what is not carried over is said.

#include <fmt/format.h>

#include "tests/io/iges/imported.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

const auto nearly = boost::test_tools::tolerance(1e-6);

std::string number(double x) { return std::to_string(x); }

// A tetrahedron with corners at the origin and 1 along each axis, as a 186 or its 514 alone.
struct Tetrahedron {
  int vertices, edges, shell;
};
Tetrahedron add_tetrahedron(IgesText& file, const char* shell_status = dependent, bool turned = false) {
  const Point p[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const int sides[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  Tetrahedron t{};
  t.vertices = file.add(502, "4,0.,0.,0.,1.,0.,0.,0.,1.,0.,0.,0.,1.", {.form = 1, .status = dependent});
  std::string edges = "6";
  for (const auto& s : sides) {
    const Point a = p[s[0]], b = p[s[1]];
    const int line = file.add(110, number(a.x) + "," + number(a.y) + "," + number(a.z) + "," + number(b.x) + "," +
                                       number(b.y) + "," + number(b.z), {.status = dependent});
    edges += fmt::format(",{},{},{},{},{}", line, t.vertices, s[0] + 1, t.vertices, s[1] + 1);
  }
  t.edges = file.add(504, edges, {.form = 1, .status = dependent});
  // Counter-clockwise from outside: edge number from 1, sign for the direction. Each face has its outward plane (190).
  const int loops[4][3] = {{-3, -2, -1}, {1, 5, -4}, {2, 6, -5}, {3, 4, -6}};
  const char* normals[4] = {"0.,0.,-1.", "0.,-1.,0.", "1.,1.,1.", "-1.,0.,0."};
  const int origins[4] = {0, 0, 1, 0};
  std::string shell = "4";
  for (int f = 0; f < 4; ++f) {
    std::string loop = "3";
    for (const int e : loops[f])
      loop += ",0," + std::to_string(t.edges) + "," + std::to_string(std::abs(e)) + "," + (e > 0 ? "1" : "0") + ",0";
    const int l = file.add(508, loop, {.form = 1, .status = dependent});
    const Point o = p[origins[f]];
    const int at = file.add(116, number(o.x) + "," + number(o.y) + "," + number(o.z) + ",0", {.status = dependent});
    const int n = file.add(123, normals[f], {.status = dependent});
    const int s = file.add(190, "{},{}", {.status = dependent}, {at, n});
    const int face = file.add(510, "{},1,1,{}", {.form = 1, .status = dependent}, {s, l});
    shell += fmt::format(",{},{}", face, turned ? 0 : 1);
  }
  t.shell = file.add(514, shell, {.form = 1, .status = shell_status});
  return t;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(structure)

BOOST_AUTO_TEST_CASE(a_solid_shares_edges_and_vertices_as_the_file_does) {
  IgesText file;
  const Tetrahedron t = add_tetrahedron(file);
  file.add(186, "{},1,0", {}, {t.shell});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_REQUIRE_EQUAL(in.root().bodies.size(), 1u);
  const Body& body = in.root().bodies[0];
  BOOST_TEST((body.kind == BodyKind::Solid));
  BOOST_TEST(body.faces.size() == 4u);
  BOOST_TEST(body.edges.size() == 6u);
  BOOST_TEST(body.vertices.size() == 4u);
  BOOST_REQUIRE_EQUAL(body.shells.size(), 1u);
  BOOST_TEST(body.shells[0].closed);
  BOOST_TEST(in.area() == 1.5 + std::sqrt(3.0) / 2, nearly);
  const auto v = volume(body, ShellId{0});
  BOOST_REQUIRE(v);
  BOOST_TEST(v->value == 1.0 / 6, nearly);
  BOOST_TEST(in.root().curves.empty());
  BOOST_TEST(in.root().points.empty());
}

BOOST_AUTO_TEST_CASE(orientation_flags_of_shell_and_solid_turn_faces) {
  for (const bool faces_turned : {false, true}) {
    for (const bool shell_turned : {false, true}) {
      IgesText file;
      const Tetrahedron t = add_tetrahedron(file, dependent, faces_turned);
      file.add(186, shell_turned ? "{},0,0" : "{},1,0", {}, {t.shell});
      const Imported in = imported(file);
      const auto v = volume(in.root().bodies.at(0), ShellId{0});
      BOOST_REQUIRE(v);
      BOOST_TEST(v->value == (faces_turned == shell_turned ? 1.0 : -1.0) / 6, nearly);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_shell_that_no_solid_uses_is_a_sheet) {
  IgesText file;
  add_tetrahedron(file, "00000000");
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST((in.root().bodies.at(0).kind == BodyKind::Sheet));
  BOOST_TEST(in.faces().size() == 4u);
}

BOOST_AUTO_TEST_CASE(faces_of_a_solid_without_shell_still_appear) {
  IgesText file;
  const Tetrahedron t = add_tetrahedron(file);
  file.add(186, "{},1,0", {}, {t.vertices});  // points at the wrong thing
  const Imported in = imported(file);
  BOOST_TEST(in.faces().size() == 4u);
  BOOST_TEST(in.has("IG-R03"));
}

BOOST_AUTO_TEST_CASE(an_edge_index_outside_the_list_fails_that_face_only) {
  IgesText file;
  const Tetrahedron t = add_tetrahedron(file);
  file.add(186, "{},1,0", {}, {t.shell});
  for (IgesEntity& e : file.entities)
    if (e.type == 508) {
      e.parameters = "1,0," + std::to_string(t.edges) + ",7,1,0";
      break;
    }
  const Imported in = imported(file);
  BOOST_REQUIRE_EQUAL(in.faces().size(), 4u);
  BOOST_TEST((in.face(0).status == FaceStatus::Failed));
  BOOST_TEST((in.face(1).status != FaceStatus::Failed));
  BOOST_TEST(in.has("IG-E508-01"));
}

BOOST_AUTO_TEST_CASE(a_surface_nobody_points_at_is_a_face_of_its_own) {
  IgesText file;
  file.add(128,
           "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,8.,0.,0.,0.,4.,0.,8.,4.,0.,0.,1.,0.,1.",
           {.status = dependent});
  const Imported in = imported(file);
  BOOST_TEST(in.faces().size() == 1u);
  BOOST_TEST(in.finding("IG-R09").entity == "D1");
}

BOOST_AUTO_TEST_CASE(definitions_are_drawn_only_where_they_are_placed) {
  IgesText file;
  const int line = file.add(110, "0.,0.,0.,1.,0.,0.", {.status = dependent});
  const int arm = file.add(308, "0,3Harm,1,{}", {.status = "00000200"}, {line});
  const int use = file.add(408, "{},0.,0.,0.,1.", {.status = dependent}, {arm});
  const int body = file.add(308, "1,4Hbody,2,{},{}", {.status = "00000200"}, {use, use});
  file.add(408, "{},0.,0.,0.,1.", {}, {body});
  file.add(408, "{},0.,0.,10.,1.", {}, {body});
  const Imported in = imported(file);
  const auto n = count(in.model);
  BOOST_REQUIRE(n);
  BOOST_TEST(n->curves == 4u);  // two bodies with two arms each
  BOOST_TEST(!in.has("IG-R06"));
}

BOOST_AUTO_TEST_CASE(a_definition_inside_itself_is_cut) {
  IgesText file;
  const int line = file.add(110, "0.,0.,0.,1.,0.,0.", {.status = dependent});
  file.add(308, "1,1Ha,2,{},7", {.status = "00000200"}, {line});  // D3 holds the instance D7
  file.add(308, "1,1Hb,1,9", {.status = "00000200"});             // D5 holds D9
  file.add(408, "5,0.,0.,0.,1.", {.status = dependent});           // D7: b in a
  file.add(408, "3,0.,0.,0.,1.", {.status = dependent});           // D9: a in b
  file.add(408, "3,0.,0.,0.,1.");
  const Imported in = imported(file);
  BOOST_TEST(in.has("IG-R07"));
  const auto n = count(in.model);
  BOOST_REQUIRE(n);
  BOOST_TEST(n->curves == 1u);
}

BOOST_AUTO_TEST_CASE(forty_levels_of_doubling_end_at_once) {
  IgesText file;
  int inner = file.add(308, "0,1Hp,1,{}", {.status = "00000200"}, {file.add(116, "0.,0.,0.,0", {.status = dependent})});
  for (int i = 1; i <= 40; ++i) {
    const int a = file.add(408, "{},1.,0.,0.,1.", {.status = dependent}, {inner});
    const int b = file.add(408, "{},2.,0.,0.,1.", {.status = dependent}, {inner});
    inner = file.add(308, std::to_string(i) + ",1Hp,2,{},{}", {.status = "00000200"}, {a, b});
  }
  file.add(408, "{},0.,0.,0.,1.", {}, {inner});
  const Imported in = imported(file);
  BOOST_TEST(in.has("IG-R08"));
  const auto n = count(in.model);
  BOOST_REQUIRE(n);  // what is left is within the limits
  BOOST_TEST(n->points <= 1'000'000u);
}

BOOST_AUTO_TEST_CASE(groups_name_bodies_and_keep_their_members_apart) {
  IgesText file;
  const auto plane = [&](double z) {
    const int rim = file.add(100, number(z) + ",0.,0.,3.,0.,3.,0.", {.status = dependent});
    return file.add(108, "0.,0.,1.," + number(z) + ",{},0.,0.,0.,0.", {.form = 1}, {rim});
  };
  const int a = plane(0), b = plane(1);
  plane(2);
  const int name = file.add(406, "1,5Hgroup", {.form = 15});
  file.add(402, "2,{},{},0,1,{}", {.form = 7}, {a, b, name});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_REQUIRE_EQUAL(in.root().bodies.size(), 2u);
  BOOST_TEST(in.root().bodies[0].faces.size() == 2u);
  BOOST_TEST(in.model[in.root().bodies[0].attributes].name == "group");
  BOOST_TEST(in.root().bodies[1].faces.size() == 1u);
}

BOOST_AUTO_TEST_CASE(names_colours_levels_and_visibility_are_kept) {
  IgesText file;
  const int orange = file.add(314, "100.,50.,0.,6Horange");
  const int name = file.add(406, "1,4Hedge", {.form = 15});
  file.add(110, "0.,0.,0.,1.,0.,0.,0,1,{}", {.colour = -orange, .level = 7}, {name});
  file.add(110, "0.,0.,0.,1.,0.,0.", {.status = "01000000", .colour = 3});
  const Imported in = imported(file);
  BOOST_REQUIRE_EQUAL(in.root().curves.size(), 2u);
  const Attributes& first = in.model[in.root().curves[0].attributes];
  BOOST_TEST(first.name == "edge");
  BOOST_REQUIRE(first.colour);
  BOOST_TEST(first.colour->r == 1.0);
  BOOST_TEST(first.colour->g == 0.5);
  BOOST_TEST(first.layer == 7);
  BOOST_TEST(first.visible);
  const Attributes& second = in.model[in.root().curves[1].attributes];
  BOOST_TEST(!second.visible);
  BOOST_REQUIRE(second.colour);
  BOOST_TEST(second.colour->g == 1.0);
}

BOOST_AUTO_TEST_CASE(the_hierarchy_status_decides_whose_colour_counts) {
  for (const bool owner_decides : {true, false}) {
    IgesText file;
    const Tetrahedron t = add_tetrahedron(file);
    for (IgesEntity& e : file.entities)
      if (e.type == 510) e.colour = 3;
    file.add(186, "{},1,0", {.status = owner_decides ? "00000000" : "00000001", .colour = 2}, {t.shell});
    const Imported in = imported(file);
    const Attributes& a = in.model[in.face(0).attributes];
    BOOST_REQUIRE(a.colour);
    BOOST_TEST((a.colour->r == 1.0) == owner_decides);
  }
}

BOOST_AUTO_TEST_CASE(what_has_no_place_in_the_model_is_named_by_type) {
  IgesText file;
  file.add(158, "1.,0.,0.,0.");
  file.add(161, "1.,0.,0.,0.");  // of an older standard
  file.add(161, "2.,0.,0.,0.");
  file.add(136, "1,0,4HROOT");  // a finite element
  const Imported in = imported(file);
  BOOST_TEST(in.report.count("MD-12") == 1u);
  BOOST_TEST(in.finding("MD-12").measured == 2.0);
  BOOST_TEST(in.has("MD-13"));
  BOOST_TEST(in.faces().size() == 1u);
}

BOOST_AUTO_TEST_CASE(profiles_and_clip_planes_are_not_shapes_of_their_own) {
  IgesText file;
  const int arc = file.add(100, "0.,0.,0.,1.,0.,1.,0.", {.status = dependent});
  file.add(164, "{},5.,0.,0.,1.", {}, {arc});
  const int plane = file.add(108, "0.,0.,1.,5.,0,0.,0.,0.,0.");
  file.add(410, "1,1.,{},0,0,0,0,0", {}, {plane});
  const Imported in = imported(file);
  BOOST_TEST(in.root().curves.empty());
  BOOST_TEST(in.faces().size() == 3u);
}

BOOST_AUTO_TEST_CASE(what_stands_in_a_drawing_is_not_in_the_model) {
  IgesText file;
  const int frame = file.add(110, "0.,0.,0.,297.,0.,0.", {.status = "00010100"});
  const int view = file.add(410, "1,1.,0,0,0,0,0,0");
  file.add(404, "1,{},0.,0.,1,{}", {}, {view, frame});
  const int circle = file.add(100, "0.,0.,0.,1.,0.,1.,0.", {.status = "00010100"});
  file.add(228, "0,1,{},0", {}, {circle});
  file.add(110, "0.,0.,0.,1.,0.,0.");
  const Imported in = imported(file);
  BOOST_TEST(in.root().curves.size() == 1u);
  BOOST_TEST(!in.has("IG-R09"));
}

BOOST_AUTO_TEST_CASE(hidden_models_say_so) {
  IgesText file;
  file.add(110, "0.,0.,0.,1.,0.,0.", {.status = "01000000"});
  BOOST_TEST(imported(file).has("MD-02"));
}

BOOST_AUTO_TEST_SUITE_END()
