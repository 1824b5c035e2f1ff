// The index and the tape: editions 1 to 3, and what real files do to the grammar.

#include <fmt/format.h>

#include <boost/test/unit_test.hpp>

#include "formats/step/container.h"
#include "formats/step/file.h"
#include "formats/step/rules.h"
#include "formats/step/tape.h"

using namespace trimloop;
using namespace trimloop::step;

namespace {

const std::string head = "ISO-10303-21;HEADER;FILE_DESCRIPTION((''),'2;1');FILE_NAME('n','2026-01-01T00:00:00',('a'),('o'),'p','s','');"
                         "FILE_SCHEMA(('CONFIG_CONTROL_DESIGN'));ENDSEC;";
const std::string tail = "END-ISO-10303-21;";

struct Read {
  Report report;
  File file;
  explicit Read(const std::string& text) : file(File::parse(text, Limits{}, report)) {}
};

Read in_data(const std::string& instances) { return Read(head + "DATA;" + instances + "ENDSEC;" + tail); }

}  // namespace

BOOST_AUTO_TEST_SUITE(step_index)

BOOST_AUTO_TEST_CASE(instances_have_names_keywords_and_places) {
  const Read r = in_data("#10=CARTESIAN_POINT('',(0.,0.,0.));\n#0007 = /* why not */ DIRECTION ( 'a;b', (1.,0.,0.) ) ;");
  BOOST_TEST(r.report.items().empty());
  BOOST_REQUIRE(r.file.instances().size() == 2u);
  const Instance* point = r.file.find({10});
  const Instance* direction = r.file.find({7});  // leading zeros do not distinguish
  BOOST_REQUIRE(point);
  BOOST_REQUIRE(direction);
  BOOST_TEST(r.file.keyword(*point).name == "CARTESIAN_POINT");
  BOOST_TEST(r.file.is(*point, Entity::Point));
  BOOST_TEST(!r.file.is(*direction, Entity::Point));
  BOOST_TEST(r.file.value(*point) == "CARTESIAN_POINT('',(0.,0.,0.))");
  BOOST_TEST(r.file.text(*direction).back() == ';');
  BOOST_TEST(r.file.header().originating_system == "s");
  BOOST_TEST(r.file.find({11}) == nullptr);
}

BOOST_AUTO_TEST_CASE(complex_instances_are_all_their_parts) {
  const Read r = in_data("#1=(BOUNDED_CURVE()B_SPLINE_CURVE(2,(#2),.U.,.F.,.F.)RATIONAL_B_SPLINE_CURVE((1.)));");
  const Instance& i = r.file.instances().front();
  BOOST_TEST(r.file.keyword(i).name == "BOUNDED_CURVE+B_SPLINE_CURVE+RATIONAL_B_SPLINE_CURVE");
  BOOST_TEST(r.file.is(i, Entity::RationalBSplineCurve));
  BOOST_TEST(r.file.is(i, Entity::Curve));
  BOOST_TEST(r.report.count("SP-F30") == 0u);
  BOOST_TEST(in_data("#1=(B()A());").report.count("SP-F30") == 1u);
}

BOOST_AUTO_TEST_CASE(edition_2_and_3_sections) {
  const Read r(head + "ANCHOR;<root>=#1;ENDSEC;REFERENCE;#9=<http://example.invalid/x#a>;ENDSEC;DATA('one',('A'));#1=A();ENDSEC;" +
               "DATA('two',('B'));#2=B(<root>);ENDSEC;" + tail + "\nSIGNATURE;\nabc=\nENDSEC;\n");
  BOOST_TEST(r.file.instances().size() == 2u);
  BOOST_REQUIRE(r.file.anchors().size() == 1u);
  BOOST_TEST(r.file.anchors().front().item == "#1");
  BOOST_REQUIRE(r.file.references().size() == 1u);
  BOOST_TEST(r.file.references().front().uri == "<http://example.invalid/x#a>");
  BOOST_REQUIRE(r.file.sections().size() == 6u);
  BOOST_TEST(r.file.sections()[4].name == "two");
  BOOST_TEST(r.report.count("SP-F34") == 1u);
  BOOST_TEST(r.report.count("SP-F03") == 0u);
  BOOST_TEST(r.report.count(Severity::Error) == 0u);
}

BOOST_AUTO_TEST_CASE(scopes_of_edition_1_are_opened) {
  const Read r = in_data("#5=&SCOPE #1=A(); #2=B(); ENDSCOPE /#1/ C(#1,#2); #6=D(#5);");
  BOOST_TEST(r.file.instances().size() == 4u);
  BOOST_REQUIRE(r.file.find({5}));
  BOOST_TEST(r.file.keyword(*r.file.find({5})).name == "C");
  BOOST_TEST(r.report.items().empty());
}

BOOST_AUTO_TEST_CASE(a_missing_semicolon_costs_nothing_but_a_finding) {
  const Read r = in_data("#1=A(1)\n#2=B(2);#3=C('x');");
  BOOST_TEST(r.file.instances().size() == 3u);
  BOOST_TEST(r.report.count("SP-F18") == 1u);
}

BOOST_AUTO_TEST_CASE(an_open_string_ends_before_the_next_instance) {
  const Read r = in_data("#1=A('open);\n#2=B('y');\n#3=C('z');");
  BOOST_TEST(r.report.count("SP-F20") == 1u);
  BOOST_TEST(r.file.find({2}) != nullptr);
  BOOST_TEST(r.file.find({3}) != nullptr);
}

BOOST_AUTO_TEST_CASE(strings_hide_everything) {
  const Read r = in_data("#1=A('it''s; #9=X(); /* no */','\\S\\''', 'a'',def');#2=B();");
  BOOST_TEST(r.file.instances().size() == 2u);
  BOOST_TEST(r.report.items().empty());
}

BOOST_AUTO_TEST_CASE(the_bytes_go_back) {
  const std::string text = head + "DATA;#1=A();\r\n#2 = B ( );ENDSEC;" + tail + "  rest";
  Report report;
  BOOST_TEST(File::parse(text, Limits{}, report).write() == text);
}

BOOST_AUTO_TEST_CASE(schemas_are_known_by_name_and_identifier) {
  BOOST_TEST(protocol_of({"AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 3 1 4 }"}) == "AP242 edition 2");
  BOOST_TEST(protocol_of({"automotive_design {1 0 10303 214 3 1 1}"}) == "AP214 edition 3");
  BOOST_TEST(protocol_of({"CONFIG_CONTROL_DESIGN"}) == "AP203");
  BOOST_TEST(protocol_of({"SOMETHING"}).empty());
}

BOOST_AUTO_TEST_CASE(findings_get_lines_and_columns) {
  Read r(head + "\nDATA;\n#1=A();\n  #0=B();\nENDSEC;\n" + tail);
  r.file.locate(r.report);
  BOOST_REQUIRE(r.report.items().size() == 1u);
  BOOST_TEST(r.report.items().front().location.line == 4u);
  BOOST_TEST(r.report.items().front().location.column == 3u);
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(step_tape)

BOOST_AUTO_TEST_CASE(values_of_every_kind) {
  Tape t;
  BOOST_REQUIRE(t.read("A($,*,-5,1.5E-3,'x',.T.,\"1F\",#7,(1.,2.),LENGTH_MEASURE(3.),<a>)", Limits{}));
  BOOST_TEST(t.faults().empty());
  using Kind = Token::Kind;
  const Kind wanted[] = {Kind::Unset, Kind::Derived, Kind::Integer, Kind::Real, Kind::String, Kind::Enumeration, Kind::Binary,
                         Kind::Reference, Kind::List, Kind::Typed, Kind::Anchor};
  std::uint32_t i = t.parts().front().first;
  for (const Kind k : wanted) {
    BOOST_REQUIRE(i < t.size());
    BOOST_TEST((t[i].kind == k));
    i = t[i].end;
  }
  BOOST_TEST(i == t.size());
  BOOST_TEST(t[2].integer == -5);
  BOOST_TEST(t[3].real == 1.5e-3);
}

BOOST_AUTO_TEST_CASE(reals_are_read_to_the_last_bit) {
  Tape t;
  for (const char* text : {"0.1", "3.1415926535897931", "1.7976931348623157E+308", "2.2250738585072014E-308", "123456789012345678901234567890.",
                           "0.30000000000000004", "9007199254740993.", "-1.E22", "1.E23", "4.9406564584124654E-324"}) {
    BOOST_REQUIRE(t.read(fmt::format("A({})", text), Limits{}));
    BOOST_TEST(t[0].real == std::strtod(text, nullptr), text);
  }
}

BOOST_AUTO_TEST_CASE(oddities_are_read_and_told) {
  const auto fault = [](const char* text) {
    Tape t;
    t.read(text, Limits{});
    return t.faults().empty() ? -1 : static_cast<int>(t.faults().front().kind);
  };
  using Kind = Fault::Kind;
  BOOST_TEST(fault("A(.5)") == static_cast<int>(Kind::RealForm));
  BOOST_TEST(fault("A(1E5)") == static_cast<int>(Kind::RealForm));
  BOOST_TEST(fault("A(1.D0)") == static_cast<int>(Kind::RealForm));
  BOOST_TEST(fault("A(1.E)") == static_cast<int>(Kind::RealForm));
  BOOST_TEST(fault("A(NaN)") == static_cast<int>(Kind::RealForm));
  BOOST_TEST(fault("A(1.E+999)") == static_cast<int>(Kind::RealOverflow));
  BOOST_TEST(fault("A(99999999999999999999)") == static_cast<int>(Kind::IntegerOverflow));
  BOOST_TEST(fault("A(.t.)") == static_cast<int>(Kind::EnumForm));
  BOOST_TEST(fault("A(.TRUE)") == static_cast<int>(Kind::EnumForm));
  BOOST_TEST(fault("A(..)") == static_cast<int>(Kind::EnumForm));
  BOOST_TEST(fault("A(\"4FF\")") == static_cast<int>(Kind::BinaryForm));
  BOOST_TEST(fault("A(\"\")") == static_cast<int>(Kind::BinaryForm));
  BOOST_TEST(fault("A(1,,2)") == static_cast<int>(Kind::Separator));
  BOOST_TEST(fault("A(1,)") == static_cast<int>(Kind::Separator));
  BOOST_TEST(fault("A(1") == static_cast<int>(Kind::Unterminated));
  BOOST_TEST(fault("A(1,2.)") == -1);
}

BOOST_AUTO_TEST_CASE(nesting_has_a_ceiling_and_no_stack) {
  Tape t;
  const std::string deep = "A(" + std::string(1'000'000, '(') + std::string(1'000'000, ')') + ")";
  BOOST_TEST(!t.read(deep, Limits{}));
  BOOST_REQUIRE(!t.faults().empty());
  BOOST_TEST((t.faults().front().kind == Fault::Kind::Depth));
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(step_container)

// printf 'ISO-10303-21;' | gzip -9n
const unsigned char gz[] = {0x1f, 0x8b, 0x08, 0x00, 0x00, 0x00, 0x00, 0x00, 0x02, 0x03, 0xf3, 0x0c, 0xf6, 0xd7, 0x35, 0x34, 0x30,
                            0x36, 0x30, 0xd6, 0x35, 0x32, 0xb4, 0x06, 0x00};

BOOST_AUTO_TEST_CASE(damaged_archives_are_refused) {
  Report report;
  const std::string cut(reinterpret_cast<const char*>(gz), sizeof gz);
  BOOST_TEST(!unpack(cut, Limits{}, report));  // its check sum is missing
  BOOST_TEST(report.has_fatal());
  Report zip;
  BOOST_TEST(!unpack("PK\3\4 and no directory", Limits{}, zip));
  BOOST_TEST(zip.count("SP-F35") == 1u);
}

BOOST_AUTO_TEST_SUITE_END()
