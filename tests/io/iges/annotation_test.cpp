// Drafting entities as strokes and runs of text; drawings, views, fonts, weights and levels.
#include "tests/io/iges/imported.h"

using namespace trimloop;
using namespace trimloop::test;

BOOST_AUTO_TEST_SUITE(annotation)

BOOST_AUTO_TEST_CASE(a_note_is_runs_of_text) {
  IgesText file;
  file.add(212, "2,5,10.,2.,1,1.5707963267948966,0.,0,0,1.,2.,3.,5Hhello,2,4.,2.,1,1.2,1.5707963267948966,1,1,0.,0.,0.,2Hab");
  const Imported in = imported(file);
  BOOST_REQUIRE(in.root().annotation.size() == 1u);
  const Annotation& a = in.root().annotation[0];
  BOOST_TEST(a.kind == "General Note");
  BOOST_REQUIRE(a.texts.size() == 2u);
  BOOST_TEST(a.texts[0].text == "hello");
  check_point(a.texts[0].origin, {1, 2, 3});
  BOOST_TEST(a.texts[0].along.x == 10);
  BOOST_TEST(a.texts[0].up.y == 2);
  BOOST_TEST(std::abs(a.texts[1].along.y + 4) < 1e-12);  // turned by a quarter, then mirrored
  BOOST_TEST(a.texts[1].vertical);
  BOOST_TEST(a.texts[1].slant_rad == 1.2);
}

BOOST_AUTO_TEST_CASE(a_dimension_draws_all_its_parts_once) {
  IgesText file;
  const int at = file.add(124, "1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,5.");
  const int note = file.add(212, "1,2,4.,2.,1,1.5707963267948966,0.,0,0,4.,1.,0.,2H10", {.status = "00010100"});
  const int left = file.add(214, "1,1.,.5,0.,0.,0.,5.,0.", {.form = 2, .status = "00010100"});
  const int right = file.add(214, "1,1.,.5,0.,10.,0.,5.,0.", {.form = 4, .status = "00010100"});
  const int witness = file.add(106, "1,3,0.,0.,-5.,0.,-4.,0.,1.", {.form = 40, .status = "00010100"});
  file.add(216, "{},{},{},{},0", {.status = "00000100", .transform = at}, {note, left, right, witness});
  const Imported in = imported(file);
  BOOST_REQUIRE(in.root().annotation.size() == 1u);
  const Annotation& a = in.root().annotation[0];
  BOOST_TEST(a.texts.size() == 1u);
  check_point(a.texts[0].origin, {4, 1, 5});
  BOOST_REQUIRE(a.strokes.size() == 4u);  // a triangle and two leaders, one witness line
  BOOST_TEST(a.strokes[0].size() == 4u);
  check_point(a.strokes[3][0], {0, -4, 5});
  check_point(a.strokes[3][1], {0, 1, 5});
  BOOST_TEST(!in.has("MD-13"));
}

BOOST_AUTO_TEST_CASE(leaders_of_an_angular_dimension_are_arcs) {
  IgesText file;
  const int note = file.add(212, "1,2,4.,2.,1,1.5,0.,0,0,4.,1.,0.,2H90", {.status = "00010100"});
  const int arrow = file.add(214, "1,1.,.5,0.,5.,0.,0.,5.", {.form = 4, .status = "00010100"});
  file.add(202, "{},0,0,0.,0.,5.,{},0", {}, {note, arrow});
  const Imported in = imported(file);
  BOOST_REQUIRE(in.root().annotation.size() == 1u);
  BOOST_REQUIRE(in.root().annotation[0].strokes.size() == 1u);
  for (const Point& p : in.root().annotation[0].strokes[0]) BOOST_TEST(std::abs(std::hypot(p.x, p.y) - 5) < 1e-12);
}

BOOST_AUTO_TEST_CASE(sections_are_hatched_around_their_islands) {
  IgesText file;
  const int border = file.add(106, "1,5,0.,0.,0.,10.,0.,10.,10.,0.,10.,0.,0.", {.form = 63, .status = "00010100"});
  const int island = file.add(106, "1,5,0.,4.,4.,6.,4.,6.,6.,4.,6.,4.,4.", {.form = 63, .status = "00010100"});
  file.add(230, "{},1,0.,.5,0.,1.,0.,1,{}", {}, {border, island});
  const Imported in = imported(file);
  BOOST_REQUIRE(in.root().annotation.size() == 1u);
  // Lines at y = 0.5 ... 9.5; those at 4.5 and 5.5 are cut in two.
  BOOST_TEST(in.root().annotation[0].strokes.size() == 2u + 8u + 4u);
  BOOST_TEST(in.root().curves.empty());
}

BOOST_AUTO_TEST_CASE(every_drafting_entity_shows_something) {
  const struct {
    int type, form;
    const char* parameters;
    std::size_t strokes;
  } cases[] = {{106, 20, "1,4,0.,0.,0.,1.,0.,2.,0.,3.,0.", 2}, {106, 21, "1,2,0.,0.,0.,1.,0.", 1},
               {106, 31, "1,4,0.,0.,0.,1.,0.,0.,1.,1.,1.", 2}, {106, 40, "1,3,0.,0.,0.,1.,0.,2.,0.", 1},
               {204, 0, "1,5,0,3,0,0,0", 3},                   {206, 0, "1,3,0,0.,0.", 2},
               {208, 0, "0.,0.,0.,0.,1,1,3", 3},               {210, 0, "1,1,3", 2},
               {218, 0, "1,3", 2},                             {218, 1, "1,3,3", 4},
               {220, 0, "1,3,5", 3},                           {222, 0, "1,3,0.,0.", 2},
               {222, 1, "1,3,0.,0.,3", 4},                     {228, 1, "1,1,5,1,3", 3}};
  for (const auto& c : cases) {
    IgesText file;
    file.add(212, "1,2,4.,2.,1,1.5,0.,0,0,4.,1.,0.,2H90", {.status = "00010100"});
    file.add(214, "1,1.,.5,0.,5.,0.,0.,5.", {.form = 1, .status = "00010100"});
    file.add(110, "0.,0.,0.,1.,0.,0.", {.status = "00010100"});
    file.add(c.type, c.parameters, {.form = c.form});
    const Imported in = imported(file);
    BOOST_REQUIRE(!in.root().annotation.empty());
    BOOST_TEST(in.root().annotation.back().strokes.size() == c.strokes, c.type << ":" << c.form);
  }
}

BOOST_AUTO_TEST_CASE(drawings_place_their_views) {
  IgesText file;
  const int turned = file.add(124, "0.,1.,0.,0.,-1.,0.,0.,0.,0.,0.,1.,0.");
  const int view = file.add(410, "3,.5,0,0,0,0,0,0", {.transform = turned});
  const int note = file.add(212, "1,2,4.,2.,1,1.5,0.,0,0,4.,1.,0.,2Hab", {.status = "00010100"});
  const int size = file.add(406, "2,420.,297.", {.form = 16});
  const int name = file.add(406, "1,5Hsheet", {.form = 15});
  file.add(404, "1,{},100.,50.,.5,1,{},0,2,{},{}", {.form = 1}, {view, note, size, name});
  const Imported in = imported(file);
  BOOST_REQUIRE(in.model.views.size() == 1u);
  BOOST_TEST(in.model.views[0].number == 3);
  BOOST_TEST(in.model.views[0].scale == 0.5);
  BOOST_REQUIRE(in.model.drawings.size() == 1u);
  const Drawing& d = in.model.drawings[0];
  BOOST_TEST(d.name == "sheet");
  BOOST_TEST(d.width_mm == 420);
  BOOST_TEST(d.height_mm == 297);
  BOOST_REQUIRE(d.views.size() == 1u);
  BOOST_TEST(d.views[0].origin.u == 100);
  BOOST_TEST(d.views[0].angle_rad == 0.5);
  BOOST_REQUIRE(d.annotation.size() == 1u);
  BOOST_TEST(in.root().annotation.empty());
}

BOOST_AUTO_TEST_CASE(fonts_weights_and_level_names_are_kept) {
  IgesText file;
  const int font = file.entities.empty() ? file.add({.type = 304, .parameters = "2,1.,2.,2H01", .form = 2, .line_font = 2}) : 0;
  file.add({.type = 110, .parameters = "0.,0.,0.,1.,0.,0.", .line_font = 4, .line_weight = 1});
  file.add({.type = 110, .parameters = "0.,0.,0.,2.,0.,0.", .line_font = -font});
  file.add({.type = 406, .parameters = "2,0,5Hwalls", .form = 3, .level = 7});
  const Imported in = imported(file);
  BOOST_REQUIRE(in.root().curves.size() == 2u);
  const Attributes& first = in.model[in.root().curves[0].attributes];
  BOOST_TEST(first.line_font == 4);
  BOOST_TEST(first.line_weight_mm == 1.0);  // one gradation of a largest width of 1
  BOOST_TEST(in.model[in.root().curves[1].attributes].line_font == 2);
  BOOST_REQUIRE(in.model.layer_names.size() == 7u);
  BOOST_TEST(in.model.layer_names[6] == "walls");
}

BOOST_AUTO_TEST_SUITE_END()
