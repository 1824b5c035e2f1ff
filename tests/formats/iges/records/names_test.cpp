#include "formats/iges/names.h"

#include <boost/test/unit_test.hpp>

#include "tests/formats/iges/records/decode.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

std::string all_names(int type, int form, std::string_view text) {
  const Decoded decoded = decode(type, form, text);
  std::vector<std::string> names;
  for (std::size_t i = 1; i < decoded.parameters.tokens.size(); ++i)
    names.push_back(iges::parameter_name(type, form, i, decoded.parameters));
  return joined(names);
}

}  // namespace

BOOST_AUTO_TEST_CASE(types_have_the_names_of_the_standard) {
  BOOST_TEST(iges::entity_name(126) == "Rational B-Spline Curve");
  BOOST_TEST(iges::entity_name(0) == "Null");
  BOOST_TEST(iges::entity_name(514) == "Shell");
  BOOST_TEST(iges::entity_name(127) == "");
  BOOST_TEST(iges::entity_name(-5) == "");
  BOOST_TEST(iges::entity_name(9999) == "");
  for (int type = 0; type < 600; ++type)
    if (iges::has_struct(type)) BOOST_TEST(iges::entity_name(type) != "", type << " has no name");
}

BOOST_AUTO_TEST_CASE(parameters_have_the_names_of_the_standard) {
  BOOST_TEST(all_names(110, 0, "0.,0.,0.,1.,0.,0.") == "X1,Y1,Z1,X2,Y2,Z2");
  BOOST_TEST(all_names(126, 0, "1,1,0,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,0.,1.,0,0") ==
             "K,M,PROP1,PROP2,PROP3,PROP4,T(-1),T(0),T(1),T(2),W(0),W(1),X(0),Y(0),Z(0),X(1),Y(1),Z(1),V(0),V(1),XNORM,"
             "YNORM,ZNORM,,");
  BOOST_TEST(all_names(106, 12, "2,2,0.,0.,0.,1.,0.,0.") == "IP,N,X(1),Y(1),Z(1),X(2),Y(2),Z(2)");
  BOOST_TEST(all_names(106, 11, "1,1,0.,0.,0.") == "IP,N,ZT,X(1),Y(1)");
  BOOST_TEST(all_names(141, 0, "1,2,9,2,5,1,1,31,7,2,2,31,31") ==
             "TYPE,PREF,SPTR,N,CRVPT(1),SENSE(1),K(1),PSCPT(1,1),CRVPT(2),SENSE(2),K(2),PSCPT(2,1),PSCPT(2,2)");
  BOOST_TEST(all_names(508, 1, "2,0,17,1,1,1,1,31,1,15,2,1,0") ==
             "N,TYPE(1),EDGE(1),NDX(1),OF(1),K(1),ISOP(1,1),CURV(1,1),TYPE(2),EDGE(2),NDX(2),OF(2),K(2)");
  BOOST_TEST(all_names(144, 0, "9,1,2,11,11,11") == "PTS,N1,N2,PTO,PTI(1),PTI(2)");
  BOOST_TEST(all_names(196, 1, "1,2.,3,3") == "DELOC,RADIUS,DEAXIS,DEREFD");
  BOOST_TEST(all_names(196, 0, "1,2.,0,0") == "DELOC,RADIUS,,");
}

BOOST_AUTO_TEST_CASE(poles_and_patches_have_two_indices) {
  const Decoded surface = decode(128, 0,
                                 "2,1,1,1,0,0,1,0,0,0.,0.,.5,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,2.,"
                                 "0.,0.,0.,1.,0.,1.,1.,0.,2.,1.,0.,"
                                 "0.,1.,0.,1.");
  const auto name = [&](std::size_t i) { return iges::parameter_name(128, 0, i, surface.parameters); };
  BOOST_TEST(name(10) == "S(-1)");
  BOOST_TEST(name(15) == "T(-1)");
  BOOST_TEST(name(19) == "W(0,0)");
  BOOST_TEST(name(22) == "W(0,1)");
  BOOST_TEST(name(28) == "X(1,0)");
  BOOST_TEST(name(43) == "U(0)");
  BOOST_TEST(name(46) == "V(1)");
  BOOST_TEST(name(47) == "");
  const Decoded patches = decode(114, 0, "3,1,1,1,0.,1.,0.,1.,1.,2.");
  const auto coefficient = [&](std::size_t i) { return iges::parameter_name(114, 0, i, patches.parameters); };
  BOOST_TEST(coefficient(5) == "TU(1)");
  BOOST_TEST(coefficient(9) == "AX(1,1)");
  BOOST_TEST(coefficient(9 + 47) == "PZ(1,1)");
  BOOST_TEST(coefficient(9 + 48) == "AX(1,2)");
  BOOST_TEST(coefficient(9 + 96 + 16) == "AY(2,1)");
}

BOOST_AUTO_TEST_CASE(without_the_counts_only_the_first_names_are_known) {
  BOOST_TEST(iges::parameter_name(126, 0, 2) == "M");
  BOOST_TEST(iges::parameter_name(126, 0, 7) == "");
  BOOST_TEST(iges::parameter_name(144, 0, 4) == "PTO");
  BOOST_TEST(iges::parameter_name(212, 0, 1) == "NS");
  BOOST_TEST(iges::parameter_name(110, 0, 0) == "");
}

BOOST_AUTO_TEST_CASE(lying_counts_only_cost_the_names) {
  for (const char* text : {"2147483647,2147483647,0,0,1,0,0.", "-5,-5,0,0", "9223372036854775807,1,1"})
    for (int type : {102, 106, 112, 114, 126, 128, 141, 144, 308, 402, 406, 502, 504, 508, 510, 514}) {
      const Decoded decoded = decode(type, 1, text);
      for (std::size_t i : {std::size_t{1}, std::size_t{100}, std::size_t{1} << 40, SIZE_MAX})
        BOOST_TEST(iges::parameter_name(type, 1, i, decoded.parameters).size() < 60u);
    }
}
