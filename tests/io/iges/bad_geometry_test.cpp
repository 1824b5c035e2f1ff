// The malformed shapes I45 to I53 and I63 to I65 of the catalogue of bad inputs, and the layouts I12 to I14: one of the
// findings named there is made, what is beside them in the file stays, and nothing large is allocated.
#include "tests/io/iges/imported.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

// A good point stands beside the bad entity. True when it came through and one of `rules` was found.
bool survives(IgesText& file, std::initializer_list<std::string_view> rules) {
  file.add(116, "7.,8.,9.,0");
  const Imported in = imported(file);
  BOOST_TEST(in.root().points.size() == 1u);
  for (const std::string_view rule : rules)
    if (in.has(rule)) return true;
  for (const Diagnostic& d : in.report.items()) BOOST_TEST_MESSAGE(d.rule->id << " " << d.text);
  return false;
}

bool survives(int type, std::string_view parameters, std::initializer_list<std::string_view> rules) {
  IgesText file;
  file.add(type, parameters);
  return survives(file, rules);
}

// A cubic 126 of four poles with these knots, weights, last pole and range.
std::string cubic(std::string_view knots = "0.,0.,0.,0.,1.,1.,1.,1.", std::string_view weights = "1.,1.,1.,1.",
                  std::string_view last = "3.,0.,0.", std::string_view range = "0.,1.") {
  return "3,3,0,0,0,0," + std::string(knots) + "," + std::string(weights) + ",0.,0.,0.,1.,1.,0.,2.,1.,0.," + std::string(last) + "," +
         std::string(range) + ",0.,0.,1.";
}

int add_plate(IgesText& file, const char* status = dependent) {  // [0,8] x [0,4], parameters in [0,1]
  return file.add(128, "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,8.,0.,0.,0.,4.,0.,8.,4.,0.,0.,1.,0.,1.", {.status = status});
}

int add_square(IgesText& file, double lo, double hi, const char* status) {
  const std::string a = std::to_string(lo) + ",", b = std::to_string(hi) + ",";
  return file.add(106, "1,5,0.," + a + a + b + a + b + b + a + b + a + std::to_string(lo), {.form = 12 - 1, .status = status});
}

int add_142(IgesText& file, int surface, int pcurve, int curve) {
  return file.add(142, "1,{},{},{},1", {.status = dependent}, {surface, pcurve, curve});
}

}  // namespace

BOOST_AUTO_TEST_SUITE(bad_geometry)

BOOST_AUTO_TEST_CASE(i12_i13_i14_layouts_are_accepted) {
  IgesText file;
  file.add(116, "1.,2.,3.,0");
  for (const std::string_view end : {"\r", "\n", "\r\n", ""}) {
    Report report;
    const auto read = iges::File::parse(file.text(end), {}, report);
    BOOST_TEST(read.directory().size() == 1u);
    BOOST_TEST(!report.has_fatal());
  }
  Report marked;
  BOOST_TEST(iges::File::parse("\xEF\xBB\xBF" + file.text(), {}, marked).directory().size() == 1u);
  BOOST_TEST(!marked.has_fatal());
}

BOOST_AUTO_TEST_CASE(i45_i46_counts_and_degrees_that_lie) {
  for (const char* head : {"2147483647,3,0,0,0,0,", "-1,3,0,0,0,0,", "2147483647,2147483647,0,0,0,0,", "3,0,0,0,0,0,", "2,3,0,0,0,0,", "3,1000000,0,0,0,0,"})
    BOOST_TEST(survives(126, std::string(head) + cubic().substr(12), {"IG-E126-01", "IG-P17"}), head);
}

BOOST_AUTO_TEST_CASE(i47_knots_that_are_none) {
  for (const char* knots : {"0.,0.,0.,0.,1.,0.5,1.,1.", "1.,1.,1.,1.,1.,1.,1.,1.", "0.,0.,0.,0.,0.,1.,1.,1."})
    BOOST_TEST(survives(126, cubic(knots), {"IG-E126-03", "IG-E126-04"}), knots);
  IgesText narrow;  // a span of 1e-300 is a span
  narrow.add(126, cubic("0.,0.,0.,0.,1.E-300,1.E-300,1.E-300,1.E-300", "1.,1.,1.,1.", "3.,0.,0.", "0.,1.E-300"));
  narrow.add(116, "7.,8.,9.,0");
  const Imported in = imported(narrow);
  BOOST_TEST(in.root().points.size() == 1u);
  for (const FreeCurve& c : in.root().curves) BOOST_TEST(is_finite(evaluate(c.curve, range(c.curve).mid())));
}

BOOST_AUTO_TEST_CASE(i48_weights_that_are_not_positive_or_of_all_sizes) {
  for (const char* weights : {"1.,0.,1.,1.", "1.,-1.,1.,1.", "1.E308,1.E-308,1.,1."})
    BOOST_TEST(survives(126, cubic("0.,0.,0.,0.,1.,1.,1.,1.", weights), {"IG-E126-07", "IG-E126-08"}), weights);
}

BOOST_AUTO_TEST_CASE(i49_poles_that_overflow) {
  BOOST_TEST(survives(126, cubic("0.,0.,0.,0.,1.,1.,1.,1.", "1.,1.,1.,1.", "1.E308,1.E308,1.E308"), {"IG-E126-09"}));
}

BOOST_AUTO_TEST_CASE(i50_ranges_that_do_not_ascend_or_leave_the_knots) {
  for (const char* range : {"1.,0.", "0.5,0.5", "-3.,7."})
    BOOST_TEST(survives(126, cubic("0.,0.,0.,0.,1.,1.,1.,1.", "1.,1.,1.,1.", "3.,0.,0.", range), {"IG-E126-06"}), range);
}

BOOST_AUTO_TEST_CASE(i52_i53_surfaces_of_impossible_and_of_no_extent) {
  BOOST_TEST(survives(128, "2147483647,2147483647,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.", {"IG-E128-02"}));
  const std::string head = "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,";
  IgesText row;  // one side is a point: a pole, and a face all the same
  row.add(128, head + "0.,0.,0.,0.,0.,0.,0.,4.,0.,8.,4.,0.,0.,1.,0.,1.");
  const Imported in = imported(row);
  BOOST_REQUIRE_EQUAL(in.faces().size(), 1u);
  BOOST_TEST((in.face().status != FaceStatus::Failed));
  BOOST_TEST(std::abs(in.area() - 16) <= 1e-9);
  BOOST_TEST(survives(128, head + "1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,0.,1.,0.,1.", {"IG-E128-09"}));
}

BOOST_AUTO_TEST_CASE(i63_curves_on_surfaces_that_are_nowhere) {
  IgesText none;
  const int s = add_plate(none);
  none.add(144, "{},1,0,{}", {}, {s, add_142(none, s, 0, 0)});
  BOOST_TEST(survives(none, {"IG-E142-02"}));
  IgesText far;
  const int p = add_plate(far);
  far.add(144, "{},1,0,{}", {}, {p, add_142(far, p, add_square(far, 0.25, 0.75, parametric), add_square(far, 2000, 6000, dependent))});
  BOOST_TEST(survives(far, {"IG-E142-04"}));
  IgesText own;
  own.add(142, "1,1,0,0,1", {.status = dependent});  // itself as its surface
  BOOST_TEST(survives(own, {"IG-R03"}));
}

BOOST_AUTO_TEST_CASE(i64_bounded_surfaces_without_or_with_foreign_boundaries) {
  IgesText none;
  none.add(143, "1,{},0", {}, {add_plate(none)});
  BOOST_TEST(survives(none, {"IG-E143-01"}));
  IgesText foreign;
  const int one = add_plate(foreign), two = add_plate(foreign), curve = add_square(foreign, 1, 3, dependent);
  const int boundary = foreign.add(141, "0,1,{},1,{},1,0", {.status = dependent}, {two, curve});
  foreign.add(143, "0,{},1,{}", {}, {one, boundary});
  BOOST_TEST(survives(foreign, {"IG-E143-02"}));
}

BOOST_AUTO_TEST_CASE(i65_loops_outside_crossing_and_equal) {
  for (const auto& [lo, hi] : {std::pair{0.8, 0.95}, std::pair{0.6, 0.9}, std::pair{0.25, 0.75}}) {  // outer: 0.25 .. 0.75
    IgesText file;
    const int s = add_plate(file);
    const int outer = add_142(file, s, add_square(file, 0.25, 0.75, parametric), 0);
    const int inner = add_142(file, s, add_square(file, lo, hi, parametric), 0);
    file.add(144, "{},1,1,{},{}", {}, {s, outer, inner});
    BOOST_TEST(survives(file, {"IG-E144-03", "IG-E144-04"}));
  }
  IgesText many;
  const int s = add_plate(many);
  many.add(144, "{},1,1000000000,{}", {}, {s, add_142(many, s, add_square(many, 0.25, 0.75, parametric), 0)});
  BOOST_TEST(survives(many, {"IG-P17"}));
}

BOOST_AUTO_TEST_SUITE_END()
