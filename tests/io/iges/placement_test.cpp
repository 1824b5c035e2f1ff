// Matrices (124): chains, mirrors, what is scaled; subfigure instances (408).

#include "tests/io/iges/imported.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

const auto nearly = boost::test_tools::tolerance(1e-9);
constexpr const char* quarter_turn_about_z = "0.,-1.,0.,0.,1.,0.,0.,0.,0.,0.,1.,0.";
constexpr const char* shift_x = "1.,0.,0.,5.,0.,1.,0.,0.,0.,0.,1.,0.";
constexpr const char* mirror_x = "-1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.";
constexpr const char* mirror_z = "1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,-1.,0.";
constexpr const char* inches = "4Htest,8Htest.igs,8Htrimloop,8Htrimloop,32,38,6,308,15,4Htest,1.,1,4HINCH,1,1.,"
                               "15H20260101.000000,1.E-6,1000.,6Hauthor,3Horg,11,0,15H20260101.000000,";

}  // namespace

BOOST_AUTO_TEST_SUITE(placement)

BOOST_AUTO_TEST_CASE(the_own_matrix_comes_first_then_the_one_it_points_at) {
  IgesText file;
  const int turn = file.add(124, quarter_turn_about_z);
  const int shift = file.add(124, shift_x, {.transform = turn});  // shifted along x, then turned to y
  file.add(116, "1.,0.,0.,0", {.transform = shift});
  const Imported in = imported(file);
  BOOST_REQUIRE(in.root().points.size() == 1u);
  check_point(in.root().points[0].point, {0, 6, 0});
}

BOOST_AUTO_TEST_CASE(the_translation_of_a_matrix_is_a_length) {
  IgesText file;
  file.global = inches;
  const int shift = file.add(124, shift_x);
  file.add(116, "1.,0.,0.,0", {.transform = shift});
  check_point(imported(file).root().points.at(0).point, {6 * 25.4, 0, 0});
}

BOOST_AUTO_TEST_CASE(a_loop_of_matrices_is_named_and_not_followed) {
  IgesText file;
  file.add(124, shift_x, {.transform = 3});
  file.add(124, shift_x, {.transform = 1});
  file.add(116, "1.,0.,0.,0", {.transform = 1});
  const Imported in = imported(file);
  BOOST_TEST(in.has("IG-R05"));
  check_point(in.root().points.at(0).point, {1, 0, 0});
}

BOOST_AUTO_TEST_CASE(a_very_long_chain_of_matrices_ends) {
  IgesText file;
  int last = file.add(124, shift_x);
  for (int i = 0; i < 2000; ++i) last = file.add(124, shift_x, {.transform = last});
  file.add(116, "1.,0.,0.,0", {.transform = last});
  BOOST_TEST(imported(file).has("IG-R05"));
}

BOOST_AUTO_TEST_CASE(a_mirrored_arc_stays_the_same_arc) {
  for (const char* mirror : {mirror_x, mirror_z}) {
    IgesText file;
    const int m = file.add(124, mirror, {.form = 1});
    file.add(100, "0.,0.,0.,5.,0.,0.,5.", {.transform = m});
    file.add(104, "0.04,0.,0.1111111111111111,0.,0.,-1.,0.,5.,0.,0.,3.", {.form = 1, .transform = m});
    const Imported in = imported(file);
    BOOST_TEST(length(in.curve(0)) == 5 * pi / 2, nearly);  // not the other three quarters
    const double side = mirror == mirror_x ? -1 : 1;
    check_point(start_point(in.curve(0)), {side * 5, 0, 0}, 1e-9);
    check_point(end_point(in.curve(0)), {0, 5, 0}, 1e-9);
    check_point(evaluate(in.curve(0), range(in.curve(0)).mid()), {side * 5 / std::sqrt(2), 5 / std::sqrt(2), 0}, 1e-9);
    BOOST_TEST(length(in.curve(1)) == 6.381747, boost::test_tools::tolerance(1e-5));  // quarter of an ellipse 5 x 3
    check_point(end_point(in.curve(1)), {0, 3, 0}, 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(a_composite_hands_its_matrix_to_its_members) {
  IgesText file;
  const int turn = file.add(124, quarter_turn_about_z);
  const int shift = file.add(124, shift_x);
  const int line = file.add(110, "0.,0.,0.,1.,0.,0.", {.status = dependent, .transform = shift});
  file.add(102, "1,{}", {.transform = turn}, {line});
  const Imported in = imported(file);
  check_point(start_point(in.curve()), {0, 5, 0});
  check_point(end_point(in.curve()), {0, 6, 0});
}

BOOST_AUTO_TEST_CASE(a_matrix_that_stretches_is_baked_in_and_reported) {
  IgesText file;
  const int stretch = file.add(124, "2.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.");
  file.add(100, "0.,0.,0.,1.,0.,0.,1.", {.transform = stretch});
  const Imported in = imported(file);
  BOOST_TEST(in.has("IG-E124-02"));
  check_point(start_point(in.curve()), {2, 0, 0});
  BOOST_TEST(length(in.curve()) == 2.422112055137, boost::test_tools::tolerance(1e-7));
}

BOOST_AUTO_TEST_CASE(an_instance_scales_then_shifts_then_takes_its_matrix) {
  IgesText file;
  const int point = file.add(116, "1.,0.,0.,0", {.status = dependent});
  const int definition = file.add(308, "0,4Hpart,1,{}", {.status = "00000200"}, {point});
  const int turn = file.add(124, quarter_turn_about_z);
  file.add(408, "{},5.,0.,0.,2.", {.transform = turn}, {definition});
  file.add(408, "{},0.,0.,0.,2.", {}, {definition});
  const Imported in = imported(file);
  const auto placed = occurrences(in.model, 100, 10);
  BOOST_REQUIRE(placed);
  BOOST_TEST(placed->size() == 3u);
  BOOST_TEST(in.root().points.empty());
  const Point p = in.model.parts[1].points.at(0).point;
  check_point(apply((*placed)[1].transform, p), {0, 7, 0});
  check_point(apply((*placed)[2].transform, p), {2, 0, 0});
  BOOST_TEST(in.model.parts[1].name == "part");
}

BOOST_AUTO_TEST_CASE(an_instance_shifts_by_file_lengths) {
  IgesText file;
  file.global = inches;
  const int point = file.add(116, "1.,0.,0.,0", {.status = dependent});
  const int definition = file.add(308, "0,4Hpart,1,{}", {.status = "00000200"}, {point});
  file.add(408, "{},5.,0.,0.,2.", {}, {definition});
  const Imported in = imported(file);
  const auto placed = occurrences(in.model, 100, 10);
  BOOST_REQUIRE(placed);
  check_point(apply(placed->at(1).transform, in.model.parts[1].points.at(0).point), {7 * 25.4, 0, 0}, 1e-9);
}

BOOST_AUTO_TEST_SUITE_END()
