// Units: flags 1 to 11, names, scale, what is assumed; and what is never scaled.

#include "tests/io/iges/imported.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

IgesText with_unit(const std::string& flag, const std::string& name, const std::string& scale = "1.") {
  IgesText file;
  file.global = "4Htest,8Htest.igs,8Htrimloop,8Htrimloop,32,38,6,308,15,4Htest," + scale + "," + flag + "," + name +
                ",1,1.,15H20260101.000000,1.E-6,1000.,6Hauthor,3Horg,11,0,15H20260101.000000,";
  return file;
}

double length_of_unit_line(IgesText file, std::optional<LengthUnit> assume = {}) {
  file.add(110, "0.,0.,0.,1.,0.,0.");
  return length(imported(file, {}, assume).curve());
}

}  // namespace

BOOST_AUTO_TEST_SUITE(units)

BOOST_AUTO_TEST_CASE(every_flag_gives_its_length) {
  const std::pair<const char*, double> flags[] = {{"1", 25.4},    {"2", 1},     {"4", 304.8},  {"5", 1609344},
                                                  {"6", 1000},    {"7", 1e6},   {"8", 0.0254}, {"9", 1e-3},
                                                  {"10", 10},     {"11", 25.4e-6}};
  for (const auto& [flag, mm] : flags)
    BOOST_TEST(length_of_unit_line(with_unit(flag, "")) == mm, boost::test_tools::tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(flag_3_asks_the_name) {
  BOOST_TEST(length_of_unit_line(with_unit("3", "2HIN")) == 25.4, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(length_of_unit_line(with_unit("3", "2HMM")) == 1.0);
  BOOST_TEST(length_of_unit_line(with_unit("3", "1HM")) == 1000.0);
}

BOOST_AUTO_TEST_CASE(an_empty_flag_is_the_inch_of_the_standard) {
  BOOST_TEST(length_of_unit_line(with_unit("", "")) == 25.4, boost::test_tools::tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(an_unknown_unit_is_said_to_be_assumed) {
  IgesText file = with_unit("12", "");
  file.add(110, "0.,0.,0.,1.,0.,0.");
  const Imported in = imported(file);
  BOOST_TEST(in.has("IG-G15"));
  BOOST_TEST(!in.model.unit_known);
  BOOST_TEST(length(in.curve()) == 1.0);
  BOOST_TEST(length_of_unit_line(with_unit("0", ""), LengthUnit::Metre) == 1000.0);
  BOOST_TEST(length_of_unit_line(with_unit("3", "7HFURLONG"), LengthUnit::Inch) == 25.4,
             boost::test_tools::tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(a_stated_unit_is_not_overruled) {
  BOOST_TEST(length_of_unit_line(with_unit("2", "2HMM"), LengthUnit::Metre) == 1.0);
}

BOOST_AUTO_TEST_CASE(lengths_are_divided_by_the_model_scale) {
  BOOST_TEST(length_of_unit_line(with_unit("2", "2HMM", "0.5")) == 2.0);
}

BOOST_AUTO_TEST_CASE(knots_weights_and_angles_are_not_scaled) {
  IgesText file = with_unit("1", "4HINCH");
  // A quarter circle of one inch as a rational quadratic over [2, 6].
  file.add(126, "2,2,1,0,0,0,2.,2.,2.,6.,6.,6.,1.,0.7071067811865476,1.,1.,0.,0.,1.,1.,0.,0.,1.,0.,2.,6.,0.,0.,1.");
  file.add(100, "0.,0.,0.,1.,0.,0.,1.");
  const Imported in = imported(file);
  const auto* nurbs = std::get_if<NurbsCurve>(&in.curve(0).shape);
  BOOST_REQUIRE(nurbs);
  BOOST_TEST(nurbs->knots()[0] == 2.0);
  BOOST_TEST(nurbs->knots()[5] == 6.0);
  BOOST_TEST(nurbs->poles()[1].w == 0.7071067811865476);
  BOOST_TEST(length(in.curve(0)) == 25.4 * pi / 2, boost::test_tools::tolerance(1e-8));
  const auto* circle = std::get_if<Circle>(&in.curve(1).shape);
  BOOST_REQUIRE(circle);
  BOOST_TEST(circle->range.lo == 0.0);
  BOOST_TEST(circle->range.hi == pi / 2, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(circle->radius == 25.4, boost::test_tools::tolerance(1e-15));
}

BOOST_AUTO_TEST_SUITE_END()
