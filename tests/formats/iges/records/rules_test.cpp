// Every rule of records fires on a minimal bad record and not on the good one beside it.
#include <boost/test/unit_test.hpp>

#include "base/bytes.h"
#include "tests/formats/iges/records/decode.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

enum Fate { Usable, Quarantined };

struct Case {
  const char* rule;
  int type, form;
  const char *good, *bad;
  Fate fate;             // of the bad one
  int bad_form = -1000;  // when the form is what is wrong
};

constexpr const char* line_126 = "1,1,1,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,0.,1.";
constexpr const char* quarter_128 =
    "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,1.,1.,0.,0.,1.,0.,1.";
constexpr const char* spline_112 =
    "3,2,3,1,0.,2.,1.,1.,0.,0.,0.,2.,0.,0.,0.,0.,0.,0.,3.,1.,0.,0.,4.,2.,0.,0.,0.,0.,0.,0.";

const Case cases[] = {
    // ---- tokens
    {"IG-P02", 110, 0, "0.,0.,0.,1.,0.,0.", "0.,0.,0.,1.,0.", Quarantined},
    {"IG-P02", 110, 0, "0.,0.,0.,1.,0.,0.", "0.,0.,,1.,0.,0.", Usable},
    {"IG-P03", 110, 0, "0.,0.,0.,1.,0.,0.,0,0", "0.,0.,0.,1.,0.,0.,0,0,0", Usable},
    {"IG-P04", 142, 0, "0,9,31,5,2", "0,9,31,5,2.", Usable},
    {"IG-P04", 142, 0, "0,9,31,5,2", "0,9,31,5,2.5", Quarantined},
    {"IG-P04", 142, 0, "0,9,31,5,2", "0,9,31,5,3Htwo", Quarantined},
    {"IG-P05", 123, 0, "0.,0.,1.", "0.,0.,1", Usable},
    {"IG-P05", 123, 0, "0.,0.,1.", "0.,0.,3Hone", Quarantined},
    {"IG-P05", 123, 0, "0.,0.,1.", "0.,0.,X", Quarantined},
    {"IG-P06", 123, 0, "0.,0.,1.D0", "0.,0.,1.D", Quarantined},
    {"IG-P06", 123, 0, "0.,0.,1.D0", "0.,0.,1D+", Quarantined},
    {"IG-P06", 123, 0, "0.,0.,1.D0", "0.,0.,--1", Quarantined},
    {"IG-P06", 123, 0, "0.,0.,1.D0", "0.,0.,1.2.3", Quarantined},
    {"IG-P06", 123, 0, "0.,0.,1.D0", "0.,0.,1 2.", Quarantined},
    {"IG-P07", 123, 0, "0.,0.,1.E308", "0.,0.,1E99999", Quarantined},
    {"IG-P07", 123, 0, "0.,1.,1.E-300", "0.,1.,1.E-99999", Usable},
    {"IG-P08", 123, 0, "0.,0.,1.", "0.,0.,NAN", Quarantined},
    {"IG-P08", 123, 0, "0.,0.,1.", "0.,0.,-inf", Quarantined},
    {"IG-P08", 123, 0, "0.,0.,1.", "0.,0.,1.#IND", Quarantined},
    {"IG-P08", 123, 0, "0.,0.,1.", "0.,0.,*****", Quarantined},
    {"IG-P09", 142, 0, "0,9,31,5,2", "0,9,31,5,99999999999999999999", Quarantined},
    {"IG-P09", 126, 0, line_126, "4294967296,1,0,0,1,0", Quarantined},
    {"IG-P10", 510, 1, "9,1,1,19", "9,1,2,19", Usable},
    {"IG-P11", 314, 0, "1.,2.,3.,3Hred", "1.,2.,3.,red", Usable},
    {"IG-P12", 314, 0, "1.,2.,3.,4Hgr\x7en", "1.,2.,3.,5Hgr\xc3\xbcn", Usable},
    {"IG-P15", 110, 0, "0.,0.,0.,1.,0.,0.,0,1,27", "0.,0.,0.,1.,0.,0.,0,2,27", Usable},
    {"IG-P15", 110, 0, "0.,0.,0.,1.,0.,0.,0,1,27", "0.,0.,0.,1.,0.,0.,-1", Usable},
    {"IG-P16", 110, 0, "0.,0.,0.,1.,0.,0.,1,29", "0.,0.,0.,1.,0.,0.,1,27", Usable},
    {"IG-P17", 102, 0, "2,5,7", "3,5,7", Quarantined},
    {"IG-P18", 102, 0, "2,5,7", "-1,5,7", Quarantined},
    {"IG-P20", 123, 0, "0.,0.,1.E0", "0.,0.,1.e0", Usable},
    {"IG-P21", 126, 0, line_126, "1,1,0,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,1,29,0", Usable},
    {"IG-R01", 102, 0, "2,5,7", "2,5,999", Usable},
    {"IG-R01", 102, 0, "2,5,7", "2,5,-7", Usable},
    {"IG-R02", 102, 0, "2,5,7", "2,5,8", Usable},
    {"IG-R03", 120, 0, "5,7,0.,1.", "5,37,0.,1.", Usable},
    {"IG-R03", 142, 0, "0,9,31,5,2", "0,39,31,5,2", Usable},  // a curve on itself
    // ---- curves
    {"IG-E100-01", 100, 0, "0.,0.,0.,1.,0.,0.,1.", "0.,0.,0.,0.,0.,0.,0.", Quarantined},
    {"IG-E100-02", 100, 0, "0.,0.,0.,1.,0.,0.,1.", "0.,0.,0.,1.,0.,0.,1.1", Usable},
    {"IG-E100-03", 100, 0, "0.,0.,0.,1.,0.,1.,0.", "0.,0.,0.,1.,0.,1.,1.E-8", Usable},
    {"IG-E102-01", 102, 0, "1,5", "0", Quarantined},
    {"IG-E102-02", 102, 0, "2,5,7", "2,5,35", Usable},
    {"IG-E102-05", 102, 0, "2,5,7", "2,5,5", Usable},
    {"IG-E104-01", 104, 1, "1.,0.,1.,0.,0.,-1.,0.,1.,0.,0.,1.", "1.,0.,-1.,0.,0.,-1.,0.,1.,0.,1.,0.", Usable},
    {"IG-E104-02", 104, 1, "1.,0.,1.,0.,0.,-1.,0.,1.,0.,0.,1.", "0.,0.,0.,0.,0.,0.,0.,1.,0.,0.,1.", Quarantined},
    {"IG-E106-01", 106, 12, "2,2,0.,0.,0.,1.,0.,0.", "1,2,0.,0.,0.,1.,0.", Usable},
    {"IG-E106-01", 106, 12, "2,2,0.,0.,0.,1.,0.,0.", "4,2,0.,0.,0.,1.,0.", Quarantined},
    {"IG-E106-02", 106, 12, "2,2,0.,0.,0.,1.,0.,0.", "2,1,0.,0.,0.", Quarantined},
    {"IG-E106-02", 106, 12, "2,2,0.,0.,0.,1.,0.,0.", "2,0", Quarantined},
    {"IG-E106-03", 106, 63, "1,3,0.,0.,0.,1.,0.,0.,0.", "1,3,0.,0.,0.,1.,0.,1.,1.", Usable},
    {"IG-E106-04", 106, 40, "1,3,0.,0.,0.,1.,0.,2.,0.", "1,4,0.,0.,0.,1.,0.,2.,0.,3.,0.", Usable},
    {"IG-E106-05", 106, 12, "2,2,0.,0.,0.,1.,0.,0.", "2,3,0.,0.,0.,0.,0.,0.,1.,0.,0.", Usable},
    {"IG-E106-06", 106, 3, "3,1,0.,0.,0.,1.,0.,0.", "3,1,0.,0.,0.,0.,0.,0.", Usable},
    {"IG-E110-01", 110, 0, "0.,0.,0.,1.,0.,0.", "1.,2.,3.,1.,2.,3.", Usable},
    {"IG-E112-01", 112, 0, spline_112,
     "7,2,3,1,0.,2.,1.,1.,0.,0.,0.,2.,0.,0.,0.,0.,0.,0.,3.,1.,0.,0.,4.,2.,0.,0.,0.,0.,0.,0.", Usable},
    {"IG-E112-02", 112, 0, spline_112,
     "3,2,4,1,0.,2.,1.,1.,0.,0.,0.,2.,0.,0.,0.,0.,0.,0.,3.,1.,0.,0.,4.,2.,0.,0.,0.,0.,0.,0.", Usable},
    {"IG-E112-02", 112, 0, spline_112,
     "3,2,2,1,0.,2.,1.,1.,0.,0.,0.,2.,0.,0.,0.,1.,0.,0.,3.,1.,0.,0.,4.,2.,0.,0.,2.,1.,0.,0.", Usable},
    {"IG-E112-03", 112, 0, spline_112, "3,2,3,0,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.", Quarantined},
    {"IG-E112-04", 112, 0, spline_112,
     "3,2,3,1,2.,2.,1.,1.,0.,0.,0.,2.,0.,0.,0.,0.,0.,0.,3.,1.,0.,0.,4.,2.,0.,0.,0.,0.,0.,0.", Quarantined},
    {"IG-E112-06", 112, 0, spline_112,
     "3,2,3,1,0.,2.,1.,1.,0.,0.,0.,2.,0.,0.,0.,0.,0.,0.,3.,1.,0.,0.,9.,2.,0.,0.,0.,0.,0.,0.", Usable},
    {"IG-E116-01", 116, 0, "0.,0.,0.,25", "0.,0.,0.,5", Usable},
    {"IG-E123-01", 123, 0, "0.,0.,1.", "0.,0.,0.", Quarantined},
    {"IG-E124-01", 124, 0, "1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.", "1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.", Usable, 7},
    {"IG-E124-02", 124, 0, "1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.", "1.,0.1,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.", Usable},
    {"IG-E124-03", 124, 0, "1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.", "-1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.", Usable},
    {"IG-E124-03", 124, 1, "-1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.", "1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.", Usable},
    {"IG-E124-04", 124, 0, "1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.", "0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.", Quarantined},
    {"IG-E124-05", 124, 0, "1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.", "2.,0.,0.,0.,0.,2.,0.,0.,0.,0.,2.,0.", Usable},
    {"IG-E126-01", 126, 0, line_126, "1,0,0,0,1,0,0.,0.5,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,0.,0.", Quarantined},
    {"IG-E126-02", 126, 0, line_126, "9,1,0,0,1,0,0.,0.,1.,1.", Quarantined},
    {"IG-E126-03", 126, 0, line_126, "1,1,1,0,1,0,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,0.,1.", Quarantined},
    {"IG-E126-04", 126, 0, line_126, "1,1,1,0,1,0,1.,1.,0.,0.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,0.,1.", Quarantined},
    {"IG-E126-06", 126, 0, line_126, "1,1,1,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,1.,0.,0.,0.,1.", Quarantined},
    {"IG-E126-06", 126, 0, line_126, "1,1,1,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,2.,3.,0.,0.,1.", Quarantined},
    {"IG-E126-06", 126, 0, line_126, "1,1,1,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,2.,0.,0.,1.", Usable},
    {"IG-E126-07", 126, 0, line_126, "1,1,1,0,0,0,0.,0.,1.,1.,1.,0.,0.,0.,0.,1.,0.,0.,0.,1.,0.,0.,1.",
     Quarantined},  // the last
    {"IG-E126-07", 126, 0, line_126, "1,1,1,0,0,0,0.,0.,1.,1.,-1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,0.,1.", Quarantined},
    {"IG-E126-08", 126, 0, line_126, "1,1,1,0,0,0,0.,0.,1.,1.,1.E308,1.E-308,0.,0.,0.,1.,0.,0.,0.,1.,0.,0.,1.", Usable},
    {"IG-E126-09", 126, 0,
     "3,3,0,0,1,0,0.,0.,0.,0.,1.,1.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,1.,1.,0.,1.,1.,1.,0.,1.,0.,0.,0.",
     "3,3,1,0,1,0,0.,0.,0.,0.,1.,1.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,1.,1.,0.,1.,1.,1.,0.,1.,0.,0.,1.", Usable},
    {"IG-E126-10", 126, 0, line_126, "1,1,1,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,0.,2.", Usable},
    {"IG-E126-11", 126, 0, line_126, "1,1,1,1,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,0.,1.", Usable},
    {"IG-E126-12", 126, 0, line_126, "1,1,1,0,1,0,0.,0.,1.,1.,1.,2.,0.,0.,0.,1.,0.,0.,0.,1.,0.,0.,1.", Usable},
    {"IG-E126-13", 126, 0, line_126, "1,1,1,0,1,1,0.,0.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,0.,1.", Usable},
    {"IG-E126-15", 126, 0, line_126, "1,1,1,0,1,0,0.,0.,1.,1.,1.,1.,1.,0.,0.,1.,0.,0.,0.,1.,0.,0.,1.", Usable},
    {"IG-E130-01", 130, 0, "7,1,0,0,0,2.,0.,0.,0.,0.,0.,1.,0.,1.", "7,4,0,0,0,2.,0.,0.,0.,0.,0.,1.,0.,1.", Quarantined},
    {"IG-E130-01", 130, 0, "7,2,0,0,1,2.,0.,3.,1.,0.,0.,1.,0.,1.", "7,2,0,0,3,2.,0.,3.,1.,0.,0.,1.,0.,1.", Usable},
    {"IG-E130-02", 130, 0, "7,1,0,0,0,2.,0.,0.,0.,0.,0.,1.,0.,1.", "7,1,0,0,0,2.,0.,0.,0.,0.,0.,0.,0.,1.", Usable},
    {"IG-E130-03", 130, 0, "7,1,0,0,0,2.,0.,0.,0.,0.,0.,1.,0.,1.", "7,1,0,0,0,2.,0.,0.,0.,0.,0.,1.,1.,1.", Usable},
    // ---- surfaces
    {"IG-E108-01", 108, 0, "0.,0.,1.,0.,0,0.,0.,0.,0.", "0.,0.,0.,1.,0,0.,0.,0.,0.", Quarantined},
    {"IG-E108-02", 108, 0, "0.,0.,1.,0.,0,0.,0.,0.,0.", "0.,0.,1.,0.,7,0.,0.,0.,0.", Usable},
    {"IG-E108-02", 108, 1, "0.,0.,1.,0.,7,0.,0.,0.,0.", "0.,0.,1.,0.,0,0.,0.,0.,0.", Usable},
    {"IG-E114-02", 114, 0, "3,1,0,1,0.,0.,1.", "3,1,0,1,0.,0.,1.", Quarantined},
    {"IG-E118-01", 118, 1, "5,7,0,0", "5,7,0,0", Usable, 2},
    {"IG-E118-02", 118, 1, "5,7,0,0", "5,5,0,0", Usable},
    {"IG-E120-01", 120, 0, "5,7,0.,1.", "5,5,0.,1.", Usable},
    {"IG-E120-02", 120, 0, "5,7,0.,1.", "5,7,1.,1.", Quarantined},
    {"IG-E120-02", 120, 0, "5,7,0.,6.283185307179586", "5,7,0.,6.3", Usable},
    {"IG-E120-02", 120, 0, "5,7,0.,1.", "5,7,1.,0.", Usable},
    {"IG-E120-03", 120, 0, "5,7,0.,3.14", "5,7,0.,180.", Usable},
    {"IG-E128-01", 128, 0, quarter_128, "1,1,2,1,0,0,1,0,0,0.,0.,0.,1.,1.", Quarantined},
    {"IG-E128-02", 128, 0, quarter_128, "9,1,1,1,0,0,1,0,0,0.,0.,0.,1.,1.", Quarantined},
    {"IG-E128-03", 128, 0, quarter_128,
     "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,1.,0.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,1.,1.,0.,0.,1.,0.,1.",
     Quarantined},
    {"IG-E128-05", 128, 0, quarter_128,
     "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,1.,1.,0.,0.,1.,1.,0.",
     Quarantined},
    {"IG-E128-06", 128, 0, quarter_128,
     "1,1,1,1,0,0,0,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,0.,0.,0.,0.,1.,0.,0.,0.,1.,0.,1.,1.,0.,0.,1.,0.,1.",
     Quarantined},
    {"IG-E128-07", 128, 0, quarter_128,
     "1,1,1,1,1,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,1.,1.,0.,0.,1.,0.,1.", Usable},
    {"IG-E128-07", 128, 0, quarter_128,
     "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,2.,0.,0.,0.,1.,0.,0.,0.,1.,0.,1.,1.,0.,0.,1.,0.,1.", Usable},
    {"IG-E128-07", 128, 0, quarter_128,
     "1,1,1,1,0,0,1,0,1,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,1.,1.,0.,0.,1.,0.,1.", Usable},
    {"IG-E128-09", 128, 0, quarter_128,  // one row of coincident poles
     "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,0.,1.,0.,0.,1.,0.,1.", Usable},
    {"IG-E128-09", 128, 0, quarter_128,  // all poles coincident
     "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,5.,0.,0.,5.,0.,0.,5.,0.,0.,5.,0.,0.,0.,1.,0.,1.",
     Quarantined},
    {"IG-E190-01", 190, 0, "1,3", "1,3,3,0,0", Usable},
    {"IG-E190-01", 190, 1, "1,3,3", "1,3", Usable},
    {"IG-E190-01", 196, 0, "1,2.", "1,2.,3,3,0,0", Usable},
    {"IG-E190-02", 192, 0, "1,3,2.", "1,3,0.", Quarantined},
    {"IG-E190-02", 194, 0, "1,3,2.,30.", "1,3,2.,90.", Quarantined},
    {"IG-E190-02", 194, 0, "1,3,2.,30.", "1,3,2.,0.", Usable},
    {"IG-E190-02", 196, 0, "1,2.", "1,-2.", Quarantined},
    {"IG-E190-02", 198, 0, "1,3,2.,1.", "1,3,1.,2.", Usable},
    {"IG-E190-02", 198, 0, "1,3,2.,1.", "1,3,2.,0.", Quarantined},
    // ---- trimming and boundary representation
    {"IG-E141-01", 141, 0, "0,1,9,1,5,1,0", "2,1,9,1,5,1,0", Usable},
    {"IG-E141-01", 141, 0, "0,1,9,1,5,1,0", "0,4,9,1,5,1,0", Usable},
    {"IG-E141-01", 141, 0, "0,1,9,1,5,1,0", "0,1,9,1,5,7,0", Quarantined},
    {"IG-E141-02", 141, 0, "0,1,9,1,5,1,0", "0,1,9,1,5,1,1,31", Usable},
    {"IG-E141-02", 141, 0, "1,1,9,1,5,1,1,31", "1,1,9,1,5,1,0", Usable},
    {"IG-P18", 141, 0, "0,1,9,1,5,1,0", "0,1,9,0", Usable},  // what SolidWorks writes around a sphere
    {"IG-E142-01", 142, 0, "0,9,31,5,2", "4,9,31,5,2", Usable},
    {"IG-E142-01", 142, 0, "0,9,31,5,2", "0,9,31,5,-1", Usable},
    {"IG-E142-02", 142, 0, "0,9,31,0,1", "0,9,0,0,1", Quarantined},
    {"IG-E142-05", 142, 0, "0,9,31,5,2", "0,9,5,5,2", Usable},
    {"IG-E143-01", 143, 0, "0,9,1,13", "0,9,0", Quarantined},
    {"IG-E143-01", 143, 0, "0,9,1,13", "3,9,1,13", Usable},
    {"IG-E144-01", 144, 0, "9,0,0,0", "9,0,0,11", Usable},
    {"IG-E144-01", 144, 0, "9,1,0,11", "9,1,0,0", Usable},
    {"IG-E186-01", 186, 0, "23,1,0", "33,1,0", Usable},
    {"IG-E186-03", 186, 0, "23,1,0", "23,1,1,23,1", Usable},
    {"IG-E502-01", 502, 1, "1,0.,0.,0.", "0", Quarantined},
    {"IG-E504-01", 504, 1, "1,5,15,1,15,2", "1,5,15,0,15,2", Usable},
    {"IG-E504-01", 504, 1, "1,5,15,1,15,2", "0", Quarantined},
    {"IG-R03", 504, 1, "1,5,15,1,15,2", "1,5,15,1,17,2", Usable},
    {"IG-E508-01", 508, 1, "1,0,17,1,1,0", "1,0,17,-1,1,0", Usable},
    {"IG-E508-01", 508, 1, "1,0,17,1,1,0", "0", Quarantined},
    {"IG-E508-01", 508, 1, "1,0,17,1,1,0", "1,2,17,1,1,0", Quarantined},
    {"IG-E508-02", 508, 1, "2,0,17,1,1,0,0,17,1,0,0", "3,0,17,1,1,0,0,17,1,0,0,0,17,1,1,0", Quarantined},
    {"IG-P10", 508, 1, "1,0,17,1,1,0", "1,0,17,1,2,0", Usable},
    {"IG-R03", 508, 1, "1,1,15,1,1,0", "1,0,15,1,1,0", Usable},
    {"IG-E510-01", 510, 1, "9,1,1,19", "9,0,1", Usable},
    {"IG-E510-01", 510, 1, "9,1,1,19", "9,2,1,19,19", Usable},
    {"IG-E514-01", 514, 1, "1,21,1", "0", Quarantined},
    {"IG-E514-01", 514, 1, "1,21,1", "2,21,1,21,0", Usable},
    // ---- structure
    {"IG-E308-01", 308, 0, "0,4Hpart,1,5", "0,,1,5", Usable},
    {"IG-E308-01", 308, 0, "0,4Hpart,1,5", "0,4Hpart,0", Usable},
    {"IG-E314-01", 314, 0, "0.,50.,100.", "0.,50.,255.", Usable},
    {"IG-E402-01", 402, 7, "1,5", "0", Usable},
    {"IG-E402-01", 402, 9, "1,1,5,7", "2,1,5,7,31", Quarantined},
    {"IG-R14", 402, 7, "2,5,7", "2,5,0", Usable},
    {"IG-E406-01", 406, 15, "1,4Hname", "2,4Hname,3Htwo", Usable},
    {"IG-E406-02", 406, 17, "2,2,2HMM", "2,12,2HMM", Usable},
    {"IG-E406-02", 406, 15, "1,4Hname", "1,5", Usable},
    {"IG-E408-01", 408, 0, "25,0.,0.,0.,1.", "25,0.,0.,0.,0.", Quarantined},
    {"IG-E408-01", 408, 0, "25,0.,0.,0.,1.", "25,0.,0.,0.,-1.", Usable},
};

}  // namespace

BOOST_AUTO_TEST_CASE(every_rule_fires_on_its_bad_record_and_not_on_the_good_one) {
  for (const Case& c : cases) {
    const Decoded bad = decode(c.type, c.bad_form == -1000 ? c.form : c.bad_form, c.bad);
    BOOST_TEST_CONTEXT(c.rule << " on " << c.type << ":" << c.form << " " << c.bad) {
      BOOST_TEST(bad.has(c.rule));
      BOOST_TEST(bad.record.is_raw() == (c.fate == Quarantined));
    }
    if (std::string_view(c.good) == c.bad && c.bad_form == -1000) continue;
    const Decoded good = decode(c.type, c.form, c.good);
    BOOST_TEST_CONTEXT(c.rule << " not on " << c.type << ":" << c.form << " " << c.good) {
      BOOST_TEST(!good.has(c.rule));
      BOOST_TEST(!good.record.is_raw());
    }
  }
}

BOOST_AUTO_TEST_CASE(bad_records_go_back_as_they_came) {
  for (const Case& c : cases) {
    const Decoded bad = decode(c.type, c.bad_form == -1000 ? c.form : c.bad_form, c.bad);
    BOOST_TEST_CONTEXT(c.rule << " on " << c.type << " " << c.bad)
    BOOST_TEST(first_difference(bad.parameters, bad.written()) == 0u);
  }
}

BOOST_AUTO_TEST_CASE(multiplicity_of_knots_is_judged_by_where_it_is) {
  const auto curve = [](const std::string& knots) {  // degree 2, five poles
    return decode(
        126, 0, "4,2,0,0,1,0," + knots + ",1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,2.,1.,0.,3.,0.,1.,4.,0.,0.,0.,1.,0.,0.,0.");
  };
  BOOST_TEST(!curve("0.,0.,0.,0.3,0.6,1.,1.,1.").has("IG-E126-05"));
  const Decoded corner = curve("0.,0.,0.,0.5,0.5,1.,1.,1.");
  BOOST_REQUIRE(corner.has("IG-E126-05"));
  BOOST_TEST(corner.report.count(Severity::Info) > 0u);
  BOOST_TEST(!corner.record.is_raw());
  const Decoded end = curve("0.,0.,0.,0.,0.5,1.,1.,1.");
  BOOST_TEST(end.has("IG-E126-05"));
  BOOST_TEST(end.record.is_raw());
  const Decoded apart =
      decode(126, 0,
             "5,2,0,0,1,0,0.,0.,0.,.5,.5,.5,1.,1.,1.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,2.,1.,0.,3.,0.,1.,"
             "4.,0.,0.,5.,0.,0.,0.,1.,0.,0.,0.");
  BOOST_TEST(apart.has("IG-E126-05"));
  BOOST_TEST(!apart.record.is_raw());
}

// I51: one curve, a planar open polynomial one with clamped knots, under all 16 claims about itself.
BOOST_AUTO_TEST_CASE(each_lying_flag_is_named_and_no_other) {
  for (int flags = 0; flags < 16; ++flags) {
    const bool planar = flags & 1, closed = flags & 2, polynomial = flags & 4, periodic = flags & 8;
    std::string text = "2,2,a,b,c,d,0.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,1.,0.,2.,0.,0.,0.,1.,0.,0.,1.";
    for (const auto& [letter, flag] : {std::pair{'a', planar}, {'b', closed}, {'c', polynomial}, {'d', periodic}})
      text[text.find(letter)] = flag ? '1' : '0';
    const Decoded decoded = decode(126, 0, text);
    BOOST_TEST_CONTEXT(text) {
      BOOST_TEST(!decoded.record.is_raw());
      BOOST_TEST(decoded.has("IG-E126-09") == !planar);
      BOOST_TEST(decoded.has("IG-E126-11") == closed);
      BOOST_TEST(decoded.has("IG-E126-12") == !polynomial);
      BOOST_TEST(decoded.has("IG-E126-13") == periodic);
      BOOST_TEST(first_difference(decoded.parameters, decoded.written()) == 0u);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_finding_names_its_place) {
  const Decoded decoded = decode(126, 0, "1,1,1,0,1,0,0.,0.,1.,1.,1.,0.,0.,0.,0.,1.,0.,0.,0.,1.,0.,0.,1.");
  BOOST_REQUIRE(decoded.report.items().size() >= 1);
  const auto& items = decoded.report.items();
  const auto weight =
      std::find_if(items.begin(), items.end(), [](const Diagnostic& d) { return d.rule->id == "IG-E126-07"; });
  BOOST_REQUIRE(weight != items.end());
  BOOST_TEST(weight->entity == "D39");
  BOOST_TEST(weight->type == "126:0");
  BOOST_TEST(weight->parameter == 12);
  BOOST_TEST(weight->measured == 0);
  BOOST_TEST(weight->limit == 0);
  BOOST_TEST(weight->location.section == 'P');
  BOOST_REQUIRE(weight->location.offset < decoded.file->bytes().size());
  BOOST_TEST(decoded.file->bytes().substr(weight->location.offset, 3) == "0.,");
  const LineColumn place = LineIndex(decoded.file->bytes()).locate(weight->location.offset);
  BOOST_TEST(weight->location.line == place.line);
  BOOST_TEST(weight->location.column == place.column);
}

BOOST_AUTO_TEST_CASE(good_entities_have_no_findings_beyond_hints) {
  const IgesText text = stock_file();
  for (std::size_t i = 0; i < text.entities.size(); ++i) {
    const Decoded decoded = decode(text, static_cast<int>(2 * i + 1));
    for (const Diagnostic& finding : decoded.report.items())
      BOOST_TEST(static_cast<int>(finding.severity) <= static_cast<int>(Severity::Hint),
                 finding.rule->id << " " << finding.entity << " " << finding.type << ": " << finding.text);
  }
}
