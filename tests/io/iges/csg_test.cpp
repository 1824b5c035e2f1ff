// Primitives, swept solids, trees, assemblies, instances and arrays, each with its closed-form answer.
#include "tests/io/iges/imported.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

double volume_of(const Imported& in) {
  const auto measures = measure(in.model, Limits{});
  BOOST_REQUIRE(measures);
  BOOST_REQUIRE(measures->volume_mm3);
  return *measures->volume_mm3;
}

void check_volume(const IgesText& file, double wanted) {
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(!in.has("MD-12"), (in.has("MD-12") ? in.finding("MD-12").text : ""));
  const double v = volume_of(in);
  BOOST_TEST(std::abs(v - wanted) <= 1e-7 * wanted, v << " is not " << wanted);
}

struct Primitive {
  int type;
  const char* parameters;
  double volume;
};
const Primitive primitives[] = {
    {150, "2.,3.,4.", 24},
    {150, "2.,3.,4.,1.,1.,1.,0.,1.,0.,0.,0.,1.", 24},
    {152, "4.,3.,2.,1.,0.,0.,0.,1.,0.,0.,0.,0.,1.", 15},
    {152, "4.,3.,2.,0.", 12},
    {154, "5.,2.", 20 * pi},
    {154, "5.,2.,1.,2.,3.,1.,1.,1.", 20 * pi},
    {156, "4.,3.,1.", pi * 4 / 3 * 13},
    {156, "4.,3.", 12 * pi},
    {158, "3.", 36 * pi},
    {158, "3.,1.,2.,3.", 36 * pi},
    {160, "5.,2.", 40 * pi * pi},
    {160, "5.,2.,1.,0.,0.,0.,1.,0.", 40 * pi * pi},
    {168, "4.,3.,2.", 32 * pi},
    {168, "4.,3.,2.,1.,0.,0.,0.,1.,0.,1.,0.,0.", 32 * pi},
};

}  // namespace

BOOST_AUTO_TEST_SUITE(csg)

BOOST_AUTO_TEST_CASE(primitives_are_solids) {
  for (const Primitive& p : primitives) {
    for (const char* matrix : {"", "1.,0.,0.,7.,0.,1.,0.,8.,0.,0.,1.,9.", "0.,-1.,0.,0.,1.,0.,0.,0.,0.,0.,1.,0.", "-1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0."}) {
      IgesText file;
      const int at = *matrix ? file.add(124, matrix, {.form = matrix[0] == '-' ? 1 : 0}) : 0;
      file.add(p.type, p.parameters, {.transform = at});
      BOOST_TEST_CONTEXT(p.type << " " << p.parameters << " under " << matrix) check_volume(file, p.volume);
    }
  }
}

BOOST_AUTO_TEST_CASE(primitives_stand_where_the_file_puts_them) {
  IgesText file;
  file.add(150, "2.,3.,4.,1.,1.,1.,0.,1.,0.,0.,0.,1.");  // x axis along y; y = z cross x = -x
  const Imported in = imported(file);
  const auto m = measure(in.model, Limits{});
  BOOST_REQUIRE(m);
  check_point(m->box.lo, {-2, 1, 1}, 1e-9);
  check_point(m->box.hi, {1, 3, 5}, 1e-9);
}

BOOST_AUTO_TEST_CASE(impossible_primitives_are_named) {
  for (const auto& [type, parameters] : {std::pair{150, "2.,-3.,4."}, {156, "4.,1.,3."}, {160, "2.,2."}, {158, "0."}}) {
    IgesText file;
    file.add(type, parameters);
    BOOST_TEST(imported(file).has("IG-E150-01"));
  }
}

BOOST_AUTO_TEST_CASE(profiles_are_swept) {
  {
    IgesText file;
    const int circle = file.add(100, "0.,0.,0.,2.,0.,2.,0.", {.status = dependent});
    file.add(164, "{},5.", {}, {circle});
    check_volume(file, 20 * pi);
  }
  {
    IgesText file;  // pushed at an angle: base times height
    const int square = file.add(106, "1,5,0.,0.,0.,2.,0.,2.,2.,0.,2.,0.,0.", {.form = 63, .status = dependent});
    file.add(164, "{},5.,3.,0.,4.", {}, {square});
    check_volume(file, 4 * 4);
  }
  {
    IgesText file;  // form 0: closed to the axis
    const int side = file.add(110, "2.,0.,0.,2.,0.,3.", {.status = dependent});
    file.add(162, "{},1.,0.,0.,0.,0.,0.,1.", {}, {side});
    check_volume(file, 12 * pi);
  }
  {
    IgesText file;  // a quarter of it
    const int side = file.add(110, "2.,0.,0.,2.,0.,3.", {.status = dependent});
    file.add(162, "{},.25", {}, {side});
    check_volume(file, 3 * pi);
  }
  {
    IgesText file;  // form 1: closed on itself, beside the axis
    const int circle = file.add(100, "0.,5.,0.,7.,0.,7.,0.", {.status = dependent});
    file.add(162, "{},1.,0.,0.,0.,0.,1.,0.", {.form = 1}, {circle});
    check_volume(file, 40 * pi * pi);
  }
}

BOOST_AUTO_TEST_CASE(profiles_that_cannot_be_turned_say_why) {
  const struct {
    const char *points, *why;
  } cases[] = {{"1,5,0.,-1.,0.,2.,0.,2.,3.,-1.,3.,-1.,0.", "the profile crosses the axis"},
               {"1,3,0.,0.,0.,0.,2.,0.,0.", "the profile lies on the axis"},
               {"1,4,1.,2.,0.,3.,0.,2.,3.,2.,0.", "the profile does not lie in a plane with the axis"}};
  for (const auto& c : cases) {
    IgesText file;
    const int profile = file.add(106, c.points, {.form = 63, .status = dependent});
    file.add(162, "{},1.,0.,0.,0.,0.,1.,0.", {.form = 1}, {profile});
    const Imported in = imported(file);
    BOOST_REQUIRE(in.has("MD-12"));
    BOOST_TEST(in.finding("MD-12").text.find(c.why) != std::string::npos, in.finding("MD-12").text);
    BOOST_TEST(count(in.model)->solids == 0u);
  }
}

BOOST_AUTO_TEST_CASE(trees_are_carried_out) {
  struct Tree {
    const char* terms;
    double volume;
  };
  const double ball = 4 * pi / 3;
  for (const Tree& t : {Tree{"3,-{},-{},1", 8 + ball * 7 / 8}, {"3,-{},-{},2", ball / 8}, {"3,-{},-{},3", 8 - ball / 8}}) {
    IgesText file;
    const int block = file.add(150, "2.,2.,2.", {.status = dependent});
    const int sphere = file.add(158, "1.", {.status = dependent});
    file.add(180, t.terms, {}, {block, sphere});
    BOOST_TEST_CONTEXT(t.terms) check_volume(file, t.volume);
  }
}

BOOST_AUTO_TEST_CASE(trees_nest_and_stand_under_their_matrices) {
  IgesText file;
  const int block = file.add(150, "4.,4.,4.", {.status = dependent});
  const int drill = file.add(154, "10.,.5,2.,2.,-3.", {.status = dependent});
  const int there = file.add(124, "1.,0.,0.,100.,0.,1.,0.,0.,0.,0.,1.,0.");
  const int drilled = file.add(180, "3,-{},-{},3", {.status = dependent}, {block, drill});
  const int side = file.add(124, "0.,0.,1.,0.,0.,1.,0.,0.,-1.,0.,0.,4.");  // a quarter about y: z becomes x
  const int across = file.add(430, "{}", {.status = dependent, .transform = side}, {drill});
  file.add(180, "3,-{},-{},3", {.transform = there}, {drilled, across});
  const Imported in = imported(file);
  in.check_sound();
  BOOST_TEST(!in.has("MD-12"));
  const auto m = measure(in.model, Limits{});
  BOOST_REQUIRE(m && m->volume_mm3);
  check_point(m->box.lo, {100, 0, 0}, 1e-6);
  const double wanted = 64 - 2 * pi + 16.0 / 3 / 8;  // two holes that cross: Steinmetz, 16 r^3 / 3
  BOOST_TEST(std::abs(*m->volume_mm3 - wanted) <= 1e-7 * wanted, *m->volume_mm3 << " is not " << wanted);
}

BOOST_AUTO_TEST_CASE(a_component_of_a_tree_is_selected) {
  IgesText file;
  const int bar = file.add(150, "10.,1.,1.", {.status = dependent});
  const int gap = file.add(150, "2.,3.,3.,3.,-1.,-1.", {.status = dependent});
  const int cut = file.add(180, "3,-{},-{},3", {.status = dependent}, {bar, gap});
  file.add(182, "{},8.,.5,.5", {}, {cut});
  check_volume(file, 5);
  IgesText nowhere = file;
  nowhere.add(182, "{},4.,.5,.5", {}, {cut});  // in the gap
  BOOST_TEST(imported(nowhere).has("MD-12"));
}

BOOST_AUTO_TEST_CASE(ten_operators_one_after_another) {
  IgesText file;
  std::string text = "21,-" + std::to_string(file.add(150, "22.,4.,2.", {.status = dependent}));
  for (int i = 0; i < 10; ++i) {
    const int drill = file.add(154, "4.,.75," + std::to_string(2 * i + 2) + ".,2.,-1.", {.status = dependent});
    text += ",-" + std::to_string(drill) + ",3";
  }
  file.add(180, text);
  check_volume(file, 22 * 4 * 2 - 10 * 2 * pi * 0.5625);
}

BOOST_AUTO_TEST_CASE(operands_of_an_undecided_tree_are_there_and_the_loss_is_said) {
  IgesText file;
  const int block = file.add(150, "2.,2.,2.", {.status = dependent});
  const int nothing = file.add(156, "4.,1.,3.", {.status = dependent});  // impossible radii
  file.add(180, "3,-{},-{},3", {}, {block, nothing});
  const Imported in = imported(file);
  BOOST_TEST(count(in.model)->solids == 1u);
  BOOST_TEST(in.has("MD-12"));
}

BOOST_AUTO_TEST_CASE(trees_that_are_no_expressions_are_named) {
  for (const char* terms : {"3,-{},1,-{}", "1,1", "3,-{},-{},4", "2,-{},-{}"}) {
    IgesText file;
    const int ball = file.add(158, "1.");
    file.add(180, terms, {}, {ball, ball});
    BOOST_TEST(imported(file).has("IG-E180-01"), terms);
  }
}

BOOST_AUTO_TEST_CASE(assemblies_and_instances_place_their_solids) {
  IgesText file;
  const int ball = file.add(158, "1.", {.status = dependent});
  const int at = file.add(124, "1.,0.,0.,10.,0.,1.,0.,0.,0.,0.,1.,0.");
  const int turned = file.add(124, "0.,-1.,0.,0.,1.,0.,0.,0.,0.,0.,1.,0.");
  file.add(184, "2,{},{},0,{}", {.transform = turned}, {ball, ball, at});
  file.add(430, "{}", {.transform = at}, {ball});
  const Imported in = imported(file);
  const auto m = measure(in.model, Limits{});
  BOOST_REQUIRE(m);
  check_point(m->box.lo, {-1, -1, -1}, 1e-6);
  check_point(m->box.hi, {11, 11, 1}, 1e-6);
  BOOST_TEST(count(in.model)->solids == 3u);
}

BOOST_AUTO_TEST_CASE(arrays_make_their_copies) {
  IgesText file;
  const int point = file.add(116, "0.,0.,0.,0", {.status = dependent});
  file.add(412, "{},1.,1.,2.,3.,3,2,10.,5.,0.,0,0", {}, {point});
  file.add(412, "{},1.,1.,2.,3.,3,2,10.,5.,1.5707963267948966,2,1,2,3", {}, {point});  // all but 2 and 3, turned
  file.add(414, "{},4,0.,0.,7.,2.,0.,1.5707963267948966,1,0,2", {}, {point});          // only the second
  const Imported in = imported(file);
  std::vector<Point> points;
  const auto all = occurrences(in.model, 1000, 10);
  BOOST_REQUIRE(all);
  for (const Occurrence& o : *all)
    for (const FreePoint& p : in.model.parts[o.part].points) points.push_back(apply(o.transform, p.point));
  BOOST_REQUIRE(points.size() == 6u + 4u + 1u);
  check_point(points[0], {1, 2, 3});
  check_point(points[1], {1, 7, 3});   // up the first column
  check_point(points[2], {11, 2, 3});  // then the second
  check_point(points[5], {21, 7, 3});
  check_point(points[6], {1, 2, 3});
  check_point(points[7], {-4, 12, 3});  // position 4: (10, 5) turned by a quarter
  check_point(points[10], {0, 2, 7});
}

BOOST_AUTO_TEST_CASE(arrays_and_trees_without_bound_end_at_once) {
  {
    IgesText file;
    const int point = file.add(116, "0.,0.,0.,0", {.status = dependent});
    file.add(412, "{},1.,0.,0.,0.,2147483647,2147483647,1.,1.,0.,0,0", {}, {point});
    BOOST_TEST(imported(file).has("IG-R08"));
  }
  {
    IgesText file;
    file.add(412, "{},1.,0.,0.,0.,2,2,1.,1.,0.,0,0", {}, {1});  // of itself
    file.add(180, "3,-{},-{},1", {}, {3, 3});                    // of itself
    file.add(184, "1,{},0", {}, {5});                            // of itself
    file.add(430, "{}", {}, {9});                                // of each other
    file.add(430, "{}", {}, {7});
    const Imported in = imported(file);
    BOOST_TEST(occurrences(in.model, 1000, 64).has_value());
  }
  {
    IgesText file;  // arrays of arrays of arrays ...: 100^8
    int base = file.add(116, "0.,0.,0.,0", {.status = dependent});
    for (int i = 0; i < 8; ++i) base = file.add(412, "{},1.,0.,0.,0.,10,10,1.,1.,0.,0,0", {}, {base});
    const Imported in = imported(file);
    BOOST_TEST(in.has("IG-R08"));
    BOOST_TEST(occurrences(in.model, 1'000'000, 64).has_value());
  }
}

BOOST_AUTO_TEST_CASE(network_subfigures_scale_each_way) {
  IgesText file;
  const int point = file.add(116, "1.,1.,1.,0", {.status = dependent});
  const int definition = file.add(320, "0,3Hnet,1,{},0,0,0,0", {.status = "00000200"}, {point});
  file.add(420, "{},10.,0.,0.,2.,3.,,0,0,0,0", {}, {definition});  // z as x
  const Imported in = imported(file);
  const auto all = occurrences(in.model, 10, 10);
  BOOST_REQUIRE(all);
  BOOST_REQUIRE(all->size() == 2u);
  check_point(apply((*all)[1].transform, in.model.parts[(*all)[1].part].points.at(0).point), {12, 3, 2});
}

BOOST_AUTO_TEST_CASE(flashes_are_outlines) {
  IgesText file;
  file.add(125, "1.,2.,4.", {.form = 1});
  file.add(125, "1.,2.,4.,3.", {.form = 2});
  file.add(125, "1.,2.,4.,3.", {.form = 3});
  file.add(125, "1.,2.,4.,2.", {.form = 4});
  const Imported in = imported(file);
  BOOST_REQUIRE(in.root().curves.size() == 5u);
  const double lengths[] = {4 * pi, 14, 4 * pi, 3 * pi, 4 + 2 * pi};
  for (std::size_t i = 0; i < 5; ++i) BOOST_TEST(length(in.curve(i)) == lengths[i], boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_SUITE_END()
